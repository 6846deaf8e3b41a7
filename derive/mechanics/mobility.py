"""A mechanism as Grübler counts it: bodies, joints, and the constraints that each joint imposes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

Space: TypeAlias = Literal["planar", "spatial", "spherical"]

FREEDOMS = {
    "revolute": 1, "prismatic": 1, "helical": 1, "cylindrical": 2, "universal": 2, "spherical": 3,
    "planar": 3,
}  # fmt: skip
LETTERS = {
    "R": "revolute", "P": "prismatic", "H": "helical", "C": "cylindrical", "U": "universal", "S": "spherical",
    "E": "planar",
}  # fmt: skip
LAMBDA: dict[Space, int] = {"planar": 3, "spatial": 6, "spherical": 3}
POSSIBLE: dict[Space, tuple[str, ...]] = {
    "planar": ("revolute", "prismatic"),
    "spatial": tuple(FREEDOMS),
    "spherical": ("revolute", "universal"),
}


@dataclass(frozen=True, slots=True)
class Joints:
    """`count` joints alike, each imposing `constraints`; each joins `joining` bodies at one place."""

    name: str  # "" where only the constraints are known
    count: int
    constraints: int
    joining: int = 2

    @property
    def pairs(self) -> int:
        """Kinematic pairs: one where k bodies meet is k - 1."""
        return self.count * (self.joining - 1)

    @property
    def total(self) -> int:
        """The constraints of them all."""
        return self.pairs * self.constraints


@dataclass(frozen=True, slots=True)
class Mechanism:
    """`bodies` counts the frame too; `rods` are bodies held by two spherical joints (or by two and a slider
    on their line), which may spin about that line while nothing else moves."""

    space: Space
    bodies: int
    joints: tuple[Joints, ...]
    rods: int = 0
    legs: tuple[tuple[str, int], ...] = ()  # (chain, count) of a parallel robot

    @property
    def pairs(self) -> int:
        """The kinematic pairs of all joints."""
        return sum(each.pairs for each in self.joints)

    @property
    def loops(self) -> int:
        """Independent closed loops, of bodies that all hang together."""
        return self.pairs - self.bodies + 1

    @property
    def dof(self) -> int:
        """lambda (n - 1) - sum of c_i (Grübler, Kutzbach)."""
        return LAMBDA[self.space] * (self.bodies - 1) - sum(each.total for each in self.joints)

    def counted_as(self, space: Space) -> int | None:
        """The degrees of freedom if its joints lie as in that space; None where they cannot."""
        if any(each.name not in POSSIBLE[space] for each in self.joints):
            return None
        freedoms = sum(FREEDOMS[each.name] * each.pairs for each in self.joints)
        return freedoms - LAMBDA[space] * self.loops


def leg_joints(chain: str, count: int, space: Space) -> tuple[Joints, ...]:
    """The joints of `count` legs such as UPS in space or RRR in the plane."""
    return tuple(Joints(LETTERS[c], count, LAMBDA[space] - FREEDOMS[LETTERS[c]]) for c in chain)


def idle_legs(chain: str) -> int:
    """How often the chain holds two spherical joints with nothing but a slider between them."""
    return sum(chain[k : k + 2] == "SS" or chain[k : k + 3] == "SPS" for k in range(len(chain)))
