"""What is drawn of an arm is held to the arm in numbers: frames in their places, joints on their axes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from derive.expression import Expr
from derive.figures.arm import Joint, Posed
from derive.figures.view import dot
from derive.mechanics.oracle import Oracle
from derive.mechanics.robot import Robot

MOVED = 0.1  # rad or m: how far a joint is moved to see what it leaves in its place
NEAR = 1e-7  # of the size of an arm


class Misdrawn(Exception):
    """A figure that would show something else than its subject; the message says what."""


def held(robot: Robot, where: Mapping[str, Expr], posed: Posed, joints: Sequence[Joint], size: float) -> None:
    """Raises Misdrawn where a frame or the end-effector is elsewhere, a joint is drawn off its axis, or one
    slides in another direction."""
    import numpy

    oracle, near = Oracle(robot, where), NEAR * size
    end = oracle.tool(posed.values)
    drawn = [] if robot.by_screws else [*zip(posed.poses, oracle.poses(posed.values), strict=True)]
    for number, (ours, theirs) in enumerate((*drawn, (posed.end, end))):
        if numpy.abs(ours - theirs).max() > near + NEAR:
            raise Misdrawn(f"frame {number} is drawn where it is not")
    if robot.coupled:
        return
    helical = {link.variable for link in robot.links if link.joint == "helical"}
    for joint in joints:
        moved = {**posed.values, joint.name: posed.values[joint.name] + MOVED}
        carried = oracle.tool(moved) @ numpy.linalg.inv(end)
        at = numpy.array([*joint.at, 1.0])
        way = [float(part) for part in (carried @ at - at)[:3]]
        on = dot(way, joint.axis)
        aside = [part - on * axis for part, axis in zip(way, joint.axis, strict=True)]
        still = abs(on) if not joint.slides and joint.name not in helical else 0.0
        if max(dot(aside, aside) ** 0.5, still) > near + NEAR:
            raise Misdrawn(f"the joint of {joint.name} is drawn off its axis")
