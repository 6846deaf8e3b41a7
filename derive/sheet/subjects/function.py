"""function: a function of several variables, alone or subject to constraints."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Any, TypeAlias

from pydantic import Discriminator, Field, Tag

from derive.algebra.function import Constraint, Function
from derive.errors import SheetError
from derive.expression import free_symbols
from derive.kinds.fields import EquationField, Formula, Name, OptionsModel
from derive.sheet.faults import did_you_mean
from derive.sheet.source import At, Faults
from derive.sheet.subjects.registry import Known

SHARED = frozenset({"subject_to"})  # a gradient may be asked beside the extremes
MOST = 20  # variables, components or constraints


def _form(value: Any) -> str:
    return "=several" if isinstance(value, list | tuple) else "=one"


_BY_FORM = Discriminator(_form)
Formulas: TypeAlias = Annotated[list[Formula], Field(min_length=1, max_length=MOST)]
Equations: TypeAlias = Annotated[list[EquationField], Field(min_length=1, max_length=MOST)]


class Given(OptionsModel):
    """A function, and what its variables obey."""

    variables: Annotated[list[Name], Field(min_length=1, max_length=MOST)]
    """The names of the variables."""
    value: Annotated[Annotated[Formulas, Tag("=several")] | Annotated[Formula, Tag("=one")], _BY_FORM]
    """What the function is; a list for a vector function."""
    subject_to: (
        Annotated[Annotated[Equations, Tag("=several")] | Annotated[EquationField, Tag("=one")], _BY_FORM]
        | None
    ) = None
    """An equation, or several, that the variables obey."""


def build(given: Given, at: At, known: Known) -> Function:
    """The function of a problem. Raises SheetErrors: a variable twice, defined, or in no expression."""
    vector = isinstance(given.value, list)
    values, equations = _listed(given.value), _listed(given.subject_to)
    constraints = tuple(Constraint(each.left, each.right) for each in equations)
    function = Function(tuple(given.variables), tuple(values), constraints, vector)
    Faults([*_variable_faults(function, at, known), *_constraint_faults(function, at, known)]).settle()
    return function


def _listed(value: Any) -> list[Any]:
    return value if isinstance(value, list) else [] if value is None else [value]


def _variable_faults(function: Function, at: At, known: Known) -> Iterator[SheetError]:
    trees = [*function.values, *(side for c in function.constraints for side in (c.left, c.right))]
    found = _names(trees, known)
    for index, name in enumerate(function.variables):
        where = ("variables", index)
        if name in function.variables[:index]:
            yield at.fault(f"'{name}' is listed twice", where, "list each variable once")
        elif name in known.where:
            hint = f"leave {name} out of where:, or out of the variables"
            yield at.fault(f"'{name}' has a value under where: and cannot vary", where, hint)
        elif name not in found:
            fault = f"the function does not depend on '{name}'"
            yield at.fault(fault, where, did_you_mean(name, found - set(function.variables)))


def _constraint_faults(function: Function, at: At, known: Known) -> Iterator[SheetError]:
    for index, constraint in enumerate(function.constraints):
        if not _names([constraint.left, constraint.right], known) & set(function.variables):
            typed = at.value(("subject_to",))
            where = ("subject_to", index) if isinstance(typed, list) else ("subject_to",)
            hint = f"the variables are {', '.join(function.variables)}"
            yield at.fault("this constraint holds none of the variables", where, hint)


def _names(trees: list[Any], known: Known) -> set[str]:
    """Every name in the trees, through the values under `where`."""
    found: set[str] = set()
    ahead = {name for tree in trees for name in free_symbols(tree)}
    while ahead:
        found |= ahead
        ahead = {n for name in ahead if name in known.where for n in free_symbols(known.where[name])} - found
    return found
