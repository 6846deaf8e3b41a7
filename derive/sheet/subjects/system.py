"""system: equations linear in their signals, in the Laplace domain."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from derive.control.system import System
from derive.errors import SheetErrors
from derive.expression import Symbol, free_symbols
from derive.kinds.fields import EquationField, Name, OptionsModel
from derive.sheet.faults import did_you_mean
from derive.sheet.source import At
from derive.sheet.subjects.registry import Known

HARMLESS = frozenset({"disturbance"})  # zero where it is not asked about


class Given(OptionsModel):
    """The equations, and which of their signals drives, is observed, disturbs."""

    equations: Annotated[list[EquationField], Field(min_length=1, max_length=100)]
    input: Name
    output: Name
    disturbance: Name | None = None


def build(given: Given, at: At, known: Known) -> System:
    """The system. Raises SheetErrors where a signal is in none of the equations."""
    sides = [side for equation in given.equations for side in (equation.left, equation.right)]
    names = frozenset().union(*(free_symbols(side) for side in sides)) - {"s"}
    signals = {"input": given.input, "output": given.output, "disturbance": given.disturbance}
    faults = [
        at.fault(f"{signal} is in none of the equations", (role,), did_you_mean(signal, names))
        for role, signal in signals.items()
        if signal is not None and signal not in names
    ]
    if given.input == given.output:
        faults.append(at.fault("input and output are the same signal", ("output",)))
    if faults:
        raise SheetErrors(faults)
    disturbance = Symbol(given.disturbance) if given.disturbance else None
    return System(tuple(given.equations), Symbol(given.input), Symbol(given.output), disturbance)
