"""Arithmetic on trees as a person does it: signs in front, squares of numbers worked out."""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from math import lcm

from derive.algebra.infix import text
from derive.expression import (
    MINUS_ONE,
    ONE,
    ZERO,
    Expr,
    Number,
    Product,
    Quotient,
    Sum,
    add,
    children,
    is_negative,
    multiply,
    negate,
    number,
    sqrt,
    squared,
)

LONG_DECIMAL = 6  # digits and point


def leaves(tree: Expr) -> int:
    """How many names and numbers stand in a tree."""
    parts = children(tree)
    return sum(map(leaves, parts)) if parts else int(tree != MINUS_ONE)


def starts_negative(tree: Expr) -> bool:
    """Whether it is written with a minus in front."""
    return text(tree).startswith("-")


def minus(tree: Expr) -> Expr:
    """The opposite, each term of a sum with its sign turned."""
    if isinstance(tree, Sum):
        return ordered(Sum(tuple(map(minus, tree.terms))))
    if isinstance(tree, Product) and tree.factors[0] == MINUS_ONE:
        return multiply(*tree.factors[1:])
    return negate(tree)


def ordered(tree: Expr) -> Expr:
    """A sum with what is subtracted at its end; of a sum with a minus in front that begins with one, the
    opposite."""
    match tree:
        case Sum(terms):
            return Sum(tuple(sorted(terms, key=is_negative)))
        case Product((first, Sum(terms))) if first == MINUS_ONE and any(map(is_negative, terms)):
            return ordered(Sum(tuple(map(minus, terms))))
        case _:
            return tree


def unsigned(tree: Expr) -> Expr:
    """Without the sign in front: what is squared needs none."""
    return minus(tree) if all_negative(tree) else tree


def all_negative(tree: Expr) -> bool:
    """Whether it is written with a minus in front, of a sum every term."""
    return all(map(is_negative, tree.terms)) if isinstance(tree, Sum) else is_negative(tree)


def terms_of(tree: Expr) -> tuple[Expr, ...]:
    """The terms of a sum; anything else by itself, zero not at all."""
    found = tree.terms if isinstance(tree, Sum) else (tree,)
    return tuple(term for term in found if term != ZERO)


def times(factor: Expr, other: Expr) -> Expr:
    """A product with the sign of its first factor in front."""
    if factor == MINUS_ONE:
        return negate(other)
    if isinstance(factor, Product) and factor.factors[0] == MINUS_ONE:
        return negate(multiply(*factor.factors[1:], other))
    if isinstance(factor, Sum) and all_negative(factor):
        return negate(multiply(minus(factor), other))
    return multiply(factor, other)


def over(top: Expr, bottom: Expr) -> Expr:
    """A quotient; by one it is the top, and signs move above."""
    if bottom == ONE:
        return top
    if all_negative(bottom):
        return over(minus(top), minus(bottom))
    return Quotient(top, bottom)


def square(tree: Expr) -> Expr:
    """The square; of a short number the number."""
    if isinstance(tree, Number) and not (tree.decimal and len(str(float(tree.value**2))) > LONG_DECIMAL):
        return Number(tree.value**2, tree.decimal)
    return squared(unsigned(tree))


def total(terms: Iterable[Expr]) -> Expr:
    """A sum in which numbers are added up, at its end."""
    found = tuple(terms)
    numbers = [term for term in found if isinstance(term, Number)]
    rest = [term for term in found if not isinstance(term, Number)]
    value = sum((n.value for n in numbers), Fraction(0))
    decimal = any(n.decimal for n in numbers)
    return add(*rest, Number(value, decimal))


def length(*parts: Expr) -> Expr:
    """sqrt(x^2 + y^2)."""
    return sqrt(total(map(square, parts)))


def signed(sign: int, tree: Expr) -> Expr:
    """The tree or its opposite."""
    return tree if sign > 0 else negate(tree)


def common_denominator(trees: Iterable[Expr]) -> int:
    """What makes the fractions in front of these whole; 1 where they are decimals."""
    found = [tree.factors[0] if isinstance(tree, Product) else tree for tree in trees]
    fractions = [each for each in found if isinstance(each, Number)]
    if any(each.decimal for each in fractions):
        return 1
    return lcm(*(each.value.denominator for each in fractions)) if fractions else 1


def multiplied(n: int, tree: Expr) -> Expr:
    """n times a term, numbers worked out."""
    if isinstance(tree, Number):
        return Number(tree.value * n, tree.decimal)
    if isinstance(tree, Product) and isinstance(tree.factors[0], Number):
        first = tree.factors[0]
        return multiply(Number(first.value * n, first.decimal), *tree.factors[1:])
    return multiply(number(n), tree)
