"""Symbols that occur only as one sum, taken for one letter: d6 and z6 where both stand as d6 + z6.

A polynomial holds x and y only as x + y exactly where its derivatives by both are the same, and only as
x - y where they are opposite. With u = x + y it has fewer terms: m (x^2 + 2 x y + y^2) is m u^2.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping

from derive.algebra.rationals import Rational
from derive.algebra.readable.terms import Alphabet, Monomial, Terms, divided, put, times

MODULUS = 1_000_003


def lumped(terms: Terms, alphabet: Alphabet) -> Terms:
    """Equal terms in which such sums are atoms; a sum that stands alone in one term is left as it is."""
    while (found := _pair(terms, alphabet)) is not None:
        terms = _joined(terms, *found, alphabet)
    return terms


def _pair(terms: Terms, alphabet: Alphabet) -> tuple[int, int, int] | None:
    """(x, y, sign) where x and y occur only as x + sign * y."""
    alike = _alike(terms, alphabet)
    for atoms in alike.values():
        slopes = {atom: _slope(terms, atom) for atom in atoms} if len(atoms) > 1 else {}
        for place, x in enumerate(slopes):
            for y in atoms[place + 1 :]:
                for sign in (1, -1):
                    if slopes[y] == {monomial: sign * k for monomial, k in slopes[x].items()}:
                        return x, y, sign
    return None


def _alike(terms: Terms, alphabet: Alphabet) -> Mapping[tuple[int, Rational], list[int]]:
    """Atoms by how often they occur, and by a checksum of their derivatives but for the sign: only such as
    agree in this can have the same derivative."""
    counts: dict[int, int] = defaultdict(int)
    sums: dict[int, Rational] = defaultdict(int)
    marks = [pow(atom + 2, 5, MODULUS) for atom in range(len(alphabet.atoms))]
    for monomial, k in terms.items():
        mark = sum([marks[atom] * power for atom, power in monomial])
        for atom, power in monomial:
            counts[atom] += 1
            sums[atom] += k * power * ((mark - marks[atom]) ** 2 % MODULUS)
    alike: dict[tuple[int, Rational], list[int]] = defaultdict(list)
    for atom in sorted(counts, key=alphabet.key):
        if counts[atom] > 1 and alphabet.is_letter(atom):
            alike[counts[atom], max(sums[atom], -sums[atom])].append(atom)
    return alike


def _slope(terms: Terms, atom: int) -> Terms:
    """The partial derivative."""
    found: Terms = {}
    for monomial, k in terms.items():
        power = dict(monomial).get(atom, 0)
        if power:
            put(found, divided(monomial, {atom: 1}), k * power)
    return found


def _joined(terms: Terms, x: int, y: int, sign: int, alphabet: Alphabet) -> Terms:
    """x + sign * y written as one atom: what is left for y = 0, with it in place of x."""
    whole = alphabet.lump(x, y, sign)
    found: Terms = {}
    for monomial, k in terms.items():
        powers = dict(monomial)
        if y not in powers:
            found[_renamed(monomial, x, whole, powers.get(x, 0))] = k
    return found


def _renamed(monomial: Monomial, old: int, new: int, power: int) -> Monomial:
    return times(divided(monomial, {old: power}), ((new, power),)) if power else monomial
