"""Who takes part, in the order of the table.

Each peer is a module: `NEEDS`, the modules it imports besides ours; `given(robot)`, the robot in its
own terms (not timed); `derive(given, asked)`, the derivation (timed), which may raise CannotDo; and
`check(answer, point)`, one number of the answer by which it is compared with ours.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass


class CannotDo(Exception):
    """A peer has no way of deriving what is asked; the message says what is missing."""


@dataclass(frozen=True, slots=True)
class Peer:
    """`module` in this package; `remark` says where its answer is less than what is asked."""

    name: str
    module: str
    remark: str = ""


PEERS = (
    Peer("derive", "ours"),
    Peer("SymPy, textbook", "textbook", "nothing simplified"),
    Peer("SymPy, trigsimp", "trigsimp", "the same, every entry through `expand` and `trigsimp`"),
    Peer("Lagrange", "lagrange", "sympy.physics.mechanics: mass matrix and forces, no single c_ijk"),
    Peer("Kane", "kane", "sympy.physics.mechanics: mass matrix and forces, no single c_ijk"),
    Peer("symengine", "symengine_peer", "the textbook's formulas in C++, expanded, nothing recognised"),
    Peer("RTB", "toolbox", "roboticstoolbox-python: recursive Newton-Euler at unit rates, unsimplified"),
    Peer("skidy", "skidy_peer", "screws; M, C and gravity, no single c_ijk, unsimplified"),
)

Point = Mapping[str, float]
