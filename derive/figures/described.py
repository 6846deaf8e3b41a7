"""What a figure of an arm is called, and what is seen in it, said for those who do not see it."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from fractions import Fraction
from math import degrees

from derive.derivation import Phrase, Said
from derive.expression import Degrees, Expr, Relation, Symbol, free_symbols
from derive.figures.arm import Posed
from derive.figures.view import Vector, View, dot
from derive.mechanics.robot import Robot

ALIGNED = 1e-6  # of a direction from an axis of the base
BASE = (("x0", (1.0, 0.0, 0.0)), ("y0", (0.0, 1.0, 0.0)), ("z0", (0.0, 0.0, 1.0)))

ARTICLE = re.compile(r"^(?:an?|the)\s+", re.IGNORECASE)


def caption(robot: Robot, posed: Posed, view: View, known: frozenset[str]) -> Phrase:
    """What stands under the figure: the arm by its name, and the position in which it is drawn; not to scale
    where it is not `known` how long several of its links are."""
    pose = _pose(robot, posed, view)
    guessed = {part.by for part in posed.parts if not part.moving and free_symbols(part.by) - known - {""}}
    if len(guessed) > 1 and not view.flat:
        pose = Phrase("not-to-scale", {"pose": pose})
    return Phrase("arm", {"name": _name(robot), "pose": pose})


def seen(robot: Robot, posed: Posed, view: View) -> Phrase:
    """Joints in their order with the directions of their axes, and the directions of the frames."""
    about: dict[str, Said] = {"name": _name(robot), "pose": _pose(robot, posed, view)}
    about["joints"] = tuple(_joints(robot, posed))
    frames = tuple(_frames(posed)) if not robot.by_screws else ()
    return Phrase("seen-with-frames", {**about, "frames": frames}) if frames else Phrase("seen", about)


def _name(robot: Robot) -> Said:
    """As its author calls it, without the article of a sentence: the words have their own."""
    return ARTICLE.sub("", robot.name) or Phrase("unnamed")


def _pose(robot: Robot, posed: Posed, view: View) -> Phrase:
    """How its revolute joints stand: in a plane any way, in space as the caption says."""
    turned = [(joint.name, posed.values[joint.name]) for joint in posed.joints if not joint.slides]
    if not turned:
        return Phrase("only-slides")
    if not any(abs(angle) > ALIGNED for _, angle in turned):
        return Phrase("all-zero" if len(turned) > 1 else "one-zero")
    if view.flat:
        return Phrase("in-plane")
    bent = [Relation(Symbol(name), "=", _in_degrees(angle)) for name, angle in turned if abs(angle) > ALIGNED]
    return Phrase("bent" if len(bent) < len(turned) else "all-bent", {"at": tuple(bent)})


def _in_degrees(angle: float) -> Expr:
    return Degrees(Fraction(round(degrees(angle))))


def _joints(robot: Robot, posed: Posed) -> Iterator[Phrase]:
    for number, joint in enumerate(posed.joints, 1):
        way = direction(joint.axis)
        kind = "slides" if joint.slides else "turns"
        about: dict[str, Said] = {"number": number, "by": Symbol(joint.name)}
        yield Phrase(kind, {**about, "way": way}) if way else Phrase(f"{kind}-aslant", about)


def _frames(posed: Posed) -> Iterator[Phrase]:
    """Of each frame after the base whose axes are along those of the base."""
    for number, pose in enumerate(posed.poses):
        columns: Sequence[Vector] = [(pose[0][k], pose[1][k], pose[2][k]) for k in (0, 2)]
        x, z = map(direction, columns)
        if number and x and z:
            yield Phrase(
                "frame", {"x": Symbol(f"x{number}"), "x_way": x, "z": Symbol(f"z{number}"), "z_way": z}
            )


def direction(axis: Vector) -> Phrase | None:
    """Along or against an axis of the base; None where it is aslant."""
    for name, base in BASE:
        if abs(abs(dot(axis, base)) - 1) < ALIGNED:
            return Phrase("along" if dot(axis, base) > 0 else "against", {"axis": Symbol(name)})
    return None
