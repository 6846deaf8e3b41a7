"""system: equations linear in their signals, in the Laplace domain."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Annotated

from pydantic import Field

from derive.algebra.formulas.units import coherent
from derive.algebra.infix import text
from derive.control.delays import Function, delay_of, found_in, replaced, transcendental
from derive.control.system import Equation, System
from derive.errors import FormulaError, SheetError
from derive.expression import Call, Matrix, Symbol, free_symbols, walk
from derive.kinds.fields import EquationField, Name, OptionsModel
from derive.sheet.faults import did_you_mean, formula_fault
from derive.sheet.source import At, Faults
from derive.sheet.subjects.registry import Known

# A disturbance is zero where it is not asked about; fractions for delays stand in the equations already;
# units stand where numbers do.
HARMLESS = frozenset({"disturbance", "delay", "units"})


class Approximation(OptionsModel):
    """What takes the place of a delay e^(-T s)."""

    pade: Annotated[int, Field(ge=1, le=6)]
    """The order of the fraction of Padé that takes its place."""


class Given(OptionsModel):
    """Linear equations in the Laplace domain, and their signals."""

    equations: Annotated[list[EquationField], Field(min_length=1, max_length=100)]
    """The equations, in s."""
    input: Name
    """The signal that drives the system."""
    output: Name
    """The signal that is observed."""
    disturbance: Name | None = None
    """A signal that disturbs, zero in the transfer function."""
    delay: Approximation | None = None
    """What takes the place of a delay."""
    units: dict[Name, str] = Field(default_factory=dict)
    """In which SI unit a signal is, as {x: m, f: N}."""


def build(given: Given, at: At, known: Known) -> System:
    """The system. Raises SheetErrors where a signal is in none of the equations, and where s stands in what
    is no ratio of polynomials."""
    sides = [side for equation in given.equations for side in (equation.left, equation.right)]
    delays = found_in(Matrix((tuple(sides),)), given.delay.pade) if given.delay else ()
    equations = tuple(Equation(replaced(e.left, delays), replaced(e.right, delays)) for e in given.equations)
    faults = Faults(
        [*_signal_faults(given, at), *_function_faults(equations, given, at), *_unit_faults(given, at)]
    )
    if given.delay and not delays:
        faults.append(at.fault("no equation holds a delay", ("delay",), "write one as exp(-T*s)"))
    faults.settle()
    units = tuple(given.units.items())
    disturbance = Symbol(given.disturbance) if given.disturbance else None
    return System(
        equations, Symbol(given.input), Symbol(given.output), disturbance, delays=delays, units=units
    )


def _signal_faults(given: Given, at: At) -> Iterator[SheetError]:
    sides = [side for equation in given.equations for side in (equation.left, equation.right)]
    names = frozenset().union(*(free_symbols(side) for side in sides)) - {"s"}
    signals = {"input": given.input, "output": given.output, "disturbance": given.disturbance}
    for role, signal in signals.items():
        if signal is not None and signal not in names:
            yield at.fault(f"{signal} is in none of the equations", (role,), did_you_mean(signal, names))
    if given.input == given.output:
        yield at.fault("input and output are the same signal", ("output",))


def _unit_faults(given: Given, at: At) -> Iterator[SheetError]:
    """Of what is no signal, and of what is no unit in which SI is coherent: the coefficients are in SI."""
    signals = [name for name in (given.input, given.output, given.disturbance) if name]
    for name, unit in given.units.items():
        if name not in signals:
            yield at.fault(
                f"{name} is no signal that has a unit here",
                ("units", name),
                did_you_mean(name, signals),
                key=True,
            )
        elif not coherent(unit):
            yield at.fault(f"'{unit}' is no unit of SI", ("units", name), "write one as N, m/s or rad")


# -- functions of s -----------------------------------------------------------------------------------


def _function_faults(equations: Sequence[Equation], given: Given, at: At) -> Iterator[SheetError]:
    """The first in each equation."""
    for place, (equation, typed) in enumerate(zip(equations, given.equations, strict=True)):
        route = ("equations", place)
        found = next(
            (each for side in (equation.left, equation.right) for each in transcendental(side)), None
        )
        if found is not None:
            written, offset = _written(found, typed, at.value(route))
            yield formula_fault(_fault(found, written, offset), at, route)


def _fault(found: Function, written: str, offset: int) -> FormulaError:
    if delay_of(found) is None:
        hint = "put a ratio of polynomials in its place that is near to it where the system works"
        return FormulaError(f"{written} is no ratio of polynomials in s", offset, hint)
    hint = "add `delay: {pade: 2}` beside equations: to put a fraction of second order in its place"
    return FormulaError(f"{written} is a delay, and no ratio of polynomials in s", offset, hint)


def _written(found: Function, equation: Equation, typed: object) -> tuple[str, int]:
    """A function as it was typed, and where: it is the n-th of its name in the equation."""
    plain = text(found).replace("**", "^")
    if not isinstance(typed, str) or not isinstance(found, Call):
        return plain, 0
    nodes = [node for side in (equation.left, equation.right) for node in walk(side)]
    before = nodes[: next((place for place, node in enumerate(nodes) if node is found), 0)]
    count = sum(isinstance(node, Call) and node.function == found.function for node in before)
    offset = typed.find(f"{found.function}(")
    for _ in range(count):
        offset = typed.find(f"{found.function}(", offset + 1)
    return (_balanced(typed[offset:]), offset) if offset >= 0 else (plain, 0)


def _balanced(typed: str) -> str:
    """Up to the parenthesis that closes the first."""
    depth = 0
    for place, letter in enumerate(typed):
        depth += (letter == "(") - (letter == ")")
        if letter == ")" and not depth:
            return typed[: place + 1]
    return typed
