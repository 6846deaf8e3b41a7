"""Link parameters found from axes: textbook tables come back, and lines in any position make the same arm."""

from __future__ import annotations

from itertools import product

import pytest

from derive.algebra.infix import text
from derive.expression import Expr, Symbol, negate, number
from derive.kinds.problem import Problem
from derive.kinds.robot._rows.dh_found import found_rows
from derive.kinds.robot._rows.dh_rows import values
from derive.kinds.work import Work
from derive.mechanics.frames import ByMatrix
from derive.mechanics.robot import Link, Robot, ScrewRow
from tests.kinds.published import matrix
from tests.robots.arms import arm, problem

# A standard table whose choices are those of the convention as made here comes back as it stands.
AS_GIVEN = ["stanford", "planar-2r", "planar-3r", "anthropomorphic", "spherical-wrist", "scara"]


@pytest.mark.parametrize("name", AS_GIVEN)
def test_the_textbook_table_comes_back(name: str) -> None:
    of = problem(name)
    rows, _ = found_rows(of.subject, "standard", of)
    given = [[text(of.final(entry)) for entry in values(link.row)] for link in of.subject.links]
    found = [[text(of.final(entry)) for entry in values(row)] for row in rows.rows]
    assert [row[1:3] for row in found] == [row[1:3] for row in given]
    assert plain(found) == plain(given)


def plain(rows: list[list[str]]) -> list[list[str]]:
    return [["0" if entry in ("0", "0*pi") else entry for entry in row] for row in rows]


def test_craigs_table_comes_back() -> None:
    of = problem("puma560-modified")
    rows, _ = found_rows(of.subject, "modified", of)
    given = [[text(entry) for entry in values(link.row)] for link in of.subject.links]
    assert plain([[text(entry) for entry in values(row)] for row in rows.rows]) == plain(given)


def test_restated_twice_is_the_same_table() -> None:
    from derive.kinds.robot._rows.dh_rows import Rows
    from derive.kinds.robot.dh_table import restated

    robot = arm("puma560-modified")
    variables, joints = zip(*((link.variable, link.joint) for link in robot.links), strict=True)
    given = Rows("modified", tuple(link.row for link in robot.links), variables, joints)
    there = restated(robot, given, "standard")
    standard = Robot(
        "", "standard", tuple(Link(r, j, v) for r, j, v in zip(there.rows, joints, variables, strict=True))
    )
    assert restated(standard, there, "modified").rows[1:] == given.rows[1:]


X, Y, Z = "x", "y", "z"
TILTED = (number("3/5"), number(0), number("4/5"))
OBLIQUE = (number("2/3"), number("-1/3"), number("2/3"))
DOWN = (number(0), number(0), number(-1))
ORIGIN = (number(0),) * 3
AWAY = (Symbol("a"), Symbol("b"), number(0))
SKEWED = (number("1/2"), number(-1), Symbol("h"))
END = ByMatrix(matrix("0,0,1,L\n1,0,0,0\n0,1,0,2\n0,0,0,1"))
LINES: list[tuple[object, tuple[Expr, ...]]] = list(
    product((X, Z, DOWN, TILTED, OBLIQUE), (ORIGIN, AWAY, SKEWED))
)


@pytest.mark.parametrize("convention", ["standard", "modified"])
@pytest.mark.parametrize("first", [(Z, ORIGIN), (X, AWAY), (OBLIQUE, SKEWED)])
@pytest.mark.parametrize("second", LINES)
def test_any_two_lines(convention, first, second) -> None:
    """Skew, meeting, parallel, antiparallel and coincident lines; the claims prove it is the same arm."""
    links = tuple(
        Link(ScrewRow(axis, through, Symbol(f"q{i}")), "revolute", f"q{i}")
        for i, (axis, through) in enumerate((first, second), 1)
    )
    of = Problem("robot", Robot("", "standard", links, home=END))
    rows, _ = found_rows(of.subject, convention, of)
    assert all(claim.holds for claim in rows.proved(rows.lines(Work(of))).claims)


def test_a_slide_and_a_turn() -> None:
    links = (
        Link(ScrewRow(TILTED, ORIGIN, Symbol("d1"), slide=True), "prismatic", "d1"),
        Link(ScrewRow("y", AWAY, negate(negate(Symbol("q2")))), "revolute", "q2"),
    )
    of = Problem("robot", Robot("", "standard", links, home=END))
    for convention in ("standard", "modified"):
        rows, _ = found_rows(of.subject, convention, of)
        assert all(claim.holds for claim in rows.proved(rows.lines(Work(of))).claims)
