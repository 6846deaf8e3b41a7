"""A system drawn as a block diagram, with what its names stand for there."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TypeAlias

from derive.algebra.readable.form import readable
from derive.algebra.scalar import Scalar
from derive.control.controllers import Controller, Loop
from derive.control.diagram import Diagram
from derive.control.rational import Rational
from derive.control.ratios import Ratio, total
from derive.control.roots import roots
from derive.errors import NotDerivable
from derive.expression import ONE, Expr, Symbol, add, multiply
from derive.figures.block_diagram import Wired, drawn, filter_name, gain_names
from derive.kinds.system._plant import Plant, verdict

S = Symbol("s")
FASTER = 100  # the filter behind a derivative against the fastest motion of the loop
Values: TypeAlias = tuple[tuple[Symbol, Expr], ...]


@dataclass(frozen=True, slots=True)
class Answer:
    """A diagram with what it is held to: `transfer` is output over reference with an ideal derivative."""

    plant: Plant
    controller: Controller | None
    transfer: Rational
    diagram: Diagram
    wired: tuple[Wired, ...]
    gains: Values  # names in the diagram, and what was typed for them
    filter: Values  # the time constant of the derivative's filter, where there is one

    @property
    def table(self) -> dict[Expr, Expr]:
        """Everything that has a value."""
        known = {**self.plant.point, **self.plant.problem.names}
        typed: dict[Expr, Expr] = {name: gain for name, gain in self.gains if name != gain}
        return {**known, **typed, **dict[Expr, Expr](self.filter)}


def modelled(solved: Plant, controller: Controller | None, transfer: Rational) -> Answer:
    """The system drawn. Raises NotDerivable."""
    diagram, wired = drawn(solved.system, solved.rational, controller, solved.style)
    if controller is None:
        return Answer(solved, None, transfer, diagram, wired, (), ())
    names = gain_names(controller, solved.system.names)
    gains = tuple(zip(names, controller.gains, strict=True))
    found = _filter(solved, controller, transfer) if controller.differentiates else ()
    return Answer(solved, controller, transfer, diagram, wired, gains, found)


def _filter(solved: Plant, controller: Controller, transfer: Rational) -> Values:
    """A time constant so short that the loop does not notice; a round number."""
    numeric = solved.numeric(transfer)
    fastest = max((abs(pole) for pole in roots(numeric.den)), default=1.0) or 1.0
    name = filter_name(solved.system)
    for shorter in range(4):
        constant = _round_below(1 / (FASTER * fastest)) * Scalar.of(1) / 10**shorter
        found = ((name, readable(constant, solved.style)),)
        loop = Loop(Rational.of(_ratio(solved, controller, name)), solved.rational).closed
        if verdict(solved.numeric(loop.at(dict[Expr, Expr](found))).den) == verdict(numeric.den):
            return found
    raise NotDerivable("a filter behind the derivative, however fast, changes whether this loop is stable")


def _ratio(solved: Plant, controller: Controller, filter_constant: Expr) -> Ratio:
    """The controller with its filter, over one denominator."""
    parts = _filtered(controller.terms, filter_constant)
    return total((Ratio.of(part) for part in parts), solved.style)


def _filtered(terms: tuple[Expr, ...], constant: Expr) -> tuple[Expr, ...]:
    """The terms of a controller, the last, its derivative, behind a filter."""
    return (*terms[:-1], terms[-1] / (multiply(constant, S) + ONE))


def _round_below(size: float) -> Scalar:
    """The next of 1, 2, 5 times a power of ten that is not larger."""
    power = math.floor(math.log10(size))
    lead = next(digit for digit in (5, 2, 1) if digit <= size / 10.0**power * (1 + 1e-9))
    ten = Scalar.of(10) ** abs(power)
    return Scalar.of(lead) * ten if power >= 0 else Scalar.of(lead) / ten


def controller_formula(answer: Answer) -> Expr | None:
    """C(s) by the names of its gains."""
    if answer.controller is None:
        return None
    terms = Controller(answer.controller.family, tuple(name for name, _ in answer.gains)).terms
    constant = next((name for name, _ in answer.filter), None)
    return add(*(terms if constant is None else _filtered(terms, constant)))
