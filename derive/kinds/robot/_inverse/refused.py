"""Why an arm has no closed form here."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from derive.algebra.infix import text
from derive.errors import NotDerivable
from derive.kinds.problem import Problem
from derive.kinds.robot._inverse.target import Target
from derive.mechanics.chain import Chain
from derive.mechanics.coupling import tangled
from derive.mechanics.inverse.goal import Goal
from derive.mechanics.inverse.paul import Equation
from derive.mechanics.inverse.plan import Plan
from derive.mechanics.inverse.search import MOST_TERMS

STEP = 1e-6  # of differences
LONGEST = 160  # letters of an equation in the message


def refuse_at_once(chain: Chain, goal: Goal) -> None:
    """Raises NotDerivable where no search can succeed: more joints than what is given can determine, or a
    joint of which it says nothing."""
    if any(joint.type not in ("revolute", "prismatic") for _, joint in chain.moving):
        raise NotDerivable("no closed form found: the arm has a helical joint")
    if chain.coupling and (name := tangled(chain.coupling, chain.variables)):
        raise NotDerivable(
            f"no closed form is sought where a joint variable, here {name}, turns one row and slides "
            "another, so that its whole turns count, or turns one by other than a number of times itself; "
            "numerical-inverse-kinematics finds a solution"
        )
    joints = len(chain.variables)
    if joints > goal.size:
        raise NotDerivable(
            f"no closed form found: the arm has {joints} joint variables, and what is given "
            f"({_listed(goal)}) can determine only {goal.size}, so there are infinitely many solutions; "
            f"give more of the pose, or say which {_left(joints - goal.size)} chosen: "
            f"free: [{', '.join(chain.variables[goal.size :])}]",
            "given",
        )


def refuse_self_motion(target: Target, points: Sequence[Mapping[str, float]]) -> None:
    """Raises NotDerivable where the arm can move everywhere without changing what is given."""
    if rank_at(target, points) < len(target.joints):
        raise NotDerivable(
            f"no closed form found: the arm can move its {len(target.joints)} joints without changing what "
            f"is given ({_listed(target.goal)}), so there are infinitely many solutions; give more of the "
            "pose, or say which joints are chosen: free: [theta1]",
            "given",
        )


def rank_at(target: Target, points: Sequence[Mapping[str, float]]) -> int:
    """How many coordinates of what is given the joints move independently."""
    import numpy as np

    ranks = []
    for point in points[:2]:
        ahead, behind = (
            np.array([target.there({**point, name: point[name] + step}) for name in target.joints])
            for step in (STEP, -STEP)
        )
        ranks.append(int(np.linalg.matrix_rank((ahead - behind) / (2 * STEP), tol=1e-5)))
    return max(ranks)


def no_closed_form(plan: Plan, goal: Goal, problem: Problem) -> str:
    """What was not found, why, and the equations it is left in."""
    unknown = ", ".join(sorted(plan.knowledge.unknown_joints()))
    equations = "; ".join(dict.fromkeys(_written(equation, problem) for equation in plan.left))
    if plan.stopped:
        return (
            f"{unknown}: the search was given up after {MOST_TERMS} terms of equations, so that a closed "
            "form may exist; give numbers to some of the symbols, or fix a joint. The equations left are "
            f"{equations}"
        )
    if not plan.left:
        return f"no closed form found: what is given ({_listed(goal)}) does not change with {unknown}"
    return (
        f"no closed form found for {unknown}: no equation holds one of them alone, and no sum of squares "
        f"does. The reduced equations are {equations}"
    )


def _written(equation: Equation, problem: Problem) -> str:
    written = " = ".join(text(problem.readable(side)) for side in (equation.left, equation.right))
    return written if len(written) <= LONGEST else f"{written[:LONGEST]} ..."


def _left(count: int) -> str:
    return "joint is" if count == 1 else f"{count} joints are"


def _listed(goal: Goal) -> str:
    return {12: "the pose", 9: "the orientation"}.get(len(goal.names), ", ".join(goal.names))
