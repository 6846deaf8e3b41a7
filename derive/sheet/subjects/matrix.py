"""matrix: a matrix given as such, a Jacobian or an inertia matrix."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated

from pydantic import Field

from derive.errors import SheetError, how_many
from derive.expression import Matrix, free_symbols
from derive.kinds.fields import Name, OptionsModel, Quantity
from derive.mechanics.matrices import GivenMatrix
from derive.sheet.faults import did_you_mean
from derive.sheet.source import At, Faults
from derive.sheet.subjects.registry import Known

MOST = 12  # rows or columns
Row = Annotated[list[Quantity], Field(min_length=1, max_length=MOST)]


class Given(OptionsModel):
    """A matrix that depends on variables."""

    value: Annotated[list[Row], Field(min_length=1, max_length=MOST)]
    """The rows of the matrix."""
    variables: tuple[Name, ...] = Field((), max_length=MOST)
    """The variables on which it depends, one for each of its columns."""


def build(given: Given, at: At, known: Known) -> GivenMatrix:
    """The matrix of a problem. Raises SheetErrors: rows of several lengths, a variable twice, or defined."""
    Faults([*_row_faults(given, at), *_variable_faults(given, at, known)]).settle()
    return GivenMatrix(Matrix(tuple(map(tuple, given.value))), given.variables)


def _row_faults(given: Given, at: At) -> Iterator[SheetError]:
    width = len(given.value[0])
    for k, row in enumerate(given.value[1:], 1):
        if len(row) != width:
            fault = f"this row has {how_many(len(row), 'entry', 'entries')}, the first {width}"
            yield at.fault(fault, ("value", k), "give every row as many entries")


def _variable_faults(given: Given, at: At, known: Known) -> Iterator[SheetError]:
    found = {name for row in given.value for entry in row for name in free_symbols(entry)}
    for k, name in enumerate(given.variables):
        where = ("variables", k)
        if name in given.variables[:k]:
            yield at.fault(f"'{name}' is listed twice", where, "list each variable once")
        elif name in known.where:
            hint = f"leave {name} out of where:, or out of the variables"
            yield at.fault(f"'{name}' has a value under where: and cannot vary", where, hint)
        elif name not in found and len(given.variables) != len(given.value[0]):
            yield at.fault(f"the matrix does not depend on '{name}'", where, did_you_mean(name, found))
