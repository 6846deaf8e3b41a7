"""A path in the plane, and the motion along a path over time, as pictures where numbers say them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from math import hypot

from derive.algebra.numbers.floats import number, scalar_number
from derive.derivation import Figure, Label, Panels, Phrase, Plot, Result
from derive.errors import NotAsWritten
from derive.expression import Call, Expr, Matrix, Symbol, symbols
from derive.expression import replace as put_in
from derive.figures.axes import IN_TIME, axis, short
from derive.kinds.bare_units import bare_units
from derive.kinds.checks import close
from derive.kinds.path._frenet import Bent
from derive.kinds.path._naming import place_name
from derive.kinds.path._timing import T_1, T_2, T
from derive.kinds.problem import Problem
from derive.kinds.work import Work

SAMPLES, BESIDE = 160, 1e-9
AXES = symbols("x y z")


def drawn(work: Work, found: Bent, results: Mapping[str, Result]) -> Iterator[Figure]:
    """The path in the plane; place, speed and size of the acceleration over time."""
    try:
        if found.flat and found.along.between is not None:
            yield _path(work, found)
        if "time" in results:
            yield _motion(work, results)
    except KeyError:  # symbols are left
        return


def unit_of_places(problem: Problem) -> str:
    """Meters, where they were typed."""
    return "m" if "m" in bare_units(problem) else ""


def _places(
    tree: Result, name: str, low: float, high: float, breaks: Sequence[float] = ()
) -> tuple[list[float], list[list[float]]]:
    """Values of the name, on both sides of `breaks` too, and those of each entry of a column there."""
    if not isinstance(tree, Matrix):
        raise TypeError("a place is a column")
    at = [low + (high - low) * k / SAMPLES for k in range(SAMPLES + 1)]
    beside = (high - low) * BESIDE
    at = sorted({*at, *(each + side for each in breaks for side in (-beside, beside))})
    return at, [[number(entry, {name: each}) for each in at] for (entry,) in tree.rows]


def _path(work: Work, found: Bent) -> Plot:
    along = found.along
    low, high = (scalar_number(work.scalar(each), {}) for each in along.between or ())
    ends = (work.problem.final(put_in(each, work.definitions)) for each in along.between or ())
    if not close([low, high], [number(end, {}) for end in ends]):
        raise NotAsWritten("a path is not drawn between its ends")
    return curve_in_the_plane(work.final(along.p), along.s.name, low, high, unit_of_places(work.problem))


def curve_in_the_plane(
    p: Result, name: str, low: float, high: float, unit: str, marked: Sequence[float] = ()
) -> Plot:
    """The path between two values of its parameter, its ends and what else is `marked` with dots."""
    _, (xs, ys) = _places(p, name, low, high)
    ends = [(xs[0], ys[0]), (xs[-1], ys[-1])]
    rows = p.rows if isinstance(p, Matrix) else ()
    if not close(ends, [[number(entry, {name: end}) for (entry,) in rows] for end in (low, high)]):
        raise NotAsWritten("a path is not drawn from end to end")
    told = dict(zip(("x_0", "y_0", "x_f", "y_f"), map(short, (*ends[0], *ends[1])), strict=True))
    between = [(number(rows[0][0], {name: at}), number(rows[1][0], {name: at})) for at in marked]
    return Plot(
        "path", axis(AXES[0], unit), axis(AXES[1], unit), {"": (tuple(xs), tuple(ys))},
        points=(*ends, *between), equal=True,
        caption=Phrase("drawn-points" if marked else "drawn-path"), alt=Phrase("seen-path", {**told}),
    )  # fmt: skip


def _motion(work: Work, results: Mapping[str, Result]) -> Panels:
    time = results["time"]
    if not isinstance(time, Expr):
        raise TypeError("a time is a formula")
    breaks = [number(work.final(each), {}) for each in (T_1, T_2) if each in work.known]
    whole = number(time, {})
    return over_time((results["p"], results["v"], results["a"]), 0.0, whole, work.problem, breaks)


def over_time(
    place_and_rates: Sequence[Result],
    begin: float,
    whole: float,
    problem: Problem,
    breaks: Sequence[float] = (),
) -> Panels:
    """Coordinates of the place, sizes of velocity and acceleration, which may jump at `breaks`."""
    unit, p = unit_of_places(problem), place_name(problem)
    curves = [_places(each, T.name, begin, whole, breaks) for each in place_and_rates]
    at, places = curves[0]
    of_place = {name: (tuple(at), values) for name, values in _apart(places)}
    speed_name, strong_name = (Call("abs", (Symbol(f"{p.name}_{dots}"),)) for dots in ("dot", "ddot"))
    speed, strong = (tuple(map(_size, zip(*values, strict=True))) for _, values in curves[1:])
    plots = (
        Plot("place", IN_TIME, axis(Phrase("place"), unit), of_place),
        Plot("speed", IN_TIME, axis(speed_name, unit and f"{unit}/s"), {"": (tuple(at), speed)}),
        Plot("size", IN_TIME, axis(strong_name, unit and f"{unit}/s²"), {"": (tuple(at), strong)}),
    )
    told = {"time": short(whole), "speed": short(max(speed)), "strong": short(max(strong))}
    return Panels("motion", plots, caption=Phrase("drawn-motion"), alt=Phrase("seen-motion", {**told}))


def _apart(places: Sequence[Sequence[float]]) -> Iterator[tuple[Label, tuple[float, ...]]]:
    """Each curve once, by the names of all coordinates that it is the curve of."""
    named = [*zip(AXES, map(tuple, places), strict=False)]
    for k, (name, values) in enumerate(named):
        same = tuple(other for other, its in named if close(values, its))
        if not any(close(values, its) for _, its in named[:k]):
            yield name if len(same) == 1 else Phrase("same-curve", {"names": same}), values


def _size(vector: Sequence[float]) -> float:
    return hypot(*vector)
