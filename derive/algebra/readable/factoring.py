"""What terms have in common, and what they are the product of."""

from __future__ import annotations

from collections import defaultdict

from flint import Ordering, fmpq_mpoly, fmpq_mpoly_ctx

from derive.algebra.multivariate import factored
from derive.algebra.rationals import Rational, lowest, measure, of_flint, over, to_flint
from derive.algebra.readable.terms import Alphabet, Monomial, Terms, divided, terminates


def common(terms: Terms) -> Monomial:
    """The greatest monomial that divides every term; of no terms the empty one."""
    if not terms:
        return ()
    monomials = [dict(m) for m in terms]
    shared = set(monomials[0]).intersection(*monomials[1:])
    return tuple((atom, min(m[atom] for m in monomials)) for atom in sorted(shared))


def content(terms: Terms, alphabet: Alphabet) -> Rational:
    """The greatest common factor of the coefficients; decimals keep theirs."""
    values = list(terms.values())
    if alphabet.style.decimals and any(map(terminates, values)):
        return 1
    return lowest(measure(values))


def divided_by(terms: Terms, monomial: Monomial, number: Rational) -> Terms:
    """The terms over a monomial that divides each of them, and over a number."""
    powers = dict(monomial)
    return {divided(m, powers): over(k, number) for m, k in terms.items()}


def is_irreducible(terms: Terms) -> bool:
    """Whether it is seen at once that terms without a common monomial are no product: x a + b has a factor
    only where a and b share it, and a single term shares none."""
    powers: dict[int, list[int]] = defaultdict(list)
    for monomial in terms:
        for atom, power in monomial:
            powers[atom].append(power)
    single = (1, len(terms) - 1)
    return any(len(found) in single and max(found) == 1 for found in powers.values())


def factors_of(terms: Terms) -> tuple[Rational, list[tuple[Terms, int]]]:
    """(number, irreducible factors with their powers) of terms without a common monomial."""
    atoms = sorted({atom for monomial in terms for atom, _ in monomial})
    number, factors = factored(_polynomial(terms, atoms))
    found = [(_terms(factor, atoms), int(power)) for factor, power in factors]
    scale = of_flint(number)
    for place, (first, power) in enumerate(found):
        if scale == -1 and power % 2:  # b - a rather than -(a - b)
            opposite = {monomial: -k for monomial, k in first.items()}
            return 1, [*found[:place], (opposite, power), *found[place + 1 :]]
    return scale, found


def _polynomial(terms: Terms, atoms: list[int]) -> fmpq_mpoly:
    """Over as many generators as there are atoms; for each number of them FLINT keeps one context."""
    context = fmpq_mpoly_ctx.get(("x", len(atoms)), Ordering.lex)
    powers = ((dict(monomial), to_flint(k)) for monomial, k in terms.items())
    return context.from_dict({tuple(found.get(atom, 0) for atom in atoms): k for found, k in powers})


def _terms(polynomial: fmpq_mpoly, atoms: list[int]) -> Terms:
    return {
        tuple((atom, int(e)) for atom, e in zip(atoms, powers, strict=True) if e): of_flint(k)
        for powers, k in polynomial.terms()
    }
