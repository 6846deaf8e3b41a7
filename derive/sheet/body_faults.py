"""What is wrong with the bodies, motors and frictions of a robot, and what is only strange about them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.algebra.signs import sign_of
from derive.errors import NotDerivable, SheetError
from derive.mechanics.bodies import Moments, PointMass
from derive.mechanics.dh import moves
from derive.mechanics.plausible import impossible_inertia, principal_minors
from derive.mechanics.poses import composed, position_part, rotation_part
from derive.mechanics.robot import Link, Robot
from derive.sheet.source import At
from derive.sheet.subjects.link import Carried, whole_matrix
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
        if link.body and known.sign(link.body.mass) == -1:
            message = f"the mass of link {index + 1} is negative; no body has a negative mass"
            yield at.fault(message, (*route, "mass"), "a mass is positive, or 0 for a link without one")
        if link.motor and known.sign(link.motor.inertia) == -1:
            message = f"the inertia of the motor of link {index + 1} is negative; no rotor has that"
            yield at.fault(message, (*route, "motor", "inertia"))
        if link.variable is None and (link.motor or link.friction):
            key = "motor" if link.motor else "friction"
            message = f"row {index + 1} has no joint that could have a {key}"
            yield at.fault(message, (*route, key), "give it to a row with a star", key=True)


def body_warnings(links: Sequence[Link], at: At, known: Known) -> Iterator[SheetError]:
    """Inertias that no body has, but which well-known sets of parameters hold."""
    for index, link in enumerate(links):
        if link.body is None or not isinstance(link.body.inertia, Moments):
            continue
        try:
            reason = impossible_inertia(link.body, known.values, known.positive)
        except (NotDerivable, ValueError, ZeroDivisionError):
            continue
        if reason:
            message = f"no body has the inertia of link {index + 1}: {reason}"
            yield at.fault(message, ("links", index, "inertia"), "the sheet is built all the same")


def matrix_faults(links: Sequence[Carried], at: At, known: Known) -> Iterator[SheetError]:
    """Matrices that are not symmetric, and those that give a turn about some axis a negative energy."""
    for index, link in enumerate(links):
        try:
            matrix = ScalarMatrix.of(
                [normal(entry, known.values) for entry in row] for row in whole_matrix(link)
            )
        except (NotDerivable, ZeroDivisionError):
            continue
        if not matrix.rows:
            continue
        uneven = [(i, j) for i, j in combinations(range(3), 2) if matrix[i, j] != matrix[j, i]]
        for i, j in uneven:
            places = f"({i + 1}, {j + 1}) and ({j + 1}, {i + 1})"
            message = f"an inertia matrix is symmetric, but entries {places} differ"
            hint = "write the product of inertia in both, its sign included"
            yield at.fault(message, ("links", index, "inertia", j, i), hint)
        if not uneven and any(sign_of(minor, known.positive) == -1 for minor in principal_minors(matrix)):
            message = f"the inertia matrix of link {index + 1} is not positive semidefinite"
            hint = "no body turns with a negative energy; mind the signs of the products of inertia"
            yield at.fault(message, ("links", index, "inertia"), hint)


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
