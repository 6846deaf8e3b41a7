"""The fastest motion along a path: the least time of sweeps over other steps than ours, by derivatives of
SymPy."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise

import sympy

from derive.audit.asked import Asked, Holds, Test
from derive.audit.budget import spend
from derive.audit.points import Point

STEPS, HALVINGS, NEAR = 160, 70, 1e-2
Place = tuple[list[float], list[float], float]  # both derivatives, and the greatest b by velocities


def fastest(asked: Asked, point: Point) -> Iterator[Test]:
    """The time, and that the parameter goes from one end to the other in it."""
    here = asked.here.in_digits() if asked.evaluate else point.in_digits()
    path = asked.subject.path
    s = sympy.Symbol(path.parameter)
    low, high = (float(here.at(asked.formula(each))) for each in path.between)
    v_max, a_max = (
        [float(here.at(asked.formula(each))) for each in limits] for limits in (path.v_max, path.a_max)
    )
    trees = [asked.formula(tree) for tree in path.places]
    slopes = [[tree.diff(s, order) for tree in trees] for order in (1, 2)]
    step = (high - low) / STEPS
    spend(STEPS * len(trees))

    def at(k: int) -> Place:
        now = here.where(**{path.parameter: sympy.Float(low + k * step, 30)})
        first, second = ([float(now.at(tree)) for tree in row] for row in slopes)
        tops = [(v / abs(x)) ** 2 for v, x in zip(v_max, first, strict=False) if abs(x) > 1e-12]
        return first, second, min([*tops, 1e9])

    least = _swept([at(k) for k in range(STEPS + 1)], a_max, step)
    told = float(here.at(asked.result("time")))
    yield Holds("time", abs(told - least) <= NEAR * least, f"it is about {least:.4g}")
    t, values = (list(map(float, asked.read(asked.results[key]))) for key in ("t", "parameter"))
    yield Holds("t", t == sorted(t) and t[0] == 0 and abs(t[-1] - told) <= NEAR * told, "it does not run on")
    ends = abs(values[0] - low) + abs(values[-1] - high) < 1e-9
    yield Holds("parameter", values == sorted(values) and ends, "it does not go from end to end")


def _swept(places: Sequence[Place], a_max: Sequence[float], step: float) -> float:
    """Back from rest, then forward, each b as great as the next one allows."""
    count = len(places)
    back = [0.0] * count
    for k in range(count - 2, -1, -1):
        low, high = 0.0, places[k][2]
        for _ in range(HALVINGS):
            middle = (low + high) / 2
            way = _onward(places[k], places[k + 1], a_max, step, middle, back[k + 1])
            low, high = (middle, high) if way is not None else (low, middle)
        back[k] = low
    b = [0.0] * count
    for k in range(count - 1):
        b[k + 1] = _onward(places[k], places[k + 1], a_max, step, b[k], back[k + 1]) or 0.0
    return sum(2 * step / (math.sqrt(x) + math.sqrt(y)) for x, y in pairwise(b))


def _onward(
    here: Place, there: Place, a_max: Sequence[float], step: float, b: float, most: float
) -> float | None:
    """The greatest b after a step whose limits are kept at both ends; None where there is none."""
    least, most = 0.0, min(most, there[2])
    for place, before in ((here, True), (there, False)):
        for x, y, a in zip(place[0], place[1], a_max, strict=True):
            after, now = x / (2 * step), -x / (2 * step)
            after, now = (after, now + y) if before else (after + y, now)
            if abs(after) < 1e-12:
                if abs(now * b) > a:
                    return None
                continue
            ends = sorted(((-a - now * b) / after, (a - now * b) / after))
            least, most = max(least, ends[0]), min(most, ends[1])
    return most if least <= most else None
