"""The point a question is evaluated at, for the kinds whose derivation depends on it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, TypeAlias

from pydantic import PlainValidator, ValidationInfo, WithJsonSchema

from derive.algebra.formulas.grammar import parse
from derive.algebra.formulas.units import ANY
from derive.errors import FormulaError
from derive.expression import Expr
from derive.kinds.fields import TREES, declared, read_name, text_of

Place: TypeAlias = tuple[tuple[str, Expr], ...]  # names and their values, in the order typed


def read(typed: Any, info: ValidationInfo) -> Place | None:
    """`true` is the empty point; a mapping gives each name its value. Raises FormulaError."""
    if typed is None or isinstance(typed, tuple):
        return typed
    if typed is True or typed == "true":
        return ()
    if not isinstance(typed, Mapping):
        raise FormulaError("names and their values are wanted here", hint="write {J: 2, b: 0.5}, or true")
    return tuple((read_name(name), formula(value, info)) for name, value in typed.items())


def formula(typed: Any, info: ValidationInfo) -> Expr:
    """The tree of what is typed, of any dimension. Raises FormulaError."""
    return typed if isinstance(typed, TREES) else parse(text_of(typed), dimension=ANY, names=declared(info))


# None where no numbers are asked for; hashable, so that it can stand in the options of a kind.
Evaluation: TypeAlias = Annotated[
    Place | None,
    PlainValidator(read),
    WithJsonSchema(
        {"type": ["object", "boolean", "string"], "description": "names and their values, or true"}
    ),
]
