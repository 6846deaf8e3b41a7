"""Determinants as they are written: factored, one sign in front, lengths as the author gave them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence

from derive.algebra.rationals import as_fraction
from derive.algebra.readable.operation_count import operations
from derive.algebra.readable.writing import opposite
from derive.algebra.scalar import Scalar
from derive.algebra.solving.factors import Factored, factored
from derive.expression import (
    MINUS_ONE,
    Call,
    Expr,
    Number,
    Power,
    Sum,
    add,
    factors_of,
    is_negative,
    multiply,
    number,
    terms_of,
)
from derive.kinds.problem import Problem

LARGE = 100  # a coefficient that decimals were multiplied up to
MOST_EXPANDED = 12  # terms of all minors


def determinant(name: Expr) -> Expr:
    """det(name), not worked out."""
    return Call("det", (name,))


def natural(problem: Problem, value: Scalar, variables: tuple[str, ...]) -> Factored:
    """The factors of a determinant. Where the author gave decimals, each is scaled by a power of ten so that
    lengths read as lengths again: 0.4318 c_2 + 0.0203 c_23, not 4318 c_2 + 203 c_23."""
    found = factored(value, variables)
    if not problem.style.decimals:
        return found
    constant, factors = found.constant, []
    for factor, power in found.factors:
        scale = _scale(factor)
        constant = constant * scale**power
        factors.append((factor / scale, power))
    return Factored(constant, tuple(factors))


def _scale(factor: Scalar) -> int:
    largest = max(abs(as_fraction(k)) for k in factor.numerator.coeffs())
    return 1 if largest < LARGE else int(10 ** len(str(int(largest))))


def as_product(problem: Problem, value: Scalar, variables: tuple[str, ...]) -> Expr:
    """A determinant by its factors, as a tree."""
    return product_tree(problem, natural(problem, value, variables))


def product_tree(problem: Problem, det: Factored) -> Expr:
    """Constants and single sines and cosines first, then sums in parentheses; one sign in front."""
    front: list[Expr] = []
    sums: list[Expr] = []
    sign = 1
    for factor, power in sorted(det.factors, key=_place):
        tree = problem.readable(factor)
        if mostly_negative(tree):
            tree, sign = opposite(tree), sign * (-1) ** power
        (sums if isinstance(tree, Sum) else front).append(tree ** number(power) if power > 1 else tree)
    constant = problem.readable(det.constant)
    if is_negative(constant):
        constant, sign = -constant, -sign
    tree = multiply(*factors_of(constant), *(f for each in front for f in factors_of(each)), *sums)
    return -tree if sign < 0 else tree


def _place(pair: tuple[Scalar, int]) -> tuple[int, bool]:
    """Lengths before sines and cosines, sums last."""
    factor, _ = pair
    return len(factor.numerator), any("(" in name for name in factor.generators())


def mostly_negative(tree: Expr) -> bool:
    """Whether more than half of its terms are written with a minus."""
    terms = terms_of(tree)
    return sum(map(is_negative, terms)) * 2 > len(terms)


def gram_determinant(problem: Problem, found: Sequence[Scalar], trees: Iterable[Expr]) -> Expr:
    """det(J J^T) or det(J^T J), whichever is smaller: the squares of the minors of full size (Cauchy and
    Binet; `trees` as they are written), or their sum multiplied out where it is shorter."""
    counted = Counter(map(_square, trees))
    squares = add(
        *(square if n == 1 else multiply(number(n), *factors_of(square)) for square, n in counted.items())
    )
    if sum(len(value.numerator) for value in found) > MOST_EXPANDED:
        return squares
    expanded = problem.readable(sum((value * value for value in found), Scalar.of(0)))
    return expanded if 2 * operations(expanded) < operations(squares) else squares


def _square(tree: Expr) -> Expr:
    """The square of a product, the sign dropped."""
    factors = [f for f in factors_of(tree) if f != MINUS_ONE]
    return multiply(*(_squared(f) for f in factors))


def _squared(factor: Expr) -> Expr:
    if isinstance(factor, Number):
        return number(factor.value**2)
    return factor.base**4 if isinstance(factor, Power) else factor**2
