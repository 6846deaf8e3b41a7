"""Groebner bases over the rationals, bounded."""

from __future__ import annotations

from collections.abc import Sequence

from flint import Ordering, fmpz, fmpz_mpoly, fmpz_mpoly_ctx, fmpz_mpoly_vec

from derive.algebra.rationals import as_fraction
from derive.algebra.scalar import Scalar

BASIS_LIMITS = (40, 120, 600)  # polynomials, terms, bits


def groebner(equations: Sequence[Scalar], unknowns: tuple[str, ...]) -> list[Scalar] | None:
    """The reduced Groebner basis (Cox, Little and O'Shea, Ideals, Varieties, and Algorithms, chapter 2) for
    the lexicographic order of the unknowns, parameters last; None where it is out of reach or says nothing
    new."""
    homes = [each.ring for each in equations]
    if any(home.roots or home.angles for home in homes):
        return None
    used = sorted({name for each in equations for name in each.generators()} - set(unknowns))
    names = (*unknowns, *used)
    context = fmpz_mpoly_ctx.get(names, Ordering.lex)
    vector = fmpz_mpoly_vec([_integral(each, names, context) for each in equations], context)
    basis, done = vector.buchberger_naive(limits=BASIS_LIMITS)
    if not done:
        return None
    return [_scalar(each, names) for each in basis.autoreduction()]


def _integral(value: Scalar, names: tuple[str, ...], context: fmpz_mpoly_ctx) -> object:
    """The polynomial with whole coefficients."""
    terms = value.numerator.to_dict()
    bottom = 1
    for k in terms.values():
        bottom = bottom * int(k.q) // int(fmpz(bottom).gcd(fmpz(int(k.q))))
    places = [value.ring.index.get(name) for name in names]
    return context.from_dict(
        {
            tuple(0 if p is None else int(exponents[p]) for p in places): int(as_fraction(k) * bottom)
            for exponents, k in terms.items()
        }
    )


def _scalar(polynomial: fmpz_mpoly, names: tuple[str, ...]) -> Scalar:
    total = Scalar.of(0)
    for exponents, k in polynomial.terms():
        term = Scalar.of(int(k))
        for name, power in zip(names, exponents, strict=True):
            term = term * Scalar.symbol(name) ** int(power) if power else term
        total = total + term
    return total
