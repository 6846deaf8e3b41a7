"""Other sequences of the same moves, about other axes, that end in the same place."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any, Literal

from derive.algebra.infix import text
from derive.derivation import Derivation, PageFacts, Phrase, Record, Step
from derive.errors import NotDerivable
from derive.expression import Symbol
from derive.kinds.fields import NoOptions as Options
from derive.kinds.motion._factors import Factors, factors_of, product_of
from derive.kinds.motion._product import motion_made
from derive.kinds.problem import Problem
from derive.mechanics.motion import Axis, Motion, Move
from derive.mechanics.sequences import Alternative, equivalents, mode, order

CLAIMS = ("same-matrix", "motion-made")

MOVES: dict[str, tuple[Literal["rotate", "translate"], Literal["world", "current"]]] = {
    "turn": ("rotate", "current"), "shift": ("translate", "current"),  # of the first either is meant
    "turn-world": ("rotate", "world"), "shift-world": ("translate", "world"),
    "turn-current": ("rotate", "current"), "shift-current": ("translate", "current"),
}  # fmt: skip
MODES = {"world": "all-world", "current": "all-current", "mixed": "mixed"}


class SequenceTold(Record):
    mode: Phrase
    moves: tuple[Phrase, ...]


class Facts(PageFacts):
    product: Symbol
    sequences: tuple[SequenceTold, ...]


def derive(motion: Motion, options: Options, problem: Problem) -> Derivation:
    """The sequences whose product has the same factors in the same order (Spong et al., section 2.4).

    Raises NotDerivable where there is only one move.
    """
    if len(motion.moves) < 2:
        raise NotDerivable("a single move can be made in one way only")
    turning = all(move.kind == "rotate" for move in motion.moves)
    factors = factors_of(motion.moves, problem, 3 if turning else 4)
    name = Symbol("R" if turning else "T")
    value, product = product_of(motion.moves, factors.size), factors.named(order(motion.moves))
    written = problem.readable_matrix(value)
    axes = tuple(step for step in factors.work.steps if step.rule == "unit-vector")
    work = replace(factors.work, steps=(*axes, Step(name.name, (name, product)))).knowing({name: written})
    work, found, exact = work.linked(), tuple(equivalents(motion.moves)), problem.final(written)
    facts = Facts(
        product=name,
        sequences=tuple(_told(alternative, factors) for alternative in found),
    )
    for number, (alternative, sequence) in enumerate(zip(found, facts.sequences, strict=True), 1):
        same = product_of(alternative.moves, factors.size) == value
        work = work.law("same-matrix", same, number=number)
        told = tuple(_move(each, factors) for each in sequence.moves)
        work = motion_made(work, Phrase("sequence", {"number": number}), told, exact)
        work = work.law("said", (sequence.mode == Phrase(MODES[mode(told)]), *_beginning(sequence)))
    results: dict[str, Any] = {"sequences": tuple(_typed(each.moves) for each in found)}
    return work.answer("equivalent-sequences", results, facts)


def _told(alternative: Alternative, factors: Factors) -> SequenceTold:
    """For the words: the moves in order, each with its axis as it is called."""
    axes = {factor.move.axis: factor.axis for factor in factors.factors}
    found = []
    for k, move in enumerate(alternative.moves):
        keys = [key for key, way in MOVES.items() if way == (move.kind, move.about)]
        first = "turn" if move.kind == "rotate" else "shift"
        about = {"by": move.by, "axis": axes[move.axis]}
        found.append(Phrase(keys[-1] if k else first, about))
    return SequenceTold(mode=Phrase(MODES[alternative.mode]), moves=tuple(found))


def _move(told: Phrase, factors: Factors) -> Move:
    """The move that is meant by what is told. Raises StopIteration for an axis that there is not."""
    kind, about = MOVES[told.key]
    by = told.about["by"]
    axis = next(factor.move.axis for factor in factors.factors if factor.axis == told.about["axis"])
    return Move(kind, axis, next(move.by for move in factors.moves if move.by == by), about)


def _beginning(sequence: SequenceTold) -> Iterator[bool]:
    """Only of the first move no axes are told."""
    for k, move in enumerate(sequence.moves):
        yield (move.key in ("turn", "shift")) == (k == 0)


def _typed(moves: tuple[Move, ...]) -> tuple[dict[str, Any], ...]:
    """The moves as an author would type them."""
    return tuple({move.kind: _axis(move.axis), "by": text(move.by), "about": move.about} for move in moves)


def _axis(axis: Axis) -> Any:
    return axis if isinstance(axis, str) else [text(part) for part in axis]
