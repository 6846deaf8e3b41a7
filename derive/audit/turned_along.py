"""A body that turns along a path, in many digits: from one orientation to the other, its rates by differences
of it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any

import mpmath

from derive.audit.asked import Asked, Holds, Test
from derive.audit.points import ROUNDED, Point, agree, shown
from derive.audit.poses import UNIT, after
from derive.mechanics.paths import Oriented, Turned

Share = Callable[[Any], Any]
LOOSE = mpmath.mpf(10) ** -6  # of what is differentiated in numbers


def turning(asked: Asked, point: Point, when: Any, now: Point, share: Share, in_time: bool) -> Iterator[Test]:
    """All that is said of the orientation at a moment, and how it changes there."""
    turned: Turned = asked.subject.turned
    first, last = (_placed(end, asked, point) for end in (turned.start, turned.end))
    like = [now.at(each) for each in asked.result("axis")] if "axis" in asked.results else None
    angle, axis = _between(first.T * last, like)

    def at(t: Any) -> mpmath.matrix:
        u = share(t)
        if turned.by == "euler-angles":
            return _sequence(turned.convention, _angles(turned, asked, point, u))
        return first * _about(axis, u * angle)

    R = at(when)
    if "angle" in asked.results:
        yield Holds("angle", agree(now.at(asked.result("angle")), angle, near=ROUNDED), f"it is {angle}")
    if "axis" in asked.results:
        yield Holds("axis", _same(like or (), axis), f"it is {shown(list(axis))}")
    if "angles" in asked.results:
        theirs = _angles(turned, asked, point, share(when))
        yield Holds("angles", _same(now.each(asked.result("angles")), theirs), f"they are {shown(theirs)}")
    if "R" in asked.results:
        rows: Any = now.each(asked.result("R"))
        ours = [each for row in rows for each in row]
        yield Holds("R", _same(ours, list(R)), f"it is {shown(list(R))}")
    if "q" in asked.results:
        q: Any = now.each(asked.result("q"))
        yield Holds("q", _same(list(_of_quaternion(q)), list(R)), "it turns otherwise")
    if in_time:
        yield from _rates(asked, now, at, when)


def _rates(asked: Asked, now: Point, at: Callable[[Any], mpmath.matrix], when: Any) -> Iterator[Test]:
    h = mpmath.mpf(10) ** -8

    def omega(t: Any) -> list[Any]:
        S = (at(t + h) - at(t - h)) / (2 * h) * at(t).T
        return [(S[2, 1] - S[1, 2]) / 2, (S[0, 2] - S[2, 0]) / 2, (S[1, 0] - S[0, 1]) / 2]

    velocity = omega(when)
    change = [(a - b) / (2 * h) for a, b in zip(omega(when + h), omega(when - h), strict=True)]
    for name, theirs in (("omega", velocity), ("alpha", change)):
        yield Holds(name, _same(now.each(asked.result(name)), theirs, LOOSE), f"it is {shown(theirs)}")


def _placed(end: Oriented, asked: Asked, point: Point) -> mpmath.matrix:
    """Its rotation (3 by 3)."""
    if end.matrix is not None:
        return mpmath.matrix([[point.at(asked.formula(entry)) for entry in row] for row in end.matrix.rows])
    T = after(end.moves, asked)
    return mpmath.matrix([[point.at(T[i, j]) for j in range(3)] for i in range(3)])


def _between(D: mpmath.matrix, like: Sequence[Any] | None) -> tuple[Any, list[Any]]:
    """The angle and the axis; of half a turn the one that is like a given one."""
    w = [D[2, 1] - D[1, 2], D[0, 2] - D[2, 0], D[1, 0] - D[0, 1]]
    size = mpmath.sqrt(sum(each**2 for each in w))
    angle = mpmath.atan2(size, D[0, 0] + D[1, 1] + D[2, 2] - 1)
    if size > ROUNDED:
        return angle, [each / size for each in w]
    j = max(range(3), key=lambda i: D[i, i])
    column = [(D[i, j] + (i == j)) / 2 for i in range(3)]
    size = mpmath.sqrt(sum(each**2 for each in column)) or 1
    sign = -1 if like and sum(a * b for a, b in zip(column, like, strict=True)) < 0 else 1
    return angle, [sign * each / size for each in column]


def _about(axis: Sequence[Any], angle: Any) -> mpmath.matrix:
    x, y, z = axis
    S = mpmath.matrix([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return mpmath.eye(3) + mpmath.sin(angle) * S + (1 - mpmath.cos(angle)) * (S * S)


def _sequence(letters: str, angles: Sequence[Any]) -> mpmath.matrix:
    R = mpmath.eye(3)
    for letter, angle in zip(letters, angles, strict=True):
        step = _about(UNIT[letter.lower()], angle)
        R = R * step if letter.isupper() else step * R
    return R


def _angles(turned: Turned, asked: Asked, point: Point, share: Any) -> list[Any]:
    ends = zip(turned.start.angles or (), turned.end.angles or (), strict=True)
    pairs = ((point.at(asked.formula(a)), point.at(asked.formula(b))) for a, b in ends)
    return [a + share * (b - a) for a, b in pairs]


def _of_quaternion(q: Sequence[Any]) -> mpmath.matrix:
    """The rotation of a unit quaternion."""
    w, x, y, z = q
    S = mpmath.matrix([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return mpmath.eye(3) + 2 * w * S + 2 * (S * S)


def _same(ours: Any, theirs: Sequence[Any], near: Any = ROUNDED) -> bool:
    size = 1 + max(map(abs, theirs))
    return len(ours) == len(theirs) and all(
        agree(a, b, size, near) for a, b in zip(ours, theirs, strict=True)
    )
