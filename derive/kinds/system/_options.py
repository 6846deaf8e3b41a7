"""What authors write beside `find` for systems: a controller with its gains, and a point to evaluate at."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, TypeAlias

from pydantic import PlainValidator, ValidationInfo, WithJsonSchema

from derive.algebra.grammar import parse
from derive.algebra.units import ANY
from derive.control.controllers import FAMILIES, GAINS, Controller, Family
from derive.errors import FormulaError
from derive.expression import Expr, Symbol
from derive.kinds.fields import TREES, declared, read_name, text_of

Point: TypeAlias = tuple[tuple[str, Expr], ...]  # names and their values, in the order typed
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


def read_point(typed: Any, info: ValidationInfo) -> Point | None:
    """Names with values, or `true` where no name is left without one. Raises FormulaError."""
    if typed is None or isinstance(typed, tuple):
        return typed
    if typed is True or typed == "true":
        return ()
    if not isinstance(typed, Mapping):
        raise FormulaError("names and their values are wanted here", hint="write {J: 2, b: 0.5}, or true")
    return tuple((read_name(name), _formula(value, info)) for name, value in typed.items())


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
    return Symbol(GAINS[letter]) if value is None else _formula(value, info)


def _formula(typed: Any, info: ValidationInfo) -> Expr:
    return typed if isinstance(typed, TREES) else parse(text_of(typed), dimension=ANY, names=declared(info))


ControllerField: TypeAlias = Annotated[
    Controller,
    PlainValidator(read_controller),
    WithJsonSchema({"type": ["string", "object"], "description": AS_WRITTEN}),
]
PointField: TypeAlias = Annotated[
    Point | None,
    PlainValidator(read_point),
    WithJsonSchema(
        {"type": ["object", "boolean", "string"], "description": "names and their values, or true"}
    ),
]
