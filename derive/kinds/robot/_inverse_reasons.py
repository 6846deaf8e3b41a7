"""Why an arm has no closed form here."""

from __future__ import annotations

from derive.algebra.text import text
from derive.errors import NotDerivable
from derive.kinds.problem import Problem
from derive.mechanics.chain import Chain
from derive.mechanics.inverse.equation import Equation
from derive.mechanics.inverse.goal import Goal
from derive.mechanics.inverse.plan import Plan

LONGEST = 160  # letters of an equation in the message


def refuse(chain: Chain, goal: Goal) -> None:
    """Raises NotDerivable where no search can succeed: more joints than what is given can determine, or a
    joint of which it says nothing."""
    if any(joint.type not in ("revolute", "prismatic") for _, joint in chain.moving):
        raise NotDerivable("no closed form found: the arm has a helical joint")
    joints = len(chain.variables)
    if joints > goal.size:
        raise NotDerivable(
            f"no closed form found: the arm has {joints} joint variables and only {goal.size} of them can be "
            f"determined by what is given ({_listed(goal)}), so there are infinitely many solutions; give more "
            "of the pose, or fix a joint"
        )


def no_closed_form(plan: Plan, problem: Problem) -> str:
    """What was found, what is left, and the equations it is left in."""
    unknown = sorted(plan.knowledge.unknown_joints())
    reason = (
        "the search was stopped after its time was up"
        if plan.late
        else "no equation holds only one of them, and no sum of squares does"
    )
    equations = "; ".join(dict.fromkeys(_written(equation, problem) for equation in plan.left))
    return f"no closed form found for {', '.join(unknown)}: {reason}. The reduced equations are {equations}"


def _written(equation: Equation, problem: Problem) -> str:
    written = " = ".join(text(problem.readable(side)) for side in (equation.left, equation.right))
    return written if len(written) <= LONGEST else f"{written[:LONGEST]} ..."


def _listed(goal: Goal) -> str:
    return {12: "the pose", 9: "the orientation"}.get(len(goal.names), ", ".join(goal.names))
