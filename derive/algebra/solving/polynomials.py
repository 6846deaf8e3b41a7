"""Scalars read as polynomials in some of their symbols, the others being parameters."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from fractions import Fraction

from flint import arb

from derive.algebra.ball_arithmetic import balls
from derive.algebra.evaluation import Evaluation
from derive.algebra.multivariate import factored, grouped
from derive.algebra.numbers.balls import number_sign
from derive.algebra.rationals import as_fraction
from derive.algebra.scalar import Scalar
from derive.algebra.signs import sign_of
from derive.errors import NotDerivable


def holds(value: Scalar, names: Collection[str]) -> bool:
    """Whether a generator with one of the names occurs."""
    return any(name in names for name in value.generators())


def numerator(value: Scalar) -> Scalar:
    """The polynomial above the line: what vanishes where the value does."""
    return Scalar(value.ring, value.numerator)


def coefficients(polynomial: Scalar, name: str) -> list[Scalar]:
    """What stands before each power of one symbol, the constant term first and the last one not zero; of zero
    [0]."""
    home = polynomial.ring
    place = home.index.get(name)
    if place is None:
        return [polynomial]
    found = grouped(polynomial.numerator, (place,))
    (degree,) = max(found, default=(0,))
    return [Scalar(home, found.get((power,), home.zero)) for power in range(degree + 1)]


def monomials(polynomial: Scalar) -> list[Scalar]:
    """The terms, each with its coefficient."""
    home = polynomial.ring
    return [Scalar(home, home.context.from_dict({powers: k})) for powers, k in polynomial.numerator.terms()]


def factors(polynomial: Scalar, names: Collection[str]) -> list[Scalar]:
    """The distinct irreducible factors that hold any of the names."""
    _, found = factored(polynomial.numerator)
    parts = (Scalar(polynomial.ring, factor) for factor, _ in found)
    return [part for part in parts if holds(part, names)]


def degree(polynomial: Scalar, names: Collection[str]) -> int:
    """The total degree in the names; 0 for zero."""
    return max(map(sum, polynomial.ring.grouped(polynomial.numerator, names)), default=0)


def require_rational(values: Iterable[Scalar], names: Collection[str]) -> None:
    """Raises NotDerivable where a name stands inside a sine, a root or another function."""
    for value in values:
        inner = [value.ring.letters(each) for each in value.generators() if each not in names]
        if hidden := [name for name in names if any(name in letters for letters in inner)]:
            raise NotDerivable(
                f"{hidden[0]} stands inside a function: only equations that are polynomials in the "
                "variables, or fractions of polynomials, are solved here"
            )


def known_sign(value: Scalar, positive: Collection[str] = ()) -> int | None:
    """1, -1 or 0; None where the parameters decide it. Even powers count as positive."""
    if not value:
        return 0
    try:
        return number_sign(value)
    except KeyError:  # a parameter has no value
        pass
    undecided = odd_part(value, positive).constant
    return None if undecided is None else 1 if undecided > 0 else -1


def odd_part(value: Scalar, positive: Collection[str] = ()) -> Scalar:
    """What decides the sign: the product of the factors, above and below, whose own signs are not known."""
    whole = numerator(value)
    if value.denominator is not None:
        whole = whole * Scalar(value.ring, value.denominator)
    content, found = factored(whole.numerator)
    known_positive = {*positive, *(name for name in value.ring.opaque if name.startswith("exp("))}
    total = Scalar.of(1 if as_fraction(content) > 0 else -1)
    for factor, power in found:
        part = Scalar(value.ring, factor)
        known = sign_of(part, known_positive) if power % 2 else 1
        total = total * (part if known is None else known)
    return total


def ball(value: Scalar, at: Mapping[str, arb]) -> arb:
    """The value in ball arithmetic, an interval that certainly holds it. Raises KeyError where a symbol has
    none."""
    return Evaluation(balls(at)).quotient(value)


def rational(value: Scalar) -> Fraction | None:
    """The value of a number without symbols and roots; None for anything else."""
    return value.constant if value else Fraction(0)
