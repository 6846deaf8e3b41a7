"""Robots for tests: from rows as a textbook prints them, and random ones."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

import numpy as np
from hypothesis import strategies as st

from derive.algebra.formulas.grammar import parse, parse_starred
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.numbers.floats import matrix_numbers
from derive.expression import Degrees, Expr, Symbol, free_symbols
from derive.kinds.problem import Problem, expressions
from derive.mechanics.bodies import Body, Moments
from derive.mechanics.motion import Move
from derive.mechanics.robot import Convention, DHRow, Link, Robot

Numbers = Any


def row(theta: str, d: str, a: str, alpha: str, body: Body | None = None) -> Link:
    """A DH row with a star at its joint variable."""
    (angle, revolute), (offset, prismatic) = parse_starred(theta), parse_starred(d)
    variable = revolute or prismatic
    joint = "revolute" if revolute else "prismatic" if prismatic else "fixed"
    return Link(DHRow(angle, offset, parse(a), parse(alpha)), joint, variable, body)


def robot(
    *links: Link, convention: Convention = "standard", gravity: str = "0, 0, -g", tool: str = "0"
) -> Robot:
    """`tool` is a length along z of the last frame."""
    x, y, z = map(parse, gravity.split(","))
    end = () if tool == "0" else (Move("translate", "z", parse(tool)),)
    return Robot("", convention, links, tool=end, gravity=(x, y, z))


def body(mass: str, com: str, inertia: str) -> Body:
    """Centre of mass and Ixx, Iyy, Izz, Ixy, Iyz, Ixz separated by commas."""
    cx, cy, cz = map(parse, com.split(","))
    xx, yy, zz, xy, yz, xz = map(parse, inertia.split(","))
    return Body(parse(mass), (cx, cy, cz), Moments((xx, yy, zz, xy, yz, xz)))


def problem(arm: Robot, **where: str) -> Problem:
    return Problem("robot", arm, {name: parse(value) for name, value in where.items()})


def array(value: ScalarMatrix, at: Mapping[str, float]) -> Numbers:
    return np.array(matrix_numbers(value, at))


def symbols(arm: Robot) -> list[str]:
    return sorted(frozenset().union(*map(free_symbols, expressions(arm))))


# -- random arms ---------------------------------------------------------------------------------------

TWISTS: tuple[Expr, ...] = (
    *(Degrees(Fraction(n)) for n in (0, 90, -90, 45, -45, 30, 60, 180)),
    Symbol("alpha"),
)
OFFSETS: tuple[Expr, ...] = (parse("0"), parse("0"), Symbol("h"), parse("1/2"))


@st.composite
def links(draw: st.DrawFn, i: int, bodies: bool) -> Link:
    twist, length = draw(st.sampled_from(TWISTS)), draw(st.sampled_from((parse("0"), Symbol(f"a{i}"))))
    weight = _weight(i) if bodies else None
    if draw(st.booleans()):
        d = draw(st.sampled_from(OFFSETS))
        return Link(DHRow(Symbol(f"theta{i}"), d, length, twist), "revolute", f"theta{i}", weight)
    turn = draw(st.sampled_from((parse("0"), Degrees(Fraction(90)))))
    return Link(DHRow(turn, Symbol(f"d{i}"), length, twist), "prismatic", f"d{i}", weight)


def _weight(i: int) -> Body:
    return body(f"m{i}", f"-a{i}/2, 0, c{i}", f"I{i}, 2*I{i}, 2*I{i}, 0, 0, I{i}/4")


@st.composite
def robots(draw: st.DrawFn, most: int = 4, bodies: bool = False) -> Robot:
    """Arms of one to `most` joints: mixed joints, and twists of 90, 45, 30 degrees and by name."""
    rows = tuple(draw(links(i, bodies)) for i in range(1, draw(st.integers(1, most)) + 1))
    return Robot("", draw(st.sampled_from(("standard", "modified"))), rows)
