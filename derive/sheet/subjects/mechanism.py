"""mechanism: bodies and joints to be counted, or the legs of a parallel robot."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal, TypeAlias

from pydantic import Discriminator, Field, Tag

from derive.algebra.formulas.quantities import rational
from derive.errors import SheetError
from derive.expression import ZERO
from derive.kinds.fields import Angle, Length, OptionsModel, Point
from derive.mechanics.linkages import INPUT, Delta, FiveBar, FourBar, Linkage, SliderCrank, Stewart
from derive.mechanics.mobility import (
    FREEDOMS,
    LAMBDA,
    LETTERS,
    POSSIBLE,
    Joints,
    Mechanism,
    Space,
    idle_legs,
    leg_joints,
)
from derive.sheet.source import At, Faults
from derive.sheet.subjects.registry import Known

LINKAGES = frozenset({"four-bar", "slider-crank", "five-bar", "delta", "stewart"})
HARMLESS = frozenset({"bodies", "joints", "legs", "rods"}) | LINKAGES
Count: TypeAlias = Annotated[int, Field(ge=1, le=1000)]
NOT_WANTED = {
    "parts": (
        "bodies and joints are counted here",
        "write {space: planar, bodies: 4, joints: [...]}",
    ),
    "lengths": (
        "the lengths of the bars are missing",
        "write {four-bar: {...}} or {slider-crank: {crank: r, rod: l}}",
    ),
    "loop": ("the lengths of the bars are missing", "write {four-bar: {...}} or {five-bar: {...}}"),
    "motors": (
        "this is no robot with several motors",
        "write {five-bar: {...}}, {delta: {...}} or {stewart: {...}}",
    ),
}
WANTED: dict[str, tuple[type, ...]] = {
    "parts": (Mechanism,),
    "lengths": (FourBar, SliderCrank),
    "loop": (FourBar, SliderCrank, FiveBar),
    "motors": (FiveBar, Delta, Stewart),
}
AS_WRITTEN = "write {revolute: 4}, four revolute joints, or {constraints: 4, count: 2}"


class GivenJoints(OptionsModel):
    """Joints of one sort."""

    revolute: Count | None = None
    """How many revolute joints."""
    prismatic: Count | None = None
    """How many prismatic joints."""
    helical: Count | None = None
    """How many helical joints."""
    cylindrical: Count | None = None
    """How many cylindrical joints."""
    universal: Count | None = None
    """How many universal joints."""
    spherical: Count | None = None
    """How many spherical joints."""
    planar: Count | None = None
    """How many planar joints."""
    constraints: Annotated[int, Field(ge=0, le=6)] | None = None
    """How many freedoms a joint of any other sort takes away."""
    count: Count = 1
    """How many joints of that other sort there are."""
    joining: Annotated[int, Field(ge=2, le=100)] = 2
    """How many bodies meet in each joint."""

    @property
    def sorts(self) -> tuple[str, ...]:
        """The keys that say which joint it is."""
        return tuple(name for name in (*FREEDOMS, "constraints") if getattr(self, name) is not None)


class GivenLegs(OptionsModel):
    """Legs between the base and the platform."""

    chain: Annotated[str, Field(min_length=1, max_length=12)]
    """The joints of a leg by letter from the base: R P H C U S E."""
    count: Count
    """How many such legs there are."""


class GivenFourBar(OptionsModel):
    """Four bars in a plane."""

    crank: Length
    """The length of the crank."""
    coupler: Length
    """The length of the coupler."""
    rocker: Length
    """The length of the rocker."""
    ground: Length
    """The distance between the pivots."""
    angle: Angle = INPUT
    """The angle of the crank; the letter theta_2 if left out."""


class GivenSliderCrank(OptionsModel):
    """A crank that moves a slider."""

    crank: Length
    """The length of the crank."""
    rod: Length
    """The length of the rod."""
    offset: Length = ZERO
    """The height at which the slider runs past the pivot of the crank."""
    angle: Angle = INPUT
    """The angle of the crank; the letter theta_2 if left out."""


class GivenFiveBar(OptionsModel):
    """Two cranks in a plane whose couplers meet."""

    cranks: tuple[Length, Length]
    """The lengths of the two cranks."""
    couplers: tuple[Length, Length]
    """The lengths of the couplers on them."""
    ground: Length
    """The distance between the pivots of the cranks."""


class GivenDelta(OptionsModel):
    """Three arms that carry a platform without turning it."""

    base: Length
    """The radius on which the pivots of the arms lie."""
    platform: Length
    """The radius on which the joints of the platform lie."""
    arm: Length
    """The length of an arm."""
    forearm: Length
    """The length of a forearm."""


class GivenStewart(OptionsModel):
    """Where each leg begins and ends, in one order."""

    base: Annotated[list[Point], Field(min_length=3, max_length=8)]
    """Where the legs begin, in the frame of the base."""
    platform: Annotated[list[Point], Field(min_length=3, max_length=8)]
    """Where the legs end, in the frame of the platform."""


class GivenLinkage(OptionsModel):
    """A linkage by the lengths of its bars."""

    four_bar: GivenFourBar | None = Field(None, alias="four-bar")
    """Four bars in a plane."""
    slider_crank: GivenSliderCrank | None = Field(None, alias="slider-crank")
    """A crank that moves a slider."""
    five_bar: GivenFiveBar | None = Field(None, alias="five-bar")
    """Two cranks in a plane whose couplers meet."""
    delta: GivenDelta | None = None
    """Three arms that carry a platform without turning it."""
    stewart: GivenStewart | None = None
    """A platform on legs that change their lengths."""


class GivenParts(OptionsModel):
    """Bodies and the joints between them, or a platform on legs."""

    space: Literal["planar", "spatial", "spherical"]
    """Where the bodies move: in a plane, in space, or about a point."""
    bodies: Annotated[int, Field(ge=2, le=10_000)] | None = None
    """How many bodies there are, the frame counted too."""
    joints: Annotated[list[GivenJoints], Field(min_length=1, max_length=50)] | None = None
    """The joints, sort by sort."""
    legs: Annotated[list[GivenLegs], Field(min_length=1, max_length=20)] | None = None
    """The legs of a platform, in place of bodies and joints."""
    rods: Annotated[int, Field(ge=0, le=1000)] = 0
    """How many bodies are rods between two spherical joints, which turn about themselves."""


def _form(value: object) -> str:
    keys = value.keys() if isinstance(value, dict) else ()
    return "=linkage" if any(name in keys for name in LINKAGES) else "=parts"


Given: TypeAlias = Annotated[
    Annotated[GivenLinkage, Tag("=linkage")] | Annotated[GivenParts, Tag("=parts")], Discriminator(_form)
]


def build(given: Given, at: At, known: Known) -> Mechanism | Linkage:
    """The mechanism. Raises SheetErrors: joints of no sort, or that its space does not have; loose bodies;
    bars without a length."""
    if isinstance(given, GivenLinkage):
        return _linkage(given, at)
    Faults(_leg_faults(given, at) if given.legs else _joint_faults(given, at)).settle()
    if given.legs:
        return _parallel(given.space, given.legs)
    joints = tuple(_joints(each, given.space) for each in given.joints or ())
    found = Mechanism(given.space, given.bodies or 0, joints, given.rods)
    Faults(_impossible(found, at)).settle()
    return found


def missing(subject: Mechanism | Linkage, need: str, at: At) -> list[SheetError]:
    """The fault where a kind needs "parts" to be counted, the "lengths" of a linkage with one crank, or a
    robot with several "motors", and this is another."""
    if isinstance(subject, WANTED[need]):
        return []
    message, hint = NOT_WANTED[need]
    return [at.fault(message, (), hint)]


def _linkage(given: GivenLinkage, at: At) -> Linkage:
    Faults(_length_faults(given, at)).settle()
    if given.four_bar is not None:
        four = given.four_bar
        return FourBar(four.crank, four.coupler, four.rocker, four.ground, four.angle)
    if given.five_bar is not None:
        return FiveBar(given.five_bar.cranks, given.five_bar.couplers, given.five_bar.ground)
    if given.delta is not None:
        return Delta(given.delta.base, given.delta.platform, given.delta.arm, given.delta.forearm)
    if given.stewart is not None:
        return Stewart(tuple(given.stewart.base), tuple(given.stewart.platform))
    slider = given.slider_crank
    if slider is None:
        raise ValueError("a linkage is one of those")
    return SliderCrank(slider.crank, slider.rod, slider.offset, slider.angle)


def _length_faults(given: GivenLinkage, at: At) -> Iterator[SheetError]:
    robots = {
        "four-bar": given.four_bar, "slider-crank": given.slider_crank, "five-bar": given.five_bar,
        "delta": given.delta, "stewart": given.stewart,
    }  # fmt: skip
    if len([each for each in robots.values() if each is not None]) > 1:
        yield at.fault("two linkages in one problem", (), "give one of them")
    if given.stewart is not None and len(given.stewart.base) != len(given.stewart.platform):
        message = f"{len(given.stewart.base)} legs begin and {len(given.stewart.platform)} end"
        yield at.fault(message, ("stewart", "platform"), "give as many points as under base")
    for key, bars in robots.items():
        for name in type(bars).model_fields if bars is not None else ():
            if name in ("offset", "angle") or key == "stewart":
                continue
            sizes = getattr(bars, name)
            for place, size in enumerate(sizes) if isinstance(sizes, tuple) else (("", sizes),):
                length = rational(size)
                if length is not None and length <= 0:
                    route = (key, name, place) if isinstance(sizes, tuple) else (key, name)
                    yield at.fault(f"the length of the {name.removesuffix('s')} must be positive", route)


def _parallel(space: Space, legs: list[GivenLegs]) -> Mechanism:
    """Base, platform, and between them the bodies of each leg."""
    chains = tuple((leg.chain.upper(), leg.count) for leg in legs)
    bodies = 2 + sum((len(chain) - 1) * count for chain, count in chains)
    joints = tuple(each for chain, count in chains for each in leg_joints(chain, count, space))
    rods = sum(idle_legs(chain) * count for chain, count in chains)
    return Mechanism(space, bodies, joints, rods, chains)


def _joints(given: GivenJoints, space: Space) -> Joints:
    (sort,) = given.sorts
    if sort == "constraints":
        return Joints("", given.count, given.constraints or 0, given.joining)
    return Joints(sort, getattr(given, sort), LAMBDA[space] - FREEDOMS[sort], given.joining)


def _joint_faults(given: GivenParts, at: At) -> Iterator[SheetError]:
    for key in ("bodies", "joints"):
        if getattr(given, key) is None:
            yield at.fault(
                f"'{key}' is missing", (), "add bodies: 4, the frame among them, and joints: [...]", True
            )
    for index, each in enumerate(given.joints or ()):
        route = ("joints", index)
        if len(each.sorts) != 1:
            what = f"both {' and '.join(each.sorts)}" if each.sorts else "no sort of joint"
            yield at.fault(f"{what} in one entry", route, AS_WRITTEN)
        elif each.sorts[0] != "constraints" and each.count != 1:
            yield at.fault("how many there are is said twice", (*route, "count"), AS_WRITTEN)
        elif each.sorts[0] == "constraints" and (each.constraints or 0) > LAMBDA[given.space]:
            message = f"a joint has at most {LAMBDA[given.space]} constraints in a {given.space} mechanism"
            yield at.fault(message, (*route, "constraints"))
        elif each.sorts[0] != "constraints" and each.sorts[0] not in POSSIBLE[given.space]:
            hint = f"joints there: {', '.join(POSSIBLE[given.space])}, or {{constraints: ...}}"
            yield at.fault(
                f"a {given.space} mechanism has no {each.sorts[0]} joint", (*route, each.sorts[0]), hint
            )


def _leg_faults(given: GivenParts, at: At) -> Iterator[SheetError]:
    for key in ("bodies", "joints", "rods"):
        if key in given.model_fields_set:
            yield at.fault(
                f"'{key}' follows from the legs", (key,), "give either legs: or bodies: and joints:", True
            )
    here = {letter: name for letter, name in LETTERS.items() if name in POSSIBLE[given.space]}
    letters = ", ".join(f"{letter} {name}" for letter, name in here.items())
    for index, leg in enumerate(given.legs or ()):
        wrong = [letter for letter in leg.chain.upper() if letter not in here]
        if wrong:
            what = f"a {given.space} mechanism has no joint {wrong[0]}"
            yield at.fault(what, ("legs", index, "chain"), f"the letters are {letters}")


def _impossible(found: Mechanism, at: At) -> Iterator[SheetError]:
    if found.loops < 0:
        message = f"{found.bodies} bodies cannot hang together by {found.pairs} joints"
        yield at.fault(message, ("bodies",), f"at least {found.bodies - 1} joints are needed")
    spherical = sum(each.pairs for each in found.joints if each.name == "spherical")
    if found.rods * 2 > spherical:
        hint = "a rod is a body held by two spherical joints and nothing else but a slider on their line"
        yield at.fault(f"{found.rods} rods need {2 * found.rods} spherical joints", ("rods",), hint)
