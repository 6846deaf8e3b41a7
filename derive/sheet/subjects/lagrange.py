"""lagrange: a mechanical system by its coordinates and its energies or bodies."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Any, TypeAlias

from pydantic import Discriminator, Field, Tag

from derive.algebra.function import Constraint
from derive.control.system import Equation
from derive.errors import SheetError, how_many
from derive.expression import ZERO, Expr, Symbol, add, free_symbols, multiply, number
from derive.kinds.fields import (
    TREES,
    Angle,
    EquationField,
    Formula,
    InertiaMoment,
    Length,
    Mass,
    Name,
    OptionsModel,
    Quantity,
)
from derive.mechanics.lagrangian import LagrangianSystem, MovingBody
from derive.sheet.checked import values_in
from derive.sheet.faults import did_you_mean
from derive.sheet.source import At, Faults, Route
from derive.sheet.subjects.registry import Known

# What has no part in an equilibrium has none in its answer either.
HARMLESS = frozenset(
    {"bodies", "kinetic", "potential", "gravity", "forces", "damping", "dissipation", "constraints"}
)
MOST = 12  # coordinates, bodies or constraints


class GivenBody(OptionsModel):
    """A mass at a position; with a moment of inertia, the angle it turns by."""

    mass: Mass
    """The mass."""
    position: Annotated[list[Length], Field(min_length=2, max_length=3)]
    """Where its centre is, in the coordinates."""
    inertia: InertiaMoment | None = None
    """The moment of inertia about its centre."""
    angle: Angle | None = None
    """The angle by which it turns, in the coordinates."""


def _form(value: Any) -> str:
    return "=several" if isinstance(value, list | tuple) else "=one"


Equations: TypeAlias = Annotated[list[EquationField], Field(max_length=MOST)]
ByCoordinate: TypeAlias = dict[Name, Quantity]


class Given(OptionsModel):
    """Coordinates with bodies or energies. Rates are written `x_dot`."""

    coordinates: Annotated[list[Name], Field(min_length=1, max_length=MOST)]
    """The generalised coordinates."""
    bodies: Annotated[list[GivenBody], Field(max_length=MOST, default_factory=list)]
    """The bodies, whose energies are found."""
    kinetic: Formula = ZERO
    """The kinetic energy that is not that of the bodies."""
    potential: Formula = ZERO
    """The potential energy that is not that of the bodies, as of springs."""
    gravity: Annotated[list[Quantity], Field(min_length=2, max_length=3)] | None = None
    """The acceleration of gravity, in the axes of the positions."""
    forces: Annotated[ByCoordinate, Field(default_factory=dict)]
    """The generalised forces, by coordinate."""
    damping: Annotated[ByCoordinate, Field(default_factory=dict)]
    """The viscous damping (b in b x_dot), by coordinate."""
    dissipation: Formula = ZERO
    """Rayleigh's function, of the rates."""
    constraints: Annotated[
        Annotated[Equations, Tag("=several")] | Annotated[EquationField, Tag("=one")],
        Discriminator(_form),
        Field(default_factory=list),
    ]
    """An equation, or several, that the coordinates obey."""


def build(given: Given, at: At, known: Known) -> LagrangianSystem:
    """The system of a problem. Raises SheetErrors."""
    faults = Faults(_coordinate_faults(given, at, known))
    faults += [*_body_faults(given, at, known), *_key_faults(given, at), *_rate_faults(given, at)]
    faults.settle()
    equations = given.constraints if isinstance(given.constraints, list) else [given.constraints]
    return LagrangianSystem(
        tuple(given.coordinates),
        tuple(MovingBody(b.mass, tuple(b.position), b.inertia, b.angle) for b in given.bodies),
        given.kinetic,
        given.potential,
        _gravity(given),
        tuple(given.forces.items()),
        add(given.dissipation, *(_viscous(name, b) for name, b in given.damping.items())),
        tuple(Constraint(each.left, each.right) for each in equations),
    )


def _viscous(name: str, b: Expr) -> Expr:
    """Rayleigh's function b x_dot^2/2."""
    return multiply(number("1/2"), b, Symbol(f"{name}_dot") ** 2)


def _gravity(given: Given) -> tuple[Expr, ...]:
    """As given; else g against the last axis. Zero where no body feels it."""
    if not given.bodies:
        return ()
    size = len(given.bodies[0].position)
    return tuple(given.gravity) if given.gravity else (*[ZERO] * (size - 1), -Symbol("g"))


# -- faults ----------------------------------------------------------------------------------------------


def _coordinate_faults(given: Given, at: At, known: Known) -> Iterator[SheetError]:
    used = _base_names(given)
    for index, name in enumerate(given.coordinates):
        where = ("coordinates", index)
        if name in given.coordinates[:index]:
            yield at.fault(f"'{name}' is listed twice", where, "list each coordinate once")
        elif name == "t":
            yield at.fault("t is the time and no coordinate", where, "choose another name")
        elif name in known.where:
            yield at.fault(f"'{name}' has a value under where: and cannot move", where)
        elif name not in used:
            hint = did_you_mean(name, used - set(given.coordinates))
            yield at.fault(f"nothing depends on the coordinate '{name}'", where, hint)
    for name in given.coordinates if not given.bodies else ():
        if _alone(given, name, known) == -1:
            message = f"the kinetic energy is negative where only {name} moves"
            yield at.fault(message, ("kinetic",), "kinetic: is positive, as 1/2*m*x_dot^2")
    if not given.bodies and given.kinetic == ZERO:
        hint = "give bodies:, or kinetic: as 1/2*m*x_dot^2"
        yield at.fault("there is no kinetic energy", (), hint)


def _alone(given: Given, moving: str, known: Known) -> int | None:
    """The sign of the kinetic energy where one coordinate moves; every name without a value is positive."""
    rates = {f"{name}_dot": number(int(name == moving)) for name in given.coordinates}
    sizes = free_symbols(given.kinetic) - {*given.coordinates, *rates}
    return Known({**known.where, **rates}, dict.fromkeys(sizes, "positive")).sign(given.kinetic)


def _body_faults(given: Given, at: At, known: Known) -> Iterator[SheetError]:
    sizes = [len(body.position) for body in given.bodies]
    if given.gravity is not None and sizes and len(given.gravity) != sizes[0]:
        message = f"gravity has {how_many(len(given.gravity), 'component')}, the positions {sizes[0]}"
        yield at.fault(message, ("gravity",), "give both in the same frame")
    if given.gravity is not None and not sizes:
        yield at.fault("gravity acts on bodies, and there are none", ("gravity",), "put it into potential:")
    for index, body in enumerate(given.bodies):
        route = ("bodies", index)
        if len(body.position) != sizes[0]:
            message = f"a position of {len(body.position)} coordinates among those of {sizes[0]}"
            yield at.fault(message, (*route, "position"), "give every body as many")
        if (body.inertia is None) != (body.angle is None):
            has, lacks = ("angle", "inertia") if body.inertia is None else ("inertia", "angle")
            yield at.fault(f"a body with {has}: needs {lacks}: too", (*route, has), f"add {lacks}:")
        for key, value in (("mass", body.mass), ("inertia", body.inertia)):
            if value is not None and known.sign(value) == -1:
                yield at.fault(f"the {key} is negative; no body has that", (*route, key))


def _key_faults(given: Given, at: At) -> Iterator[SheetError]:
    for key, table in (("forces", given.forces), ("damping", given.damping)):
        for name in table:
            if name not in given.coordinates:
                hint = did_you_mean(name, given.coordinates)
                yield at.fault(f"'{name}' is no coordinate", (key, name), hint, True)


def _rate_faults(given: Given, at: At) -> Iterator[SheetError]:
    """A rate of something that is no coordinate, and accelerations anywhere."""
    known = {f"{name}_dot" for name in given.coordinates}
    for route, tree in _trees(given):
        for name in sorted(free_symbols(tree)):
            if name.endswith("_ddot"):
                yield at.fault(f"{name}: energies and forces hold no accelerations", route)
            elif name.endswith("_dot") and name not in known:
                yield at.fault(f"{name} is the rate of no coordinate", route, did_you_mean(name, known))


def _trees(given: Given) -> Iterator[tuple[Route, Expr]]:
    """Every formula with its way from here, gravity apart."""
    for route, value in values_in(given):
        if isinstance(value, Equation):
            yield from ((route, side) for side in (value.left, value.right))
        elif isinstance(value, TREES) and route[0] != "gravity":
            yield route, value


def _base_names(given: Given) -> set[str]:
    """The names in all formulas; of a rate that of its coordinate."""
    names = {name for _, tree in _trees(given) for name in free_symbols(tree)}
    return {name.removesuffix("_ddot").removesuffix("_dot") for name in names}
