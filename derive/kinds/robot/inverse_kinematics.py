"""The joint variables that bring the end-effector to a given place, in closed form."""

from __future__ import annotations

from derive.derivation import Derivation
from derive.kinds.fields import Evaluation, OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import chain_of
from derive.kinds.robot._inverse import held, open_chain
from derive.kinds.robot._inverse import two_link as triangle
from derive.kinds.robot._inverse.facts import Facts as Facts
from derive.kinds.robot._inverse.given import Given, goal_of
from derive.kinds.robot._inverse.held import Free
from derive.kinds.robot._inverse.sampled import sample_points
from derive.kinds.robot._units import of_variables
from derive.mechanics.inverse.two_link import two_link
from derive.mechanics.robot import Robot

CLAIMED = {"solutions": "as-printed", "quartic": "quartic"}
CLAIMS = (
    "pose-found|every-solution", "when-holds|polynomial", "lines|cut-there", "as-printed",
    "read-there|elbow-seen|no-formula",
)  # fmt: skip
measures = of_variables


class Options(OptionsModel):
    """What is known of the end-effector."""

    given: Given = ("x", "y")
    """What is known of the end-effector: its pose (r11 ... r33, x, y, z), its orientation, two or three
    coordinates of its position, or two and its angle in the plane."""
    free: Free = ()
    """Of a redundant arm what is chosen; the others are found from it and what is given."""
    evaluate: Evaluation = None


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """By named sub-problems, each chosen by the form of the equations (Paul; Craig, chapter 4; Siciliano et
    al., section 2.12); the two links of a planar arm by their triangle."""
    chain, given = chain_of(problem), options.given
    if psi := open_chain.swung_by(chain, given, options.free, problem):
        return open_chain.derive(chain, given, options.evaluate, problem, psi)
    if options.free:
        return held.derive(problem, options.free, given, options.evaluate)
    arm = two_link(chain)
    if (
        arm is not None
        and isinstance(given, tuple)
        and len(given) == 2
        and triangle.has_triangle(arm, problem)
    ):
        return triangle.derive(arm, chain, given, options.evaluate, problem)
    return open_chain.derive(chain, given, options.evaluate, problem)


def claims_of(robot: Robot, options: Options) -> tuple[str, ...]:
    """One more of the branches at a place."""
    return CLAIMS if options.evaluate is None else (*CLAIMS, "placed")


def reached(options: Options, problem: Problem, count: int) -> tuple[dict[str, float], ...]:
    """Points at which what is given is the place of the end-effector: joint variables, lengths, and that."""
    chain = chain_of(problem)
    return sample_points(chain, goal_of(options.given, chain, problem), problem, count)
