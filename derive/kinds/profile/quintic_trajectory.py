"""The quintic polynomial in time from one value to another."""

from __future__ import annotations

from derive.derivation import Derivation
from derive.kinds.fields import Evaluation, OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.profile._polynomial import Facts as Facts
from derive.kinds.profile._polynomial import polynomial
from derive.mechanics.profile import Profile

NEEDS = ("journey", "time")
USES = frozenset({"start_velocity", "end_velocity", "start_acceleration", "end_acceleration"})
CLAIMS = ("both-ends",)


class Options(OptionsModel):
    """Where symbols stand for the ends, `evaluate` draws the trajectory at a point; with t also q there."""

    evaluate: Evaluation = None


def derive(profile: Profile, options: Options, problem: Problem) -> Derivation:
    """Place, velocity and acceleration at both ends (Craig, section 7.3; Spong et al., section 5.5.2)."""
    return polynomial(profile, "quintic-trajectory", 3, options.evaluate, problem)
