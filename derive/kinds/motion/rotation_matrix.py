"""The rotation matrix of a sequence of rotations about world and current axes."""

from __future__ import annotations

from derive.derivation import Derivation
from derive.kinds.fields import Evaluation, OptionsModel
from derive.kinds.motion._product import Facts as Facts
from derive.kinds.motion._product import composed
from derive.kinds.problem import Problem
from derive.mechanics.motion import Motion

CLAIMS = ("orthogonal", "right-handed", "motion-made", "as-told")


class Options(OptionsModel):
    """`evaluate: true` writes a motion of numbers in decimals."""

    evaluate: Evaluation = None


def derive(motion: Motion, options: Options, problem: Problem) -> Derivation:
    """R (3 by 3); translations do not turn anything and are left out (Spong et al., section 2.4)."""
    return composed("rotation-matrix", motion, problem, 3, options.evaluate == ())
