"""The names of the joint variables of an arm, and what the joints that follow others are moved by."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction

from derive.errors import SheetError
from derive.sheet.exchange.urdf import TURNING, Joint
from derive.sheet.exchange.values import written, written_angle


class Variables:
    """theta1, d2, ...: of each joint that moves, by its place among them."""

    def __init__(self, joints: Sequence[Joint]) -> None:
        self.joints = {joint.name: joint for joint in joints}
        self.names = {
            joint.name: f"{'theta' if joint.type in TURNING else 'd'}{k}" for k, joint in enumerate(joints, 1)
        }

    def follows(self, joint: Joint) -> bool:
        """Whether a joint has no variable of its own."""
        return joint.mimic is not None and joint.mimic.joint in self.joints

    def by(self, joint: Joint) -> str:
        """What a joint is moved by. Raises SheetErrors where joints follow each other in a circle."""
        if not self.follows(joint):
            return f"{self.names[joint.name]}*"
        leader, ratio, offset = self._leader(joint)
        name = self.names[leader.name]
        scaled = {"1": name, "-1": f"-{name}", "0": ""}.get(written(ratio), f"{written(ratio)}*{name}")
        shift = written_angle(offset) if joint.type in TURNING else written(offset, "m")
        if not scaled or shift == "0":
            return scaled or shift
        return f"{scaled} + {shift}".replace("+ -", "- ")

    def _leader(self, joint: Joint) -> tuple[Joint, Fraction, Fraction]:
        """The joint that another follows, over others: ratio * leader + offset."""
        ratio, offset, seen = Fraction(1), Fraction(0), {joint.name}
        while joint.mimic is not None and self.follows(joint):
            offset += ratio * joint.mimic.offset
            ratio *= joint.mimic.multiplier
            mimic, joint = joint.mimic, self.joints[joint.mimic.joint]
            if joint.name in seen:
                raise mimic.element.error(f"joint '{joint.name}' follows itself")
            seen.add(joint.name)
        return joint, ratio, offset

    def strange(self) -> Iterator[SheetError]:
        """Joints that follow one outside of the arm."""
        for joint in self.joints.values():
            if joint.mimic and not self.follows(joint):
                message = f"joint '{joint.name}' follows '{joint.mimic.joint}', which is no joint of this arm"
                yield joint.mimic.element.fault(message, "it moves by itself here")
