"""Two eliminations whose product holds one angle: an equation in twice that angle.

Where x = u s and z = u c, and v c = a and v s = b, the unknown lengths u and v and the angle of c and s are
eliminated at once by x a = z b. Where each side is linear in the cosine and sine of an angle q, that is an
equation in 2 q.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from itertools import combinations

from derive.algebra.angles import Form
from derive.algebra.scalar import Scalar
from derive.mechanics.inverse import subproblems
from derive.mechanics.inverse.known import Knowledge
from derive.mechanics.inverse.search import Stage
from derive.mechanics.inverse.subproblems import Coordinate, DoubleAngle, HalfAngle

MOST = 24  # equations of which products are tried
HALF = Scalar.of(Fraction(1, 2))
Pair = tuple[Coordinate, Coordinate]


def doubled(stage: Stage, known: Knowledge, name: str) -> tuple[DoubleAngle, HalfAngle] | None:
    """The shortest such equation, in an angle by this name; and what it leaves of the single angle."""
    forms = (form for form in known.sought() if len(form.parts) == 1)
    found = [each for form in forms for each in _products(stage, known, form, name)]
    best = min(found, key=lambda each: sum(len(part.numerator) for part in each.coefficients), default=None)
    return (best, HalfAngle(best.angle, name)) if best else None


def _products(stage: Stage, known: Knowledge, form: Form, name: str) -> Iterator[DoubleAngle]:
    rows = _alone(stage, known, form)[:MOST]
    alike: dict[frozenset[str], list[tuple[Pair, Scalar]]] = {}
    for pair in combinations(rows, 2):
        product = pair[0].unknown * pair[1].unknown
        if len(product.numerator) == 1:
            alike.setdefault(frozenset(product.generators()), []).append((pair, product))
    couples = (couple for pairs in alike.values() for couple in combinations(pairs, 2))
    for (first, one), (second, other) in couples:
        ratio = (one / other).constant
        if ratio is None or {*map(id, first)} & {*map(id, second)}:
            continue
        value = first[0].known * first[1].known - second[0].known * second[1].known * ratio
        coefficients = subproblems.double_angle(value, form)
        if coefficients and not stage.vanishes(*coefficients[:2]):
            yield DoubleAngle(name, form, first, second, Scalar.of(ratio), coefficients)


def _alone(stage: Stage, known: Knowledge, form: Form) -> list[Coordinate]:
    """Equations of which the side that is known but for this angle equals one term, short ones first, none
    twice."""
    unknown = known.unknown_generators(form) - {f"cos({form})", f"sin({form})"}
    found: list[Coordinate] = []
    for one in stage.equations:
        value = one.value.into(known.home(form, one.value.ring))
        part = subproblems.split(one.equation, value, unknown)
        again = any(part.known in (other.known, -other.known) for other in found)
        if part.known and len(part.unknown.numerator) == 1 and not again:
            found.append(part)
    return sorted(found, key=lambda part: len(part.known.numerator))
