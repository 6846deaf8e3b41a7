"""A motion drawn: position, velocity and acceleration over time."""

from __future__ import annotations

from collections.abc import Mapping
from math import degrees

from derive.derivation import Label, Panels, Phrase, Plot
from derive.mechanics.course import Course, Points, sampled
from derive.mechanics.profile import Sort

ORDERS = ("position", "velocity", "acceleration")
LIMIT = Phrase("limit")
UNITS = {"length": ("m", "m/s", r"m/s$^2$"), "angle": ("rad", "rad/s", r"rad/s$^2$")}
IN_DEGREES = ("deg", "deg/s", r"deg/s$^2$")


def panels(
    name: str,
    courses: Mapping[Label, Course],
    sort: Sort,
    in_degrees: bool,
    limits: tuple[float | None, float | None] = (None, None),
) -> Panels:
    """Three plots, one above the other; `courses` are named as in the legend, `limits` are those of velocity
    and acceleration."""
    turned = sort == "angle" and in_degrees
    units = IN_DEGREES if turned else UNITS.get(sort, ("", "", ""))
    plots = []
    for order, (what, unit) in enumerate(zip(ORDERS, units, strict=True)):
        curves = {name: _scaled(sampled(course, order), turned) for name, course in courses.items()}
        most = (None, *limits)[order]
        marks: dict[Label, float] = {} if most is None else {LIMIT: degrees(most) if turned else most}
        if marks and min(min(values) for _, values in curves.values()) < -0.2 * marks[LIMIT]:
            marks[" "] = -marks[LIMIT]
        label = Phrase(what)
        y_label = Phrase("quantity", {"name": label, "unit": unit}) if unit else label
        plots.append(Plot(what, Phrase("time"), y_label, curves, marks))
    return Panels(name, tuple(plots))


def _scaled(points: Points, turned: bool) -> Points:
    times, values = points
    return (times, tuple(map(degrees, values))) if turned else points
