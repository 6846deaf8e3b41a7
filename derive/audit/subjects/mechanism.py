"""A mechanism: each body moves freely, and each joint takes what its own motions leave of that freedom."""

from __future__ import annotations

import re
from collections.abc import Iterator

import sympy

from derive.audit.asked import Asked, Same, Test
from derive.audit.linkages import position, singularities, velocity
from derive.audit.parallel import five_bar_singularities, inverse_kinematics, jacobian, meeting
from derive.audit.points import Point
from derive.mechanics.linkages import FiveBar
from derive.mechanics.mobility import Mechanism

X, Y, Z = (tuple(row) for row in sympy.eye(3).tolist())
STILL = (0, 0, 0)
# The motions that a joint allows, each (omega, v) of a body seen from the other.
MOTIONS = {
    "revolute": [(Z, STILL)],
    "prismatic": [(STILL, X)],
    "helical": [(Z, Z)],
    "cylindrical": [(Z, STILL), (STILL, Z)],
    "universal": [(Z, STILL), (X, STILL)],
    "spherical": [(X, STILL), (Y, STILL), (Z, STILL)],
    "planar": [(Z, STILL), (STILL, X), (STILL, Y)],
}
# All that a body can do there.
SPACES = {
    "planar": MOTIONS["planar"],
    "spherical": MOTIONS["spherical"],
    "spatial": [(X, STILL), (Y, STILL), (Z, STILL), (STILL, X), (STILL, Y), (STILL, Z)],
}
LETTERS = {sort[0].upper(): sort for sort in MOTIONS if sort != "planar"} | {"E": "planar"}
ROD = re.compile("S(?=P?S)")  # two balls with nothing but a slider between them


def mobility(asked: Asked, point: Point) -> Iterator[Test]:
    """The freedoms of all bodies but one, less what each joint takes from one body of each of its pairs."""
    mechanism: Mechanism = asked.subject
    whole = _rank(SPACES[mechanism.space])
    free = whole * (_bodies(mechanism) - 1) - sum(_taken(mechanism, whole))
    yield Same("dof", point.number(free))
    if rods := _rods(mechanism):
        yield Same("idle", point.number(rods))
        yield Same("effective", point.number(free - rods))


def _taken(mechanism: Mechanism, whole: int) -> Iterator[int]:
    """What each sort of joints takes away."""
    if mechanism.legs:
        for chain, count in mechanism.legs:
            yield from (count * (whole - _rank(MOTIONS[LETTERS[letter]])) for letter in chain)
        return
    for joint in mechanism.joints:
        each = whole - _rank(MOTIONS[joint.name]) if joint.name else joint.constraints
        yield joint.count * (joint.joining - 1) * each


def _bodies(mechanism: Mechanism) -> int:
    """With the frame; of a parallel robot base, platform, and those between the joints of each leg."""
    if not mechanism.legs:
        return mechanism.bodies
    return 2 + sum(count * (len(chain) - 1) for chain, count in mechanism.legs)


def _rods(mechanism: Mechanism) -> int:
    """Bodies that may spin about the line of their balls."""
    if not mechanism.legs:
        return mechanism.rods
    return sum(count * len(ROD.findall(chain)) for chain, count in mechanism.legs)


def _rank(motions: list[tuple[tuple[int, ...], tuple[int, ...]]]) -> int:
    return int(sympy.Matrix([[*omega, *v] for omega, v in motions]).rank())


def _position(asked: Asked, point: Point) -> Iterator[Test]:
    """Of two cranks or of one."""
    yield from meeting(asked, point) if isinstance(asked.subject, FiveBar) else position(asked, point)


def _singularities(asked: Asked, point: Point) -> Iterator[Test]:
    yield from (five_bar_singularities if isinstance(asked.subject, FiveBar) else singularities)(asked, point)


KINDS = {
    "mobility": mobility,
    "position": _position,
    "velocity": velocity,
    "singularities": _singularities,
    "inverse-kinematics": inverse_kinematics,
    "jacobian": jacobian,
}
