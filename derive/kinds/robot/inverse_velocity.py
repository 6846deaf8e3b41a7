"""The joint rates that give the end-effector a wanted velocity."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import partial
from typing import Any

from derive.algebra.normal import normal_matrix
from derive.algebra.numbers.floats import Point, number
from derive.derivation import Claim, Derivation, PageFacts, Phrase, Said
from derive.errors import NotReal
from derive.expression import ONE, ZERO, Expr, Relation, Symbol, column, transpose
from derive.kinds.checks import close, random_points, route
from derive.kinds.fields import TREES, OptionsModel, Quantity
from derive.kinds.linear_systems import solution_at
from derive.kinds.meanings import farthest
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import LINKS_ALONE, oracle_of
from derive.kinds.robot._determinants import determinant
from derive.kinds.robot._point import PointOn
from derive.kinds.robot._units import of_joints
from derive.kinds.robot._velocity.equations import equations_for
from derive.kinds.robot._velocity.functions import task_for
from derive.kinds.robot._velocity.solving import (
    PLUS,
    RATES,
    A,
    J,
    Solved,
    V,
    by_inverse,
    by_pseudo_inverse,
    fills_pages,
)
from derive.kinds.robot._velocity.splitting import by_wrist
from derive.kinds.robot._velocity.task import RowName, Task
from derive.kinds.work import Work
from derive.mechanics.robot import Robot
from derive.mechanics.wrist import wrist_of

DIFFERENCES, ANY, POINTS = 1e-5, 1e-9, 2

CLAIMED = {"qdot": "pseudo-inverse"}
CLAIMS = ("pseudo-inverse",)
measures = of_joints("qdot", power=1)


class Options(OptionsModel):
    """Which velocities are wanted, of which point."""

    rows: tuple[RowName, ...] = ()
    """The velocities that are wanted. If left out, the position or the orientation where the joints command
    just that, else all that moves."""
    point: PointOn | None = None
    """The point whose motion counts; that of the end-effector if left out."""
    task: tuple[Quantity, ...] = ()
    """Functions of the joint variables whose rates r1_dot, r2_dot, ... are wanted, in place of rows."""


BY_JOINT = ("qdot",)


class Facts(PageFacts):
    way: str  # "wrist", "adjugate", "pseudo-inverse", "equations"
    rows: tuple[Symbol, ...]
    frames: tuple[int, ...] = ()  # of the arm and of the hand
    offset: bool = False  # of the center of the wrist
    zero: tuple[tuple[Expr, ...], ...]  # singular where one of these holds
    least: Phrase | None = None  # what the pseudo-inverse makes so
    spare: Phrase | None = None  # joint rates
    of_functions: bool = False


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """qdot (n by 1): J^-1 v by the adjugate; the least rates (J^T (J J^T)^-1 v) or the least error
    ((J^T J)^-1 J^T v) where J is not square (Siciliano et al., section 3.5).

    Where that would fill pages, the linear equations for it. Raises NotDerivable where J is singular in every
    configuration.
    """
    task = task_for(problem, options.rows, options.point, options.task)
    whole = task.square and options.point is None and not options.task
    wrist = wrist_of(task.found) if whole else None
    if wrist:
        split = by_wrist(task, wrist)
        facts = Facts(
            way="wrist",
            rows=task.velocities,
            frames=split.frames,
            offset=split.offset,
            zero=split.zero,
            by_joint=BY_JOINT,
        )
        return _answer(task, split.work, split.qdot, facts)
    if fills_pages(task):
        return _as_equations(task, bool(options.task))
    solved = by_inverse(task) if task.square else by_pseudo_inverse(task)
    facts = Facts(
        way=solved.way,
        rows=task.velocities,
        zero=(solved.zero,),
        least=None if task.square else _least(task.redundant),
        spare=Phrase("null-space", {"rows": task.velocities}) if task.redundant else None,
        of_functions=bool(options.task),
        by_joint=BY_JOINT,
    )
    return _answer(task, _law(task, solved), problem.final(solved.qdot), facts, solved.apart)


def _as_equations(task: Task, of_functions: bool) -> Derivation:
    """The equations for qdot. Raises NotDerivable where they are dependent everywhere."""
    system, work = equations_for(task)
    facts = Facts(
        way="equations",
        rows=task.velocities,
        zero=((determinant(J if task.square else A), ZERO),),
        least=None if task.square else _least(task.redundant),
        spare=Phrase("null-space", {"rows": task.velocities}) if task.redundant else None,
        of_functions=of_functions,
        by_joint=BY_JOINT,
    )
    found = partial(solution_at, system)
    work = work.claim(route("pseudo-inverse", _is_least(facts.least, task))) if facts.least else work
    return _compared(task, work, found).answer(
        "inverse-velocity",
        {"J": task.problem.final(task.written), "qdot": system},
        facts,
        matrices=frozenset({"J"}),
    )


def _law(task: Task, solved: Solved) -> Work:
    """J qdot = v, exactly; with more rows than joints J^T (J qdot - v) = 0."""
    error = task.J @ solved.exact - normal_matrix(column(task.velocities)).scaled(solved.det)
    if not task.square and not task.redundant:
        return solved.work.law("least-squares", not task.J.T @ error)
    return solved.work.law("solves", not error)


def _least(redundant: bool) -> Phrase:
    """What the pseudo-inverse makes least."""
    inverse, turned = A**-1, transpose(J)
    plus = turned * inverse if redundant else inverse * turned
    about: dict[str, Said] = {"rates": Relation(RATES, "=", PLUS * V), "plus": Relation(PLUS, "=", plus)}
    return Phrase("least-rates" if redundant else "least-error", about)


def _is_least(told: Phrase | None, task: Task) -> Iterator[bool]:
    """Whether the pseudo-inverse that is told is that of any matrix of this shape."""
    import numpy as np

    drawn, (m, n) = np.random.default_rng(1), task.J.shape
    J_any, v_any = drawn.normal(size=(m, n)), drawn.normal(size=(m, 1))
    plus = np.linalg.pinv(J_any)
    gram = J_any @ J_any.T if task.redundant else J_any.T @ J_any
    whole: dict[Expr, Any] = {J: J_any, A: gram, PLUS: plus, V: v_any, RATES: plus @ v_any}
    names = {name: value if value.size > 1 else value.item() for name, value in whole.items()}
    for each in told.about.values() if told else ():
        sides = (each.left, each.right) if isinstance(each, Relation) and each.sign == "=" else ()
        chain = tuple(side for side in sides if isinstance(side, TREES))
        yield len(chain) == 2 and farthest([chain], names) < ANY


def _answer(task: Task, work: Work, qdot: Expr, facts: Facts, apart: Expr = ONE) -> Derivation:
    """As formulas."""
    work = _compared(task, work, qdot).claim(_fails_where(task, facts, apart))
    work = work.claim(route("pseudo-inverse", _is_least(facts.least, task))) if facts.least else work
    return work.answer("inverse-velocity", {"qdot": qdot}, facts, unread=LINKS_ALONE)


def _compared(task: Task, work: Work, qdot: Expr | Callable[[Point], Any]) -> Work:
    """With NumPy's pseudo-inverse of a Jacobian by differences as the second route."""
    names = [name.name for name in task.velocities]

    def seen(at: Point) -> Any:
        import numpy as np

        return np.linalg.pinv(task.numbers(at)) @ np.array([at[name] for name in names])

    return work.agrees("pseudo-inverse", task.symbols.union(names), qdot, seen, DIFFERENCES)


def _fails_where(task: Task, facts: Facts, apart: Expr) -> Claim:
    """That the equations of the places without an inverse say det J = 0: what stands there vanishes, and
    together, with the factors `apart` that never do, they are the determinant of the Jacobian by differences,
    but for its sign."""
    import numpy as np

    tried = [chain[-1] == ZERO for chain in facts.zero]
    for point in random_points(task.symbols, POINTS) if task.square else ():
        with suppress(NotReal, KeyError):  # det J_11 of a wrist stands there by its name
            at = oracle_of(task.problem).at(point)
            product = number(apart, at) * math.prod(number(chain[-2], at) for chain in facts.zero)
            tried.append(close(abs(product), abs(float(np.linalg.det(task.numbers(at)))), DIFFERENCES))
    return route("no-inverse", tried)
