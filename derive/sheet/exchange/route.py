"""Which links of a tree are the arm: the way from the root to its end, and what is welded to each of them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from math import asin, atan2

from derive.sheet.exchange.elements import Element
from derive.sheet.exchange.rigid import (
    Mass,
    Pose,
    Rows,
    Vector,
    rotation,
    seen_from,
    transposed,
    vector,
    welded,
)
from derive.sheet.exchange.urdf import TURNING, Joint, Model
from derive.sheet.exchange.values import Value
from derive.sheet.faults import did_you_mean


@dataclass(frozen=True, slots=True)
class Way:
    """The joints of the arm from its base to `tip`, fixed ones among them, those `before` its base, and those
    `beside` it that move: both are held at zero."""

    before: tuple[Joint, ...]
    joints: tuple[Joint, ...]
    tip: str
    beside: tuple[Joint, ...]

    @property
    def moving(self) -> dict[str, Joint]:
        """The joints of the arm that move, by the link to which each leads."""
        return {joint.child: joint for joint in self.joints if joint.moves}


def way(model: Model, base: str = "", tip: str = "") -> Way:
    """The way to `tip`; else to the end of most moving joints, and where several ends have as many, to the
    last link that is on the way to all of them. Raises SheetErrors."""
    for name in filter(None, (base, tip)):
        if name not in model.links:
            hint = did_you_mean(name, tuple(model.links), "there are")
            raise model.element.error(f"there is no link '{name}'", hint)
    path = model.path(tip) if tip else _longest(model, base)
    before: tuple[Joint, ...] = ()
    if base and base != model.root:
        start = next((k for k, joint in enumerate(path, 1) if joint.child == base), None)
        if start is None:
            raise model.element.error(f"link '{base}' is not on the way to '{tip or path[-1].child}'")
        before, path = path[:start], path[start:]
    if not any(joint.moves for joint in path):
        raise model.element.error("no joint moves on the way to the end of the arm")
    taken = {joint.child for joint in path}
    first = path[0].parent
    beside = tuple(
        joint
        for joint in model.joints.values()
        if joint.moves and joint.child not in taken and _hangs_on(model, joint, taken, first)
    )
    return Way(before, path, path[-1].child, beside)


def _longest(model: Model, base: str) -> tuple[Joint, ...]:
    leaves = [link for link in model.links if not model.children(link)]
    paths = [path for leaf in leaves if _through(path := model.path(leaf), base, model)]
    most = max((_moving(path) for path in paths), default=0)
    longest = [path for path in paths if _moving(path) == most]
    if not longest or not most:
        return ()
    shared = longest[0]
    for path in longest[1:]:
        shared = tuple(a for a, b in zip(shared, path, strict=False) if a is b)
    if 2 * _moving(shared) <= most:
        ends = " or ".join(f"--tip {path[-1].child}" for path in longest[:4])
        hint = f"say where the arm ends: derive import FILE {ends}"
        raise model.element.error("this robot has several arms", hint)
    return shared


def _through(path: tuple[Joint, ...], base: str, model: Model) -> bool:
    return not base or base == model.root or any(joint.child == base for joint in path)


def _moving(path: tuple[Joint, ...]) -> int:
    return sum(joint.moves for joint in path)


def _hangs_on(model: Model, joint: Joint, taken: set[str], first: str) -> bool:
    """Whether a joint beside the arm carries a part of it that moves with the arm."""
    link = joint.parent
    while link in model.joints and link not in taken and link != first:
        link = model.joints[link].parent
    return link in taken


def welds(model: Model, link: str, along: Way, within: float) -> Iterator[tuple[Mass, Element]]:
    """The bodies of a link and of all that hangs on it beside the arm, in its frame, joints at zero."""
    body = model.links[link]
    if body is not None:
        yield body.body(within), body.element
    for joint in model.children(link):
        if joint.child not in along.moving:
            pose = at_rest(joint, within)
            for mass, element in welds(model, joint.child, along, within):
                yield seen_from(pose, mass), element


def at_rest(joint: Joint, within: float) -> Pose:
    """The frame of the link to which a joint leads, in that where it starts: at zero, or at its offset."""
    pose = joint.origin.pose(within)
    return pose @ _moved(joint, joint.mimic.offset, within) if joint.mimic and joint.mimic.offset else pose


def _moved(joint: Joint, by: Fraction, within: float) -> Pose:
    """What a joint adds when it moves by a value."""
    length = sum(float(entry) ** 2 for entry in joint.axis) ** 0.5
    unit = vector(float(entry) / length for entry in joint.axis)
    if joint.type not in TURNING:
        return Pose(p=vector(float(by) * entry for entry in unit))
    return Pose(R=_about(unit, by, within))


def _about(unit: Vector, angle: Value, within: float) -> Rows:
    """Rodrigues' formula, by way of roll, pitch and yaw about a turned axis."""
    pitch, yaw = -asin(max(-1.0, min(1.0, float(unit[2])))), atan2(unit[1], unit[0])
    to = Pose(rotation((Fraction(0), pitch, yaw), within))  # its x axis is the unit vector
    turn = Pose(rotation((angle, Fraction(0), Fraction(0)), within))
    back = Pose(transposed(to.R))
    return (to @ turn @ back).R


def joined(bodies: Iterator[tuple[Mass, Element]]) -> tuple[Mass | None, Element | None]:
    """Bodies of one frame as one, and the place of the first."""
    found = list(bodies)
    return welded([mass for mass, _ in found]), next((element for _, element in found), None)
