"""A motion drawn: position, velocity and acceleration over time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import degrees, isclose

from derive.derivation import Label, Panels, Phrase, Place, Plot, Said
from derive.errors import NotAsWritten
from derive.expression import Approximate, Expr, Relation, Symbol
from derive.figures.axes import IN_TIME, axis, short
from derive.mechanics.course import Course, Points, at, extremes, is_joined, sampled
from derive.mechanics.profile import Sort
from derive.mechanics.shapes import TERMS

NAMES = tuple(map(Symbol, ("q", "q_dot", "q_ddot")))
LIMIT, OTHER_LIMIT = Phrase("limit"), Phrase("limit-back")
UNITS = {"length": ("m", "m/s", "m/s²"), "angle": ("rad", "rad/s", "rad/s²")}
IN_DEGREES = ("°", "°/s", "°/s²")
SHAPES = {
    (3,): "shape-cubic",
    (5,): "shape-quintic",
    (TERMS,): "shape-cycloid",
    (2, 1, 2): "shape-trapezoid",
    (2, 2): "shape-triangle",
}
RAMPS = ((2, 1, 2), (2, 2))
SAME = 1e-9  # of times that are one
NEARLY = 0.7  # of the greatest value: drawn at samples
PAST = 0.2  # of a limit: how far back a motion goes for the limit to be drawn there too


def panels(
    name: str,
    courses: Mapping[Label, Course],
    sort: Sort,
    in_degrees: bool,
    moments: Mapping[Expr, float],
    limits: tuple[float | None, float | None] = (None, None),
    through: Sequence[Place] = (),
) -> Panels:
    """Three plots, one above the other; `courses` are named as in the legend, `moments` on the axis of time,
    `limits` are those of velocity and acceleration. A course goes `through` places at times. Raises
    NotAsWritten where one has a gap."""
    if not all(map(is_joined, courses.values())):
        raise NotAsWritten
    turned = sort == "angle" and in_degrees
    units = IN_DEGREES if turned else UNITS.get(sort, ("", "", ""))
    plots = []
    for order, (symbol, unit) in enumerate(zip(NAMES, units, strict=True)):
        curves = {name: _scaled(sampled(course, order), turned) for name, course in courses.items()}
        most = (None, *limits)[order]
        marks = {} if most is None else _limits(degrees(most) if turned else most, curves)
        points = tuple((t, degrees(q) if turned else q) for t, q in through) if not order else ()
        label = axis(symbol, unit)
        plots.append(Plot(symbol.name, IN_TIME, label, curves, marks, merged(moments), points=points))
    return Panels(
        name, tuple(plots), caption=_caption(courses, units, turned), alt=_alternative(courses, units, turned)
    )


def _caption(courses: Mapping[Label, Course], units: tuple[str, ...], turned: bool) -> Phrase:
    """What moves how, from where to where, and what is drawn of it."""
    about: dict[str, Said] = dict(zip(("q", "v", "a"), NAMES, strict=True))
    if len(courses) > 1:
        return Phrase("drawn-together", {**about, "count": len(courses)})
    (course,) = courses.values()
    ends = _told(course, units, turned).about
    return Phrase(
        "drawn-motion",
        {**about, "shape": _shape(course), **{name: ends[name] for name in ("start", "end", "time")}},
    )


def _shape(course: Course) -> Phrase:
    """What a course is, by the degrees of its pieces; ramps have a name of their own from rest to rest."""
    degrees_ = tuple(len(piece.coefficients) - 1 for piece in course)
    ends = (abs(at(course, time, 1)) for time in (course[0].start, course[-1].end))
    if degrees_ in RAMPS and max(ends) > SAME * (1 + max(map(abs, extremes(course, 1)))):
        return Phrase("shape-pieces")
    return Phrase(SHAPES.get(degrees_, "shape-spline" if {*degrees_} == {3} else "shape-pieces"))


def merged(moments: Mapping[Expr, float]) -> dict[Label, float]:
    """Each with its time: t_1 = 0.5; those at the same time under one name: t_1 = t_2 = 0.4."""
    names: dict[float, Expr | Relation] = {}
    for name, time in moments.items():
        same = next((t for t in names if isclose(t, time, rel_tol=SAME)), None)
        names[time if same is None else same] = name if same is None else Relation(names[same], "=", name)
    return {Relation(name, "=", Approximate(time)): time for time, name in names.items()}


def _limits(most: float, curves: Mapping[Label, Points]) -> dict[Label, float]:
    back = min(min(values) for _, values in curves.values()) < -PAST * most
    return {LIMIT: most, OTHER_LIMIT: -most} if back else {LIMIT: most}


def _scaled(points: Points, turned: bool) -> Points:
    times, values = points
    return (times, tuple(map(degrees, values))) if turned else points


def _alternative(courses: Mapping[Label, Course], units: tuple[str, ...], turned: bool) -> Phrase:
    """What each does, to three digits."""
    said = [_told(course, units, turned) for course in courses.values()]
    if len(said) == 1:
        return Phrase("seen-course", {"axes": said[0]})
    pairs = zip(courses, said, strict=True)
    return Phrase(
        "seen-course", {"axes": tuple(Phrase("seen-axis", {"axis": k, "told": m}) for k, m in pairs)}
    )


def _told(course: Course, units: tuple[str, ...], turned: bool) -> Phrase:
    def sized(value: float, order: int) -> str:
        return f"{short(degrees(value) if turned else value)} {units[order]}".replace(" °", "°").rstrip()

    fast, strong = (_greatest(course, order) for order in (1, 2))
    last = course[-1]
    return Phrase(
        "seen-motion",
        {
            "start": sized(course[0].at(course[0].start), 0), "end": sized(last.at(last.end), 0),
            "time": f"{short(last.end)} s", "fast": sized(fast, 1), "strong": sized(strong, 2),
        },
    )  # fmt: skip


def _greatest(course: Course, order: int) -> float:
    """Of a derivative, in size. Raises NotAsWritten where more is drawn, or nothing near it."""
    greatest = max(map(abs, extremes(course, order)))
    drawn = max(map(abs, sampled(course, order)[1]))
    if not NEARLY * greatest <= drawn <= (1 + SAME) * greatest:
        raise NotAsWritten
    return greatest
