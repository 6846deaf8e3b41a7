"""Three ways to the singular configurations: the determinant, its split at a wrist, or the minors."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from math import comb

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.algebra.scalar import Scalar
from derive.algebra.solving.factors import Factored, TooLong, effort
from derive.derivation import Phrase, Step
from derive.errors import NotDerivable
from derive.expression import Expr, Indexed, Matrix, Product, Symbol, add, transpose
from derive.kinds.problem import Problem
from derive.kinds.robot._determinants import determinant, gram_determinant, natural, product_tree
from derive.kinds.robot._singular.geometry import Seeing
from derive.kinds.robot._singular.sets import Block
from derive.kinds.robot._velocity.task import Task
from derive.kinds.work import Work
from derive.mechanics.budget import Budget
from derive.mechanics.jacobian import jacobian
from derive.mechanics.minors import Minor, minors
from derive.mechanics.poses import position_part, rotation_part
from derive.mechanics.seen import seen_shortest
from derive.mechanics.strata import of_determinant, of_minors, searching
from derive.mechanics.vanishing import Locus
from derive.mechanics.wrist import Wrist

SIX = 6
MOST_MINORS = 60
MOST_LINKED = 100  # terms of all minors up to which det(J J^T) is multiplied out to be compared with them
MOST_PRODUCTS = 300_000  # of terms, for the determinant or all minors
MOST_TERMS = 400  # of one of them
MOST_EFFORT = 100_000  # of taking them apart: a second or two


@dataclass(frozen=True, slots=True)
class Part:
    """A block and where it loses rank."""

    block: Block
    sets: tuple[Locus, ...]


@dataclass(frozen=True, slots=True)
class Way:
    """What the determinant came from: `name` is "determinant", "wrist" or "minors", `point` says whose
    velocity it is; `work` has the lines."""

    name: str
    point: Phrase
    work: Work
    det: Expr
    parts: tuple[Part, ...]
    complete: bool  # False where there may be more sets


def by_determinant(task: Task) -> Way:
    """det J of a square Jacobian, in the axes of a middle frame where it has six rows."""
    problem, variables = task.problem, task.found.variables
    frame = _middle(task) if len(task.rows) == SIX else 0
    J = _seen_from(task, frame) if frame else task.J
    name = Symbol(f"J^{frame}" if frame else "J")
    (whole,) = _minors(task, J)
    det = natural(problem, whole.value, variables)
    _refuse_dependent(task, bool(det.constant))
    tree, shown = product_tree(problem, det), problem.readable_matrix(J)
    chain = (determinant(name), *_two_by_two(shown), tree)
    work = _resting_on(task, frame).step(
        Step("J", (name, shown), "frame" if frame else "rows"), _closed(problem, "det", chain)
    )
    search = searching(task.found, problem.readable)
    block = Block(name.name, J, variables, task.rows, frame, _seeing(task))
    parts = (Part(block, of_determinant(det, search)),)
    work = work.law("factors", det.value == whole.value)
    return Way("determinant", _moved(task), work, tree, parts, not search.open)


def by_wrist(task: Task, wrist: Wrist) -> Way:
    """det J = det J_11 det J_22 at the center of the wrist."""
    problem, found = task.problem, task.found
    arm = Seeing(problem, found, wrist.center, wrist.arm_rows)
    hand = Seeing(problem, found, wrist.center, wrist.hand_rows)
    blocks = (
        Block("J_11", wrist.J_11, found.variables[:3], task.rows[:3], wrist.arm, arm),
        Block("J_22", wrist.J_22, found.variables[3:], task.rows[3:], wrist.hand, hand),
    )
    center = (Symbol(f"o_{wrist.frame}"), problem.readable_matrix(wrist.center))
    work = _resting_on(task, wrist.frame).step(Step("center", center, "center"))
    parts, dets = [], []
    search = searching(found, problem.readable)
    for block in blocks:
        det = natural(problem, block.J.det(), block.variables)
        dets.append(det)
        _refuse_dependent(task, bool(det.constant))
        name = Symbol(block.name)
        work = work.step(
            Step(block.name, (name, problem.readable_matrix(block.J)), "block"),
            _closed(problem, f"det_{block.name}", (determinant(name), product_tree(problem, det))),
        )
        parts.append(Part(block, of_determinant(det, search)))
    whole = Factored(dets[0].constant * dets[1].constant, (*dets[0].factors, *dets[1].factors))
    tree = product_tree(problem, whole)
    split = Product(tuple(determinant(Symbol(block.name)) for block in blocks))
    work = work.step(Step("det", (determinant(Symbol("J")), split, problem.final(tree)), "in-numbers"))
    (six,) = _minors(task, seen_from_middle(task))
    work = work.law("blocks", six.value == whole.value)
    return Way("wrist", Phrase("center-of-the-wrist"), work, tree, tuple(parts), not search.open)


def by_minors(task: Task) -> Way:
    """All minors of full size, which vanish together: det(J J^T) is the sum of their squares."""
    problem, variables = task.problem, task.found.variables
    frame, rows, J = seen_shortest(task.found, task.whole, task.rows)
    name = Symbol(f"J^{frame}" if frame else "J")
    if comb(max(J.shape), min(J.shape)) > MOST_MINORS:
        raise NotDerivable("the Jacobian has too many minors to be solved together; ask for some rows only")
    found = [minor for minor in _minors(task, J) if minor.value]
    _refuse_dependent(task, bool(found))
    names = [_minor_name(task, minor) for minor in found]
    trees = [product_tree(problem, natural(problem, minor.value, variables)) for minor in found]
    pairs = list(zip(names, trees, strict=True))
    tree = gram_determinant(problem, [minor.value for minor in found], trees)
    chain = (determinant(_gram(task, name)), add(*(each**2 for each in names)), tree)
    det = _closed(problem, "det", chain)
    work = _resting_on(task, frame).knowing(dict[Expr, Expr](pairs))
    if sum(len(minor.value.numerator) for minor in found) > MOST_LINKED:
        det = replace(det, rule="in-numbers")
        total = sum((minor.value * minor.value for minor in found), Scalar.of(0))
        work = work.law("minors", normal(tree) == total)
    work = work.step(
        Step("J", (name, problem.readable_matrix(J)), "frame" if frame else "rows"),
        *(Step(f"minor_{place}", pair, "minor") for place, pair in enumerate(pairs, 1)),
        det,
    )
    search = searching(task.found, problem.readable)
    block = Block(name.name, J, variables, rows, frame, _seeing(task))
    parts = (Part(block, of_minors([minor.value for minor in found], search)),)
    return Way("minors", _moved(task), work, tree, parts, not search.open)


def _resting_on(task: Task, frame: int) -> Work:
    """The poses where the velocities are seen from a frame, else the Jacobian that was asked for."""
    return Work(task.problem, uses=(task.problem.ask("forward-kinematics"),) if frame else task.base)


def _minors(task: Task, J: ScalarMatrix) -> tuple[Minor, ...]:
    """Raises NotDerivable before they outgrow what can be taken apart."""
    budget = Budget(MOST_PRODUCTS)
    try:
        found = minors(J, budget)
        Budget(MOST_EFFORT).spend(sum(effort(minor.value, task.found.variables) for minor in found))
        Budget(MOST_TERMS).spend(max(len(minor.value.numerator) for minor in found))
    except TooLong:
        raise NotDerivable(
            "the determinants of this Jacobian are too long to be taken apart; ask for fewer rows, or give "
            "numbers to lengths and twists, quarter turns where they will do"
        ) from None
    return found


def _two_by_two(J: Matrix) -> tuple[Expr, ...]:
    """The products of a determinant of two rows, as they are subtracted."""
    if J.shape != (2, 2):
        return ()
    (a, b), (c, d) = J.rows
    return (Product((a, d)) - Product((b, c)),)  # a minus sign of b stays inside


def _closed(problem: Problem, name: str, chain: Iterable[Expr]) -> Step:
    links = tuple(chain)
    final = problem.final(links[-1])
    return Step(name, links if final == links[-1] else (*links, final), "determinant")


def _seeing(task: Task) -> Seeing:
    rows = tuple(i for i, _ in task.found.moving if i <= task.point.last)
    return Seeing(task.problem, task.found, task.point.position, rows)


def _moved(task: Task) -> Phrase:
    return Phrase("the-point" if task.point.carried else "end-effector")


def _middle(task: Task) -> int:
    """The frame of the joint in the middle: seen from there a Jacobian is shortest."""
    moving = [i for i, _ in task.found.moving]
    return moving[(len(moving) - 1) // 2]


def seen_from_middle(task: Task) -> ScalarMatrix:
    """The whole Jacobian where it is shortest: in the axes of the middle frame. No determinant of six rows
    and no minor of that size changes."""
    return _seen_from(task, _middle(task))


def _seen_from(task: Task, frame: int) -> ScalarMatrix:
    """The whole Jacobian of the origin of the last frame, in the axes of a frame."""
    found = task.found
    tool_moves = found.coupling is not None and found.coupling.rows[-1] > len(found.T_local)
    if tool_moves or task.point.drift is not None:
        raise NotDerivable(
            "six rows are worked at the origin of the last row, and here the point moves against it; "
            "ask for three of them, as rows: [vx, vy, vz]"
        )
    R_T = rotation_part(found.T[frame]).T
    J = jacobian(found, position_part(found.T[-1]), len(found.T_local))
    return ScalarMatrix.stacked([R_T @ J.block(rows, slice(None)) for rows in (slice(0, 3), slice(3, 6))])


def _refuse_dependent(task: Task, regular: bool) -> None:
    """Raises NotDerivable where every determinant vanishes in every configuration."""
    if not regular:
        which = ", ".join(task.rows)
        raise NotDerivable(
            f"the rows {which} of the Jacobian are dependent in every configuration; ask for fewer rows"
        )


def _minor_name(task: Task, minor: Minor) -> Expr:
    """Delta with the columns, or the rows, that it is made of."""
    if task.redundant:
        return Symbol("Delta_" + "".join(str(k + 1) for k in minor.lines))
    return Indexed("Delta", tuple(Symbol(task.rows[k]) for k in minor.lines))


def _gram(task: Task, J: Symbol) -> Expr:
    return Product((J, transpose(J)) if task.redundant else (transpose(J), J))
