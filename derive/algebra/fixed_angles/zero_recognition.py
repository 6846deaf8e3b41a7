"""Whether a polynomial in fixed angles is zero: 4 cos(36 deg) = 1 + sqrt(5).

A ring keeps a fixed angle as its author gave it, cos(35 deg), and knows only c^2 + s^2 = 1 of it; a root of
a sum of roots, sqrt(3 + 2 sqrt(2)), is a generator of its own, though it is 1 + sqrt(2). What stands before
each product of the other generators is a number, and is asked for by itself: first in ball arithmetic, which
refutes. Then angles that are sums of others are written out, for all numbers at once; what is left of one is
freed of its nested roots one by one, and at last seen as a sum of waves (`waves`).

With r^2 = u a number is a + b r. Where it is zero, so is a^2 - b^2 u, which no longer holds r; and where that
is zero, one of a + b r and a - b r is: the other one is refuted, or both a and b r are zero.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache

from flint import fmpq_mpoly

from derive.algebra.fixed_angles.addition_theorems import independent
from derive.algebra.fixed_angles.constants import ball, holds_zero, number_places
from derive.algebra.fixed_angles.exponential_sums import cancels
from derive.algebra.multivariate import grouped
from derive.algebra.ring import Ring


def vanishes(polynomial: fmpq_mpoly, home: Ring) -> bool:
    """Whether a reduced polynomial of a ring stands for zero.

    Raises NotDerivable where that is too much work.
    """
    if polynomial == 0:
        return True
    degrees = polynomial.degrees()
    if any(degrees[place] > 0 for place in _over_fixed_angles(home)):
        polynomial, home = independent(polynomial, home)
        degrees = polynomial.degrees()
    if not any(degrees[place] > 0 for place in _doubtful(home)):
        return bool(polynomial == 0)
    if any(_refuted(number, home) for number in _numbers(polynomial, home)):
        return False
    polynomial, home = independent(polynomial, home)
    return all(_is_zero(number, home) for number in _numbers(polynomial, home))


@lru_cache(maxsize=1024)
def _doubtful(home: Ring) -> frozenset[int]:
    """The places of the numbers that obey more relations than the ring knows; roots of primes do not."""
    return number_places(home) - {i for i, root in enumerate(home.roots) if _plain(root.radicand)}


@lru_cache(maxsize=1024)
def _over_fixed_angles(home: Ring) -> frozenset[int]:
    """The places of roots of expressions that hold doubtful numbers: two may be the same root."""
    names = {home.names[place] for place in _doubtful(home)}
    held = {
        i for i, r in enumerate(home.roots) if any(n in names for powers, _ in r.radicand for n, _ in powers)
    }
    return frozenset(held) - number_places(home)


def _plain(radicand: Iterable[tuple[tuple[tuple[str, int], ...], object]]) -> bool:
    return not any(powers for powers, _ in radicand)


def _numbers(polynomial: fmpq_mpoly, home: Ring) -> list[fmpq_mpoly]:
    """What stands before each product of generators that are no numbers, the shortest first."""
    others = [place for place in range(len(home.names)) if place not in number_places(home)]
    return sorted(grouped(polynomial, others).values(), key=len)


def _refuted(number: fmpq_mpoly, home: Ring) -> bool:
    return not holds_zero(ball(number, home))


def _is_zero(number: fmpq_mpoly, home: Ring) -> bool:
    if number == 0:
        return True
    if _refuted(number, home):
        return False
    degrees = number.degrees()
    roots = ((i, root) for i, root in enumerate(home.roots) if degrees[i] > 0 and root.degree == 2)
    place = next((i for i, root in roots if not _plain(root.radicand)), None)
    if place is None:
        return cancels(number, home)
    root = home.roots[place]
    r, u = home.gen(root.name), home.polynomial(root.radicand)
    b = number.derivative(place)
    a = number - b * r
    if not _is_zero(home.reduce(a * a - b * b * u), home):
        return False
    return _refuted(a - b * r, home) or (_is_zero(a, home) and _is_zero(home.reduce(b * b * u), home))
