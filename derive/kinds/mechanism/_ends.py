"""Where a rocker or a slider is at the ends of its range, the crank and the bar behind it lying in line."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from derive.derivation import Phrase, Step
from derive.expression import ZERO, Call, Expr, Symbol, cos, negate, sqrt, subtract
from derive.kinds.mechanism._facts import EndTold
from derive.kinds.work import Work


@dataclass(frozen=True)
class End:
    """The coordinate of what is moved for each angle of the crank, the step that tells it, and how it goes
    with the angle."""

    values: tuple[Expr, ...]
    step: Step
    said: Phrase

    @property
    def told(self) -> EndTold:
        return EndTold(line=self.step.name, said=self.said)


def of_rocker(work: Work, name: str, reach: Expr, side: int | None, sizes: tuple[Expr, Expr]) -> End | None:
    """By the law of cosines at its pivot; None where nothing says on which side of the ground it is. The tip
    lies on the line of the crank, at the distance `reach`, ahead (`side` 1) or behind
    (-1); `sizes` are those of rocker and ground."""
    theta = Symbol("theta_4")
    if not side:
        return None
    rocker, ground = sizes
    head, formula = cos(theta), (reach**2 - ground**2 - rocker**2) / (2 * ground * rocker)
    angle = Call("acos", (work.problem.final(work.shown(formula)),))
    signed = (angle, negate(angle)) if side > 0 else (negate(angle), angle)
    return End(signed, _told(work, name, head, formula), Phrase("same-side" if side > 0 else "other-side"))


def of_slider(work: Work, name: str, reach: Expr, side: int | None, height: Expr, s: Symbol) -> End | None:
    """By Pythagoras, on either side of the pivot of the crank."""
    if not side:
        return None
    straight = reach**2 if height == ZERO else subtract(reach**2, height**2)
    formula = sqrt(straight)
    place = work.problem.final(work.shown(formula))
    signed = (place, negate(place)) if side > 0 else (negate(place), place)
    return End(signed, _told(work, name, s, formula), Phrase("either-side"))


def _told(work: Work, name: str, head: Expr, formula: Expr) -> Step:
    value = work.shown(formula)
    links: Sequence[Expr] = (head, formula) if value == formula else (head, formula, value)
    return Step(name, tuple(links), "in-numbers")
