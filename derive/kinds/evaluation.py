"""The point a question is evaluated at, for the kinds whose derivation depends on it."""

from __future__ import annotations

from typing import Annotated, Any, TypeAlias

from pydantic import PlainValidator, ValidationInfo, WithJsonSchema

from derive.algebra.grammar import parse
from derive.algebra.units import ANY
from derive.expression import Expr
from derive.kinds.fields import TREES, declared, read_name, text_of

Place: TypeAlias = tuple[tuple[str, Expr], ...]


def read(typed: Any, info: ValidationInfo) -> Place | None:
    """`true` is the empty point; a mapping gives each name its value. Raises FormulaError."""
    if typed is None or isinstance(typed, tuple):
        return typed
    if isinstance(typed, dict):
        return tuple((read_name(name), _value(value, info)) for name, value in typed.items())
    return ()


def _value(typed: Any, info: ValidationInfo) -> Expr:
    if isinstance(typed, TREES):
        tree: Expr = typed
        return tree
    return parse(text_of(typed), dimension=ANY, names=declared(info))


# None where no numbers are asked for; hashable, so that it can stand in the options of a kind.
Evaluation: TypeAlias = Annotated[
    Place | None, PlainValidator(read), WithJsonSchema({"type": ["object", "boolean"]})
]
