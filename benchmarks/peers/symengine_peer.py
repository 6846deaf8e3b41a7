"""symengine with the textbook's formulas, every entry expanded."""

from __future__ import annotations

from collections.abc import Sequence

import symengine

from benchmarks.cases import Asked
from benchmarks.peers import Point, formulas
from benchmarks.rows import rows_of
from derive.mechanics.robot import Robot


def given(robot: Robot) -> formulas.Given:
    return formulas.read(rows_of(robot), symengine)


def derive(given: formulas.Given, asked: Sequence[Asked]) -> formulas.Answer:
    return formulas.derive(given, asked, symengine.expand)


def check(answer: formulas.Answer, point: Point) -> float:
    return formulas.check(answer, point, symengine)
