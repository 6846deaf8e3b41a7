"""Frames as an exercise gives them: by observed axes, by a matrix, or by a motion."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

from derive.expression import Expr, Matrix
from derive.mechanics.motion import Motion


@dataclass(frozen=True, slots=True)
class Observed:
    """Axes read off a figure: each is a combination (3 coefficients) of the parent's x, y, z. `rounded`
    are the places to which its author rounded them, where the nearest rotation stands for what was typed."""

    x: tuple[Expr, Expr, Expr]
    y: tuple[Expr, Expr, Expr]
    z: tuple[Expr, Expr, Expr]
    origin: tuple[Expr, Expr, Expr]
    rounded: int = 0


@dataclass(frozen=True, slots=True)
class ByMatrix:
    """A homogeneous transform (4 by 4) or a rotation (3 by 3) written out; `rounded` as above."""

    matrix: Matrix
    rounded: int = 0


FrameSource: TypeAlias = Observed | ByMatrix | Motion


@dataclass(frozen=True, slots=True)
class Frame:
    """Frame `number`, given in the coordinates of frame `parent` (0 is the world)."""

    number: int
    parent: int
    source: FrameSource


@dataclass(frozen=True, slots=True)
class Frames:
    """The frames 1, 2, ... of an exercise; each parent comes before its child. `again` gives some of them
    a second time, in other frames: each closes a loop."""

    frames: tuple[Frame, ...]
    again: tuple[Frame, ...] = ()
