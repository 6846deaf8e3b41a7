"""The homogeneous transform of a sequence of rotations and translations."""

from __future__ import annotations

from derive.derivation import Derivation
from derive.kinds.fields import Evaluation, OptionsModel
from derive.kinds.motion._product import Facts as Facts
from derive.kinds.motion._product import composed
from derive.kinds.problem import Problem
from derive.mechanics.motion import Motion

CLAIMS = ("orthogonal", "right-handed", "inverse-of", "motion-made", "as-told")


class Options(OptionsModel):
    """`evaluate: true` writes a motion of numbers in decimals."""

    evaluate: Evaluation = None


def derive(motion: Motion, options: Options, problem: Problem) -> Derivation:
    """T (4 by 4) (Spong et al., section 2.6)."""
    return composed("transform", motion, problem, 4, options.evaluate == ())
