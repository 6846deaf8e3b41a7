"""Why a row has its length and its twist: how each axis z lies to the one before."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from derive.algebra.numbers.floats import completed, number
from derive.derivation import Phrase, Said
from derive.expression import Expr, Measured, Number, Symbol, is_negative
from derive.kinds.checks import close, random_points
from derive.kinds.fields import TREES
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import oracle_of
from derive.mechanics.robot import Convention, DHRow

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

NONE = 1e-9  # a sine that is zero
POINTS = 2
KEYS = {  # by whether the axes are parallel, point the other way, and have a distance
    (True, False, False): "axis-on", (True, True, False): "axis-on-against",
    (True, False, True): "axis-parallel", (True, True, True): "axis-against",
    (False, False, False): "axis-meets", (False, False, True): "axis-apart",
}  # fmt: skip
BACK = {  # the same where the distance leads against x
    "axis-parallel": "axis-parallel-back", "axis-against": "axis-against-back",
    "axis-apart": "axis-apart-back",
}  # fmt: skip


def axes_told(rows: Sequence[DHRow], convention: Convention, where: Mapping[str, Expr]) -> tuple[Phrase, ...]:
    """A sentence for each row; none at all where a twist has no value."""
    turns = [_value(row.alpha, where) for row in rows]
    return tuple(
        _told(i, row, turn, _value(row.a, where) != 0, convention)
        for i, (row, turn) in enumerate(zip(rows, turns, strict=True), 1)
        if turn is not None and None not in turns
    )


def _told(i: int, row: DHRow, turn: float, apart: bool, convention: Convention) -> Phrase:
    parallel = abs(math.sin(turn)) < NONE
    against = parallel and math.cos(turn) < 0
    about: dict[str, Said] = {"i": i, "a": Symbol(f"z_{i - 1}"), "b": Symbol(f"z_{i}")}
    if not parallel or against:
        about["angle"] = row.alpha
    back = is_negative(row.a)
    if apart:
        about["length"] = _in_its_unit(-row.a if back else row.a)
    if apart or not parallel:
        about["x"] = Symbol(f"x_{i if convention == 'standard' else i - 1}")
    key = KEYS[parallel, against, apart]
    return Phrase(BACK[key] if back else key, about)


def _in_its_unit(length: Expr) -> Expr:
    return Measured(length, length.unit) if isinstance(length, Number) and length.unit else length


def _value(tree: Expr, where: Mapping[str, Expr]) -> float | None:
    try:
        return number(tree, completed({}, where))
    except KeyError:
        return None


def axes_seen(told: Sequence[Phrase], convention: Convention, problem: Problem) -> Iterator[bool]:
    """Whether the axes of the frames in numbers lie as is told of each."""
    oracle = oracle_of(problem)
    for at in random_points(problem.symbols, POINTS):
        poses = oracle.poses(at)
        for i, each in enumerate(told, 1):
            before, here = poses[i - 1], poses[i]
            along = (here if convention == "standard" else before)[:3, 0]
            yield _lies(each, before, here, along, lambda tree, at=at: number(tree, oracle.at(at)))
            yield _called(each, i, convention)


def _lies(told: Phrase, before: Array, here: Array, x: Array, value: Any) -> bool:
    import numpy as np

    a, b, apart = before[:3, 2], here[:3, 2], here[:3, 3] - before[:3, 3]
    angle, length = (told.about.get(key) for key in ("angle", "length"))
    turn = value(angle) if isinstance(angle, TREES) else 0.0
    turned = a * math.cos(turn) + np.cross(x, a) * math.sin(turn)
    parallel, against = bool(np.abs(np.cross(a, b)).max() < NONE), float(a @ b) < 0
    distance = float(apart @ x)
    meet = abs(float(apart @ x)) < NONE
    key = KEYS[parallel, parallel and against, not meet]
    back = told.key == BACK.get(key)
    return (
        close(turned, b)
        and abs(float(a @ x)) < NONE
        and close(value(length) if isinstance(length, TREES) else 0.0, -distance if back else distance)
        and (back or told.key == key)
    )


def _called(told: Phrase, i: int, convention: Convention) -> bool:
    x = told.about.get("x")
    return (
        told.about["i"] == i
        and (told.about["a"], told.about["b"]) == (Symbol(f"z_{i - 1}"), Symbol(f"z_{i}"))
        and x in (None, Symbol(f"x_{i if convention == 'standard' else i - 1}"))
    )
