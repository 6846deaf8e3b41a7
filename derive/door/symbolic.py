"""Results as SymPy objects, their symbols with the assumptions of the sheet."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any, TypeAlias, get_args

import sympy

from derive.algebra.infix import text
from derive.audit.text import sympy_of_text
from derive.derivation import Branch, LinearSystem, Phrase
from derive.expression import Expr, Matrix, Relation, free_symbols

Say: TypeAlias = Callable[[Any], Any]
TREES = get_args(Expr)
KNOWN = ("positive", "nonnegative", "nonzero", "integer")


def symbol(name: str, assumed: str = "") -> sympy.Symbol:
    """The symbol of a sheet: real, and what the sheet assumes of it."""
    return sympy.Symbol(name, real=True, **({assumed: True} if assumed in KNOWN else {}))


def symbolic(value: Any, assumptions: Mapping[str, str], say: Say) -> Any:
    """A result of a derivation: a scalar is an expression, a matrix or column a matrix, a solution a mapping
    with `when`, equations in place of a formula are equations; what is words goes through `say`."""

    def made(part: Any) -> Any:
        match part:
            case Matrix(rows):
                return sympy.ImmutableMatrix([[made(entry) for entry in row] for row in rows])
            case Branch(values, when, short, true_at, facts):
                found = {name: made(each) for name, each in (short or values).items()}
                return {**found, "when": say(when), **({} if true_at else {"true_at": False}), **facts}
            case LinearSystem():
                return {
                    "unknowns": [made(each) for each in part.unknowns],
                    "equations": [sympy.Eq(made(a), made(b), evaluate=False) for a, b in part.equations],
                    "where": {name: made(each) for name, each in part.names.items()},
                }
            case Relation() | Phrase():
                return say(part)
            case Mapping():
                return {name: made(each) for name, each in part.items()}
            case tuple() | list():
                return [made(each) for each in part]
        return _expression(part, assumptions) if isinstance(part, TREES) else part

    return made(value)


def _expression(tree: Expr, assumptions: Mapping[str, str]) -> sympy.Expr:
    names = {name: symbol(name, assumptions.get(name, "")) for name in free_symbols(tree) - {"pi"}}
    return sympy_of_text(text(tree), names)


def expressions(value: Any) -> Iterator[sympy.Basic]:
    """Every expression and matrix in a result."""
    if isinstance(value, sympy.Basic):
        yield value
    elif isinstance(value, Mapping):
        for each in value.values():
            yield from expressions(each)
    elif isinstance(value, list):
        for each in value:
            yield from expressions(each)
