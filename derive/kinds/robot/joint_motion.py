"""Joint variables, rates and accelerations over time that carry the end-effector along a path."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import PlainValidator, WithJsonSchema

from derive.derivation import Derivation
from derive.kinds.fields import Described, Evaluation, OptionsModel, Place, read_point
from derive.kinds.problem import Problem
from derive.kinds.robot._carried.closed import in_closed_form
from derive.kinds.robot._carried.facts import Facts as Facts
from derive.kinds.robot._carried.integrated import by_rates
from derive.kinds.robot._carried.setting import setting_of
from derive.kinds.robot._units import of_joints, together
from derive.mechanics.paths import Path, Via
from derive.mechanics.robot import Robot

CLAIMED = dict.fromkeys(("t", "q", "qdot", "qddot"), "followed")
measures = together(of_joints("q"), of_joints("qdot", power=1), of_joints("qddot", power=2))
Start = Annotated[Place, PlainValidator(read_point), WithJsonSchema({"type": "object"})]


class Options(OptionsModel):
    """The path, and how the joints are found; `evaluate` gives the time t, and values of symbols."""

    path: Annotated[Path, Described(Path)]
    """The path of the end-effector, as the subject of this name, with a timing or as functions of the time t:
    two coordinates, two and the angle of the last link, or three."""
    method: Literal["inverse-kinematics", "inverse-velocity"] = "inverse-kinematics"
    """Whether the joints are found at each point, or their rates are integrated."""
    start: Start = ()
    """Joint variables near those of the solution that is wanted (the first one if left out), or from which
    the rates are integrated."""
    evaluate: Evaluation = None


def claims_of(robot: Robot, options: Options) -> tuple[str, ...]:
    """The keys of what is claimed; of a law of time that too."""
    listed = ("integrated", "as-tabled") if options.method == "inverse-velocity" else ()
    if isinstance(options.path.shape, Via):
        return ("all-conditions", "followed", *listed)
    return ("differences", "followed", *listed, *(("timed",) if options.path.timing else ()))


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """q(t) by a branch of the inverse kinematics, its rates J^-1 v and accelerations J^-1 (a - J_dot qdot)
    (Siciliano et al., sections 3.5, 3.6 and 4.3); or its rates J^+ v integrated in numbers (section 3.5).

    Raises NotDerivable where the path has no timing, leaves the reach of the arm, or passes a singular
    configuration.
    """
    given = setting_of(problem, options.path, options.start, options.evaluate)
    return by_rates(given) if options.method == "inverse-velocity" else in_closed_form(given)
