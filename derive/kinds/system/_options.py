"""What authors write beside `find` for systems: a controller with its gains."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, TypeAlias

from pydantic import PlainValidator, ValidationInfo, WithJsonSchema

from derive.control.controllers import FAMILIES, GAINS, Controller, Family
from derive.control.rational import S
from derive.errors import FormulaError
from derive.expression import Expr, Symbol, free_symbols
from derive.kinds.fields import formula

AS_WRITTEN = "write it as {PID: {K_p: 20, K_i: 5, K_d: 10}}, or PID for symbolic gains"


def read_controller(typed: Any, info: ValidationInfo) -> Controller:
    """`PID`, `{P: 20}` or `{PID: {K_p: 20, K_i: 5, K_d: 10}}`. Raises FormulaError."""
    if isinstance(typed, Controller):
        return typed
    if isinstance(typed, str):
        typed = {typed: None}
    if not isinstance(typed, Mapping) or len(typed) != 1:
        raise FormulaError("one controller is wanted here", hint=AS_WRITTEN)
    ((name, gains),) = typed.items()
    family = _family(name)
    given = _gains(family, gains)
    return Controller(family, tuple(_gain(letter, given, info) for letter in family))


def _family(name: Any) -> Family:
    for family in FAMILIES:
        if family == str(name).upper():
            return family
    raise FormulaError(f"there is no controller '{name}'", hint=f"choose one of {', '.join(FAMILIES)}")


def _gains(family: Family, typed: Any) -> dict[str, Any]:
    """The gains typed, by letter."""
    if not isinstance(typed, Mapping):
        if typed is not None and len(family) > 1:
            raise FormulaError(f"a {family} controller has {len(family)} gains", hint=AS_WRITTEN)
        return {family[0]: typed}
    return {_letter(family, name): value for name, value in typed.items()}


def _letter(family: Family, name: Any) -> str:
    letter = str(name).replace("_", "").upper().removeprefix("K")
    if len(letter) != 1 or letter not in family:
        names = ", ".join(GAINS[each] for each in family)
        raise FormulaError(f"a {family} controller has no gain '{name}'", hint=f"its gains: {names}")
    return letter


def _gain(letter: str, given: Mapping[str, Any], info: ValidationInfo) -> Expr:
    value = given.get(letter)
    found = Symbol(GAINS[letter]) if value is None else formula(value, info)
    if S.name in free_symbols(found):
        raise FormulaError(
            "a gain holds no s", hint="write a controller that has one as part of the equations"
        )
    return found


ControllerField: TypeAlias = Annotated[
    Controller,
    PlainValidator(read_controller),
    WithJsonSchema({"type": ["string", "object"], "description": AS_WRITTEN}),
]
