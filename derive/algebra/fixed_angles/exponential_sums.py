"""Polynomials in fixed angles as sums of waves k e^(i phi), in which it is seen whether they are zero.

c = (e^(i phi) + e^(-i phi))/2, and s is the same of phi - 90 degrees. A product of waves is a wave, so that
an addition theorem leaves nothing behind, however many digits the angles have. What is left is a sum for each
angle in radians, and those are independent over all algebraic numbers (Lindemann and Weierstrass; Baker,
Transcendental Number Theory, theorem 1.4). Each is a polynomial in a root of unity, zero where the
cyclotomic polynomial divides it (Washington, Introduction to Cyclotomic Fields, chapter 2). The root of a
prime p is a sum of waves as well, Gauss's: of the cosines of 2 pi k^2/p, or of the sines where p = 3 mod 4
(Ireland and Rosen, chapter 6). A prime that divides no denominator of the angles has a root that is
independent of them.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import lcm, prod
from typing import TypeAlias

from flint import fmpq, fmpq_mpoly, fmpz, fmpz_poly

from derive.algebra.generators import PI, Root
from derive.algebra.ring import Ring
from derive.errors import NotDerivable

Turn: TypeAlias = tuple[int, ...]  # of pi, then of every other atom, each in parts of its own
Waves: TypeAlias = dict[Turn, fmpq]

MOST_WAVES = 200_000  # products of two, for one polynomial
MOST_PARTS = 30_000  # the product of the primes in the denominators
TWO_AND_THREE = {2: Fraction(1, 4), 3: Fraction(1, 6)}  # sqrt(2) is 2 cos(pi/4), sqrt(3) is 2 cos(pi/6)


def cancels(number: fmpq_mpoly, home: Ring) -> bool:
    """Whether a polynomial in fixed angles and roots of primes is zero.

    Raises NotDerivable where that is too much work.
    """
    places = Places(home)
    sums: dict[tuple[tuple[int, int], ...], Waves] = defaultdict(dict)
    for exponents, coefficient in number.terms():
        rest = tuple((i, int(e)) for i, e in enumerate(exponents) if e and i not in places.waves)
        term: Waves = {places.nothing: coefficient}
        for i, power in enumerate(exponents):
            for _ in range(int(power) if i in places.waves else 0):
                term = places.product(term, places.waves[i])
        places.add(sums[rest], term)
    return all(places.is_zero(waves) for waves in sums.values())


@dataclass
class Places:
    """The waves of the generators of a ring, by their places, and how waves are counted there."""

    home: Ring
    work: int = 0

    @cached_property
    def parts(self) -> dict[str, int]:
        """Of how many parts each atom of the fixed angles is made: a wave turns by whole parts."""
        found = {PI: 2}
        for form in self.home.angles:
            for atom, n in () if form.moving.parts else form.parts:
                found[atom] = lcm(found.get(atom, 1), n.denominator)
        primes = [_radicand(root) for root in self.home.roots]
        found[PI] = lcm(found[PI], *(TWO_AND_THREE[p].denominator for p in primes if p in TWO_AND_THREE))
        return found

    @property
    def nothing(self) -> Turn:
        """The turn of a wave that is a number."""
        return (0,) * len(self.parts)

    @cached_property
    def waves(self) -> dict[int, Waves]:
        """The sum of waves of each generator that is one, by its place."""
        found = {}
        for k, form in enumerate(self.home.angles):
            if not form.moving.parts:
                c, s = self.home.pair_index(k)
                at = dict(form.parts)
                found[c] = self._cosine(at)
                found[s] = self._cosine({**at, PI: at.get(PI, 0) - Fraction(1, 2)})
        for place, root in enumerate(self.home.roots):
            prime = _radicand(root)
            if prime in TWO_AND_THREE:
                found[place] = self.product({self.nothing: fmpq(2)}, self._cosine({PI: TWO_AND_THREE[prime]}))
            elif prime and self.parts[PI] % prime == 0:
                found[place] = self._gauss(prime)
        return found

    def _cosine(self, at: Mapping[str, Fraction | int]) -> Waves:
        turn = tuple(int(at.get(atom, 0) * parts) for atom, parts in self.parts.items())
        found: Waves = {}
        for sign in (1, -1):
            self.add(found, {tuple(sign * n for n in turn): fmpq(1, 2)})
        return found

    def _gauss(self, prime: int) -> Waves:
        back = Fraction(1, 2) if prime % 4 == 3 else 0
        found: Waves = {}
        for k in range(prime):
            self.add(found, self._cosine({PI: Fraction(2 * k * k % (2 * prime), prime) - back}))
        return found

    def add(self, total: Waves, waves: Waves) -> None:
        """In place; half a turn of pi is a sign."""
        half = self.parts[PI]
        for turn, k in waves.items():
            halves, first = divmod(turn[0], half)
            key = (first, *turn[1:])
            found = total.get(key, fmpq(0)) + (-k if halves % 2 else k)
            if found:
                total[key] = found
            else:
                total.pop(key, None)

    def product(self, left: Waves, right: Waves) -> Waves:
        """The product of two sums of waves. Raises NotDerivable where it is too much work."""
        self.work += len(left) * len(right)
        if self.work > MOST_WAVES:
            raise NotDerivable(TOO_MUCH)
        found: Waves = {}
        for a, k in left.items():
            self.add(found, {tuple(map(sum, zip(a, b, strict=True))): k * n for b, n in right.items()})
        return found

    def is_zero(self, waves: Waves) -> bool:
        """Whether a sum of waves is zero: each of its sums over a circle is."""
        sums: dict[Turn, dict[int, fmpq]] = defaultdict(dict)
        for (first, *others), k in waves.items():
            sums[tuple(others)][first] = k
        return all(_cancels_on_the_circle(each, 2 * self.parts[PI]) for each in sums.values())


TOO_MUCH = (
    "whether a long expression in several fixed angles is zero is too much work to decide; "
    "give names to some of the angles"
)


def _cancels_on_the_circle(powers: Mapping[int, fmpq], n: int) -> bool:
    """Whether the sum of k z^power is zero for a primitive n-th root z of unity.

    With m the product of the primes of n the powers 1, z, ..., z^(n/m - 1) are independent over the field of
    z^(n/m), an m-th root of unity.
    """
    m = prod(int(prime) for prime, _ in fmpz(n).factor())
    if m > MOST_PARTS:
        raise NotDerivable(TOO_MUCH)
    scale = lcm(*(int(k.q) for k in powers.values()))
    sums: dict[int, list[int]] = defaultdict(lambda: [0] * m)
    for power, k in powers.items():
        quotient, rest = divmod(power, n // m)
        sums[rest][quotient] = int((k * scale).p)
    cyclotomic = fmpz_poly.cyclotomic(m)
    return all(fmpz_poly(dense) % cyclotomic == 0 for dense in sums.values())


def _radicand(root: Root) -> int:
    """n of the square root of a number; 0 for any other root."""
    match root.radicand:
        case (((), Fraction() as value),) if value.denominator == 1 and root.degree == 2:
            return int(value)
    return 0
