"""What is given of a motion along one coordinate or several: ways, times and limits."""

from __future__ import annotations

from collections.abc import Iterator

from derive.algebra.formulas.with_units import measured
from derive.derivation import Cell, Phrase, Table
from derive.expression import ZERO, Expr, Symbol
from derive.given.datum import Datum
from derive.kinds.problem import Problem
from derive.mechanics.profile import Axis, JointPath, Journey, Profile, Units, Via

ENDS = ("start_velocity", "end_velocity", "start_acceleration", "end_acceleration")
BLENDS = ("cruise", "acceleration", "blend")  # how a line with blends is made
LIMITS = ("v_max", "a_max")
TIMES = ("time", "blend")
RATES = {"start_velocity": 1, "end_velocity": 1, "velocity": 1, "v_max": 1, "cruise": 1} | {
    "start_acceleration": 2, "end_acceleration": 2, "acceleration": 2, "a_max": 2,
}  # fmt: skip

IN_QUESTIONS = True


def data(profile: Profile, problem: Problem) -> Iterator[Datum]:
    """A table of the axes where there are several; else a sentence for each size."""
    units = profile.units
    if profile.path is not None:
        yield from _path(profile.path)
        return
    if len(profile.axes) > 1:
        yield _axes(profile.axes, units)
    elif profile.journey and not _is_distance(profile.axes, profile.journey):
        yield from _journey(profile.journey, units)
    else:
        yield from _sizes(profile.axes[0], ("distance", *LIMITS), units)
    yield from _sizes(profile, ("time",), units)


def _path(path: JointPath) -> Iterator[Datum]:
    """The places, the range, and a table of the limits."""
    q = tuple(Symbol(f"q_{k}") for k, _ in enumerate(path.places, 1))
    chains = tuple(zip(q, path.places, strict=True))
    said = Phrase("path", {"s": Symbol(path.parameter)})
    yield Datum(said, equations=chains, ours=frozenset(name.name for name in q))
    low, high = path.between
    yield Datum(
        Phrase("path-range", {"s": Symbol(path.parameter), "low": low, "high": high}), words=("rest",)
    )
    limits = tuple(each for each in (path.v_max, path.a_max) if each)
    rows = tuple((str(k), *map(measured, each)) for k, each in enumerate(zip(*limits, strict=True), 1))
    keys = ("v_max", "a_max") if path.v_max else ("a_max",)
    yield Datum(Phrase("path-limits"), Table((Phrase("axis-number"), *map(Phrase, keys)), rows))


def _said(value: Expr, key: str, units: Units) -> Expr:
    unit = units.time if key in TIMES else units.motion[RATES.get(key, 0)]
    return measured(value, unit)


def _sizes(of: Axis | Journey | Profile, keys: tuple[str, ...], units: Units) -> Iterator[Datum]:
    """A sentence for each that is given."""
    for key in keys:
        if (value := getattr(of, key)) is not None:
            yield Datum(Phrase(f"one-{key}", {"value": _said(value, key, units)}))


def _axes(axes: tuple[Axis, ...], units: Units) -> Datum:
    keys = [key for key in ("distance", *LIMITS) if all(getattr(axis, key) is not None for axis in axes)]
    lines: list[tuple[Cell, ...]] = [
        (str(i), *(_said(getattr(axis, key), key, units) for key in keys)) for i, axis in enumerate(axes, 1)
    ]
    return Datum(Phrase("axes"), Table((Phrase("axis-number"), *map(Phrase, keys)), tuple(lines)))


def _is_distance(axes: tuple[Axis, ...], journey: Journey) -> bool:
    """Whether it was given as a distance within limits."""
    return bool(axes) and journey.start == ZERO and journey.end == axes[0].distance and not journey.via


def _journey(journey: Journey, units: Units) -> Iterator[Datum]:
    """The ends, what is passed on the way, and the limits."""
    start, end = (_said(place, "place", units) for place in (journey.start, journey.end))
    yield Datum(Phrase("ends", {"start": start, "end": end}))
    yield from _sizes(journey, tuple(key for key in ENDS if getattr(journey, key) != ZERO), units)
    if journey.via:
        yield Datum(Phrase("via"), _passed(journey.via, units))
    yield from _sizes(journey, (*BLENDS, *LIMITS), units)


def _passed(points: tuple[Via, ...], units: Units) -> Table:
    """Times and places, and velocities where some are prescribed."""
    keys = ("time", "place", "velocity") if any(via.velocity for via in points) else ("time", "place")
    lines: list[tuple[Cell, ...]] = [
        tuple(
            "" if value is None else _said(value, key, units) for key in keys for value in [getattr(via, key)]
        )
        for via in points
    ]
    return Table(tuple(Phrase(f"via-{key}") for key in keys), tuple(lines))
