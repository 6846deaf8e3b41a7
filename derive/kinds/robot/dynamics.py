"""The equations of motion of an arm after Euler and Lagrange."""

from __future__ import annotations

from typing import Literal

from derive.derivation import Derivation
from derive.expression import ZERO, column
from derive.kinds.fields import OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.robot._by_index import by_index
from derive.kinds.robot._chain import BODIES_ALONE
from derive.kinds.robot._dynamics.arm import Arm
from derive.kinds.robot._dynamics.christoffel_lines import left_out, left_out_rightly, listed
from derive.kinds.robot._dynamics.drives import Facts as Facts
from derive.kinds.robot._dynamics.drives import effort_told, friction_sorts, friction_told
from derive.kinds.robot._dynamics.index_laws import motion_law
from derive.kinds.robot._dynamics.terms import equation, equations, written_out
from derive.kinds.robot._units import of_joints, together
from derive.kinds.robot.inertia_matrix import Facts as InertiaFacts
from derive.kinds.work import Work
from derive.mechanics.robot import Robot

NEEDS = ("bodies",)
CLAIMS = ("motion-of-each-body", "names")
CLAIMED = {"tau": "motion-of-each-body"}  # of a long arm no line has it
measures = together(of_joints("tau", "g", "v", effort=True), P="J")


class Options(OptionsModel):
    """Whose letters are used."""

    notation: Literal["spong", "khatib"] = "spong"
    """spong: D, c_ijk and g by Euler and Lagrange; khatib: M, v and G."""


FRICTIONS = {  # whether there is viscous and Coulomb friction, and what is said of it
    (False, False): "", (True, False): "viscous", (False, True): "coulomb", (True, True): "both-frictions",
}  # fmt: skip


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """tau_k = sum d_kj qddot_j + sum c_ijk qdot_i qdot_j + g_k (Spong et al., eq. 6.39)."""
    if options.notation == "khatib":
        from derive.kinds.robot._dynamics.khatib_dynamics import khatib_dynamics  # seldom asked for

        return khatib_dynamics(problem)
    arm, speed, weight = Arm(problem), problem.ask("christoffel"), problem.ask("gravity")
    big = arm.inertia.told(InertiaFacts).big
    work = Work(problem).resting_on(arm.inertia, speed, weight)
    viscous, coulomb = friction_sorts(robot)
    work, found = work.showing(motion_law(problem.taken, viscous, coulomb)), equations(problem)
    if not big:
        lines = (
            equation(f"tau_{k}", terms, "euler-lagrange", problem.style) for k, terms in enumerate(found, 1)
        )
        work = work.showing(*lines)
    tau = column(written_out(terms, problem.style) for terms in found)
    work = arm.moved(work, tau)
    results = {"D": arm.inertia.results["D"], **speed.results, **weight.results, "tau": tau}
    work = by_index(work, results)
    rubbing, effort = friction_told(viscous, coulomb), effort_told(robot)
    facts = Facts(
        big=big,
        notation="spong",
        rubbing=rubbing,
        effort=effort,
        numbers=listed(results, arm.christoffel),
        remark=left_out(results, arm.christoffel),
    )
    work = work.law("listed", left_out_rightly(facts, arm.exact_christoffel))
    rubs = [friction for link in robot.links if (friction := link.friction) is not None]
    sorts = (
        any(each.viscous != ZERO for each in rubs),
        any(each.coulomb != ZERO for each in rubs),
    )
    work = work.law("friction-said", (facts.rubbing.key if facts.rubbing else "") == FRICTIONS[sorts])
    return work.answer("dynamics", results, facts, matrices=frozenset({"D"}), unread=BODIES_ALONE)
