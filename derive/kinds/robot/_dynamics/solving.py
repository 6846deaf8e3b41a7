"""The accelerations of an arm of many joints: the linear equations that they solve, in names of entries."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from derive.algebra.numbers.floats import Point
from derive.derivation import Claim, LinearSystem, Phrase, Step
from derive.errors import NotDerivable
from derive.expression import ONE, ZERO, Expr, Matrix, Product, Symbol, children, column, symbols
from derive.kinds.checks import random_points
from derive.kinds.meanings import column_of, told
from derive.kinds.problem import Problem
from derive.kinds.robot._dynamics.arm import Arm
from derive.kinds.robot._dynamics.drives import friction_sorts, friction_told
from derive.kinds.robot._dynamics.index_laws import rest_law
from derive.kinds.robot._dynamics.terms import equations, written_out
from derive.kinds.work import Work
from derive.mechanics.oracle.heavy import Heavy
from derive.names import entry_symbol, free

NONE = 1e-9  # what the least eigenvalue of D is of the largest, at most, where some joint moves no mass
TRIES = 3
MOST_TERMS = 15_000  # of the Christoffel symbols; of more the equations take longer than anyone waits
D, H, TAU, RISES = symbols("D h tau q_ddot")
EQUATIONS = Step("equations", (Product((D, RISES)), TAU - H), "unsolved")


@dataclass(frozen=True)
class Unsolved:
    """The equations, h (n by 1) written out, and the board with both as they are told."""

    system: LinearSystem
    rest: Matrix
    work: Work
    rubbing: Phrase | None


def equations_of_motion(problem: Problem, arm: Arm) -> Unsolved:
    """D qddot = tau - h. Raises NotDerivable where D has no inverse."""
    if not any(_is_regular(arm.rigid.inertia_matrix(at)) for at in random_points(arm.still, TRIES)):
        raise NotDerivable("D is singular: some joint moves without moving a mass, give the links inertia")
    arm.refuse_vast(MOST_TERMS)
    motion, sorts = problem.ask("dynamics"), friction_sorts(problem.subject)
    terms = [[each for each in row if each.sort != "acceleration"] for row in equations(problem)]
    rest = column(written_out(row, problem.style) for row in terms)
    work = Work(problem).resting_on(motion).step(rest_law(problem.taken, *sorts))
    work = work.step(EQUATIONS).claim(held(arm, EQUATIONS.chain, (H, rest)))
    return Unsolved(_system(arm, motion.matrix("D"), rest), rest, work, friction_told(*sorts))


def held(arm: Arm, *lines: tuple[Expr, ...]) -> Claim:
    """That lines in D, h, tau and the accelerations hold."""
    return told(
        lines,
        lambda at: _meanings(arm, at),
        arm.moving,
        arm.problem.where,
        key="equations-hold",
        moving=arm.problem.moving,
    )


def _is_regular(inertia: Any) -> bool:
    import numpy as np

    sizes = np.linalg.svd(inertia, compute_uv=False)
    return bool(sizes[-1] > NONE * sizes[0])


def _meanings(arm: Arm, at: Point) -> Mapping[Expr, Any]:
    """D, the joint forces of a motion and what of them is left without accelerations, by Newton and Euler."""
    heavy = Heavy(arm.rubbing, at)
    rises = [at[name.name] for name in arm.accelerations]
    return {
        D: heavy.D,
        RISES: column_of(rises),
        TAU: column_of(heavy.tau),
        H: column_of(heavy.tau_without_acceleration),
    }


def accelerations_at(arm: Arm, at: Point) -> list[float]:
    """Those that tau_1, tau_2, ... bring about there, by Newton and Euler (n)."""
    import numpy as np

    forces = [at[f"tau_{k}"] for k, _ in enumerate(arm.variables, 1)]
    return [*Heavy(arm.rubbing, at).accelerations(np.array(forces))]


def _system(arm: Arm, inertia: Matrix, rest: Matrix) -> LinearSystem:
    """By the names of the entries that do not vanish."""
    n = len(arm.variables)
    names: dict[str, Expr] = {}
    rows = []
    for i, row in enumerate(inertia.rows, 1):
        places = (entry_symbol("d", *sorted((i, j))) for j in range(1, n + 1))
        kept = [(name if entry != ZERO else ZERO, entry) for name, entry in zip(places, row, strict=True)]
        names |= {name.name: entry for name, entry in kept if isinstance(name, Symbol)}
        rows.append(tuple(name for name, _ in kept))
    parts = {Symbol(f"h_{k}"): entry for k, entry in enumerate(children(rest), 1)}
    names |= {name.name: entry for name, entry in parts.items() if entry != ZERO}
    left = (name if entry != ZERO else ZERO for name, entry in parts.items())
    forces = column(Symbol(f"tau_{k}") - each for k, each in enumerate(left, 1))
    return LinearSystem(arm.accelerations, Matrix(tuple(rows)), forces, n, names)


def first_order(accelerations: LinearSystem, arm: Arm) -> LinearSystem:
    """f = (qdot, qddot) by those equations, its first half as it stands (2n)."""
    n = len(arm.variables)
    letter = free(arm.problem.taken, "f", "phi", indices=[f"_{k}" for k in range(1, 2 * n + 1)])
    unknowns = tuple(Symbol(f"{letter}_{k}") for k in range(1, 2 * n + 1))
    nothing: tuple[Expr, ...] = (ZERO,) * n
    above = ((*(ONE if i == j else ZERO for j in range(n)), *nothing) for i in range(n))
    left = (*above, *((*nothing, *row) for row in accelerations.left.rows))
    right = column((*arm.rates, *children(accelerations.right)))
    return LinearSystem(unknowns, Matrix(left), right, 2 * n, accelerations.names)
