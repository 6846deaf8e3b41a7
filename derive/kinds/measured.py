"""Answers that rest on rounded data, in decimals: exactly they have dozens of digits that nobody reads.

The answer is derived and verified exactly; only then is each number in it that fills a line rounded, and what
was made of a formula compared with it in numbers.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import fields, replace
from fractions import Fraction
from math import prod
from typing import Any, get_args

from derive.algebra.numbers.floats import number, numbers
from derive.derivation import Branch, Derivation, Step, Table
from derive.errors import NotAsWritten, NotDerivable
from derive.expression import (
    Approximate,
    Expr,
    Matrix,
    Number,
    Product,
    Sum,
    add,
    free_symbols,
    multiply,
    rebuild,
    walk,
)
from derive.kinds.checks import TOLERANCE, flat, random_points
from derive.kinds.values_at import NOT_REAL

TREES = get_args(Expr)
LONGEST = 10**9  # above this the numerator or the denominator of a fraction is not read
PARTS = (Step, Branch, Table)
POINTS = 2
NOTHING = 1e-12  # numbers are compared as if one were as large


class InDecimals:
    """Derivations in decimals, each made once: what two questions share stays shared."""

    def __init__(self) -> None:
        self.known: dict[int, tuple[Derivation, Derivation]] = {}

    def __call__(self, value: Any) -> Any:
        """A derivation, or anything that holds some, in decimals. Raises NotAsWritten."""
        if isinstance(value, Derivation):
            if id(value) not in self.known:
                self.known[id(value)] = value, self._part(value)
            return self.known[id(value)][1]
        if isinstance(value, TREES):
            return _compared(value, decimals(value))
        if isinstance(value, tuple | list):
            return type(value)(map(self, value))
        if isinstance(value, Mapping):
            return {name: self(part) for name, part in value.items()}
        return self._part(value) if isinstance(value, PARTS) else value

    def _part(self, value: Any) -> Any:
        return replace(value, **{each.name: self(getattr(value, each.name)) for each in fields(value)})


def _compared(exact: Expr, rounded: Expr) -> Expr:
    """What was rounded, where it has the same numbers. Raises NotAsWritten."""
    if rounded is not exact:
        for at in random_points(free_symbols(exact) | free_symbols(rounded), POINTS):
            with suppress(NotDerivable, *NOT_REAL):  # a law has no numbers
                ours, theirs = (list(flat(numbers(tree, at))) for tree in (exact, rounded))
                near = TOLERANCE * max(map(abs, (*ours, *theirs, NOTHING)))
                if any(abs(a - b) > near for a, b in zip(ours, theirs, strict=True)):
                    raise NotAsWritten
    return rounded


def decimals(expr: Expr) -> Expr:
    """The tree with every number that holds a long one rounded, as a whole."""
    if not any(map(_is_long, walk(expr))):
        return expr
    if not free_symbols(expr) and not any(isinstance(node, Matrix) for node in walk(expr)):
        try:
            return _shortest(number(expr, {}))
        except (NotDerivable, ValueError, ZeroDivisionError):  # no number after all
            pass
    if isinstance(expr, Product) and (spread := _spread(expr)):
        return decimals(spread)
    if isinstance(expr, Product | Sum):
        return _gathered(expr)
    return rebuild(expr, decimals)


def _spread(expr: Product) -> Expr | None:
    """Multiplied out where a long number stands before a sum of others: each of its terms then has one."""
    for part in expr.factors:
        if isinstance(part, Sum) and any(map(_is_long, walk(part))):
            plain = [one for one in expr.factors if not free_symbols(one) and not isinstance(one, Matrix)]
            rest = [one for one in expr.factors if one is not part and one not in plain]
            terms = add(*(multiply(*_exactly(*plain, *_factors(term))) for term in part.terms))
            return multiply(*rest, terms) if plain else None
    return None


def _factors(term: Expr) -> Iterator[Expr]:
    """All of them, in products of products too."""
    if isinstance(term, Product):
        for factor in term.factors:
            yield from _factors(factor)
    else:
        yield term


def _exactly(*factors: Expr) -> Iterator[Expr]:
    """With one number for those among them that are fractions."""
    yield Number(prod((each.value for each in factors if isinstance(each, Number)), start=Fraction(1)))
    yield from (each for each in factors if not isinstance(each, Number))


def _gathered(expr: Product | Sum) -> Expr:
    """One number for all those among the factors or the terms."""
    parts = expr.factors if isinstance(expr, Product) else expr.terms
    plain = [part for part in parts if not free_symbols(part) and not isinstance(part, Matrix)]
    rest = [decimals(part) for part in parts if part not in plain]
    if not any(_is_long(node) for part in plain for node in walk(part)):
        return rebuild(expr, decimals)
    if isinstance(expr, Product):
        return multiply(_shortest(prod(number(part, {}) for part in plain)), *rest)
    return add(*rest, _shortest(sum(number(part, {}) for part in plain)))


def _shortest(value: float) -> Expr:
    """Whole numbers stay what they are."""
    return Number(Fraction(round(value))) if value == round(value) else Approximate(value)


def _is_long(node: Expr) -> bool:
    if not isinstance(node, Number) or node.decimal:
        return False
    return max(abs(node.value.numerator), node.value.denominator) > LONGEST
