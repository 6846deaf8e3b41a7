"""A motion worked out: its factors one by one, and their product in the order that the axes command."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial
from typing import Any, Literal

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.numbers.floats import completed, numbers
from derive.derivation import Claim, Derivation, PageFacts, Phrase, Result
from derive.expression import Call, Expr, Matrix, Symbol, column, free_symbols, walk
from derive.kinds.checks import is_rotation, law
from derive.kinds.meanings import Chain, as_told
from derive.kinds.motion._factors import Factors, factors_of, product_of, rounded_matrix, value_of
from derive.kinds.motion._meanings import axes_told, meant, order_chains, order_told, placed_chains
from derive.kinds.pose._numbers import along
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.motion import Motion, Move
from derive.mechanics.oracle import made
from derive.mechanics.poses import inverse_pose, rotation_part
from derive.mechanics.sequences import mode, order

AT_A_GLANCE = 8  # nodes of an entry
REASONS = {"single": "one-factor", "world": "about-world", "current": "about-current"}


class Facts(PageFacts):
    reason: Phrase | None  # for the order of the factors
    placed: tuple[Phrase, ...]  # where each is told one by one
    by: Expr | None  # of one turn about a written axis of numbers: its angle,
    along: Matrix | None  # and a vector along the axis


def composed(kind: str, motion: Motion, problem: Problem, size: Literal[3, 4], evaluate: bool) -> Derivation:
    """R (3 by 3), for which only rotations count, or T (4 by 4), as a derivation. `evaluate` writes it in
    decimals where nothing is left to give; the results stay exact."""
    moves = tuple(move for move in motion.moves if size == 4 or move.kind == "rotate")
    name = Symbol("R" if size == 3 else "T")
    numeric = evaluate and all(value_of(move.by, problem) is not None for move in moves)
    factors = factors_of(moves, problem, size, numeric)
    value = product_of(moves, size)
    written = problem.readable_matrix(value)
    formula: tuple[Expr, ...] = (factors.named(order(moves)),) if moves else ()
    shown = rounded_matrix(written, problem) if numeric else written
    if numeric and shown != written and _is_short(written):
        formula += (written,)
    work = factors.work if len(moves) != 1 else _without_its_matrix(factors.work)
    work = work.line(name, *formula, value=shown, rule="product")
    exact = problem.final(written)
    work = work.knowing({name: written}) if numeric else work.closed(name)
    parts = _factor_results(factors, problem)
    work = work.linked(but=("turned",)).claim(*_laws(problem.exact(value), name.name))
    told = [parts[f"{name.name.replace('T', 'A')}_{k}"] for k in range(1, len(moves) + 1)]
    work = motion_made(work, name.name, moves, exact, *told)
    if moves != motion.moves:
        work = motion_made(work, name.name, motion.moves, exact)
    facts, point = _facts(factors, numeric, name), completed({}, problem.where)
    orders = (*placed_chains(factors, facts.placed), *order_chains(factors, facts.reason, name))
    chains = (*orders, *_single(factors, facts))
    work = as_told(work, partial(meant, factors, name), chains)
    told_so = order_told(factors, facts.reason), bool(facts.placed) == (facts.reason is None)
    work = work.law("said", (axes_told(factors), *told_so))
    results: dict[str, Result] = {name.name: exact, **parts}
    evaluated: dict[str, Any] = {}
    if numeric:  # the page shows them so already
        evaluated = {
            each: numbers(result, point) for each, result in results.items() if isinstance(result, Matrix)
        }
    return work.answer(kind, results, facts, evaluated=evaluated)


def _without_its_matrix(work: Work) -> Work:
    """One move alone, whose matrix is the answer; what that follows from is told."""
    kept = (step for step in work.steps if step.rule != "elementary")
    shorter = (replace(step, chain=step.chain[:-1]) if step.rule == "rodrigues" else step for step in kept)
    return replace(work, steps=tuple(shorter))


def _facts(factors: Factors, numeric: bool, name: Symbol) -> Facts:
    noun, how = Phrase("rotation" if factors.size == 3 else "move"), mode(factors.moves)
    axis = _written_axis(factors)
    return Facts(
        by=factors.moves[0].by if axis else None,
        along=along(axis) if axis else None,
        reason=None if how == "mixed" else Phrase(REASONS[how], {"noun": noun}),
        placed=factors.placed() if how == "mixed" else (),
        numbers=() if numeric else (name.name,),
    )


def _written_axis(factors: Factors) -> Matrix | None:
    """That of one turn, where it and the angle are numbers."""
    if factors.size == 4 or len(factors.moves) != 1:
        return None
    (move,) = factors.moves
    if isinstance(move.axis, str) or any(map(free_symbols, (*move.axis, move.by))):
        return None
    return column(move.axis)


def _single(factors: Factors, facts: Facts) -> Iterator[Chain]:
    """The angle and the axis that are said of it."""
    if facts.by is not None and facts.along is not None:
        yield factors.factors[0].axis, facts.along / Call("abs", (facts.along,))
        yield factors.moves[0].by, facts.by


def _is_short(matrix: Matrix) -> bool:
    """Whether its entries are numbers and roots that are read at a glance."""
    entries = [entry for row in matrix.rows for entry in row]
    calls = {node.function for entry in entries for node in walk(entry) if isinstance(node, Call)}
    return calls <= {"sqrt"} and all(sum(1 for _ in walk(entry)) <= AT_A_GLANCE for entry in entries)


def _factor_results(factors: Factors, problem: Problem) -> dict[str, Expr]:
    """R_1, R_2, ... or A_1, A_2, ..., exact, in the order of the motion."""
    letter = "R" if factors.size == 3 else "A"
    return {
        f"{letter}_{factor.index}": problem.final(problem.readable_matrix(factor.value))
        for factor in factors.factors
    }


def _laws(R: ScalarMatrix, name: str) -> tuple[Claim, ...]:
    """A rotation is one; a transform undone is the identity."""
    if R.shape == (3, 3):
        return is_rotation(R, name)
    inverse = inverse_pose(R) @ R == ScalarMatrix.identity(4)
    return (*is_rotation(rotation_part(R)), law("inverse-of", inverse))


def motion_made(work: Work, name: str | Phrase, moves: Sequence[Move], exact: Expr, *factors: Expr) -> Work:
    """With the second route: the motion made in numbers, every move as told, on the axes themselves; and
    each move by itself against its factor, where they are given."""
    size = exact.shape[0] if isinstance(exact, Matrix) else 4
    told = (moves, *((move,) for move in moves[: len(factors)]))
    return work.agrees(
        "motion-made",
        work.problem.symbols,
        lambda at: [numbers(each, at) for each in (exact, *factors)],
        lambda at: [made(each, at)[:size, :size] for each in told],
        name=name,
    )
