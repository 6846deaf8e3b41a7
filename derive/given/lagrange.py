"""What is given of a mechanical system: its coordinates, bodies, energies, forces and constraints."""

from __future__ import annotations

from collections.abc import Iterator

from derive.algebra.formulas.with_units import measured
from derive.derivation import Phrase
from derive.expression import ZERO, Symbol
from derive.given.datum import Datum, names, vector
from derive.kinds.problem import Problem
from derive.mechanics.lagrangian import LagrangianSystem, MovingBody


def data(system: LagrangianSystem, problem: Problem) -> Iterator[Datum]:
    """Coordinates first, for everything else is said in them."""
    several = "s" if len(system.coordinates) > 1 else ""
    yield Datum(Phrase(f"coordinate{several}", {"names": names(system.coordinates)}))
    if system.bodies:
        bodies = tuple(map(_body, system.bodies))
        yield (
            Datum(Phrase("bodies"), items=bodies)
            if bodies[1:]
            else Datum(Phrase("body", {"body": bodies[0]}))
        )
        if system.gravity:
            yield Datum(
                Phrase("gravity", {"vector": vector(system.gravity)}), words=("gravity|weight|hang|incline",)
            )
    beside = "-beside" if system.bodies else ""
    for key in ("kinetic", "potential"):
        if (energy := getattr(system, key)) != ZERO:
            yield Datum(Phrase(key + beside, {"energy": energy}), words=("energy",))
    for name, force in system.forces:
        yield Datum(
            Phrase("force", {"force": force, "coordinate": Symbol(name)}), words=("forces?|torque|push|driv",)
        )
    if system.dissipation != ZERO:
        yield Datum(Phrase("dissipation", {"dissipation": system.dissipation}), words=("dissipation",))
    if system.constraints:
        equations = tuple((each.left, each.right) for each in system.constraints)
        yield Datum(Phrase("constraints"), equations=equations)


def _body(body: MovingBody) -> Phrase:
    about = {"mass": measured(body.mass), "position": vector(body.position)}
    if body.inertia is None or body.angle is None:
        return Phrase("mass-at", about)
    return Phrase("turning-mass-at", about | {"inertia": measured(body.inertia), "angle": body.angle})
