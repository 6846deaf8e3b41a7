"""What the joints of an arm exert: torques where all of them turn, forces where all slide."""

from __future__ import annotations

from derive.derivation import Phrase
from derive.mechanics.robot import Robot


def effort(robot: Robot) -> Phrase:
    """That of one joint."""
    sorts = _sorts(robot)
    return Phrase("torque" if sorts == {"revolute"} else "force" if sorts == {"prismatic"} else "effort")


def efforts(robot: Robot) -> Phrase:
    """Those of all joints."""
    sorts = _sorts(robot)
    return Phrase("torques" if sorts == {"revolute"} else "forces" if sorts == {"prismatic"} else "efforts")


def _sorts(robot: Robot) -> set[str]:
    return {link.joint for link in robot.links if link.variable}
