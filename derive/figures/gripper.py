"""The gripper of an arm: jaws that open along y of the last frame (Spong's s, the sliding direction), and in
a plane along an axis that lies in it."""

from __future__ import annotations

from collections.abc import Sequence

from derive.derivation import Caption, Stroke
from derive.figures.arm import SMALL, Joint, Posed, length_between, place_of
from derive.figures.arm_angles import BEYOND, within_joint
from derive.figures.solids import pointing
from derive.figures.view import Vector, View, along, between, cross, dot, length, unit

STEM = 0.5  # sizes of a joint: what holds a gripper that stands on one
JAW, THICK = (
    0.6,
    0.17,
)  # sizes of a joint: half of how far jaws are open, and how long they are; half of how thick
SEEN = 0.25  # of a direction: one that is seen shorter points at the reader
ROUND = 0.24  # sizes of a joint: the sign of an axis that does
PARALLEL = 0.95

Marked = tuple[list[Stroke], list[Caption]]


def gripper(view: View, posed: Posed, joints: Sequence[Joint], size: float, index: str) -> Marked:
    """At the end of an arm, pointing on along its last link, or along the axis of its last joint where that
    stands there. Jaws that are seen edge on are one line, and the axis along which they open is marked."""
    at, way = _end(view, posed, joints, size)
    if length(view.place(way)) < SEEN:
        return [], []
    T = posed.end
    axes = {letter: (float(T[0, k]), float(T[1, k]), float(T[2, k])) for k, letter in enumerate("xyz")}
    across = [letter for letter in "yxz" if abs(dot(axes[letter], way)) < PARALLEL]
    seen = (letter for letter in across if abs(dot(axes[letter], view.front)) < PARALLEL and view.flat)
    letter = next(seen, across[0])
    opening = axes[letter]
    jaw = unit(along(opening, (-dot(opening, way), way)))
    if length(view.place(jaw)) < SEEN:
        aside = cross(view.front, way)
        ends = [along(at, (end * size, way)) for end in (0.0, 1.2 * JAW)]
        low, high = ([along(end, (side * THICK * size, aside)) for end in ends] for side in (-1, 1))
        finger = (*low, *reversed(high), low[0])
        mark = [*pointing(view, place_of(T), opening, ROUND * size)]
        name = Caption(view.place(place_of(T)), f"{letter}{index}", (-1.0, -1.0), letter, clear=ROUND * size)
        return [Stroke(tuple(map(view.place, finger)), "gripper"), *mark], [name]
    left, right = (along(at, (side * JAW * size, jaw)) for side in (1, -1))
    fingers = (along(left, (JAW * size, way)), left, right, along(right, (JAW * size, way)))
    stem = [at, along(at, (-STEM * size, way))] if at != posed.parts[-1].end else []
    return [Stroke(tuple(map(view.place, line)), "gripper") for line in (fingers, stem) if line], []


def _end(view: View, posed: Posed, joints: Sequence[Joint], size: float) -> tuple[Vector, Vector]:
    """Where the jaws are fixed, and which way they point."""
    last, end = posed.parts[-1], place_of(posed.end)
    joint = joints[-1] if joints else None
    if joint and last.along_joint and not view.flat and within_joint(joint, size):
        way = unit(between(last.start, last.end))
        return along(joint.at, (joint.offset, joint.axis), ((BEYOND + STEM) * size, way)), way
    at_end = posed.joints and length_between(posed.joints[-1].at, end) < SMALL
    if joint is None or joint.slides or view.flat or not at_end:
        return last.end, unit(between(last.start, last.end))
    out = between(posed.joints[-1].at, joint.at)
    side = -1 if dot(out, joint.axis) < 0 else 1
    axis = (side * joint.axis[0], side * joint.axis[1], side * joint.axis[2])
    return along(joint.at, ((0.7 + STEM) * size, axis)), axis
