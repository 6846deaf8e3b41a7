"""Whether a polynomial in fixed angles is zero: 4 cos(36 deg) = 1 + sqrt(5).

A ring keeps a fixed angle as its author gave it, cos(35 deg), and knows only c^2 + s^2 = 1 of it.
Between such angles, and the square roots of numbers, there are more relations. All of them hold in the
real part of a cyclotomic field, and there zero is decided. An angle pi k/n with n = 2^a m, m odd, is a
multiple of pi/2^a and one of 2 pi/m. The field is then a tower of independent steps:

- h_2 = sqrt(2), h_3 = sqrt(2 + h_2), ...: h_a = 2 cos(pi/2^a);
- c = cos(2 pi/m), of degree phi(m)/2, by its minimal polynomial;
- s = sin(2 pi/m), with s^2 = 1 - c^2: no sine of an odd part is rational in its cosine;
- the root of each prime that does not divide n. Of a prime that divides m it is a sum of Gauss,
  the sum of (k/p) cos(2 pi k/p), or of sines where p = 3 mod 4 (Ireland and Rosen, chapter 6).

(Washington, Introduction to Cyclotomic Fields, chapter 2.)
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property, lru_cache

from flint import fmpq_mpoly, fmpz_poly

from derive.algebra.angles import PI, Form
from derive.algebra.nested_roots import cancels
from derive.algebra.ring import Pair, Ring, Root, ring

# Beyond this n of pi k/n the field is too large; equality is then that of the polynomials alone.
MOST_PARTS = 3600


def vanishes(polynomial: fmpq_mpoly, home: Ring) -> bool:
    """Whether a reduced polynomial of a ring stands for zero."""
    if polynomial == 0:
        return True
    if home.fixed is None or home.fixed.of_atom(PI).denominator > MOST_PARTS:
        return cancels(polynomial, home, home.reduce)
    field, images = _settling(home, home.fixed)
    total = field.ring.zero
    for powers, rest in _by_powers(polynomial, home, home.fixed).items():
        part = rest.compose(*images, ctx=field.ring.context)
        for place, power in powers:
            part = field.reduce(part * field.power(images[place], power))
        total = total + part
    return cancels(field.reduce(total), field.ring, field.reduce)


def _by_powers(
    polynomial: fmpq_mpoly, home: Ring, fixed: Form
) -> dict[tuple[tuple[int, int], ...], fmpq_mpoly]:
    """What multiplies each product of powers of the fixed cosine and sine, keyed by (place, power):
    put in at once, a cosine to the 89th would be multiplied out before anything is reduced."""
    places = home.pair_index(home.angles.index(fixed))
    groups: dict[tuple[tuple[int, int], ...], dict[tuple[int, ...], object]] = {}
    for exponents, coefficient in polynomial.to_dict().items():
        rest = tuple(0 if place in places else e for place, e in enumerate(exponents))
        key = tuple((place, int(exponents[place])) for place in places)
        groups.setdefault(key, {})[rest] = coefficient
    return {key: home.context.from_dict(terms) for key, terms in groups.items()}


@dataclass(frozen=True)
class _Field:
    """A ring over the field with the angle 2 pi/m (none for m = 1) and h_2, ..., h_a."""

    ring: Ring
    m: int
    a: int

    @cached_property
    def relation(self) -> fmpq_mpoly:
        """The minimal polynomial of c = cos(2 pi/m)."""
        c, _ = self.pair
        terms = fmpz_poly.cos_minpoly(self.m).coeffs()  # of 2 c
        return sum(((2 * c) ** k * int(n) for k, n in enumerate(terms)), self.ring.zero)

    @property
    def pair(self) -> Pair:
        """(cosine, sine) of 2 pi/m."""
        return self.ring.pair(self.ring.angles.index(_generator(self.m)))

    def reduce(self, polynomial: fmpq_mpoly) -> fmpq_mpoly:
        """The unique representative: sines and roots at most once, then c below its degree."""
        polynomial = self.ring.reduce(polynomial)
        return divmod(polynomial, self.relation)[1] if self.m > 1 else polynomial

    def trig(self, turns: Fraction) -> Pair:
        """(cosine, sine) of turns * pi, for a denominator that divides 2^a m."""
        two = turns.denominator & -turns.denominator
        odd = turns.denominator // two
        v = turns.numerator * pow(two, -1, odd) % odd
        v += v % 2 * odd  # even, as the generator is 2 pi/m
        u = (turns.numerator - v * two) // odd
        rest = self._times(self.pair, v * self.m // (2 * odd)) if odd > 1 else self._nought
        return self._added(self._times(self._halved(two), u % (2 * two)), rest)

    def power(self, base: fmpq_mpoly, n: int) -> fmpq_mpoly:
        """base^n, reduced on the way."""
        found = self.ring.one
        while n:
            found = self.reduce(found * base) if n & 1 else found
            base, n = self.reduce(base * base) if n > 1 else base, n >> 1
        return found

    @property
    def _nought(self) -> Pair:
        return self.ring.one, self.ring.zero

    def _halved(self, two: int) -> Pair:
        """(cosine, sine) of pi/two, `two` a power of 2; the sine is the cosine of what is left to pi/2."""
        if two <= 2:
            return (-self.ring.one, self.ring.zero) if two == 1 else (self.ring.zero, self.ring.one)
        c = self.ring.gen(tower(two.bit_length() - 1)[-1].name) / 2
        before, cosine = self.ring.one, c
        for _ in range(two // 2 - 2):  # cos (k + 1) x = 2 cos x cos k x - cos (k - 1) x
            before, cosine = cosine, self.ring.reduce(2 * c * cosine) - before
        return c, cosine

    def _times(self, pair: Pair, n: int) -> Pair:
        """Of n times the angle, by doubling."""
        found, power = self._nought, pair
        while n:
            found = self._added(found, power) if n & 1 else found
            power, n = self._added(power, power), n >> 1
        return found

    def _added(self, p: Pair, q: Pair) -> Pair:
        return self.reduce(p[0] * q[0] - p[1] * q[1]), self.reduce(p[1] * q[0] + p[0] * q[1])

    def prime_root(self, p: int) -> fmpq_mpoly:
        """sqrt(p) of a prime that divides m, by Gauss's sum."""
        total = self.ring.zero
        for k in range(1, p):
            sign = 1 if pow(k, (p - 1) // 2, p) == 1 else -1
            total = total + sign * self.trig(Fraction(2 * k, p))[0 if p % 4 == 1 else 1]
        return total


def tower(a: int) -> tuple[Root, ...]:
    """h_2, ..., h_a, each named as the same root typed by an author would be."""
    found = [Root("sqrt(2)", (((), Fraction(2)),))]
    for _ in range(a - 2):
        below = found[-1].name
        found.append(Root(f"sqrt((1*{below}^1+2))", (((), Fraction(2)), (((below, 1),), Fraction(1)))))
    return tuple(found[: max(a - 1, 0)])


def _generator(m: int) -> Form:
    return Form.of({PI: Fraction(2, m)})


@lru_cache(maxsize=256)
def _settling(home: Ring, fixed: Form) -> tuple[_Field, tuple[fmpq_mpoly, ...]]:
    """The field for a ring with this fixed angle, and where its generators go there."""
    n = fixed.of_atom(PI).denominator
    a = (n & -n).bit_length() - 1
    m = n >> a
    angles = [form for form in home.angles if form != fixed]
    target = ring((), (*angles, *([_generator(m)] if m > 1 else ())), home.symbols)
    for root in tower(a):
        target = target.with_root(root)
    for root in reversed(home.roots):
        if not _known(root, m):
            field = _Field(target, m, a)
            inside = home.polynomial(root.radicand).compose(*_images(home, field), ctx=target.context)
            target = target.with_root(replace(root, radicand=target.terms(field.reduce(inside))))
    field = _Field(target, m, a)
    return field, _images(home, field)


def _images(home: Ring, field: _Field) -> tuple[fmpq_mpoly, ...]:
    """Zero for the roots that have no place yet."""
    pairs = [field.trig(q) if (q := form.of_atom(PI)) else field.ring.trig(form) for form in home.angles]
    known = [pair for pair in pairs if pair is not None]
    return (
        *(_root(root, field) for root in home.roots),
        *(sine for _, sine in known),
        *(cosine for cosine, _ in known),
        *map(field.ring.gen, home.symbols),
    )


def _root(root: Root, field: _Field) -> fmpq_mpoly:
    if _known(root, field.m):
        return field.prime_root(_radicand(root))
    return field.ring.gen(root.name) if root.name in field.ring.index else field.ring.zero


def _known(root: Root, m: int) -> bool:
    """Whether it is the root of a prime that divides m."""
    inside = _radicand(root)
    return inside > 1 and m % inside == 0


def _radicand(root: Root) -> int:
    """n of the square root of a number; 0 for any other root."""
    match root.radicand:
        case (((), Fraction() as value),) if value.denominator == 1 and root.degree == 2:
            return int(value)
    return 0
