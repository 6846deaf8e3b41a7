"""Pieper's quartic: three revolute joints whose axes neither meet nor are parallel move a point.

Neither the distance of the point from a point of the first axis nor its height along that axis changes with
the first joint. Both are linear in the cosine and the sine of the second angle, with coefficients that are at
right angles to each other, so that squaring and adding leaves the third angle alone: a polynomial of degree
two in its cosine and sine, of degree four in the tangent of its half (Pieper 1968; Craig, section 4.6).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import reduce
from itertools import groupby, product
from operator import add

from derive.algebra.angles import Form
from derive.algebra.multivariate import factored
from derive.algebra.scalar import Scalar, common_ring
from derive.mechanics.inverse.known import Knowledge
from derive.mechanics.inverse.paul import Equation
from derive.mechanics.inverse.search import Difference, Stage
from derive.mechanics.inverse.subproblems import (
    Coordinate,
    Joined,
    Quartic,
    TrigEquation,
    TrigPolynomial,
    split,
    trig_equation,
    two_equations,
)


def quartic(stage: Stage, known: Knowledge, name: str) -> tuple[Quartic, Joined] | None:
    """The third angle, by a root called `name`, and then the second; None where the equations are not so."""
    unknown = known.unknown_joints()
    if len(unknown) != 3 or known.forms or known.slides:
        return None
    return next(_found(stage, unknown, name), None)


def _found(stage: Stage, unknown: frozenset[str], name: str) -> Iterator[tuple[Quartic, Joined]]:
    """Whatever distance and height two joints have alone, in the one of them that they are linear in."""
    heights = [each for each in stage.equations if each.equation.is_position and len(each.joints) == 2]
    for coordinates, height in product(_by_frame(stage), heights):
        (first,), distance = unknown - height.joints, _distance(stage, coordinates)
        if distance.diff(first):
            continue
        for second in (name for name in stage.joints if name in height.joints):
            (third,) = height.joints - {second}
            angle, q = Form.of({second: 1}), Form.of({third: 1})
            rows = _turned(angle, third, distance, coordinates[0], height)
            trig = rows and _in_trig(_joined(*rows), q)
            factors = trig and tuple(_factors(_in_half_angle(trig), name))
            if rows and trig and factors:
                sides = tuple(_sides(stage, each) for each in coordinates)
                equation = _height(height, coordinates)
                joined = two_equations(angle, *rows)
                yield (
                    Quartic(q, angle, first, sides, equation, *rows, trig, name, factors),
                    Joined(angle, joined.first, joined.second, joined.method),
                )


def _joined(one: TrigEquation, other: TrigEquation) -> Scalar:
    """c_1^2 + c_2^2 - a^2 - b^2."""
    return one.c * one.c + other.c * other.c - one.a * one.a - one.b * one.b


def _height(height: Difference, coordinates: Sequence[Difference]) -> Equation:
    """The height; one of the coordinates where that says the same."""
    same = (each.equation for each in coordinates if each.value in (height.value, -height.value))
    return next(same, height.equation)


def _by_frame(stage: Stage) -> Iterator[list[Difference]]:
    """The three coordinates of the point, seen from each frame but the base."""
    positions = [
        each for each in stage.equations if each.equation.is_position and each.equation.between.last is None
    ]
    for between, group in groupby(positions, key=lambda each: each.equation.between):
        each = list(group)
        if between.first != stage.base and len(each) == 3:
            yield each


def goal_names(stage: Stage) -> frozenset[str]:
    """The names of the coordinates that are known: what stands left in the base."""
    return frozenset(
        name
        for each in stage.equations
        if each.equation.between.first == stage.base and each.equation.between.last is None
        for name in each.equation.left.generators()
    )


def _sides(stage: Stage, one: Difference) -> Coordinate:
    """What is known of the point on the one side, the lengths of the arm on the other."""
    found = split(one.equation, one.value, goal_names(stage))
    return Coordinate(one.equation, -found.unknown, -found.known)


def _distance(stage: Stage, coordinates: Sequence[Difference]) -> Scalar:
    """The squares of the one side less those of the other."""
    sides = [_sides(stage, each) for each in coordinates]
    return reduce(add, (each.unknown * each.unknown - each.known * each.known for each in sides))


def _turned(
    angle: Form, third: str, distance: Scalar, at: Difference, height: Difference
) -> tuple[TrigEquation, TrigEquation] | None:
    """Both as a c + b s = c_1 and -b c + a s = c_2, where the distance is that from the foot of the common
    normal of the first two axes; None where there is no such point."""
    one = trig_equation(distance, angle, at.equation)
    other = trig_equation(height.value, angle, height.equation)
    if one is None or other is None:
        return None
    shift = _multiple(one.a * other.a + one.b * other.b, other.a * other.a + other.b * other.b, third)
    if shift is None:
        return None
    one = replace(one, a=one.a - shift * other.a, b=one.b - shift * other.b, c=one.c - shift * other.c)
    if not (one.a or one.b):  # the first two axes meet
        return None
    one = _over(one, _content(Form.of({third: 1}), one.a, one.b))
    ratio = _multiple(other.b, one.a, third) if one.a else _multiple(-other.a, one.b, third)
    if not ratio or other.a != -ratio * one.b or other.b != ratio * one.a:
        return None
    if ratio.constant is not None:  # the height as it is
        size = abs(ratio.constant)
        return _over(one, Scalar.of(1 / size)), _over(other, ratio / size)
    return one, _over(other, ratio)


def _over(row: TrigEquation, by: Scalar) -> TrigEquation:
    return replace(row, a=row.a / by, b=row.b / by, c=row.c / by)


def _multiple(value: Scalar, of: Scalar, third: str) -> Scalar | None:
    """What another has to be multiplied by to be this, where that does not rest on the third joint."""
    home, names = common_ring((value, of)), tuple(f"{f}({third})" for f in ("cos", "sin"))
    tops, bottoms = (home.grouped(each.into(home).numerator, names) for each in (value, of))
    power, bottom = next(iter(bottoms.items()), ((0, 0), home.zero))
    if not bottom:
        return None
    found = Scalar(home, tops.get(power, home.zero)) / Scalar(home, bottom)
    return found if value == found * of else None


def _content(angle: Form, *values: Scalar) -> Scalar:
    """Twice what all coefficients of the cosine and the sine of an angle have in common in these, numbers
    apart: a square has its products twice."""
    home = common_ring(values)
    c, s = f"cos({angle})", f"sin({angle})"
    parts = [part for each in values for part in home.grouped(each.into(home).numerator, (c, s)).values()]
    return Scalar(home, 2 * reduce(lambda a, b: a.gcd(b), parts))


def _in_trig(value: Scalar, angle: Form) -> TrigPolynomial | None:
    """By powers of the cosine and the sine of an angle, without what they have in common; None of a degree
    above two, and where another angle is left."""
    home = value.ring
    c, s = f"cos({angle})", f"sin({angle})"
    found = home.grouped(value.numerator, (c, s))
    if any(c + s > 2 for c, s in found) or found.keys() <= {(0, 0)}:
        return None
    common = reduce(lambda a, b: a.gcd(b), found.values())
    return {(n, m): Scalar(home, divmod(each, common)[0]) for (n, m), each in found.items()}


def _in_half_angle(trig: TrigPolynomial) -> tuple[Scalar, ...]:
    """With u = tan(theta/2), times (1 + u^2)^2: the coefficients of u^4, u^3, ..., 1."""
    zero = Scalar.of(0)
    cc, cs, ss = (trig.get(powers, zero) for powers in ((2, 0), (1, 1), (0, 2)))
    c, s, one = (trig.get(powers, zero) for powers in ((1, 0), (0, 1), (0, 0)))
    return cc - c + one, 2 * (s - cs), 2 * one + 4 * ss - 2 * cc, 2 * (s + cs), cc + c + one


def _factors(coefficients: Sequence[Scalar], name: str) -> Iterator[tuple[Scalar, ...]]:
    """The factors of a polynomial with these coefficients in which the name occurs, each by its own, the
    highest power first."""
    u = Scalar.symbol(name)
    total = Scalar.of(0)
    for each in coefficients:
        total = total * u + each
    home = total.ring
    for factor, _ in factored(total.numerator)[1]:
        powers = home.grouped(factor, (name,))
        if degree := max(n for (n,) in powers):
            yield tuple(Scalar(home, powers.get((n,), home.zero)) for n in range(degree, -1, -1))
