"""The arm in a tree of links as the rows of a robot: each joint a free row, fixed joints merged into it, what
is welded to a link one body with it, a joint that follows another coupled to it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from math import fabs

from derive.sheet.exchange.beside import driven, held, nearly
from derive.sheet.exchange.elements import Element
from derive.sheet.exchange.rigid import ORIGIN, Mass, Pose, added
from derive.sheet.exchange.route import Way, at_rest, joined, way, welds
from derive.sheet.exchange.told import Data, Told
from derive.sheet.exchange.urdf import TURNING, Joint, Model, Origin
from derive.sheet.exchange.values import EXACT, Value, moment, written, written_angle
from derive.sheet.exchange.variables import Variables
from derive.sheet.range_faults import MOST

GRAVITY = Fraction("9.81")  # m/s^2, against the z axis of the root


def arm(model: Model, base: str = "", tip: str = "", within: float = EXACT) -> Told:
    """The robot as its YAML would hold it. Raises SheetErrors."""
    along = way(model, base, tip)
    rows = list(_rows(along))
    variables = Variables([row.joint for row in rows])
    told = Told(model.element, f"{along.joints[0].parent} to {along.tip}")
    if model.name:
        told.put(model.name, model.element, "name")
    bodies = [joined(welds(model, row.joint.child, along, within)) for row in rows]
    loose = driven(along)
    heavy = any(body for body, _ in bodies) and not loose
    if heavy:
        told.put(_gravity(along, within), model.element, "gravity")
    if moves := _places(rows[0].fixed, within):
        told.put(moves, rows[0].joint.element, "base")
    for index, (row, (body, element)) in enumerate(zip(rows, bodies, strict=True)):
        _put_row(told, index, row, variables, within)
        if heavy:
            _put_body(told, index, body, element or row.joint.element)
        _put_joint(told, index, row.joint, variables, within)
    behind = [joint.origin for joint in along.joints[along.joints.index(rows[-1].joint) + 1 :]]
    if moves := _places(behind, within):
        told.put(moves, along.joints[-1].element, "tool")
    told.doubts += [*held(along), *loose, *variables.strange(), *nearly(along, within)]
    return told


def _gravity(along: Way, within: float) -> Data:
    """In the frame of the base, the joints before it at zero."""
    pose = Pose()
    for joint in along.before:
        pose = pose @ at_rest(joint, within)
    return [written(-GRAVITY * entry, "m/s^2") for entry in pose.R[2]]


@dataclass(frozen=True, slots=True)
class _Row:
    """A joint that moves, and the fixed frames that come before its own."""

    joint: Joint
    fixed: tuple[Origin, ...]


def _rows(along: Way) -> Iterator[_Row]:
    fixed: list[Origin] = []
    for joint in along.joints:
        if joint.moves:
            yield _Row(joint, tuple(fixed))
            fixed = []
        else:
            fixed.append(joint.origin)


def _places(origins: list[Origin] | tuple[Origin, ...], within: float) -> list[Data]:
    """Frames one after the other as moves about current axes: displacements, then yaw, pitch and roll."""
    merged: list[Origin] = []
    for origin in origins:
        if merged and not any(merged[-1].rpy):
            origin = Origin(added(merged.pop().xyz, origin.xyz), origin.rpy)
        merged.append(origin)
    return [move for origin in merged for move in _moves(origin, within)]


def _moves(origin: Origin, within: float) -> Iterator[Data]:
    for axis, length in zip("xyz", origin.xyz, strict=True):
        if (text := written(length, "m")) != "0":
            yield {"translate": axis, "by": text}
    for axis, angle in zip("zyx", reversed(origin.rpy), strict=True):
        if (text := written_angle(angle, within)) != "0":
            yield {"rotate": axis, "by": text}


def _own(joint: Joint, by: str, within: float) -> Data:
    """The move of a joint itself; about a negative axis the other way."""
    kind = "rotate" if joint.type in TURNING else "translate"
    size = max(map(fabs, joint.axis))
    near = [round(float(entry) / size) for entry in joint.axis]
    aligned = all(
        fabs(float(entry) / size - whole) <= within for entry, whole in zip(joint.axis, near, strict=True)
    )
    if not aligned or sum(map(abs, near)) != 1:
        return {kind: [written(entry) for entry in joint.axis], "by": by}
    k = near.index(1) if 1 in near else near.index(-1)
    if near[k] > 0:
        return {kind: "xyz"[k], "by": by}
    if " " in by:
        return {kind: "xyz"[k], "by": f"-({by})"}
    return {kind: "xyz"[k], "by": by[1:] if by.startswith("-") else f"-{by}"}


def _put_row(told: Told, index: int, row: _Row, variables: Variables, within: float) -> None:
    before = [*(row.fixed if index else ()), row.joint.origin]
    motion = [*_places(before, within), _own(row.joint, variables.by(row.joint), within)]
    told.put(motion, row.joint.element, "links", index, "motion")
    told.notes.append(row.joint.name)


def _put_body(told: Told, index: int, body: Mass | None, element: Element) -> None:
    mass = body or Mass(Fraction(0), ORIGIN, (ORIGIN, ORIGIN, ORIGIN))
    told.put(written(mass.mass, "kg"), element, "links", index, "mass")
    told.put([written(entry, "m") for entry in mass.com], element, "links", index, "com")
    told.put(_inertia(mass), element, "links", index, "inertia")


def _inertia(mass: Mass) -> Data:
    (xx, xy, xz), (_, yy, yz), (_, _, zz) = mass.inertia
    if not any((xx, yy, zz, xy, yz, xz)):
        return "point"
    mixed: tuple[Value, ...] = (xy, yz, xz)
    return [moment(each) for each in (xx, yy, zz, *(mixed if any(mixed) else ()))]


def _put_joint(told: Told, index: int, joint: Joint, variables: Variables, within: float) -> None:
    endless = joint.type in TURNING and max(map(fabs, joint.limits or (0,))) > MOST
    if joint.limits and not endless and not variables.follows(joint):
        unit = "m" if joint.type == "prismatic" else "rad"
        limits: Data = [
            written_angle(each, within) if unit == "rad" else written(each, unit) for each in joint.limits
        ]
        told.put(limits, joint.element.one("limit") or joint.element, "links", index, "range")
    friction: dict[str, Data] = {}
    if joint.damping:
        friction["viscous"] = written(joint.damping)
    if joint.friction:
        friction["coulomb"] = written(joint.friction)
    if friction and not variables.follows(joint):
        told.put(friction, joint.element.one("dynamics") or joint.element, "links", index, "friction")
