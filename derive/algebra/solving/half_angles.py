"""Polynomials in sines and cosines by half angles, where factors are unique.

Modulo c^2 + s^2 = 1 a polynomial has no unique factors: s^2 is also (1 - c)(1 + c). With u = sin(theta/2)
and v = cos(theta/2) it becomes homogeneous of even degree in each pair (u, v), for c = v^2 - u^2,
s = 2 u v and 1 = u^2 + v^2, and such polynomials factor in one way only. Stored is the part where v = 1,
a polynomial in t = tan(theta/2), and the degree in each pair.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property, reduce

from flint import Ordering, fmpq_mpoly, fmpq_mpoly_ctx

from derive.algebra.multivariate import factored, grouped
from derive.algebra.ring import Ring
from derive.algebra.roots_and_functions import in_single_angles
from derive.algebra.scalar import Scalar, common_ring

MOST = 20_000  # terms of the one times those of the other, times their degrees


@dataclass(frozen=True, slots=True, eq=False)
class Halved:
    """A polynomial homogeneous in each pair: its part in t, and its degree in each angle."""

    part: fmpq_mpoly
    degrees: tuple[int, ...]

    def __mul__(self, other: Halved) -> Halved:
        degrees = tuple(a + b for a, b in zip(self.degrees, other.degrees, strict=True))
        return Halved(self.part * other.part, degrees)

    def __pow__(self, power: int) -> Halved:
        return Halved(self.part**power, tuple(degree * power for degree in self.degrees))

    def __floordiv__(self, other: Halved) -> Halved:
        """The quotient; the other must be a factor."""
        degrees = tuple(a - b for a, b in zip(self.degrees, other.degrees, strict=True))
        return Halved(divmod(self.part, other.part)[0], degrees)

    @property
    def parity(self) -> tuple[int, ...]:
        """1 for each angle of odd degree; with none it is a polynomial in sines and cosines."""
        return tuple(degree % 2 for degree in self.degrees)


@dataclass(frozen=True)
class HalfAngles:
    """The half angles of some of the angles of a ring, by their places there; all else stays as it is."""

    home: Ring
    places: tuple[int, ...]

    @cached_property
    def context(self) -> fmpq_mpoly_ctx:
        """FLINT's context of the tangents t and of every generator of the ring."""
        return fmpq_mpoly_ctx.get((*(f"t{k}" for k in self.places), *self.home.names), Ordering.lex)

    def of(self, polynomial: fmpq_mpoly) -> Halved:
        """A polynomial of the ring made homogeneous of even degree in each pair."""
        places = [place for k in self.places for place in self.home.pair_index(k)]
        found = [
            (list(zip(powers[::2], powers[1::2], strict=True)), rest)  # of cosine and sine of each angle
            for powers, rest in grouped(polynomial, places).items()
        ]
        most = [max((sum(powers[k]) for powers, _ in found), default=0) for k in self._counted]
        total = self.context.constant(0)
        for powers, rest in found:
            term = rest.project_to_context(self.context)
            for k in self._counted:
                term = term * self._power(k, *powers[k], most[k])
            total = total + term
        return Halved(total, tuple(2 * degree for degree in most))

    def back(self, halved: Halved) -> fmpq_mpoly:
        """The polynomial in sines and cosines. Raises ValueError where a degree is odd."""
        if any(halved.parity):
            raise ValueError("an odd degree in half angles")
        pairs = [self.home.pair(k) for k in self.places]
        total = self.home.zero
        for powers, rest in grouped(halved.part, self._counted).items():
            term = rest.project_to_context(self.home.context)
            for (c, s), power, degree in zip(pairs, powers, halved.degrees, strict=True):
                term = self.home.reduce(term * self._whole(c, s, power, degree))
            total = total + term
        return self.home.reduce(total)

    def common(self, several: Sequence[Halved]) -> Halved:
        """The greatest common factor, the powers of v included."""
        part = reduce(lambda a, b: a.gcd(b), (each.part for each in several))
        spare = map(min, zip(*(_powers_of_v(each) for each in several), strict=True))
        return Halved(part, tuple(int(n) + more for n, more in zip(part.degrees(), spare, strict=False)))

    def factors(self, halved: Halved) -> list[tuple[Halved, int]]:
        """The irreducible factors with their powers, but for numbers; u^2 + v^2 = 1 is left out."""
        ones = [self.context.gen(k) ** 2 + 1 for k in self._counted]
        factors = [
            (Halved(part, tuple(map(int, part.degrees()[: len(ones)]))), power)
            for part, power in factored(halved.part)[1]
            if part not in ones
        ]
        for k, spare in enumerate(_powers_of_v(halved)):
            if spare:
                v = Halved(self.context.constant(1), tuple(int(i == k) for i in self._counted))
                factors.append((v, spare))
        return factors

    @property
    def _counted(self) -> range:
        return range(len(self.places))

    def _power(self, k: int, cosines: int, sines: int, degree: int) -> fmpq_mpoly:
        """c^cosines s^sines of an angle, made of this degree by powers of 1 = u^2 + v^2."""
        t, ones = self.context.gen(k), int(degree - cosines - sines)
        return (1 - t**2) ** int(cosines) * (2 * t) ** int(sines) * (1 + t**2) ** ones

    @staticmethod
    def _whole(c: fmpq_mpoly, s: fmpq_mpoly, power: int, degree: int) -> fmpq_mpoly:
        """u^power v^(degree - power), the degree even."""
        odd = power % 2
        squares_of_u, squares_of_v = (power - odd) // 2, (degree - power - odd) // 2
        return ((1 - c) / 2) ** squares_of_u * ((1 + c) / 2) ** squares_of_v * (s / 2) ** odd


def _powers_of_v(halved: Halved) -> list[int]:
    """By how much each degree is more than that of the part in t."""
    degrees = halved.part.degrees()
    return [degree - int(degrees[k]) for k, degree in enumerate(halved.degrees)]


def half_angles(home: Ring, names: Iterable[str]) -> HalfAngles:
    """The half angles of all angles that hold one of these names."""
    moving = set(names)
    held = (k for k, form in enumerate(home.angles) if moving & {atom for atom, _ in form.parts})
    return HalfAngles(home, tuple(held))


def resultant(one: Scalar, two: Scalar, name: str) -> Scalar | None:
    """The resultant of two polynomials by one variable (Cox, Little and O'Shea, Ideals, Varieties, and
    Algorithms, chapter 3), for an angle in the tangent of its half: it vanishes wherever both do for some
    value of the name. None where it would be out of all proportion."""
    one, two = in_single_angles(one), in_single_angles(two)
    home = common_ring((one, two))
    p, q = one.into(home).numerator, two.into(home).numerator
    if name in home.index:
        place = home.index[name]
        if _size(p, q, place) > MOST:
            return None
        return Scalar(home, home.reduce(p.resultant(q, name)))
    halves = half_angles(home, (name,))
    if len(halves.places) != 1:
        return None
    f, g = halves.of(p).part, halves.of(q).part
    if _size(f, g, 0) > MOST:
        return None
    found = f.resultant(g, f"t{halves.places[0]}")
    return Scalar(home, home.reduce(found.project_to_context(home.context)))


def _size(p: fmpq_mpoly, q: fmpq_mpoly, place: int) -> int:
    return len(p) * len(q) * (int(p.degrees()[place]) + int(q.degrees()[place]) + 1)
