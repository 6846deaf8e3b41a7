"""drive: a motor that moves a load through a gear, `{rotor: J_m, load: J_l, gear: G}`, or by `stages`."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import Annotated, TypeAlias

from pydantic import Field

from derive.algebra.formulas.quantities import rational
from derive.errors import SheetError
from derive.expression import ZERO, Expr
from derive.kinds.fields import Formula, InertiaMoment, Length, OptionsModel, Torque
from derive.mechanics.gearing import Size, Stage
from derive.mechanics.sensing import Drive
from derive.sheet.source import At, Faults
from derive.sheet.subjects.registry import Known

HARMLESS = frozenset({"gear", "torque", "load_torque"})
SHARED = frozenset({"rotor", "load", "stages"})
FORMS = ("teeth", "radii", "diameters", "belt", "harmonic", "planetary", "ratio")
AS_WRITTEN = "write {teeth: [20, 60]}, {belt: [r_1, r_2]}, {harmonic: [160, 162]} or {ratio: 50}"
HINTS = {
    "rotor": "add rotor: J_m, the inertia of what the motor turns",
    "load": "add load: J_l, the inertia that it moves",
    "gear": "add gear: G, or stages: [{teeth: [20, 60]}]",
    "stages": "add stages: [{teeth: [20, 60]}]",
}
Lengths: TypeAlias = tuple[Length, Length]
Teeth: TypeAlias = tuple[Formula, Formula]


class GivenStage(OptionsModel):
    """Two wheels, that of the driving shaft first, in one of these ways."""

    teeth: Teeth | None = None
    """Gears by their numbers of teeth."""
    radii: Lengths | None = None
    """Gears by their radii."""
    diameters: Lengths | None = None
    """Gears by their diameters."""
    belt: Lengths | None = None
    """Pulleys of a belt by their radii."""
    harmonic: Teeth | None = None
    """The teeth of the flexspline and of the circular spline, which is held."""
    planetary: Teeth | None = None
    """The teeth of the sun and of the ring, which is held."""
    ratio: Formula | None = None
    """The ratio of the stage alone."""
    internal: bool = False
    """Whether the second gear is a ring."""
    crossed: bool = False
    """Whether the belt is crossed."""
    inertia: InertiaMoment | None = None
    """The moment of inertia of the shaft behind the stage."""

    @property
    def forms(self) -> tuple[str, ...]:
        """The keys that say what it is."""
        return tuple(form for form in FORMS if getattr(self, form) is not None)


class Given(OptionsModel):
    """A motor, a load, and the gear between them: by its ratio, or by its stages."""

    rotor: InertiaMoment | None = None
    """The moment of inertia of the rotor about its own axis."""
    load: InertiaMoment | None = None
    """The moment of inertia of the load about its own axis."""
    gear: Formula | None = None
    """The ratio of the gear."""
    stages: Annotated[list[GivenStage], Field(min_length=1, max_length=12)] | None = None
    """The stages of the gear, the first of them at the motor."""
    torque: Torque | None = None
    """The torque of the motor."""
    load_torque: Torque | None = None
    """The torque that the load needs."""


def build(given: Given, at: At, known: Known) -> Drive:
    """The drive. Raises SheetErrors for an inertia, a gear or a motor torque that is not positive, and for
    stages that are no gear."""
    Faults(_faults(given, at)).settle()
    stages = tuple(map(_stage, given.stages or ()))
    return Drive(given.rotor or ZERO, given.load or ZERO, given.gear, given.torque, given.load_torque, stages)


def missing(subject: Drive, need: str, at: At) -> list[SheetError]:
    """The fault where a kind needs "rotor", "load", "stages" or a "gear" of either sort and none is given."""
    there = subject.gear or subject.stages if need == "gear" else getattr(subject, need) not in ((), ZERO)
    return [] if there else [at.fault(f"'{need}' is missing", (), HINTS[need], key=True)]


def _stage(given: GivenStage) -> Stage:
    (form,) = given.forms
    if form == "ratio" and given.ratio is not None:
        return Stage("ratio", (given.ratio,), "", given.inertia)
    sizes: tuple[Expr, ...] = getattr(given, form)
    if form == "belt":
        return Stage("crossed" if given.crossed else "belt", sizes, "radii", given.inertia)
    if form == "harmonic":
        return Stage("harmonic", sizes, "teeth", given.inertia)
    if form == "planetary":
        return Stage("planetary", sizes, "teeth", given.inertia)
    measured: Size = "radii" if form == "radii" else "diameters" if form == "diameters" else "teeth"
    return Stage("ring" if given.internal else "gears", sizes, measured, given.inertia)


def _faults(given: Given, at: At) -> Iterator[SheetError]:
    for name in ("rotor", "load", "gear", "torque"):
        if (size := _size(getattr(given, name))) is not None and size <= 0:
            yield at.fault(f"{name} must be positive", (name,))
    if given.gear is not None and given.stages is not None:
        yield at.fault("the gear follows from its stages", ("gear",), "give either gear: or stages:", True)
    for index, stage in enumerate(given.stages or ()):
        yield from _stage_faults(stage, at, index)


def _stage_faults(given: GivenStage, at: At, index: int) -> Iterator[SheetError]:
    route = ("stages", index)
    if len(given.forms) != 1:
        what = f"both {' and '.join(given.forms)}" if given.forms else "no wheels and no ratio"
        yield at.fault(f"{what} in one stage", route, AS_WRITTEN)
        return
    (form,) = given.forms
    if given.internal and form not in ("teeth", "radii", "diameters"):
        yield at.fault("only gears mesh inside", (*route, "internal"), "leave it out", True)
    if given.crossed and form != "belt":
        yield at.fault("only a belt is crossed", (*route, "crossed"), "leave it out", True)
    if (inertia := _size(given.inertia)) is not None and inertia < 0:
        yield at.fault("an inertia is not negative", (*route, "inertia"))
    if form == "ratio":
        if _size(given.ratio) == 0:
            yield at.fault("a ratio is not zero", (*route, "ratio"))
        return
    sizes = [rational(size) for size in getattr(given, form)]
    whole = form in ("teeth", "harmonic", "planetary")
    for place, size in enumerate(sizes):
        if size is not None and size <= 0:
            yield at.fault("the size of a wheel is positive", (*route, form, place))
        elif size is not None and whole and size.denominator != 1:
            yield at.fault("a wheel has a whole number of teeth", (*route, form, place))
    first, second = sizes
    if first is None or second is None or first <= 0 or second <= 0:
        return
    if form == "harmonic" and first >= second:
        hint = "the flexspline first, which has a few teeth less: [160, 162]"
        yield at.fault("a flexspline has fewer teeth than its circular spline", (*route, form), hint)
    elif form == "planetary" and first >= second:
        yield at.fault("a sun has fewer teeth than its ring", (*route, form), "the sun first: [24, 72]")
    elif given.internal and first >= second:
        yield at.fault("a pinion is smaller than the ring it turns in", (*route, form), "the pinion first")


def _size(given: Expr | None) -> Fraction | None:
    return None if given is None else rational(given)
