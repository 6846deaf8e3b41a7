"""What holds an arm at rest beside its motors: the dry friction of its joints."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from derive.algebra.formulas.with_units import measured
from derive.algebra.numbers.floats import Point
from derive.algebra.numbers.floats import number as value_of
from derive.derivation import Phrase
from derive.expression import ZERO, Symbol
from derive.kinds.fields import TREES
from derive.kinds.robot._dynamics.drives import moving
from derive.mechanics.oracle import Oracle
from derive.mechanics.robot import Link, Robot

CREEPING = 1e-6  # a rate at which a joint rubs, and next to nothing else happens
NEARLY = 1e-4  # of what it then takes


def held_by_friction(robot: Robot) -> tuple[Phrase, ...]:
    """Of each joint that rubs dry: how far its force may be from that of gravity."""
    return tuple(
        Phrase(
            "dry-friction",
            {
                "k": k,
                "limit": measured(link.friction.coulomb),
                "effort": _effort(link),
                "tau": Symbol(f"tau_{k}"),
                "g": Symbol(f"g_{k}"),
            },
        )
        for k, link in enumerate(moving(robot), 1)
        if link.friction is not None and link.friction.coulomb != ZERO
    )


def _effort(link: Link) -> Phrase:
    """What moves a joint."""
    return Phrase("torque" if link.joint == "revolute" else "force")


@dataclass(frozen=True, slots=True)
class Rubbing:
    """What is told of the joints, against an arm in numbers that begins to move."""

    arm: Oracle
    told: Sequence[Phrase]

    def as_told(self, at: Point) -> list[tuple[float, ...]]:
        """Of each joint how much more and less than gravity it takes to move, and of which joints the force
        and the share of gravity are."""
        by_joint = {said.about["k"]: said.about for said in self.told}
        rows = []
        for k, link in enumerate(moving(self.arm.robot), 1):
            about = by_joint.get(k, {})
            limit = about.get("limit", ZERO)
            size = value_of(limit, self.arm.at(at)) if isinstance(limit, TREES) else 0.0
            named = (about.get(name) in (None, Symbol(f"{name}_{k}")) for name in ("tau", "g"))
            rows.append((size, -size, *named, about.get("effort") in (None, _effort(link))))
        return [*rows, (len(by_joint),)]

    def as_it_moves(self, at: Point) -> list[tuple[float, ...]]:
        """The same where each joint alone moves slowly forward, and back."""
        names, rest = self.arm.robot.variables, self.arm.torques_at_rest(at)
        still = {f"{name}_{dots}": 0.0 for name in names for dots in ("dot", "ddot")}
        rows: list[tuple[float, ...]] = []
        for k, name in enumerate(names):
            onward, back = (
                float((self.arm.torques({**at, **still, f"{name}_dot": rate}) - rest)[k])
                for rate in (CREEPING, -CREEPING)
            )
            rows.append((onward, back, True, True, True))
        return [*rows, (len(self.told),)]
