"""The poses of the frames of an arm, one in the other and in the base."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby

from pydantic import Field

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.readable.form import readable_matrix
from derive.algebra.readable.terms import Style
from derive.derivation import Derivation, PageFacts, Phrase, Result, Step
from derive.errors import NotDerivable
from derive.expression import ZERO, Expr, Matrix, Product, Symbol, column, symbols
from derive.kinds.checks import is_rotation
from derive.kinds.fields import Name, OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.robot._by_index import by_index
from derive.kinds.robot._chain import TOOL, chain_of, end_frame, oracle_of, pose_name
from derive.kinds.robot._columns import product_lines
from derive.kinds.robot._lengths import unit_of_lengths
from derive.kinds.robot._rows.exponentials import NAMED, Exponentials, ScrewsTold
from derive.kinds.work import Work
from derive.mechanics.dh import CONVENTIONS
from derive.mechanics.elementary import factor_name, homogeneous, rotation_matrix, translation
from derive.mechanics.motion import Move
from derive.mechanics.oracle.rows import TYPED
from derive.mechanics.poses import composed, position_part, rotation_part
from derive.mechanics.robot import DHRow, FreeRow, Link, Robot

A_1, T_BASE = symbols("A_1 T_base")


class Options(OptionsModel):
    """How much of the chain is wanted."""

    to: int | None = Field(None, ge=1)
    """The last frame wanted; all of them if left out."""
    coordinates: tuple[Name, ...] = Field((), max_length=3)
    """Names for the x, y and z of its origin, where only these are wanted."""


class Facts(PageFacts):
    screws: ScrewsTold | None = None
    dh_rows: bool = False
    free: Phrase | None = None  # rows of another form beside these
    locals: tuple[tuple[str, ...], ...] = ()  # steps that stand side by side
    base: tuple[str, ...] = ()  # steps
    tool: tuple[str, ...] = ()  # steps
    product: str = ""  # a step
    coordinates: bool = False  # alone


def claims_of(robot: Robot, options: Options) -> tuple[str, ...]:
    """Of screws also that each exponential is one."""
    if options.coordinates:
        return ("place",)
    screws = ("derivative", "exponential-series", "twist-of-any-screw") if robot.by_screws else ()
    return ("orthogonal", "right-handed", "poses-composed", "names", *screws)


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """T_1^0, T_2^1, ... and their product (4 by 4 each; Spong et al., eq. 3.11; Siciliano et al., eq. 2.52);
    of screws T = e^{[S_1] q_1} ... e^{[S_n] q_n} M (Lynch and Park, eq. 4.14).

    Raises NotDerivable where a frame is asked for that the arm does not have.
    """
    if options.coordinates:
        return _coordinates(options, problem)
    last = options.to or len(robot.links)
    if last > len(robot.links):
        count = f"{len(robot.links)} row{'s' * (len(robot.links) != 1)}"
        raise NotDerivable(f"frame {last} is asked for, but the arm has {count}")
    whole = options.to is None or last == len(robot.links)
    if robot.by_screws:
        return _by_screws(robot, problem, last, whole)
    found = chain_of(problem)
    T = found.T_tool if whole else found.T[last]
    name = Symbol(f"T_{end_frame(robot)}^0") if whole else pose_name(last)
    sorts = ["dh-row" if isinstance(link.row, DHRow) else "motion" for link in robot.links[:last]]
    rows = tuple(pose_name(i, i - 1) for i in range(1, last + 1))
    if robot.base:  # frame 0 is that of the base, so the first row is not yet T_1^0
        rows = (A_1, *rows[1:])
    work = _law(Work(problem), robot) if "dh-row" in sorts else Work(problem)
    for row, T_i, link in zip(rows, found.T_local, robot.links, strict=False):
        work = _line(work, row, T_i, link)
    beside = _beside(work.steps[-len(rows) :])
    work = work.law("each-row", (len(rows) == last, *(pose_name(i, i - 1) in rows for i in range(2, last))))
    poses = rows
    if robot.base:
        poses = (pose_name(1), *rows[1:])
        work = work.line(T_BASE, value=composed(robot.base), rule="motion")
        work = work.line(poses[0], T_BASE * A_1, value=found.T[1], rule="compose")
    results = {pose.name: problem.final(work[pose]) for pose in poses}
    tool = (f"T_{TOOL}^{last}",) if robot.tool and whole else ()
    for each in tool:
        work = work.line(each, value=composed(robot.tool), rule="motion")
    factors = (*poses, *map(Symbol, tool))
    work = product_lines(work, name, factors, T)
    results[pose_name(last).name] = work.final(name)
    free = tuple(i for i, sort in enumerate(sorts, 1) if sort == "motion")
    facts = Facts(
        dh_rows="dh-row" in sorts,
        free=_free(free) if "dh-row" in sorts else None,
        locals=beside,
        base=("T_base", "T_1^0") if robot.base else (),
        tool=tool,
        product=name.name if len(factors) > 1 else "",
        page_names={pose_name(last).name: name.name},
    )
    work = work.claim(*is_rotation(rotation_part(T), _rotation_name(name)))
    work = _named(_as_in_numbers(work, T, last, whole), results, facts)
    return work.answer("forward-kinematics", results, facts)


def _coordinates(options: Options, problem: Problem) -> Derivation:
    """The last column of the pose, by names of its own."""
    base = problem.answer("forward-kinematics", options.model_copy(update={"coordinates": ()}))
    last, robot, found = options.to or len(problem.subject.links), problem.subject, chain_of(problem)
    whole = last == len(robot.links)
    position = position_part(found.T_tool if whole else found.T[last]).entries
    work, names = Work(problem, uses=(base,)), options.coordinates
    for name, value in zip(names, position, strict=False):
        work = work.line(name, value=value, rule="coordinate").closed(name)
    oracle = oracle_of(problem)
    work = work.agrees(
        "place",
        problem.symbols,
        column(work[Symbol(name)] for name in names),
        lambda at: (oracle.tool(at) if whole else oracle.poses(at)[last])[: len(names), 3:],
    )
    unit = unit_of_lengths(problem)
    units: dict[Expr | Phrase, str] = {Symbol(name): unit for name in names if unit}
    results: dict[str, Result] = {name: work.final(Symbol(name)) for name in names}
    return work.answer("forward-kinematics", results, Facts(coordinates=True), units=units)


def _line(work: Work, name: Symbol, T_i: ScalarMatrix, link: Link) -> Work:
    """The transformation of a row; of a free motion also as the product of its moves, where these are about
    coordinate axes."""
    if isinstance(link.row, DHRow):
        return work.line(name, value=T_i, rule="dh-row")
    moves = link.row.moves if isinstance(link.row, FreeRow) else ()
    elementary = {factor: matrix for move in moves for factor, matrix in _elementary(move)}
    product = (Product(tuple(elementary)),) if 1 < len(moves) == len(elementary) else ()
    return work.knowing(elementary).line(name, *product, value=T_i, rule="motion", spare=product)


def _elementary(move: Move) -> Iterator[tuple[Expr, Matrix]]:
    """Rot_{z,theta} or Trans_{z,d}, and its matrix (4 by 4); nothing of an axis that was written."""
    if isinstance(move.axis, str):
        turns = move.kind == "rotate"
        T = homogeneous(rotation_matrix(move.axis, move.by)) if turns else translation(move.axis, move.by)
        yield factor_name(move, Symbol(move.axis), ("Rot", "Trans")), T


def _beside(rows: Sequence[Step]) -> tuple[tuple[str, ...], ...]:
    """Which stand side by side: those with a product have their own lines."""
    groups = groupby(rows, key=lambda step: len(step.chain))
    return tuple(tuple(step.name for step in group) for _, group in groups)


def _free(rows: tuple[int, ...]) -> Phrase | None:
    """That the frames of these rows follow no convention."""
    return Phrase("free-frames" if len(rows) > 1 else "free-frame", {"frames": rows}) if rows else None


def _by_screws(robot: Robot, problem: Problem, last: int, whole: bool) -> Derivation:
    screws = Exponentials(problem, robot, last, whole)
    work = screws.lines(Work(problem))
    results = {step.name: problem.final(step.result) for step in work.steps if step.rule in NAMED}
    results[pose_name(last).name] = work.final(screws.name)
    work = screws.proved(work).claim(*is_rotation(rotation_part(screws.pose), _rotation_name(screws.name)))
    work = _as_in_numbers(work, screws.pose, last, whole)
    facts = Facts(screws=screws.told(), page_names={pose_name(last).name: screws.name.name})
    return _named(work, results, facts).answer("forward-kinematics", results, facts)


def _named(work: Work, results: Mapping[str, Expr], facts: Facts) -> Work:
    """The frames by their numbers; the end-effector counts as the last one in the results."""
    return by_index(work, {str(facts.page_names.get(name, name)): pose for name, pose in results.items()})


def _rotation_name(pose: Symbol) -> str:
    return pose.name.replace("T", "R", 1)


def _parts(row: DHRow) -> tuple[Expr, ...]:
    return row.theta, row.d, row.a, row.alpha


PARAMETERS = {"standard": "theta_i d_i a_i alpha_i", "modified": "theta_i d_i a_i-1 alpha_i-1"}


def _law(work: Work, robot: Robot) -> Work:
    """T_i^i-1, the transformation of any row of the table; A_i where a base stands before the first. Tried in
    the row that has most of the parameters."""
    names = symbols(PARAMETERS[robot.convention])
    style = Style(order=("theta_i",))  # which stands before the twist in the books, of either convention
    A = readable_matrix(composed(CONVENTIONS[robot.convention](DHRow(*names))), style)
    rows = {i: _parts(link.row) for i, link in enumerate(robot.links) if isinstance(link.row, DHRow)}
    i = max(rows, key=lambda i: sum(part != ZERO for part in rows[i]))
    row = work.problem.readable_matrix(chain_of(work.problem).T_local[i])
    head = Symbol("A_i") if robot.base else Symbol("T_i^i-1")
    case: dict[Expr, Expr] = {head: row, **dict(zip(names, rows[i], strict=True))}
    return work.step(Step("A_i", (head, A), "law", instance=case)).agrees(
        "row-in-general",
        (name.name for name in names),
        A,
        lambda at: TYPED[robot.convention](*(at[name.name] for name in names)),
    )


def _as_in_numbers(work: Work, T: ScalarMatrix, last: int, whole: bool) -> Work:
    oracle = oracle_of(work.problem)
    return work.agrees(
        "poses-composed",
        work.problem.symbols,
        T,
        lambda at: oracle.tool(at) if whole else oracle.poses(at)[last],
        frame=last,
    )
