"""The accelerations of an arm that its joint forces bring about."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from derive.algebra.bounds import no_charge
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal, normal_matrix
from derive.algebra.numbers.floats import Point, numbers
from derive.algebra.readable.form import readable, readable_matrix
from derive.derivation import Derivation, PageFacts, Phrase, Step
from derive.errors import NotDerivable, TooManyTerms
from derive.expression import (
    Call,
    Expr,
    Matrix,
    Symbol,
    add,
    children,
    column,
    is_negative,
    multiply,
    replace,
    terms_of,
)  # fmt: skip
from derive.kinds.fields import Evaluation, OptionsModel
from derive.kinds.linear_systems import solution_at
from derive.kinds.problem import Problem
from derive.kinds.robot._by_index import EVERY, Meaning, by_index
from derive.kinds.robot._dynamics.arm import Arm
from derive.kinds.robot._dynamics.at_a_point import AtAPoint, at_a_point, rounded
from derive.kinds.robot._dynamics.matrix_laws import acceleration_law
from derive.kinds.robot._dynamics.solving import (
    EQUATIONS,
    RISES,
    D,
    accelerations_at,
    equations_of_motion,
    held,
)
from derive.kinds.robot._dynamics.terms import Term, equation, equations
from derive.kinds.robot._efforts import efforts
from derive.kinds.robot._units import of_joints, together
from derive.kinds.work import Work
from derive.mechanics.robot import Robot
from derive.names import entry_symbol

CLAIMED = {"D_inv": "adjugate", "h": "equations-hold|at-a-point", "qddot": "solved|at-a-point"}
INTRODUCED = r"h_\d+"  # entries of h

NEEDS = ("bodies",)
measures = together(of_joints("qddot", power=2), of_joints("h", effort=True))


MOST_JOINTS = 3
MOST_REDUCED = 2  # joints; with more, fractions are not multiplied out
DET = Call("det", (D,))


MEANINGS: Mapping[str, Meaning] = {
    **EVERY,
    "det": lambda arm, _: arm.det,
    "D_inv": lambda arm, _: arm.D_inv,
}


class Options(OptionsModel):
    """Of an arm whose equations are too long in letters, `evaluate` gives them in numbers."""

    evaluate: Evaluation = None


def claims_of(robot: Robot, options: Options) -> tuple[str, ...]:
    """Those of formulas, or of equations; of either in numbers, where they are too long."""
    if len(robot.variables) > MOST_JOINTS:
        return ("equations-hold|at-a-point", "solved|at-a-point", "names|at-a-point")
    return ("adjugate|at-a-point", "joint-forces|at-a-point", "names|at-a-point")


class Facts(PageFacts):
    one: bool  # joint
    in_full: Phrase | None
    rubbing: Phrase | None = None  # in the equations of many joints
    efforts: Phrase | None = None  # of its joints, there
    at_a_point: bool = False  # in numbers alone


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """qddot = D^-1 (tau - h), by the adjugate and the determinant (Craig, eq. 6.115).

    Of more than three joints the linear equations D qddot = tau - h; at a point in numbers where they are too
    long. Raises NotDerivable where D has no inverse.
    """
    try:
        return _in_letters(robot, problem)
    except TooManyTerms as error:
        with no_charge():  # what was spent on letters is gone
            return _in_numbers(at_a_point(problem, options.evaluate, error, forces=True))


def _in_letters(robot: Robot, problem: Problem) -> Derivation:
    arm, n = Arm(problem), len(robot.variables)
    if n > MOST_JOINTS:
        return _as_equations(problem, arm)
    motion, indices = problem.ask("dynamics"), range(1, n + 1)
    inertia = motion.matrix("D")
    names = Matrix(tuple(tuple(entry_symbol("d", *sorted((i, j))) for j in indices) for i in indices))
    work = Work(problem).resting_on(motion).knowing({D: inertia})
    work = work.knowing(dict(zip(children(names), children(inertia), strict=True)))
    value = work.value_matrix(D)
    if not value.det():
        raise NotDerivable("D is singular: some joint moves without moving a mass, give the links inertia")
    by_names = normal_matrix(names)
    det, adjugate = readable(by_names.det()), readable_matrix(by_names.adjugate())
    rest = [
        equation(f"h_{k}", _rest(terms), "rest", problem.style)
        for k, terms in enumerate(equations(problem), 1)
    ]
    work, long = work.step(*rest), n > MOST_REDUCED or arm.long

    def written(expr: Expr) -> Expr:
        """In full as a person would write it; of a long arm with values where the names stand."""
        return replace(expr, work.definitions) if long else work.readable(work.value(expr))

    forces = [Symbol(f"tau_{k}") - Symbol(f"h_{k}") for k in indices]
    tops = [add(*map(multiply, row, forces)) for row in adjugate.rows]
    over = Matrix(tuple(tuple(entry / det for entry in row) for row in adjugate.rows))
    results = {
        "det": written(det),
        "D_inv": written(over),
        "h": column(step.result for step in rest),
        "qddot": column(written(top / det) for top in tops),
    }
    work = work.line(DET, det, value=results["det"], label="det", rule="determinant")
    work = work.step(acceleration_law()) if n > 1 else work
    work = work.linked() if long else work  # of long fractions the law says as much
    for name, top, result in zip(arm.accelerations, tops, children(results["qddot"]), strict=True):
        positive_first = add(*sorted(terms_of(top), key=is_negative))
        chain = (name, positive_first / DET, result)
        work = work.showing(Step(name.name, chain, "acceleration", spare=(result,)))
    one = ScalarMatrix.identity(n)
    inverse = value @ work.value_matrix(adjugate) == one.scaled(value.det())
    if not long:
        inverse &= value @ normal_matrix(results["D_inv"]) == one and normal(results["det"]) == value.det()
    work = work.law("adjugate", inverse)
    work = work.agrees(
        "joint-forces",
        arm.moving | {f"tau_{k}" for k in indices},
        lambda at: arm.rubbing.torques({**at, **_moved(arm, results["qddot"], at)}),
        lambda at: [at[f"tau_{k}"] for k in indices],
    )
    work = by_index(work, results, MEANINGS)
    return work.answer(
        "forward-dynamics",
        results,
        Facts(one=n == 1, in_full=Phrase("long") if long else None, page_names={"det": DET, "D_inv": D**-1}),
        matrices=frozenset({"D_inv"}),
    )


def _as_equations(problem: Problem, arm: Arm) -> Derivation:
    """D qddot = tau - h with the entries of D and h by name. Raises NotDerivable where D has no inverse."""
    solved = equations_of_motion(problem, arm)
    work = solved.work.agrees(
        "solved",
        arm.moving | {f"tau_{k}" for k, _ in enumerate(arm.variables, 1)},
        lambda at: solution_at(solved.system, at),
        lambda at: accelerations_at(arm, at),
    )
    results = {"D": arm.inertia.results["D"], "h": solved.rest, "qddot": solved.system}
    work = by_index(work, results)
    facts = Facts(
        one=False,
        in_full=None,
        rubbing=solved.rubbing,
        efforts=efforts(problem.subject),
        by_joint=("D", "h", "qddot"),
    )
    return work.answer("forward-dynamics", results, facts, matrices=frozenset({"D"}))


def _in_numbers(there: AtAPoint) -> Derivation:
    """D, h and what they come to where every name has a value."""
    told = {"D": there.motion.D, "h": there.motion.h, "qddot": there.accelerations}
    results = {name: rounded(value) for name, value in told.items()}
    steps = [Step(name, (Symbol(name), results[name]), "at-a-point") for name in ("D", "h")]
    end = Step("q_ddot", (RISES, results["qddot"]), "at-a-point")
    work = Work(there.problem, known=there.named).showing(*steps, EQUATIONS, end)
    work = work.claim(there.claim(**results), held(Arm(there.problem), EQUATIONS.chain))
    facts = Facts(
        one=False, in_full=None, at_a_point=True, efforts=efforts(there.problem.subject), numbers=()
    )
    evaluated = {name: value.tolist() for name, value in told.items()}
    return work.answer("forward-dynamics", results, facts, matrices=frozenset({"D"}), evaluated=evaluated)


def _rest(terms: Iterable[Term]) -> Iterable[Term]:
    """h_k, what is left of tau_k without accelerations."""
    return (term for term in terms if term.sort != "acceleration")


def _moved(arm: Arm, qddot: Expr, at: Point) -> dict[str, float]:
    """The accelerations in numbers."""
    found = zip(arm.accelerations, numbers(qddot, at), strict=True)
    return {name.name: value for name, value in found}
