"""The bodies of an arm, its motors, the friction in its joints and gravity: where a question needs them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from derive.algebra.formulas.with_units import measured, unit_of
from derive.derivation import Cell, Phrase, Said, Table
from derive.expression import ZERO, Call, Expr, Symbol
from derive.given.datum import Datum, vector
from derive.given.moves import axis_said
from derive.kinds.problem import Problem
from derive.kinds.registry import load
from derive.mechanics.bodies import Body, Box, Cylinder, Inertia, Moments, PointMass, Rod, Sphere
from derive.mechanics.dynamics import gravity_of
from derive.mechanics.robot import Robot

DRIVEN = ("rotor", "ratio", "viscous", "coulomb")


HEAVY = frozenset({  # kinds whose answers hold gravity
    "dynamics", "energy", "forward-dynamics", "gravity", "newton-euler", "properties", "regressor",
    "state-space",
})  # fmt: skip


def bodies(robot: Robot, problem: Problem) -> Iterator[Datum]:
    """A table of the bodies, one of what the joints add, and a sentence about gravity."""
    if not any("bodies" in getattr(load(problem.name, kind), "NEEDS", ()) for kind, _ in problem.questions):
        return
    if robot.gravity or any(kind in HEAVY for kind, _ in problem.questions):
        yield Datum(Phrase("gravity", {"vector": vector(gravity_of(robot))}))
    carried = [(i, link.body) for i, link in enumerate(robot.links, 1) if link.body]
    headings: tuple[Cell, ...] = (
        Symbol("i"), Phrase("mass"), Phrase("center-of-mass"), Phrase("inertia-of-body"),
    )  # fmt: skip
    key = "bodies-of-screws" if robot.by_screws else "bodies"
    said = _of_one(key, [i for i, _ in carried])
    table = Table(headings, tuple(_line(i, body) for i, body in carried))
    yield Datum(said, table, ours=frozenset(f"o_{i}" for i in range(len(robot.links) + 1)))
    if added := dict(_added(robot)):
        kept = [k for k in range(len(DRIVEN)) if any(line[k] != ZERO for line in added.values())]
        lines: list[tuple[Cell, ...]] = [
            (str(i), *(measured(line[k]) for k in kept)) for i, line in added.items()
        ]
        headings = (Phrase("joint"), *(Phrase(DRIVEN[k]) for k in kept))
        only = {link.motor is None for link in robot.links if link.motor or link.friction}
        key = "drives" if len(only) > 1 or len(kept) > 2 else "frictions" if True in only else "motors"
        yield Datum(_of_one(key, [*added]), Table(headings, tuple(lines)))


def _of_one(key: str, numbers: Sequence[int]) -> Phrase:
    """The words of `key`, or those that speak of one link or joint."""
    match numbers:
        case [i]:
            return Phrase(f"{key}-one", {"i": str(i)})
    return Phrase(key)


def _line(i: int, body: Body) -> tuple[Cell, ...]:
    com: Cell = _middle(i) if body.com == "center" else vector(body.com)
    inertia = inertia_said(body.inertia)
    if body.about == "origin" and isinstance(body.inertia, Moments):
        inertia = Phrase("about-origin", {"inertia": inertia})
    return str(i), measured(body.mass), com, inertia


def _middle(i: int) -> Phrase:
    return Phrase("middle", {"before": Symbol(f"o_{i - 1}"), "here": Symbol(f"o_{i}")})


def inertia_said(inertia: Inertia) -> Phrase:
    """The moments along the axes of the frame, or the shape that has them."""
    match inertia:
        case Moments(values):
            unit = next(filter(None, map(unit_of, values)), "")
            moments: dict[str, Said] = {"moments": measured(Call("diag", values[:3]), unit)}
            if all(each == ZERO for each in values[3:]):
                return Phrase("moments", moments)
            return Phrase("six-moments", moments | dict(zip(("xy", "yz", "xz"), values[3:], strict=True)))
        case Box((x, y, z)):
            return Phrase("box", {"x": x, "y": y, "z": z})
        case Rod(length, axis):
            return Phrase("rod", {"length": measured(length), "axis": axis_said(axis)})
        case Cylinder(radius, length, axis):
            about = {"radius": measured(radius), "length": measured(length), "axis": axis_said(axis)}
            return Phrase("cylinder", about)
        case Sphere(radius):
            return Phrase("sphere", {"radius": measured(radius)})
        case PointMass():
            return Phrase("point-mass")


def _added(robot: Robot) -> Iterator[tuple[int, tuple[Expr, Expr, Expr, Expr]]]:
    """Of each joint with a motor or with friction: the inertia of the rotor, the gear ratio, and friction."""
    for i, link in enumerate(robot.links, 1):
        if link.motor or link.friction:
            rotor = (link.motor.inertia, link.motor.ratio) if link.motor else (ZERO, ZERO)
            yield (
                i,
                (
                    *rotor,
                    *((link.friction.viscous, link.friction.coulomb) if link.friction else (ZERO, ZERO)),
                ),
            )
