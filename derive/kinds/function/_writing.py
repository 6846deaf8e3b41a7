"""How values and vanishing polynomials are written on the page."""

from __future__ import annotations

from flint import arb

from derive.algebra.rationals import as_fraction
from derive.algebra.readable.operation_count import operations
from derive.algebra.scalar import Scalar, fraction
from derive.algebra.solving.polynomial_systems import Value
from derive.algebra.solving.polynomials import monomials
from derive.expression import ZERO, Approximate, Expr, is_negative
from derive.kinds.problem import Problem


def written(value: Value, problem: Problem) -> Expr:
    """An exact value in its shortest form; an enclosed one rounded."""
    if isinstance(value, arb):
        return Approximate(float(value.mid()))
    forms = [problem.readable(value)]
    if value.denominator is not None:
        plain = _roots_above(value)
        forms.append(problem.readable(plain))
        for root in plain.ring.roots:
            if root.name in plain.generators():
                forms += _over_root(plain, Scalar(plain.ring, plain.ring.gen(root.name)), problem)
    return min(forms, key=operations)


def _roots_above(value: Scalar) -> Scalar:
    """With no root below the line: both parts times the conjugate of the denominator."""
    home = value.ring
    for place, root in enumerate(home.roots):
        bottom = home.one if value.denominator is None else value.denominator
        along = bottom.derivative(place)
        if along != 0 and root.degree == 2:
            conjugate = bottom - 2 * along * home.gen(root.name)
            value = fraction(home, value.numerator * conjugate, home.reduce(bottom * conjugate))
    return value


def _over_root(value: Scalar, root: Scalar, problem: Problem) -> list[Expr]:
    """a r/sqrt(a^2 + b^2) rather than a r sqrt(a^2 + b^2)/(a^2 + b^2)."""
    above = value * root
    if above.denominator is not None:
        return []
    top = problem.readable(above)
    return [top / problem.readable(root)]


def vanishing(polynomial: Scalar, problem: Problem) -> tuple[Expr, Expr]:
    """(left, right) of the equation that it is zero: x = y rather than x - y = 0."""
    lead = as_fraction(polynomial.numerator.leading_coefficient())
    whole = polynomial / lead if polynomial.ring.roots else _primitive(polynomial)
    parts = monomials(whole)
    if len(parts) == 2 and any(part.constant is None for part in parts):
        left, right = sorted(parts, key=lambda part: part.constant is not None)
        found = problem.readable(left), problem.readable(-right)
        negative = as_fraction(left.numerator.leading_coefficient()) < 0
        return (-found[0], problem.readable(right)) if negative else found
    shown = problem.readable(whole)
    return -shown if is_negative(shown) else shown, ZERO


def _primitive(polynomial: Scalar) -> Scalar:
    """With whole coefficients that have no common factor, the first one positive."""
    content, _ = polynomial.numerator.factor_squarefree()
    return polynomial / abs(as_fraction(content)) * _sign(polynomial)


def _sign(polynomial: Scalar) -> int:
    return 1 if as_fraction(polynomial.numerator.leading_coefficient()) > 0 else -1
