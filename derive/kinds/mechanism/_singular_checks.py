"""Singular positions of a linkage, looked for all around: where distances between joints are sums of bars."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from math import tau

from derive.algebra.numbers.floats import Point
from derive.algebra.numbers.floats import number as at
from derive.derivation import Branch, Phrase, Step
from derive.errors import NotReal
from derive.expression import Expr, Symbol, free_symbols, replace
from derive.kinds.checks import close, random_points
from derive.kinds.mechanism._facts import EndTold, Singular
from derive.kinds.mechanism._loop_oracle import ROUND, tip, zeros
from derive.kinds.mechanism._position_checks import SIZES
from derive.kinds.work import Work
from derive.mechanics.linkages import FourBar, SliderCrank

POINTS, NEAR, TURN = 4, 1e-6, 0.7
TOUCHING = 1e-3  # of a cosine: where it is this near to one, two places meet and no sign changes


def gaps(linkage: FourBar | SliderCrank, sizes: Sequence[float]) -> dict[str, Callable[[float], float]]:
    """What vanishes at an angle of the crank where bars lie in line, or a rod stands upright, by its key."""
    if isinstance(linkage, FourBar):
        crank, coupler, rocker, ground = sizes
        return {
            "toggle-stretched": lambda t: abs(tip(crank, t) - ground) - (coupler + rocker),
            "toggle-folded": lambda t: abs(tip(crank, t) - ground) - abs(coupler - rocker),
            "limit-stretched": lambda t: abs(tip(crank + coupler, t) - ground) - rocker,
            "limit-folded": lambda t: abs(tip(crank - coupler, t) - ground) - rocker,
        }
    crank, rod, offset = sizes
    return {
        "upright-above": lambda t: tip(crank, t).imag - offset - rod,
        "upright-below": lambda t: tip(crank, t).imag - offset + rod,
        "rod-stretched": lambda t: tip(crank + rod, t).imag - offset,
        "rod-folded": lambda t: tip(crank - rod, t).imag - offset,
    }


def all_found(
    linkage: FourBar | SliderCrank,
    work: Work,
    branches: tuple[Branch, ...],
    around: Phrase | None,
    places: Sequence[Singular],
) -> Iterator[bool]:
    """At every size of the bars the angles that were found, where they are real, are those at which there is
    such a position; each is told of the right bars, the lines hold there, and what is moved is where the loop
    closes, as the words say. The crank goes round where the bars can be joined at every angle."""
    ends = {place.line: place.end for place in places if place.end}
    problem = work.problem
    names = [name for name in SIZES[type(linkage)] if name != "angle"]
    trees = [problem.final(getattr(linkage, name)) for name in names]
    for point in random_points(frozenset().union(*map(free_symbols, trees)), POINTS):
        sizes = [at(tree, point) for tree in trees]
        seen = gaps(linkage, sizes)
        found: dict[str, list[float]] = {key: [] for key in seen}
        for branch in branches:
            found[_key(branch)].extend(_real(branch, point))
            yield from _closes(linkage, sizes, branch, point)
            if end := ends.get(_key(branch)):
                yield from _ends(work, end, branch, point)
        if around is not None:
            yield (around.key == "all-round") == _goes_round(seen)
        for key, angles in found.items():
            yield all(abs(seen[key](angle)) < NEAR for angle in angles)
            there = zeros(seen[key], 0, tau)
            apart = {round(abs(tip(1, a) - tip(1, b)), 3) for a in angles for b in angles} - {0.0}
            if not angles or apart:
                yield len(there) == len(angles)
                yield all(min(abs(tip(1, a) - tip(1, b)) for b in there) < NEAR for a in angles)
        yield from _lines(work, found, point)
        yield from _triangles([step for step in work.steps if step.name in seen], work, linkage, sizes, point)


def vanish_in_line(
    linkage: FourBar | SliderCrank, factors: Sequence[Expr], names: Sequence[Symbol]
) -> Iterator[bool]:
    """Whether the first factor is zero just with the coupler along the rocker, or the rod upright, and the
    second just with the crank along the coupler."""
    crank, coupler, last = (each.name for each in names)
    first, second = factors
    for k in range(4):
        turned, along = TURN + k * tau / 4, k % 2 == 0
        if isinstance(linkage, FourBar):
            yield (abs(at(first, {coupler: turned, last: TURN})) < NEAR) == along
        else:
            yield (abs(at(first, {coupler: turned - TURN})) < NEAR) != along
        yield (abs(at(second, {crank: TURN, coupler: turned})) < NEAR) == along


def _goes_round(seen: Mapping[str, Callable[[float], float]]) -> bool:
    """Whether the bars can be joined at every angle of the crank."""
    above, below = list(seen.values())[:2]
    angles = [tau * k / ROUND for k in range(ROUND)]
    return all(above(t) <= 0 <= below(t) for t in angles)


def _closes(
    linkage: FourBar | SliderCrank, sizes: Sequence[float], branch: Branch, point: Point
) -> Iterator[bool]:
    """Whether the loop closes with what is said of the rocker or of the slider."""
    if len(branch.values) < 2:
        return
    try:
        turn, moved = (at(tree, point) for tree in branch.values.values())
    except (NotReal, ValueError):
        return
    if isinstance(linkage, FourBar):
        crank, coupler, rocker, ground = sizes
        yield close(abs(ground + tip(rocker, moved) - tip(crank, turn)), coupler)
        yield _in_line(tip(crank, turn), ground + tip(rocker, moved))
    else:
        crank, rod, offset = sizes
        yield close(abs(moved + 1j * offset - tip(crank, turn)), rod)
        yield _in_line(tip(crank, turn), moved + 1j * offset)


def _ends(work: Work, end: EndTold, branch: Branch, point: Point) -> Iterator[bool]:
    """Whether what is moved has the line of its end there, and goes with the crank as is said."""
    angle, moved = branch.values.values()
    try:
        turn, there = at(angle, point), at(moved, point)
    except (NotReal, ValueError):
        return
    head, *formulas = next(step.chain for step in work.steps if step.name == end.line)
    (name,) = free_symbols(head)
    size = at(head, {name: there})
    for each in formulas:
        value = at(work.problem.final(replace(each, work.definitions)), point)
        yield close(abs(size), value) if end.said.key == "either-side" else close(size, value)
    same = tip(1, turn).imag * tip(1, there).imag
    if end.said.key != "either-side" and abs(same) > NEAR:
        yield (same > 0) == (end.said.key == "same-side")


def _in_line(one: complex, other: complex) -> bool:
    return abs((one.conjugate() * other).imag) < NEAR * abs(one) * (abs(one) + abs(other))


def _lines(work: Work, found: Mapping[str, list[float]], point: Point) -> Iterator[bool]:
    """The cosine or the sine at each angle, in each way of writing it."""
    for step in work.steps:
        for angle in found.get(step.name, []):
            head, *formulas = step.chain
            (name,) = free_symbols(head)
            values = [work.problem.final(replace(each, work.definitions)) for each in formulas]
            yield all(close(at(each, point), at(head, {name: angle})) for each in values)


def _triangles(
    steps: Sequence[Step], work: Work, linkage: FourBar | SliderCrank, sizes: Sequence[float], point: Point
) -> Iterator[bool]:
    """Every cosine by the triangle of the bars in line, every sine by the heights, where none is an angle
    too."""
    crank, coupler, last = sizes[:3]
    for step in steps:
        for each in step.chain[1:]:
            value = at(work.problem.final(replace(each, work.definitions)), point)
            reach = {"stretched": 1, "folded": -1}.get(step.name.rpartition("-")[2], 0)
            if isinstance(linkage, FourBar):
                ground = sizes[3]
                one, other = (
                    (crank, coupler + reach * last)
                    if "toggle" in step.name
                    else (crank + reach * coupler, last)
                )
                yield close(one**2 + ground**2 - 2 * one * ground * value, other**2)
            elif reach:
                yield close((crank + reach * coupler) * value, last)
            else:
                yield close(crank * value, last + coupler * (1 if step.name == "upright-above" else -1))


def _key(branch: Branch) -> str:
    (when,) = branch.when
    return when.key if isinstance(when, Phrase) else ""


def _real(branch: Branch, point: Point) -> Iterator[float]:
    for tree in list(branch.values.values())[:1]:
        try:
            yield at(tree, point)
        except (NotReal, ValueError):
            return
