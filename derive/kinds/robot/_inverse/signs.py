"""Signs as a person writes them: what is subtracted last, one minus in front, numbers worked out."""

from __future__ import annotations

from collections.abc import Container, Iterable
from fractions import Fraction

from derive.expression import (
    MINUS_ONE,
    ONE,
    Expr,
    Number,
    Product,
    Sum,
    Symbol,
    add,
    children,
    is_negative,
    multiply,
    terms_of,
    walk,
)

LONG_DECIMAL = 6  # digits and point


def leaves(tree: Expr) -> int:
    """How many names and numbers stand in a tree, signs apart."""
    return sum(1 for node in walk(tree) if not children(node) and node != MINUS_ONE)


def begins_negative(tree: Expr) -> bool:
    """Whether it is written with a minus in front, of a sum the first term."""
    return is_negative(terms_of(tree)[0])


def all_negative(tree: Expr) -> bool:
    """Whether it is written with a minus in front, of a sum every term."""
    return all(map(is_negative, terms_of(tree)))


def opposite(tree: Expr) -> Expr:
    """-tree, each term of a sum with its sign turned."""
    if isinstance(tree, Sum):
        return ordered(Sum(tuple(map(opposite, tree.terms))))
    return -tree


def ordered(tree: Expr) -> Expr:
    """A sum with what is subtracted at its end; of a sum with a minus in front that begins with one, the
    opposite."""
    match tree:
        case Sum(terms):
            return Sum(tuple(sorted(terms, key=is_negative)))
        case Product((first, Sum(terms))) if first == MINUS_ONE and any(map(is_negative, terms)):
            return opposite(Sum(terms))
        case _:
            return tree


def facing(tree: Expr, names: Container[str]) -> Expr:
    """A sum in whose factors none of these names is only subtracted: (d r - y) c as -(y - d r) c."""
    if not isinstance(tree, Sum):
        return tree
    return Sum(tuple(-turned if (turned := _turned(term, names)) else term for term in tree.terms))


def _turned(term: Expr, names: Container[str]) -> Expr | None:
    """The opposite of a product with one such factor; None of any other term."""
    if not isinstance(term, Product) or is_negative(term):
        return None
    for k, factor in enumerate(term.factors):
        if isinstance(factor, Sum):
            plain = [part for part in factor.terms if isinstance(part, Symbol) and part.name in names]
            minus = [-part for part in factor.terms if is_negative(part)]
            if not plain and any(isinstance(part, Symbol) and part.name in names for part in minus):
                return multiply(*term.factors[:k], opposite(factor), *term.factors[k + 1 :])
    return None


def unsigned(tree: Expr) -> Expr:
    """Without the sign in front: what is squared needs none, nor (d r - x) in place of (x - d r)."""
    return opposite(tree) if all_negative(tree) or _alone_negative(tree) else tree


def _alone_negative(tree: Expr) -> bool:
    """Whether a name by itself is subtracted in a sum, and none added."""
    terms = terms_of(tree)
    plain = any(isinstance(term, Symbol) for term in terms)
    return not plain and any(is_negative(term) and isinstance(-term, Symbol) for term in terms)


def times(factor: Expr, other: Expr) -> Expr:
    """A product with the sign of its first factor in front."""
    if factor == MINUS_ONE:
        return -other
    if isinstance(factor, Product) and factor.factors[0] == MINUS_ONE:
        return -multiply(*factor.factors[1:], other)
    if isinstance(factor, Sum) and all_negative(factor):
        return -multiply(opposite(factor), other)
    return multiply(factor, other)


def over(top: Expr, bottom: Expr) -> Expr:
    """A quotient; by one it is the top, and signs move above."""
    if bottom == ONE:
        return top
    if all_negative(bottom):
        return over(opposite(top), opposite(bottom))
    return top / bottom


def square(tree: Expr) -> Expr:
    """The square; of a short number the number."""
    if isinstance(tree, Number) and not (tree.decimal and len(str(float(tree.value**2))) > LONG_DECIMAL):
        return Number(tree.value**2, tree.decimal)
    return unsigned(tree) ** 2


def total(terms: Iterable[Expr]) -> Expr:
    """A sum in which numbers are added up, at its end."""
    found = tuple(terms)
    numbers = [term for term in found if isinstance(term, Number)]
    rest = [term for term in found if not isinstance(term, Number)]
    value = sum((n.value for n in numbers), Fraction(0))
    decimal = any(n.decimal for n in numbers)
    return add(*rest, Number(value, decimal))


def signed(sign: int, tree: Expr) -> Expr:
    """The tree or its opposite."""
    return tree if sign > 0 else -tree
