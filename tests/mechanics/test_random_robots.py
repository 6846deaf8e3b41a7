"""Laws and oracles over random robots: up to seven joints, revolute and prismatic in any order, rows of
either convention and free ones, twists and offsets of all kinds, with a base and a tool."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from derive.algebra import bounds
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.scalar import Scalar
from derive.expression import ZERO, Degrees, Expr, Symbol, add, number
from derive.kinds.checks import random_points
from derive.mechanics.bodies import Body, Moments
from derive.mechanics.chain import chain
from derive.mechanics.jacobian import jacobian
from derive.mechanics.motion import Axis, Move
from derive.mechanics.oracle import Oracle
from derive.mechanics.poses import position_part, rotation_part
from derive.mechanics.robot import DHRow, FreeRow, Link, Robot
from tests.mechanics.robots import array, symbols
from tests.mechanics.two_derivations import Arm, torques


@pytest.fixture(scope="module", autouse=True)
def _no_bounds() -> Iterator[None]:
    """Some random arms are longer than any page could hold."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(bounds, "MOST_PRODUCTS", 10**12)
        patch.setattr(bounds, "MOST_IN_PRODUCT", 10**12)
        yield


MOST = 7
MOST_IN_MOTION = 4
LONG_ARM_MOMENTS = (number("1/10"), number("1/7"), number("1/6"), ZERO, ZERO, number("1/30"))
AXES: tuple[Axis, ...] = ("x", "y", "z", (number(2), number(1), number(2)))


def turns(*names: str) -> st.SearchStrategy[Expr]:
    """0, multiples of 90, 45 and 30 degrees, angles with names, and one of them with 45 degrees more."""
    fixed = [Degrees(Fraction(n)) for n in (90, -90, 180, 45, -135, 30, 60, -150)]
    named = [Symbol(name) for name in names]
    return st.sampled_from(
        (ZERO, ZERO, *fixed, *named, *(add(name, Degrees(Fraction(45))) for name in named))
    )


def lengths(name: str) -> st.SearchStrategy[Expr]:
    return st.sampled_from((ZERO, Symbol(name), number("1/2")))


def variables(name: str) -> st.SearchStrategy[Expr]:
    """A joint angle as it stands in a table: alone or with an offset."""
    more = (ZERO, ZERO, Degrees(Fraction(90)), Degrees(Fraction(-30)), Degrees(Fraction(180)), Symbol("beta"))
    return st.sampled_from([add(Symbol(name), offset) for offset in more])


@dataclass(frozen=True)
class Place:
    """Which row, and whether it carries a body."""

    i: int
    weighs: bool

    @property
    def body(self) -> Body | None:
        """A com off the axes and one product of inertia."""
        if not self.weighs:
            return None
        I = Symbol(f"I{self.i}")
        moments = (I, Symbol(f"J{self.i}"), I, ZERO, ZERO, Symbol(f"K{self.i}"))
        return Body(Symbol(f"m{self.i}"), (Symbol(f"x{self.i}"), ZERO, number("1/3")), Moments(moments))


@st.composite
def dh_rows(draw: st.DrawFn, place: Place) -> Link:
    i = place.i
    a, alpha = draw(lengths(f"a{i}")), draw(turns("alpha"))
    if draw(st.sampled_from((True, True, False))):
        row = DHRow(draw(variables(f"q{i}")), draw(lengths(f"d{i}")), a, alpha)
        return Link(row, "revolute", f"q{i}", place.body)
    row = DHRow(draw(turns("gamma")), Symbol(f"q{i}"), a, alpha)
    return Link(row, "prismatic", f"q{i}", place.body)


@st.composite
def free_rows(draw: st.DrawFn, place: Place) -> Link:
    """Moves before and after a joint about any axis; now and then a row without a joint."""
    i, axes = place.i, st.sampled_from(AXES)
    before = Move("translate", draw(axes), Symbol(f"b{i}"))
    after = Move("rotate", draw(axes), draw(turns("alpha")))
    kind = draw(st.sampled_from(("revolute", "prismatic", "fixed")))
    if kind == "revolute":
        moves = (before, Move("rotate", draw(axes), draw(variables(f"q{i}"))), after)
        return Link(FreeRow(moves), "revolute", f"q{i}", place.body)
    if kind == "prismatic":
        moves = (before, Move("translate", draw(axes), Symbol(f"q{i}")), after)
        return Link(FreeRow(moves), "prismatic", f"q{i}", place.body)
    return Link(FreeRow((before, after)), "fixed", None, place.body)


@st.composite
def robots(draw: st.DrawFn, most: int, weighs: bool = False) -> Robot:
    """At least one joint and, with bodies, one on every link."""
    count = draw(st.integers(1, most))
    rows = [draw(dh_rows(Place(1, weighs)))]
    for i in range(2, count + 1):
        place = Place(i, weighs)
        rows.append(draw(st.one_of(dh_rows(place), dh_rows(place), dh_rows(place), free_rows(place))))
    base = draw(
        st.sampled_from(
            ((), (Move("translate", "z", Symbol("b")), Move("rotate", "y", Degrees(Fraction(30)))))
        )
    )
    tool = draw(
        st.sampled_from(((), (Move("rotate", "x", Symbol("delta")), Move("translate", "z", Symbol("h")))))
    )
    convention = draw(st.sampled_from(("standard", "modified")))
    return Robot("", convention, tuple(rows), base, tool)


@st.composite
def long_arms(draw: st.DrawFn) -> Robot:
    """Five to seven joints of both types, standard or modified, with numbers for all but the joints."""
    twists = st.sampled_from([Degrees(Fraction(n)) for n in (0, 90, -90, 90, -90, 180, 45, -30)])
    length = st.sampled_from((ZERO, number("1/2"), number("3/4")))
    rows = []
    for i in range(1, draw(st.integers(5, MOST)) + 1):
        body = Body(number(i), (number("1/5"), ZERO, number(f"1/{i + 2}")), Moments(LONG_ARM_MOMENTS))
        q, a, alpha = Symbol(f"q{i}"), draw(length), draw(twists)
        if draw(st.sampled_from((True, True, False))):
            row = DHRow(add(q, draw(twists)), draw(length), a, alpha)
            rows.append(Link(row, "revolute", q.name, body))
        else:
            rows.append(Link(DHRow(draw(twists), q, a, alpha), "prismatic", q.name, body))
    return Robot("", draw(st.sampled_from(("standard", "modified"))), tuple(rows))


@settings(max_examples=25)
@given(robots(MOST))
def test_poses(arm: Robot) -> None:
    """R^T R = 1 and det R = 1 exactly; the numbers are those of motions composed by Rodrigues' formula."""
    found, oracle = chain(arm), Oracle(arm, {})
    R = rotation_part(found.T_tool)
    assert ScalarMatrix.identity(3) == R.T @ R
    assert R.det() == 1
    for at in random_points(symbols(arm), 2):
        assert np.allclose(array(found.T_tool, at), oracle.tool(at), atol=1e-9)
        assert np.allclose(array(found.T[-1], at), oracle.poses(at)[-1], atol=1e-9)


@settings(max_examples=25)
@given(robots(MOST))
def test_jacobians(arm: Robot) -> None:
    """Linear columns are derivatives of the position; S(z) R those of R; numbers by differences."""
    found = chain(arm)
    p, R = position_part(found.T_tool), rotation_part(found.T_tool)
    J = jacobian(found, p, len(arm.links))
    for k, name in enumerate(found.variables):
        column = J.columns(k)
        assert p.diff(name) == column.block(slice(0, 3), slice(None))
        x, y, z = column.entries[3:]
        S = ScalarMatrix.of([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        assert R.diff(name) == S @ R
    at = next(random_points(symbols(arm), 1))
    by_differences = Oracle(arm, {}).jacobian(at, len(arm.links) + 1, (0, 0, 0))
    assert np.allclose(array(J, at), by_differences, atol=1e-6)


@settings(max_examples=14)
@given(robots(MOST_IN_MOTION, weighs=True))
def test_dynamics(arm_in_rows: Robot) -> None:
    assert_dynamics(arm_in_rows)


@settings(max_examples=8)
@given(long_arms())
def test_dynamics_of_long_arms(arm_in_rows: Robot) -> None:
    assert_dynamics(arm_in_rows)


def assert_dynamics(arm_in_rows: Robot) -> None:
    """Both derivations are equal, D is symmetric, dD/dt - 2 C skew, and the numbers are the oracle's."""
    arm, names = Arm(arm_in_rows), arm_in_rows.variables
    D, c, g = found = arm.by_jacobians()
    D_of_forces, c_of_forces, g_of_forces = arm.by_forces()
    assert D.T == D
    assert D_of_forces == D
    assert all(c[key] == c_of_forces[key] for key in c)
    assert all(map(Scalar.__eq__, g, g_of_forces))
    n = range(len(names))
    slopes = [D.diff(name) for name in names]
    for i, j, k in product(n, repeat=3):
        assert c[i + 1, j + 1, k + 1] + c[i + 1, k + 1, j + 1] == slopes[i][k, j]
    points = arm.points(1)
    theirs = np.array([arm.in_numbers(at) for at in points])
    assert np.allclose(torques(found, names, points), theirs, atol=1e-9 * max(1, np.abs(theirs).max()))
