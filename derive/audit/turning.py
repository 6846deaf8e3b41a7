"""How fast a pose turns, whatever it is the pose of: by the derivatives of its matrix in time."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping
from typing import TypeAlias

import sympy

from derive.audit.asked import Asked, Same, Test
from derive.audit.points import Point
from derive.audit.poses import vector_of
from derive.audit.putting_back import put_back
from derive.audit.registry import Auditor

TIME = "t"
PoseOf: TypeAlias = Callable[[Asked, Point], sympy.Matrix]
NamesOf: TypeAlias = Callable[[Asked], Collection[str]]


def kinds(pose: PoseOf, names: NamesOf) -> Mapping[str, Auditor]:
    """The auditors of the kinds that ask how fast; `names` are those that the pose is by."""
    return {
        "velocity": lambda asked, point: velocity(asked, point, pose(asked, point), names(asked)),
        "acceleration": lambda asked, point: acceleration(asked, point, pose(asked, point), names(asked)),
    }


def velocity(asked: Asked, point: Point, T: sympy.Matrix, names: Collection[str]) -> Iterator[Test]:
    """S = dR/dt R^T, omega out of it, and dp/dt."""
    rate = _rise(T, _varying(asked, names))
    S = rate[:3, :3] * T[:3, :3].T
    yield Same("S", point.each(S))
    yield Same("omega", point.each(vector_of(S)))
    yield from _moved("v", "omega", asked, point, rate)


def acceleration(asked: Asked, point: Point, T: sympy.Matrix, names: Collection[str]) -> Iterator[Test]:
    """alpha out of d(dR/dt R^T)/dt, and the second derivative of p."""
    varying = _varying(asked, names)
    rate = _rise(T, varying)
    S = rate[:3, :3] * T[:3, :3].T
    yield Same("omega", point.each(vector_of(S)))
    yield Same("alpha", point.each(vector_of(_rise(S, varying))))
    yield from _moved("v", "omega", asked, point, rate)
    yield from _moved("a", "alpha", asked, point, _rise(rate, varying))


def _moved(name: str, other: str, asked: Asked, point: Point, rate: sympy.Matrix) -> Iterator[Test]:
    """What the origin does; where nothing is said of it, it rests."""
    moved = list(rate[:3, 3])
    if name in asked.results:
        yield Same(name, point.each(moved))
    else:
        yield put_back(other, point, moved, [sympy.Integer(0)] * 3, "the origin moves too")


def _rise(value: sympy.Matrix, varying: Collection[str]) -> sympy.Matrix:
    """How fast a matrix of names and their rates changes."""
    total = sympy.zeros(*value.shape)
    for name in varying:
        if name == TIME:
            total += value.diff(sympy.Symbol(name))
            continue
        first, second = (sympy.Symbol(f"{name}_{end}") for end in ("dot", "ddot"))
        total += value.diff(sympy.Symbol(name)) * first + value.diff(first) * second
    return total


def _varying(asked: Asked, names: Collection[str]) -> set[str]:
    """The names that change: as asked; else the time, or all that it is by."""
    every = set(names) - asked.where.keys()
    return set(asked.options.rates) or {TIME} & every or every
