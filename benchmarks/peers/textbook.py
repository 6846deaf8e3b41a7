"""SymPy with the textbook's formulas, nothing simplified."""

from __future__ import annotations

from collections.abc import Sequence

import sympy

from benchmarks.cases import Asked
from benchmarks.peers import Point, formulas
from benchmarks.rows import rows_of
from derive.mechanics.robot import Robot


def given(robot: Robot) -> formulas.Given:
    return formulas.read(rows_of(robot), sympy)


def derive(given: formulas.Given, asked: Sequence[Asked]) -> formulas.Answer:
    return formulas.derive(given, asked, lambda entry: entry)


def check(answer: formulas.Answer, point: Point) -> float:
    return formulas.check(answer, point, sympy)
