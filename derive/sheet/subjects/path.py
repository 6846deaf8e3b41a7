"""path: a line, an arc of a circle, a helix, or coordinates as functions of a parameter."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import product
from typing import Annotated, Any, Literal, TypeAlias

from pydantic import Discriminator, Field, Tag

from derive.errors import SheetError
from derive.expression import ONE, PI, ZERO, Expr, add, column, free_symbols, multiply, number
from derive.kinds.fields import Angle, Formula, Length, Name, OptionsModel, Quantity, Time
from derive.mechanics.paths import Arc, Curve, Line, Path, Place, Shape, Timing, Via
from derive.sheet.faults import NO_FORM
from derive.sheet.source import At, Faults, Route
from derive.sheet.subjects.moves import AxisField
from derive.sheet.subjects.orientation import GivenOrientation, turned
from derive.sheet.subjects.parameters import faults_of
from derive.sheet.subjects.registry import Known

FORMS = (
    "write line: {from: [..], to: [..]}, circle: {center, radius, axis, start}, helix: {..} "
    "function: [..] of s, or via: [[..], ..] with times: [..]"
)
CIRCLE, HELIX = ("radius", "axis", "start", "angle"), ("center", "radius", "axis", "start", "turns")
HARMLESS = frozenset(  # each of them makes the path
    {
        "parameter",
        "range",
        "timing",
        "orientation",
        "ends",
        *(f"circle.{each}" for each in CIRCLE),
        *(f"helix.{each}" for each in HELIX),
    }
)
UNIT = {"x": (ONE, ZERO, ZERO), "y": (ZERO, ONE, ZERO), "z": (ZERO, ZERO, ONE)}
TURN = multiply(number(2), PI)
Point: TypeAlias = Annotated[list[Length], Field(min_length=2, max_length=3)]


class GivenLine(OptionsModel):
    """Straight from one point to another."""

    start: Point = Field(alias="from")
    """Where the line begins."""
    end: Point = Field(alias="to")
    """Where it ends."""


class GivenCircle(OptionsModel):
    """An arc of a circle."""

    center: Point
    """The centre of the circle."""
    radius: Length | None = None
    """The radius, where the start does not tell it."""
    axis: AxisField | None = None
    """The axis about which it turns; z if left out, none in the plane."""
    start: Point | None = None
    """The point where it starts, or the direction of that from the centre; that of x, or of the next axis, if
    left out."""
    angle: Angle = TURN
    """The angle by which it turns; a full turn if left out."""


class GivenHelix(OptionsModel):
    """A circle that moves along its axis."""

    center: tuple[Length, Length, Length] = (ZERO, ZERO, ZERO)
    """A point of the axis."""
    radius: Length | None = None
    """The radius, where the start does not tell it."""
    axis: AxisField = "z"
    """The direction of the axis."""
    start: tuple[Length, Length, Length] | None = None
    """The point where it starts, or the direction of that from the axis."""
    pitch: Length
    """How far it moves along the axis in a turn."""
    turns: Formula = ONE
    """How many turns it makes."""


class GivenTiming(OptionsModel):
    """From rest to rest: a cubic or quintic law in a time, or a trapezoidal velocity by two of time, v_max
    and a_max."""

    law: Literal["cubic", "quintic", "trapezoidal"]
    """How the way along the path depends on time."""
    time: Time | None = None
    """How long it takes."""
    v_max: Quantity | None = None
    """The greatest velocity along the path (of a function: of its parameter)."""
    a_max: Quantity | None = None
    """The greatest acceleration along the path (of a function: of its parameter)."""


class Timed(OptionsModel):
    """How the point moves along the path, and how a body turns meanwhile, if that is asked too."""

    timing: GivenTiming | None = None
    """How the point moves along the path, if that is asked too."""
    orientation: GivenOrientation | None = None
    """How a body turns meanwhile, if that is asked too."""


class OfLine(Timed):
    """A line."""

    line: GivenLine
    """Straight from one point to another."""


class OfCircle(Timed):
    """An arc of a circle."""

    circle: GivenCircle
    """An arc of a circle."""


class OfHelix(Timed):
    """A helix."""

    helix: GivenHelix
    """A circle that moves along its axis."""


class OfFunction(Timed):
    """Coordinates as functions of a parameter."""

    function: Annotated[list[Quantity], Field(min_length=2, max_length=3)]
    """Two or three coordinates."""
    parameter: Name = "s"
    """The name of the parameter; t where it is the time."""
    range: tuple[Quantity, Quantity] | None = None
    """The first and the last value of the parameter, needed for the length."""


class OfVia(OptionsModel):
    """Points that are passed at times, by a cubic spline of each coordinate."""

    via: Annotated[list[Point], Field(min_length=3, max_length=12)]
    """The points."""
    times: Annotated[list[Time], Field(max_length=12)]
    """When each is passed."""
    ends: Literal["clamped", "natural"] = "clamped"
    """clamped: at rest; natural: without acceleration."""


def _form(value: Any) -> str | None:
    keys = value if isinstance(value, dict) else ()
    return next((f"={form}" for form in ("line", "circle", "helix", "function", "via") if form in keys), None)


Given: TypeAlias = Annotated[
    Annotated[OfLine, Tag("=line")]
    | Annotated[OfCircle, Tag("=circle")]
    | Annotated[OfHelix, Tag("=helix")]
    | Annotated[OfFunction, Tag("=function")]
    | Annotated[OfVia, Tag("=via")],
    Discriminator(_form, custom_error_type=NO_FORM, custom_error_message=FORMS),
]


def build(given: Given, at: At, known: Known) -> Path:
    """The path. Raises SheetErrors: a line of no length, a start beside the circle, no parameter, a law of
    time that its sizes do not make."""
    shape = _shape(given, at, known)
    if isinstance(given, OfVia):
        return Path(shape)
    oriented = None if given.orientation is None else turned(given.orientation, at / "orientation", known)
    if oriented is not None and isinstance(shape, Curve) and shape.between is None:
        hint = "add range: [from, to]"
        raise at.error("where it begins and ends to turn is not given", ("function",), hint)
    if given.timing is None:
        return Path(shape, None, oriented)
    Faults(_timing_faults(given.timing, shape, at, known)).settle()
    timing = given.timing
    return Path(shape, Timing(timing.law, timing.time, timing.v_max, timing.a_max), oriented)


def _shape(given: Given, at: At, known: Known) -> Shape:
    match given:
        case OfLine(line=line):
            Faults(_line_faults(line, at, known)).settle()
            return Line(tuple(line.start), tuple(line.end))
        case OfCircle(circle=circle):
            return _arc(circle, circle.angle, None, at, known, ("circle",))
        case OfHelix(helix=helix):
            turned = multiply(TURN, helix.turns) if helix.turns != ONE else TURN
            arc = _arc(helix, turned, helix.pitch, at, known, ("helix",))
            return replace(arc, turns=helix.turns)
        case OfFunction():
            Faults(_function_faults(given, at, known)).settle()
            return Curve(given.parameter, column(given.function), given.range)
        case OfVia(via=via, times=times, ends=ends):
            Faults(_via_faults(given, at, known)).settle()
            return Via(tuple(map(tuple, via)), tuple(times), ends)
    raise TypeError(f"no path: {given!r}")


# -- circles ------------------------------------------------------------------------------------------


def _arc(
    given: GivenCircle | GivenHelix, angle: Expr, pitch: Expr | None, at: At, known: Known, key: Route
) -> Arc:
    Faults(_arc_faults(given, angle, pitch, at, known, key)).settle()
    center = tuple(given.center)
    axis = given.axis if len(center) == 2 or given.axis else "z"
    start = _first(axis) if given.start is None else tuple(given.start)
    placed = given.start is not None and _on_circle(given, known)
    return Arc(center, given.radius, axis, start, placed, angle, pitch)


def _first(axis: Any) -> Place:
    """The direction of x, or of the next coordinate axis, beside a coordinate axis."""
    return (ONE, ZERO) if axis is None else UNIT["y" if axis == "x" else "x"]


def _on_circle(given: GivenCircle | GivenHelix, known: Known) -> bool:
    """Whether it starts at a point of the circle and not in a direction."""
    away = _away(given)
    if given.radius is None:
        return True
    size = add(*(part * part for part in away)) - given.radius * given.radius
    return known.sign(size) == 0 and known.sign(_dot(away, _axis(given))) == 0


def _away(given: GivenCircle | GivenHelix) -> Place:
    return tuple(p - c for p, c in zip(given.start or (), given.center, strict=False))


def _axis(given: GivenCircle | GivenHelix) -> Place:
    axis = given.axis or "z"
    return UNIT[axis] if isinstance(axis, str) else axis


def _dot(left: Place, right: Place) -> Expr:
    return add(*(a * b for a, b in zip(left, right, strict=False))) if len(left) == 3 else ZERO


def _arc_faults(
    given: GivenCircle | GivenHelix, angle: Expr, pitch: Expr | None, at: At, known: Known, key: Route
) -> Iterator[SheetError]:
    flat = len(given.center) == 2
    if given.radius is None and given.start is None:
        yield at.fault(
            "how large it is is not given", key, "add radius: r, or the point start: [..]", key=True
        )
        return
    if given.radius is not None and known.sign(given.radius) in (0, -1):
        yield at.fault("the radius must be positive", (*key, "radius"))
    if known.sign(angle) == 0:
        yield at.fault("it turns by nothing", (*key, "turns" if pitch is not None else "angle"))
    if flat and given.axis is not None:
        yield at.fault("a circle in the plane has no axis", (*key, "axis"), "give its center as [x, y, z]")
        return
    if given.start is None:
        if given.axis is not None and not isinstance(given.axis, str):
            hint = "a direction perpendicular to the axis, or a point of the circle: start: [..]"
            yield at.fault("where it starts is not given", key, f"add {hint}", key=True)
        return
    if len(given.start) != len(given.center):
        yield at.fault(
            f"the start has {len(given.start)} coordinates, the center {len(given.center)}", (*key, "start")
        )
        return
    direction = _away(given) if _on_circle(given, known) else tuple(given.start)
    if all(known.sign(part) == 0 for part in direction):
        yield at.fault("this start is no direction", (*key, "start"), "give a point of the circle")
    elif not flat and known.sign(_dot(direction, _axis(given))) != 0:
        hint = "give a point of the circle, or a direction perpendicular to its axis"
        yield at.fault("the start is not on the circle", (*key, "start"), hint)


# -- what is refused ----------------------------------------------------------------------------------


def _line_faults(line: GivenLine, at: At, known: Known) -> Iterator[SheetError]:
    if len(line.start) != len(line.end):
        fault = f"it ends at {len(line.end)} coordinates and starts at {len(line.start)}"
        yield at.fault(fault, ("line", "to"), "give both points as many coordinates")
    elif all(known.sign(b - a) == 0 for a, b in zip(line.start, line.end, strict=True)):
        yield at.fault("the line ends where it starts", ("line", "to"))


def _function_faults(given: OfFunction, at: At, known: Known) -> Iterator[SheetError]:
    yield from faults_of(given.parameter, given.function, "function", "t", at, known)
    for end, (k, tree) in product((given.parameter,), enumerate(given.range or ())):
        if end in free_symbols(tree):
            yield at.fault("the range depends on the parameter", ("range", k))
    if given.range and known.sign(given.range[1] - given.range[0]) in (0, -1):
        yield at.fault("the range ends before it begins", ("range",), "write range: [from, to]")


def _via_faults(given: OfVia, at: At, known: Known) -> Iterator[SheetError]:
    if len(given.times) != len(given.via):
        fault = f"{len(given.times)} times for {len(given.via)} points"
        yield at.fault(fault, ("times",), "give each point its time")
        return
    for k, point in enumerate(given.via):
        if len(point) != len(given.via[0]):
            fault = f"this point has {len(point)} coordinates, the first {len(given.via[0])}"
            yield at.fault(fault, ("via", k), "give all points as many coordinates")
    for k, time in enumerate(given.times):
        later = known.sign(time - given.times[k - 1]) if k else 1
        if later is None:
            yield at.fault("this time has no value", ("times", k), "give it one, here or under where:")
        elif later != 1:
            yield at.fault("it must be later than the one before", ("times", k))


def _timing_faults(timing: GivenTiming, shape: Shape, at: At, known: Known) -> Iterator[SheetError]:
    sizes = {key: getattr(timing, key) for key in ("time", "v_max", "a_max")}
    given = [key for key, value in sizes.items() if value is not None]
    for key in given:
        if known.sign(sizes[key]) in (0, -1):
            yield at.fault(f"{key} must be positive", ("timing", key))
    if timing.law == "trapezoidal" and len(given) != 2:
        hint = "give two of time, v_max and a_max: the third follows"
        yield at.fault(f"{len(given) or 'none'} of its sizes given", ("timing",), hint, key=True)
    if timing.law != "trapezoidal" and given != ["time"]:
        hint = f"write timing: {{law: {timing.law}, time: t_f}}"
        yield at.fault(f"a {timing.law} law is made by its time alone", ("timing",), hint, key=True)
    if isinstance(shape, Curve):
        if shape.between is None:
            yield at.fault(
                "where the motion begins and ends is not given", ("function",), "add range: [from, to]"
            )
        if shape.parameter == "t":
            yield at.fault("t is the time and cannot be the parameter", ("timing",), "call the parameter s")
