"""The equations that close a linkage, and their derivatives."""

from __future__ import annotations

from dataclasses import dataclass

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.derivation import Phrase, Step
from derive.expression import ZERO, Expr, Symbol, add, column, cos, sin
from derive.kinds.mechanism import _four_bar, _slider_crank
from derive.kinds.mechanism._assemblies import Closed
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.linkages import FourBar, SliderCrank
from derive.names import free

Sides = tuple[Expr, Expr]
THETA_3 = Symbol("theta_3")


@dataclass(frozen=True)
class Loop:
    """Two equations, along x and along y; the angle of the crank, and the coordinates that it moves."""

    along: Sides
    across: Sides
    angle: Symbol
    unknown: tuple[Symbol, Symbol]

    def steps(self) -> tuple[Step, Step]:
        """The equations as lines."""
        return Step("along", self.along, "in-numbers"), Step("across", self.across, "in-numbers")

    def jacobian(self, *by: Symbol) -> ScalarMatrix:
        """The derivatives of left less right, a row for each equation."""
        gaps = [normal(left) - normal(right) for left, right in (self.along, self.across)]
        return ScalarMatrix.of([[gap.diff(name.name) for name in by] for gap in gaps])

    @property
    def rates(self) -> Expr:
        """Those of the unknown coordinates."""
        return column([rate(name) for name in self.unknown])


def closed(linkage: FourBar | SliderCrank, problem: Problem) -> Closed:
    """The linkage in each of its assemblies."""
    if isinstance(linkage, FourBar):
        return _four_bar.closed(linkage, Work(problem))
    return _slider_crank.closed(linkage, Work(problem))


def loop_of(linkage: FourBar | SliderCrank, work: Work) -> tuple[Work, Loop]:
    """Once around, along the crank and what it drives, and back; on a board with the names of the bars."""
    if isinstance(linkage, FourBar):
        work, names = _four_bar.lengths(linkage, work)
        last = Symbol("theta_4")
        back = (add(names["d"], names["c"] * cos(last)), names["c"] * sin(last))
    else:
        work, names = _slider_crank.lengths(linkage, work)
        last = Symbol(free(work.problem.taken, "s", "s_p"))
        back = (last, names.get("e", ZERO))
    a, b, theta = (names[name] for name in ("a", "b", "theta"))
    there = (a * cos(theta) + b * cos(THETA_3), a * sin(theta) + b * sin(THETA_3))
    return work, Loop((there[0], back[0]), (there[1], back[1]), theta, (THETA_3, last))


def rate(name: Symbol) -> Symbol:
    """theta_2_dot."""
    return Symbol(f"{name.name}_dot")


def units_of(problem: Problem, place: Symbol) -> dict[Expr | Phrase, str]:
    """Those of the place of a slider and of its rate, where units were typed."""
    if not problem.style.units:
        return {}
    turning: list[Expr] = [rate(Symbol(name)) for name in ("theta_3", "theta_4")]
    return {place: "m", rate(place): "m/s", **dict.fromkeys(turning, "rad/s")}
