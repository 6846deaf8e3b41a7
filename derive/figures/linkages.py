"""Mechanisms that their joints alone say how to draw: one closed loop in a plane, and a platform on legs."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from math import cos, pi, sin

from derive.derivation import Caption, Drawing, Phrase, Place, Stroke, Words
from derive.errors import NotDerivable
from derive.figures import solids
from derive.figures.view import Vector, View, along, around, between, in_space, onto_plane
from derive.mechanics.mobility import Joints, Mechanism

LOOP, LEGS = range(3, 7), range(2, 9)  # how many joints of a loop, and legs, can be drawn so as to be read
HIGH = 130.0  # points
WIDE, STEEP, START = 2.0, 1.15, 0.85  # of a loop: between its fixed joints, how high it is
BASE, TOP, RISE = 1.0, 0.62, 1.25  # of a platform
JOINT, ASKEW = 0.12, 0.42  # half of a joint; an angle at which no leg stands behind another
UNKNOWN = "its joints do not say how they are arranged"


def drawn(mechanism: Mechanism) -> Drawing:
    """Raises NotDerivable for all others."""
    if mechanism.legs:
        return _platform(mechanism)
    return _loop(mechanism)


# -- a loop in a plane --------------------------------------------------------------------------------


def _loop(mechanism: Mechanism) -> Drawing:
    """From one fixed joint to the other by links; a slider is the last joint, on a fixed line."""
    counts = _counts(mechanism.joints)
    total, sliding = sum(counts.values()), counts.get("prismatic", 0)
    alike = all(joint.joining == 2 for joint in mechanism.joints)
    in_plane = mechanism.space == "planar" and {*counts} <= {"revolute", "prismatic"}
    if not (in_plane and alike and total == mechanism.bodies and total in LOOP and sliding < 2):
        raise NotDerivable(UNKNOWN)
    view = onto_plane((0.0, 0.0, 1.0))
    assert view is not None
    pins = [*_pins(total - sliding, bool(sliding))]
    strokes = [*solids.ground(view, (*pins[0], 0.0), JOINT * 1.3).strokes]
    if not sliding:
        strokes += solids.ground(view, (*pins[-1], 0.0), JOINT * 1.3).strokes
    strokes += [Stroke((a, b), "link") for a, b in pairwise(pins)]
    if sliding:
        strokes += _slider(pins[-1])
    for x, y in pins:
        strokes += solids.cylinder(view, (x, y, 0.0), (0.0, 0.0, 1.0), JOINT * 1.3).strokes
    return _drawing(strokes, [])


def _pins(count: int, sliding: bool) -> Iterator[Place]:
    """The revolute joints of a loop, from left to right over an arch; a crank is short."""
    if sliding and count == 3:
        yield from ((0.0, 0.0), (0.42, 0.62), (WIDE, 0.0))
        return
    for k in range(count):
        turn = pi * (1 - k / (count - 1))
        lean = 0.12 * sin(turn) * (1 if k < count / 2 else 2.2)
        yield WIDE / 2 * (1 + cos(turn)) + lean, STEEP * sin(turn) * (START if k < count / 2 else 1.1)


def _slider(at: Place) -> Iterator[Stroke]:
    """A block on its line, which is fixed."""
    (x, y), w, h = at, 1.9 * JOINT, 1.1 * JOINT
    yield Stroke(((x - 5 * w, y - h), (x + 2.5 * w, y - h)), "thin")
    for k in range(14):
        left = x - 5 * w + (k + 0.6) * 7.5 * w / 14
        yield Stroke(((left, y - h), (left - 0.05, y - h - 0.05)), "thin")
    yield Stroke(((x - w, y - h), (x + w, y - h), (x + w, y + h), (x - w, y + h)), "body")


# -- a platform on legs -------------------------------------------------------------------------------


def _platform(mechanism: Mechanism) -> Drawing:
    """Legs that are alike, each a letter for each of its joints, from the base to the platform."""
    chains = {chain for chain, _ in mechanism.legs}
    count = sum(each for _, each in mechanism.legs)
    if mechanism.space != "spatial" or len(chains) != 1 or count not in LEGS:
        raise NotDerivable(UNKNOWN)
    (chain,) = chains
    if len(chain) != 3 or chain[1] != "P":
        raise NotDerivable(UNKNOWN)
    view = in_space()
    feet = [(BASE * cos(t), BASE * sin(t), 0.0) for t in _turns(count, 0.22)]
    tops = [(TOP * cos(t), TOP * sin(t), RISE) for t in _turns(count, 0.78)]
    strokes = [Stroke(tuple(map(view.place, feet)), "ground")]
    legs = sorted(zip(feet, tops, strict=True), key=lambda leg: view.depth(leg[0]) + view.depth(leg[1]))
    for foot, top in legs:
        strokes += _leg(view, foot, top)
    strokes.append(Stroke(tuple(map(view.place, tops)), "body"))
    for spot in (*feet, *tops):
        strokes.append(Stroke(_ball(view, spot), "cap"))
    return _drawing(strokes, [*_letters(view, legs[-1], chain)])


def _turns(count: int, pair: float) -> list[float]:
    """The angles of joints on a circle; of an even number in pairs, near or far."""
    if count % 2 or count < 4:
        return [ASKEW + 2 * pi * k / count for k in range(count)]
    half = count // 2
    return [ASKEW + 2 * pi * (k + side * pair / 2) / half for k in range(half) for side in (-1, 1)]


def _leg(view: View, foot: Vector, top: Vector) -> Iterator[Stroke]:
    """A slider: a wide part below, a thin one above."""
    middle = along(foot, (0.55, between(foot, top)))
    yield Stroke((view.place(middle), view.place(top)), "rod")
    yield Stroke((view.place(foot), view.place(middle)), "link")


def _letters(view: View, leg: tuple[Vector, Vector], chain: str) -> Iterator[Caption]:
    """Of the joints of the leg in front."""
    foot, top = leg
    spots: tuple[tuple[float, Place], ...] = ((0.0, (0.0, -1.0)), (0.55, (-1.0, 0.0)), (1.0, (-1.0, -0.6)))
    for letter, (share, side) in zip(chain, spots, strict=True):
        at = view.place(along(foot, (share, between(foot, top))))
        yield Caption(at, Words(letter), side, "joint", clear=0.5 * JOINT)


def _ball(view: View, at: Vector) -> tuple[Place, ...]:
    return tuple(around(view.place(at), 0.45 * JOINT, 2 * pi * k / 20) for k in range(20))


# -- both ---------------------------------------------------------------------------------------------


def _counts(joints: Sequence[Joints]) -> dict[str, int]:
    found: dict[str, int] = {}
    for joint in joints:
        found[joint.name] = found.get(joint.name, 0) + joint.count
    return found


def _drawing(strokes: list[Stroke], captions: list[Caption]) -> Drawing:
    return Drawing("figure", tuple(strokes), tuple(captions), Phrase("sketch"), None, HIGH, schematic=True)
