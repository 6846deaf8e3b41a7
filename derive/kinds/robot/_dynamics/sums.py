"""Sums over the indices of names, as a general law has them, and the same written out in one case.

The operator is a factor that stands before what is summed: a name `sum` with the indices that it goes over.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from itertools import product

from derive.expression import (
    Derivative,
    Expr,
    Indexed,
    Product,
    Sum,
    Symbol,
    children,
    multiply,
    rebuild,
    symbols,
)


def over(indices: str, *factors: Expr) -> Product:
    """The sum over i, or over i and j, of a product; it is written as a factor that stands before it."""
    return Product((Indexed("sum", symbols(indices)), *factors))


def written_out(total: Product, fixed: Mapping[str, int], case: Mapping[Expr, Expr], size: int = 3) -> Expr:
    """Such a sum term by term, indices as 1, 2, 3 and then names as in the case; other indices are fixed."""
    operator, *factors = total.factors
    letters = [each.name for each in children(operator) if isinstance(each, Symbol)]
    terms = [
        numbered(multiply(*factors), {**fixed, **dict(zip(letters, values, strict=True))}, case)
        for values in product(range(1, size + 1), repeat=len(letters))
    ]
    return Sum(tuple(terms))


def numbered(expr: Expr, at: Mapping[str, int], case: Mapping[Expr, Expr]) -> Expr:
    """With numbers for letters in the indices of names, and what these names are in the case."""
    match expr:
        case Symbol(name):
            named = Symbol(_numbered(name, at))
            return case.get(named, named)
        case Derivative(of, Symbol(by)):
            slope = Derivative(Symbol(_numbered(str(getattr(of, "name", "")), at)), Symbol(_numbered(by, at)))
            return case.get(slope, slope)
    return rebuild(expr, lambda part: numbered(part, at, case))


def _numbered(name: str, at: Mapping[str, int]) -> str:
    """d_kj with k = 3 and j = 1 is d_31; q_i_dot is q_1_dot."""
    return re.sub(r"(?<=_)[cijk]+(?=_|\^|$)", lambda found: _digits(found[0], at), name)


def _digits(index: str, at: Mapping[str, int]) -> str:
    return "".join(str(at.get(letter, letter)) for letter in index)
