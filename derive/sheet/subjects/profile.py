"""profile: a distance within limits of velocity and acceleration, or a way from one value to another."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated, Any, TypeAlias

from pydantic import BaseModel, Discriminator, Field, GetCoreSchemaHandler, Tag, ValidationInfo
from pydantic_core import CoreSchema, core_schema

from derive.algebra.formulas.grammar import parse
from derive.algebra.formulas.units import ANGLE, LENGTH, Dimension, power, times
from derive.algebra.formulas.units import TIME as SECONDS
from derive.algebra.normal import normal
from derive.algebra.numbers.floats import scalar_number
from derive.errors import FormulaError, NotDerivable, SheetError
from derive.expression import ONE, PI, ZERO, Degrees, Expr, free_symbols, multiply, number, rebuild, walk
from derive.kinds.fields import TREES, Name, OptionsModel, Quantity, Time, declared, text_of
from derive.mechanics.profile import NO_UNITS, Axis, JointPath, Journey, Profile, Sort, Units, Via
from derive.sheet.checked import values_in
from derive.sheet.faults import NO_FORM
from derive.sheet.source import At, Faults, Route
from derive.sheet.subjects.parameters import faults_of
from derive.sheet.subjects.registry import Known

# Limits are told to be kept or not by every kind; how fast the middle part is belongs to one.
HARMLESS = frozenset({"time", "v_max", "a_max", "parameter", "range"})
SHARED = frozenset({"cruise", "acceleration", "blend"})
FORMS = "write {distance: d, v_max: v_M, a_max: a_M}, a list of such axes, or {from: q0, to: qf, time: t_f}"


@dataclass(frozen=True, slots=True)
class Measured:
    """A quantity of a motion, and whether it is one of a length or of an angle ("" where both could be)."""

    expr: Expr
    sort: Sort


@dataclass(frozen=True, slots=True)
class _Reader:
    """A length or an angle, per second to the power `rate`."""

    rate: int

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.with_info_plain_validator_function(self.read)

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: Any) -> dict[str, Any]:
        unit = ("", "/s", "/s^2")[self.rate]
        return {"type": ["string", "number"], "description": f"a length or an angle (m{unit}, rad{unit})"}

    def read(self, typed: Any, info: ValidationInfo) -> Measured:
        if isinstance(typed, Measured):
            return typed
        if isinstance(typed, TREES):
            return Measured(typed, "")
        text, names = text_of(typed), declared(info)
        angular = _read(text, self.dimension(ANGLE), names)
        linear = _read(text, self.dimension(LENGTH), names)
        if isinstance(linear, FormulaError):
            if isinstance(angular, FormulaError):
                raise linear
            return Measured(angular, "angle")
        if isinstance(angular, FormulaError) or linear != angular:  # a declared m is a symbol among angles
            return Measured(linear, "length")
        return Measured(linear, "")

    def dimension(self, of: Dimension) -> Dimension:
        return times(of, power(SECONDS, -self.rate))


def _read(text: str, dimension: Dimension, names: frozenset[str]) -> Expr | FormulaError:
    try:
        return parse(text, dimension=dimension, names=names)
    except FormulaError as error:
        return error


Stretch: TypeAlias = Annotated[Measured, _Reader(0)]
Rate: TypeAlias = Annotated[Measured, _Reader(1)]
Push: TypeAlias = Annotated[Measured, _Reader(2)]


class GivenAxis(OptionsModel):
    """One axis and its limits."""

    distance: Stretch
    """How far it goes."""
    v_max: Rate
    """The greatest velocity."""
    a_max: Push
    """The greatest acceleration."""


class GivenOne(OptionsModel):
    """One axis, from rest to rest."""

    distance: Stretch
    """How far it goes."""
    v_max: Rate
    """The greatest velocity."""
    a_max: Push | None = None
    """The greatest acceleration; it may have no limit where the time is given."""
    time: Time | None = None
    """How long it is to take."""


class GivenAxes(OptionsModel):
    """Several axes that are to arrive together."""

    axes: Annotated[list[GivenAxis], Field(min_length=1, max_length=12)]
    """The axes, each with its distance and limits."""
    time: Time | None = None
    """How long all are to take."""


class GivenVia(OptionsModel):
    """A place passed on the way, at a time counted from the start."""

    time: Time
    """When it is passed, counted from the start."""
    place: Stretch = Field(alias="at")
    """Where."""
    velocity: Rate | None = None
    """How fast."""


class GivenJourney(OptionsModel):
    """From one value to another, with what is prescribed on the way and the limits to be kept."""

    start: Stretch = Field(alias="from")
    """Where it starts."""
    end: Stretch = Field(alias="to")
    """Where it ends."""
    time: Time | None = None
    """How long it takes."""
    start_velocity: Rate | None = None
    """The velocity at the start; zero if left out."""
    end_velocity: Rate | None = None
    """The velocity at the end; zero if left out."""
    start_acceleration: Push | None = None
    """The acceleration at the start; zero if left out."""
    end_acceleration: Push | None = None
    """The acceleration at the end; zero if left out."""
    via: Annotated[list[GivenVia], Field(max_length=12)] = Field(default=[])
    """The places passed on the way."""
    cruise: Rate | None = None
    """The constant velocity between the blends."""
    acceleration: Push | None = None
    """The acceleration within the blends."""
    blend: Time | None = None
    """How long a blend takes."""
    v_max: Rate | None = None
    """The greatest velocity that is allowed."""
    a_max: Push | None = None
    """The greatest acceleration that is allowed."""


class GivenPath(OptionsModel):
    """A path of several axes, from rest to rest."""

    path: Annotated[list[Quantity], Field(min_length=1, max_length=12)]
    """The place of each axis as a function of the parameter."""
    parameter: Name = "s"
    """The name of the parameter."""
    range: tuple[Quantity, Quantity] = (ZERO, ONE)
    """The values of the parameter at the start and at the end; 0 and 1 if left out."""
    v_max: Annotated[list[Quantity], Field(max_length=12)] = Field(default=[])
    """The greatest velocity of each axis; without limits if left out."""
    a_max: Annotated[list[Quantity], Field(max_length=12)]
    """The greatest acceleration of each axis."""


def _form(value: Any) -> str | None:
    if isinstance(value, list):
        return "=list"
    keys = value if isinstance(value, dict) else ()
    forms = {"path": "=path", "axes": "=axes", "from": "=journey", "to": "=journey", "distance": "=one"}
    return next((form for key, form in forms.items() if key in keys), None)


Given: TypeAlias = Annotated[
    Annotated[GivenOne, Tag("=one")]
    | Annotated[GivenAxes, Tag("=axes")]
    | Annotated[GivenJourney, Tag("=journey")]
    | Annotated[GivenPath, Tag("=path")]
    | Annotated[list[GivenAxis], Field(min_length=1, max_length=12), Tag("=list")],
    Discriminator(_form, custom_error_type=NO_FORM, custom_error_message=FORMS),
]


def build(given: Given, at: At, known: Known) -> Profile:
    """The profile. Raises SheetErrors: limits that are not positive, lengths beside angles, no way to go."""
    if isinstance(given, GivenPath):
        return _along(given, at, known)
    Faults(_faults(given, at, known)).settle()
    if _mixes_degrees(given):
        given = _in_radians(given)
    sort: Sort = next((each.sort for _, each in _measured(given) if each.sort), "")
    if isinstance(given, GivenJourney):
        journey = _journey(given)
        axes: tuple[Axis, ...] = ()
        if journey.v_max is not None and journey.a_max is not None:
            axes = (Axis(journey.end - journey.start, journey.v_max, journey.a_max),)
        return Profile(axes, journey, given.time, sort, _units(given, sort, known))
    if isinstance(given, GivenOne):
        axis = _axis(given)
        nothing = (ZERO,) * 4
        whole = Journey(ZERO, axis.distance, *nothing, v_max=axis.v_max, a_max=axis.a_max)
        return Profile((axis,), whole, given.time, sort, _units(given, sort, known))
    listed = given.axes if isinstance(given, GivenAxes) else given if isinstance(given, list) else []
    time = given.time if isinstance(given, GivenAxes) else None
    shared: Sort = sort if len(_sorts(given)) < 2 else ""
    return Profile(tuple(map(_axis, listed)), None, time, shared, _units(given, shared, known))


def _along(given: GivenPath, at: At, known: Known) -> Profile:
    """Raises SheetErrors: not a limit for each axis, a parameter that is none, a range that is none."""
    Faults(_wrong_path(given, at, known)).settle()
    path = JointPath(given.parameter, tuple(given.path), given.range, tuple(given.v_max), tuple(given.a_max))
    return Profile(path=path)


def _wrong_path(given: GivenPath, at: At, known: Known) -> Iterator[SheetError]:
    for key, limits in (("v_max", given.v_max), ("a_max", given.a_max)):
        if len(limits) != len(given.path) and (limits or key == "a_max"):
            yield at.fault(f"{len(limits)} limits for {len(given.path)} axes", (key,), "give each axis one")
        for k, limit in enumerate(limits):
            size = _number(limit, known)
            if size is not None and size <= 0:
                yield at.fault(f"{key} must be positive", (key, k), "limits are sizes")
    yield from faults_of(given.parameter, given.path, "path", "u", at, known)
    if known.sign(given.range[1] - given.range[0]) in (0, -1):
        yield at.fault("the range ends before it begins", ("range",), "write range: [from, to]")


def missing(subject: Profile, need: str, at: At) -> list[SheetError]:
    """The faults where a kind needs "limits", a "journey", or its "time"."""
    lacking, message, hint = {
        "limits": (not subject.axes, "no distance within limits", "{distance: d, v_max: v_M, a_max: a_M}"),
        "journey": (
            subject.journey is None,
            "no way from one value to another",
            "{from: q0, to: qf, time: t_f}",
        ),
        "time": (subject.time is None, "no time", "time: t_f"),
    }[need]
    message += " is given"
    return [at.fault(message, (), f"write {hint}", key=True)] if lacking else []


def _axis(given: GivenAxis | GivenOne) -> Axis:
    strongest = None if given.a_max is None else given.a_max.expr
    return Axis(given.distance.expr, given.v_max.expr, strongest)


def _journey(given: GivenJourney) -> Journey:
    def rest(value: Measured | None) -> Expr:
        return ZERO if value is None else value.expr

    def maybe(value: Measured | None) -> Expr | None:
        return None if value is None else value.expr

    return Journey(
        given.start.expr,
        given.end.expr,
        rest(given.start_velocity),
        rest(given.end_velocity),
        rest(given.start_acceleration),
        rest(given.end_acceleration),
        tuple(Via(via.time, via.place.expr, maybe(via.velocity)) for via in given.via),
        maybe(given.cruise),
        maybe(given.acceleration),
        given.blend,
        maybe(given.v_max),
        maybe(given.a_max),
    )


def _mixes_degrees(given: Given) -> bool:
    """Whether some of the angles are in degrees and others in radians: 90 deg at 2 rad/s."""
    trees = [each.expr for _, each in _measured(given) if each.expr != ZERO]
    told = {any(isinstance(node, Degrees) for node in walk(tree)) for tree in trees if not free_symbols(tree)}
    return told == {True, False}


def _in_radians(given: Any) -> Any:
    """The same with degrees as multiples of pi."""
    if isinstance(given, Measured):
        return Measured(_turned(given.expr), given.sort)
    if isinstance(given, list):
        return [_in_radians(each) for each in given]
    if isinstance(given, BaseModel):
        names = type(given).model_fields
        return given.model_copy(update={name: _in_radians(getattr(given, name)) for name in names})
    return given


def _turned(tree: Expr) -> Expr:
    if isinstance(tree, Degrees):
        return multiply(number(tree.value / 180), PI)
    return rebuild(tree, _turned)


def _units(given: Given, sort: Sort, known: Known) -> Units:
    """What is printed after the numbers of a motion; nothing where symbols stand for them."""
    values = [value.expr if isinstance(value, Measured) else value for _, value in values_in(given)]
    if not sort or any(_number(value, known) is None for value in values):
        return NO_UNITS
    if sort == "length":
        return Units(("m", "m/s", "m/s^2"), "s")
    in_degrees = any(isinstance(node, Degrees) for value in values for node in walk(value))
    return Units(("", "/s", "/s^2") if in_degrees else ("rad", "rad/s", "rad/s^2"), "s")


# -- what is refused ----------------------------------------------------------------------------------


def _measured(given: Any) -> Iterator[tuple[Route, Measured]]:
    return ((route, value) for route, value in values_in(given) if isinstance(value, Measured))


def _sorts(given: Any) -> set[Sort]:
    return {each.sort for _, each in _measured(given) if each.sort}


def _faults(given: Given, at: At, known: Known) -> Iterator[SheetError]:
    yield from _not_positive(given, at, known)
    each = given.axes if isinstance(given, GivenAxes) else given if isinstance(given, list) else [given]
    for index, one in enumerate(each):
        if len(_sorts(one)) > 1:
            route = () if one is given else (index,) if isinstance(given, list) else ("axes", index)
            hint = "give all of them in m, m/s and m/s^2, or all in rad (or deg), rad/s and rad/s^2"
            yield at.fault("lengths and angles are mixed in one motion", route, hint)
    if isinstance(given, GivenJourney):
        yield from _wrong_journey(given, at, known)
    if isinstance(given, GivenOne) and given.a_max is None and given.time is None:
        yield at.fault("'a_max' is missing", (), "add a_max: ..., or the time it is to take", key=True)


def _not_positive(given: Given, at: At, known: Known) -> Iterator[SheetError]:
    for route, value in values_in(given):
        name = route[-1]
        if name in ("v_max", "a_max", "time", "blend", "cruise", "acceleration"):
            size = _number(value.expr if isinstance(value, Measured) else value, known)
            if size is not None and size <= 0 and name not in ("cruise", "acceleration"):
                yield at.fault(f"{name} must be positive", route, "limits are sizes, and time runs on")
            elif size == 0:
                yield at.fault(f"{name} is zero: nothing would move", route)
        if name == "distance" and isinstance(value, Measured) and _number(value.expr, known) == 0:
            yield at.fault("the distance is zero: there is nothing to move", route)


def _wrong_journey(given: GivenJourney, at: At, known: Known) -> Iterator[SheetError]:
    chosen = [name for name in ("cruise", "acceleration", "blend") if getattr(given, name) is not None]
    if len(chosen) > 1:
        yield at.fault(f"give one of {' and '.join(chosen)}: each follows from the other", (chosen[1],))
    before: float | None = 0.0
    for index, via in enumerate(given.via):
        now = _number(via.time, known)
        if before is not None and now is not None and now <= before:
            hint = "times count from the start, and the list is in the order of travel"
            yield at.fault("a via point must be later than the one before", ("via", index, "time"), hint)
        before = now
    last = None if given.time is None else _number(given.time, known)
    if given.via and before is not None and last is not None and last <= before:
        yield at.fault("the last via point must be before the end", ("time",), "time is the whole duration")


def _number(expr: Expr, known: Known) -> float | None:
    """The value, None where it depends on symbols."""
    try:
        return scalar_number(normal(expr, known.values), {})
    except (KeyError, NotDerivable, ZeroDivisionError, ValueError):
        return None
