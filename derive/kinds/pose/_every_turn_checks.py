"""Every turn put back: where there is one, and for half turns at rotations by half a turn."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from derive.algebra.numbers.arrays import arrays
from derive.algebra.numbers.floats import Point, completed, number, numbers
from derive.derivation import Branch, Claim, Phrase
from derive.expression import Matrix, Relation, Symbol, free_symbols
from derive.expression import number as exact
from derive.kinds.checks import agreement, close, route
from derive.kinds.fields import Place
from derive.kinds.meanings import Names, column_of, farthest
from derive.kinds.pose._every_turn import EveryTurn, Half
from derive.kinds.pose._meanings import entries_of
from derive.kinds.values_at import point_of
from derive.mechanics.oracle.poses import turn

if TYPE_CHECKING:
    from numpy.typing import NDArray

NEARLY = 1e-9
DIRECTIONS = ((2.0, -3.0, 6.0), (0.0, 3.0, -4.0), (0.0, 0.0, 1.0))  # with 0, 1, 2 zeros at their beginning


def put_back(turns: EveryTurn, branches: tuple[Branch, ...], steps: Mapping[str, Any]) -> Iterator[Claim]:
    """The turn that was found and its opposite, at random points; then the singular ones."""
    given = turns.given
    where = given.problem.where

    def ours(at: Point) -> list[Any]:
        there = given.place(completed(at, where))
        return [[_made(each, there), *map(float, _met(each, turns, there))] for each in branches[:2]]

    def other(at: Point) -> list[Any]:
        R = given.turns(completed(at, where))
        return [[R, *[1.0 for _ in each.when]] for each in branches[:2]]

    yield agreement("turns-again", given.problem.symbols, ours, other, 1e-8, moving=given.problem.moving)
    if given.named:
        yield route("no-turn", (*_holds(branches[2].when, _named(turns, _turned(DIRECTIONS[0], 0.0))),))
        for k, case in enumerate(turns.facts().cases):
            pair = branches[3 + 2 * k : 5 + 2 * k]
            yield route("half-turns", _half(turns, case, pair, steps, DIRECTIONS[k]), place=exact(k + 1))


def _half(
    turns: EveryTurn, case: Half, pair: tuple[Branch, ...], steps: Mapping[str, Any], way: tuple[float, ...]
) -> Iterator[bool]:
    """The axis as it is written, and both branches, where the rotation is by half a turn about this way."""
    import numpy as np

    R, unit = _turned(way, math.pi), np.array(way) / np.linalg.norm(way)
    at = _named(turns, R)
    written = np.ravel(arrays(steps[case.axis][1], at))
    yield close(written, unit if next(filter(None, way)) > 0 else -unit)
    yield from _holds(case.where, at)
    means: Names = {turns.axis: column_of(unit), turns.given.rotation: R, Symbol("I"): np.eye(3)}
    yield farthest([turns.facts().outer], means) < NEARLY
    for each, axis in zip(pair, (written, -written), strict=True):
        yield close(_axis(each, at), axis)
        yield close(_made(each, at), R)
        yield from _holds(each.when, at)


def _turned(way: tuple[float, ...], angle: float) -> NDArray[Any]:
    import numpy as np

    return turn(np.array(way) / np.linalg.norm(way), angle)


def _named(turns: EveryTurn, R: NDArray[Any]) -> dict[str, float]:
    """The entries by their names here, and by those of the sheet."""
    found = {name.name: value for name, value in entries_of(R).items() if isinstance(name, Symbol)}
    typed = {str(getattr(turns.given.entries[Symbol(name)], "name", name)): found[name] for name in found}
    return {**found, **typed}


def _axis(branch: Branch, at: Point) -> NDArray[Any]:
    import numpy as np

    return np.ravel(arrays(branch.values["axis"], at))


def _made(branch: Branch, at: Point) -> NDArray[Any]:
    """The rotation by a turn, the axis as long as it is."""
    return turn(_axis(branch, at), number(branch.values["angle"], at))


def _met(branch: Branch, turns: EveryTurn, at: Point) -> Iterator[bool]:
    """Whether the sign that is said of the sine is that of the angle."""
    yield from _holds(branch.when, {**at, turns.angle.name: number(branch.values["angle"], at)})


def _holds(conditions: tuple[Any, ...], at: Point) -> Iterator[bool]:
    for each in conditions:
        said = each.about.get("at") if isinstance(each, Phrase) else each
        if isinstance(said, Relation) and not isinstance(said.left, Relation):
            left, right = number(said.left, at), number(said.right, at)
            same = abs(left - right) < NEARLY
            yield {"=": same, ">": left > right and not same, "<": left < right and not same}[said.sign]
        else:
            yield False


def turns_at(turns: EveryTurn, place: Place | None, branches: tuple[Branch, ...]) -> dict[str, Any]:
    """The turns in floats, nothing where symbols are left; those that do not occur there are not real."""
    given = turns.given
    point = point_of(dict(place or ()), given.problem.where)
    if place is None or not free_symbols(Matrix(given.problem.readable_matrix(given.R).rows)) <= point.keys():
        return {}
    import numpy as np

    R = np.array(numbers(given.problem.readable_matrix(given.R), point))
    flat = bool(np.abs(R - R.T).max() < NEARLY)
    at = {**point, **_named(turns, R)} if given.named else point
    found: list[dict[str, Any]] = []
    for k, branch in enumerate(branches):
        occurs = (all(_holds(branch.when, at)) if k > 1 else not flat) if given.named else True
        values = {name: _floats(value, at) for name, value in branch.values.items()} if occurs else {}
        found.append({**values, "when": branch.when, **({} if occurs else {"real": False})})
    first = next(each for each in found if each.get("real", True))
    regular = {"axis": first["axis"]} if first is found[0] else {}
    return {"angle": first["angle"], **regular, "solutions": found}


def _floats(value: Any, at: Point) -> Any:
    if isinstance(value, Matrix):
        return [number(each, at) for (each,) in value.rows]
    return number(value, at)
