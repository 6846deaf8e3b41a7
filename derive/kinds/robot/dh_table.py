"""The table of link parameters after Denavit and Hartenberg."""

from __future__ import annotations

from derive.derivation import Derivation, Step, Table
from derive.errors import NotDerivable
from derive.expression import MINUS_ONE, Expr, Indexed, Matrix, Sum, Symbol, number, replace
from derive.kinds.fields import OptionsModel
from derive.kinds.problem import Problem
from derive.mechanics.robot import DHRow, Robot

RESULTS = {"DH": "one row a link: theta, d, a, alpha; the joint variable unstarred"}
EXAMPLE = """\
title: Link parameters
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: a1, alpha: 0}
    - {theta: theta2*, d: 0, a: a2, alpha: 0}
  find: dh-table
"""
COLUMNS = ("theta", "d", "a", "alpha")


class Options(OptionsModel):
    """None."""


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """The rows as given, each joint variable marked; in the modified convention a and alpha are
    those of the axis before (a_{i-1}, alpha_{i-1})."""
    rows = [link.row for link in robot.links]
    if not all(isinstance(row, DHRow) for row in rows):
        free = [str(i) for i, row in enumerate(rows, 1) if not isinstance(row, DHRow)]
        raise NotDerivable(f"row {', '.join(free)} is a free motion and has no Denavit-Hartenberg parameters")
    values = tuple(_values(row) for row in rows if isinstance(row, DHRow))
    joints = [link.variable for link in robot.links]
    facts = {
        "convention": robot.convention,
        "revolute": [Symbol(link.variable or "") for link in robot.links if link.joint == "revolute"],
        "prismatic": [Symbol(link.variable or "") for link in robot.links if link.joint == "prismatic"],
        "table": _table(robot, values, joints),
    }
    return Derivation(
        "dh-table",
        (Step("DH", (), "dh-parameters"),),
        {"DH": Matrix(tuple(tuple(problem.final(entry) for entry in row) for row in values))},
        facts=facts,
    )


def _values(row: DHRow) -> tuple[Expr, Expr, Expr, Expr]:
    return row.theta, row.d, row.a, row.alpha


def _table(robot: Robot, rows: tuple[tuple[Expr, ...], ...], joints: list[str | None]) -> Table:
    """Under theta_i, d_i, a_i, alpha_i (a_{i-1}, alpha_{i-1} where modified); joint variables starred."""
    before = robot.convention == "modified"
    headings = [Indexed(name, (_index(before and name in ("a", "alpha")),)) for name in COLUMNS]
    lines = [
        (number(i), *(_starred(entry, joint) for entry in row))
        for i, (row, joint) in enumerate(zip(rows, joints, strict=True), 1)
    ]
    return Table((Symbol("i"), *headings), tuple(lines))


def _index(before: bool) -> Expr:
    return Sum((Symbol("i"), MINUS_ONE)) if before else Symbol("i")


def _starred(entry: Expr, variable: str | None) -> Expr:
    return entry if variable is None else replace(entry, {Symbol(variable): Symbol(f"{variable}*")})
