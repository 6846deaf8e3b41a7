"""What is wrong with the bodies, motors and frictions of a robot, and what is only strange about them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from derive.algebra.normal import Names, normal
from derive.algebra.signs import sign_of
from derive.errors import NotDerivable, SheetError
from derive.expression import Expr, Symbol
from derive.mechanics.bodies import Moments, PointMass
from derive.mechanics.dh import moves
from derive.mechanics.plausible import impossible_inertia
from derive.mechanics.poses import composed, position_part, rotation_part
from derive.mechanics.robot import Link, Robot
from derive.sheet.source import At
from derive.sheet.subjects.registry import Known


def body_faults(robot: Robot, at: At, known: Known) -> Iterator[SheetError]:
    """Negative masses and rotors, inertias about a point they cannot be about, drives without a joint."""
    for index, link in enumerate(robot.links):
        route = ("links", index)
        if link.body and link.body.com == "center" and _middle_moves(link, robot):
            n = index + 1
            message = f"joint {n} moves the middle between the origins in the frame of link {n}"
            yield at.fault(message, (*route, "com"), "write com: as a point of the link, as [0, 0, -l/2]")
        yield from _about_what(link, at, index)
        if link.body and _sign(link.body.mass, known) == -1:
            message = f"the mass of link {index + 1} is negative; no body has a negative mass"
            yield at.fault(message, (*route, "mass"), "a mass is positive, or 0 for a link without one")
        if link.motor and _sign(link.motor.inertia, known) == -1:
            message = f"the inertia of the motor of link {index + 1} is negative; no rotor has that"
            yield at.fault(message, (*route, "motor", "inertia"))
        if link.variable is None and (link.motor or link.friction):
            key = "motor" if link.motor else "friction"
            message = f"row {index + 1} has no joint that could have a {key}"
            yield at.fault(message, (*route, key), "give it to a row with a star", key=True)


def body_warnings(links: Sequence[Link], at: At, known: Known) -> Iterator[SheetError]:
    """Inertias that no body has, but which well-known sets of parameters hold."""
    names: Names = {Symbol(name): value for name, value in known.where.items()}
    for index, link in enumerate(links):
        if link.body is None or not isinstance(link.body.inertia, Moments):
            continue
        try:
            reason = impossible_inertia(link.body, names, _positive(known))
        except (NotDerivable, ValueError, ZeroDivisionError):
            continue
        if reason:
            message = f"no body has the inertia of link {index + 1}: {reason}"
            yield at.fault(message, ("links", index, "inertia"), "the sheet is built all the same")


def _middle_moves(link: Link, robot: Robot) -> bool:
    """Whether the middle between the origins is no point of the link: where the joint slides, and where a
    link turns about the end that is its own origin, as in modified rows with a length."""
    T = composed(moves(link, robot))
    back = rotation_part(T).T @ position_part(T)
    return any(back.diff(name) for name in robot.variables)


def _about_what(link: Link, at: At, index: int) -> Iterator[SheetError]:
    if link.body is None or link.body.about == "com":
        return
    route = ("links", index, "about")
    if link.body.com == "center":
        message = "an inertia about the origin needs the com as a point"
        yield at.fault(message, route, "write com: [-L/2, 0, 0], say, in place of center")
    elif not isinstance(link.body.inertia, Moments | PointMass):
        message = "the inertia of a shape is about its own center"
        yield at.fault(message, route, "leave about: out, or give the moments as [Ixx, Iyy, Izz]", key=True)


def _sign(value: Expr, known: Known) -> int | None:
    try:
        return sign_of(normal(value, {Symbol(n): v for n, v in known.where.items()}), _positive(known))
    except (NotDerivable, ZeroDivisionError):
        return None


def _positive(known: Known) -> frozenset[str]:
    return frozenset(name for name, said in known.assumptions.items() if said == "positive")
