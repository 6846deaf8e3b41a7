"""Which stationary points are the highest and the lowest of all, where these are sure to exist.

On a set that is closed and bounded a continuous function has both; on a closed set alone it has a
smallest value where it grows beyond all bounds towards infinity.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

from flint import arb

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.scalar import Scalar
from derive.algebra.solving.polynomial_systems import Value
from derive.algebra.solving.polynomials import coefficients, degree, holds, known_sign, monomials
from derive.kinds.function._stationary import Point, Task, as_ball


@dataclass(frozen=True, slots=True)
class Reach:
    """Why there is a highest or lowest point: "compact", "grows", or ""."""

    highest: str = ""
    lowest: str = ""


def reach(task: Task) -> Reach:
    """What can be said without looking at the points."""
    if any(h.denominator is not None for h in (task.f, *task.g)):
        return Reach()
    f, g, left = _reduced(task)
    if not left or any(leading_sign(each, left, task.positive) for each in g):
        return Reach("compact", "compact")
    sign = leading_sign(f, left, task.positive)
    return Reach("grows" if sign == -1 else "", "grows" if sign == 1 else "")


def _reduced(task: Task) -> tuple[Scalar, list[Scalar], tuple[str, ...]]:
    """With the linear constraints used up: f, the other constraints, and the variables left in them."""
    f, g, left = task.f, list(task.g), task.variables
    while (found := _linear(g, left)) is not None:
        used, name, value = found
        g = [each.substitute({name: value}) for each in g if each is not used]
        f = f.substitute({name: value})
        left = tuple(each for each in left if each != name)
    return f, g, left


def _linear(g: Sequence[Scalar], names: tuple[str, ...]) -> tuple[Scalar, str, Scalar] | None:
    for each in g:
        for name in names:
            k = coefficients(each, name)
            if len(k) == 2 and not holds(k[1], names):
                return each, name, -k[0] / k[1]
    return None


def leading_sign(polynomial: Scalar, names: Sequence[str], positive: Collection[str]) -> int:
    """1 or -1 where the terms of the highest degree are a definite form in all the names; else 0."""
    size = degree(polynomial, names)
    if size == 0 or size % 2 or polynomial.denominator is not None:
        return 0
    top = [term for term in monomials(polynomial) if degree(term, names) == size]
    if size == 2:
        return _definite(sum(top, Scalar.of(0)), names, positive)
    pure = {name for name in names for term in top if len(coefficients(term, name)) == size + 1}
    even = all((len(coefficients(term, name)) - 1) % 2 == 0 for term in top for name in names)
    signs = {known_sign(term, positive) for term in top}
    return (signs.pop() or 0) if even and pure == set(names) and len(signs) == 1 else 0


def _definite(form: Scalar, names: Sequence[str], positive: Collection[str]) -> int:
    """The sign of a definite quadratic form, by Sylvester's criterion."""
    rows = ScalarMatrix.of([form.diff(x).diff(y) for y in names] for x in names)
    minors = [rows.block(slice(k), slice(k)).det() for k in range(1, len(names) + 1)]
    signs = [known_sign(minor, positive) for minor in minors]
    if all(sign == 1 for sign in signs):
        return 1
    return -1 if all(sign == (-1) ** k for k, sign in enumerate(signs, 1)) else 0


def extremes(points: Sequence[Point], found: Reach, positive: Collection[str]) -> list[str]:
    """For each point "maximum", "minimum", "both" or "": the highest and lowest of all the points."""
    said = [""] * len(points)
    if any(not holds(each, point.solution.free) for point in points for each in point.solution.real_if):
        return said  # which of them exist depends on the parameters
    for word, sign in (("maximum", 1), ("minimum", -1)):
        if not (found.highest if sign == 1 else found.lowest):
            continue
        for k in _best(points, sign, positive):
            said[k] = "both" if said[k] else word
    return said


def _best(points: Sequence[Point], sign: int, positive: Collection[str]) -> list[int]:
    """Those whose value no other exceeds (times `sign`); none where a comparison is not known."""
    best: list[int] = []
    for k, point in enumerate(points):
        gaps = [_gap(point.value, other.value, positive) for other in points]
        if None in gaps:
            return []
        if all(gap is not None and gap * sign >= 0 for gap in gaps):
            best.append(k)
    return best


def _gap(a: Value, b: Value, positive: Collection[str]) -> int | None:
    """The sign of a - b."""
    if isinstance(a, Scalar) and isinstance(b, Scalar):
        return known_sign(a - b, positive)
    gap: arb = as_ball(a) - as_ball(b)
    return 1 if gap > 0 else -1 if gap < 0 else 0
