"""The poses of the frames of an arm, one in the other and in the base."""

from __future__ import annotations

from pydantic import Field

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.numbers.floats import matrix_numbers
from derive.algebra.readable.form import readable_matrix
from derive.derivation import Claim, Derivation, PageFacts, Step, named_results
from derive.errors import NotDerivable
from derive.expression import Expr, Product, Symbol
from derive.kinds.checks import agreement, is_rotation, links
from derive.kinds.fields import OptionsModel
from derive.kinds.naming import with_named_entries
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import TOOL, chain_of, end_frame, oracle_of, pose_name
from derive.kinds.robot._rows.exponentials import ScrewsTold
from derive.mechanics.chain import Chain
from derive.mechanics.dh import CONVENTIONS
from derive.mechanics.motion import Move
from derive.mechanics.poses import composed, rotation_part
from derive.mechanics.robot import DHRow, Robot

RESULTS = {
    "T_1^0, T_2^1, ...": "each frame in the one before (4 by 4)",
    "T_n^0": "the last frame in the base (4 by 4), the tool included where there is one",
}
EXAMPLE = """\
title: A planar arm
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: a1, alpha: 0}
    - {theta: theta2*, d: 0, a: a2, alpha: 0}
  find: forward-kinematics
"""


class Options(OptionsModel):
    """`to`: the last frame wanted; all of them if left out."""

    to: int | None = Field(None, ge=1)


class Facts(PageFacts):
    screws: ScrewsTold | None = None
    dh_rows: tuple[int, ...] = ()
    free_rows: tuple[int, ...] = ()
    locals: tuple[str, ...] = ()  # steps
    base: tuple[str, ...] = ()  # steps
    tool: tuple[str, ...] = ()  # steps
    product: str = ""  # a step


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """T_1^0, T_2^1, ... and their product (Spong et al., eq. 3.11; Siciliano et al., eq. 2.52)."""
    last = options.to or len(robot.links)
    if last > len(robot.links):
        count = f"{len(robot.links)} row{'s' * (len(robot.links) != 1)}"
        raise NotDerivable(f"frame {last} is asked for, but the arm has {count}")
    whole = options.to is None or last == len(robot.links)
    if robot.by_screws:
        return _by_screws(robot, problem, last, whole)
    found = chain_of(problem)
    rows, base = _rows(problem, found, last), _base(problem, found)
    local = [*base[-1:], *rows[len(base[-1:]) :]]
    tool = [_fixed(problem, f"T_{TOOL}^{last}", robot.tool)] if robot.tool and whole else []
    T = found.T_tool if whole else found.T[last]
    name = Symbol(f"T_{end_frame(robot)}^0") if whole else pose_name(last)
    product = _product(problem, name, T, [*local, *tool])
    steps = (*_law(robot, rows), *rows, *base, *tool, *product)
    definitions = named_results(step for step in steps if step.rule != "law")
    written = problem.readable_matrix(T)
    results: dict[str, Expr] = {s.name: problem.final(s.result) for s in local}
    results[pose_name(last).name] = problem.final(written)
    definitions[name] = written
    claims = (
        *links(steps, {**problem.names, **definitions}),
        *is_rotation(rotation_part(T), name.name.replace("T", "R", 1)),
        _second_route(problem, T, last, whole),
    )
    facts = Facts(
        dh_rows=tuple(i for i, step in enumerate(rows, 1) if step.rule == "dh-row"),
        free_rows=tuple(i for i, step in enumerate(rows, 1) if step.rule == "motion"),
        locals=tuple(step.name for step in rows),
        base=tuple(step.name for step in base),
        tool=tuple(step.name for step in tool),
        product=name.name if product else "",
        page_names={pose_name(last).name: name.name},
    )
    return Derivation("forward-kinematics", steps, results, claims, definitions, facts=facts)


def _by_screws(robot: Robot, problem: Problem, last: int, whole: bool) -> Derivation:
    """T = e^{[S_1] q_1} ... e^{[S_n] q_n} M (Lynch and Park, eq. 4.14)."""
    from derive.kinds.robot._rows.exponentials import Exponentials  # few sheets need it

    work = Exponentials(problem, robot, last, whole)
    steps, definitions, T = work.steps(), work.definitions(), work.pose
    results: dict[str, Expr] = {
        step.name: problem.final(step.result)
        for step in steps
        if step.rule in ("exponential", "home", "twist")
    }
    results[work.name.name] = problem.final(definitions[work.name])
    claims = (
        *links(steps, {**problem.names, **definitions}),
        *work.claims(),
        *is_rotation(rotation_part(T), f"R_{last}^0"),
        _second_route(problem, T, last, whole),
    )
    facts = Facts(screws=work.told())
    return Derivation("forward-kinematics", steps, results, claims, definitions, facts=facts)


def _rows(problem: Problem, found: Chain, last: int) -> list[Step]:
    """The transformation of each row: each frame in the one before. On a base motion the first is A_1,
    for frame 0 is that of the base."""
    steps = []
    for i, T in enumerate(found.T_local[:last], 1):
        name = Symbol("A_1") if i == 1 and problem.subject.base else pose_name(i, i - 1)
        row = problem.subject.links[i - 1].row
        rule = "dh-row" if isinstance(row, DHRow) else "motion"
        steps.append(Step(name.name, (name, problem.readable_matrix(T)), rule))
    return steps


def _base(problem: Problem, found: Chain) -> list[Step]:
    """T_base and T_1^0 = T_base A_1, where there is a motion before the first row."""
    if not problem.subject.base:
        return []
    fixed, name = _fixed(problem, "T_base", problem.subject.base), pose_name(1)
    chain = (name, Product((Symbol(fixed.name), Symbol("A_1"))), problem.readable_matrix(found.T[1]))
    return [fixed, Step(name.name, chain, "compose")]


def _law(robot: Robot, local: list[Step]) -> tuple[Step, ...]:
    """A_i, the transformation of any row of the table."""
    if not any(step.rule == "dh-row" for step in local):
        return ()
    before = "i" if robot.convention == "standard" else "i-1"
    row = DHRow(*map(Symbol, ("theta_i", "d_i", f"a_{before}", f"alpha_{before}")))
    A = readable_matrix(composed(CONVENTIONS[robot.convention](row)))
    return (Step("A_i", (Symbol("A_i"), A), "law"),)


def _fixed(problem: Problem, name: str, moves: tuple[Move, ...]) -> Step:
    return Step(name, (Symbol(name), problem.readable_matrix(composed(moves))), "motion")


def _product(problem: Problem, name: Symbol, T: ScalarMatrix, factors: list[Step]) -> tuple[Step, ...]:
    if len(factors) < 2:
        return ()
    matrix, entries = with_named_entries(problem.readable_matrix(T))
    product = Product(tuple(Symbol(step.name) for step in factors))
    return Step(name.name, (name, product, matrix), "compose"), *entries


def _second_route(problem: Problem, T: ScalarMatrix, last: int, whole: bool) -> Claim:
    oracle = oracle_of(problem)
    return agreement(
        "poses-composed",
        problem.symbols,
        lambda at: matrix_numbers(T, oracle.at(at)),
        lambda at: oracle.tool(oracle.at(at)) if whole else oracle.poses(oracle.at(at))[last],
        frame=last,
    )
