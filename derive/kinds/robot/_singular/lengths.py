"""What is taken for granted of the lengths of an arm where its singular sets are told."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from derive.derivation import Claim, Phrase
from derive.kinds.checks import random_points, route
from derive.kinds.robot._chain import oracle_of
from derive.kinds.robot._singular.search import Values, placed, rank_at
from derive.kinds.robot._singular.sets import Analysed
from derive.kinds.robot._velocity.task import Task

POINTS, MOST = 2, 20
NOT_ZERO = ("positive", "nonzero")


def lengths_told(task: Task, sets: Sequence[Analysed]) -> Phrase | None:
    """Nothing where the sheet says that they are not zero, and the ranks hold at special lengths too."""
    names = _names(task)
    if not names:
        return None
    if not all(_ranks(task, sets)):
        return Phrase("lengths-in-general")
    said = all(task.problem.assumptions.get(name) in NOT_ZERO for name in names)
    return None if said else Phrase("lengths")


def at_special_lengths(task: Task, sets: Sequence[Analysed], told: Phrase | None) -> Iterator[Claim]:
    """That the ranks are as told wherever lengths are not zero, unless more is said of them."""
    if _names(task) and (told is None or told.key == "lengths") and (tried := [*_ranks(task, sets)]):
        yield route("at-special-lengths", tried)


def _names(task: Task) -> list[str]:
    return sorted(task.problem.symbols - set(task.problem.subject.variables))


def _ranks(task: Task, sets: Sequence[Analysed]) -> Iterator[bool]:
    """Whether each choice of values has the rank of its set at lengths that are special; of a set that is
    told without values nothing is known."""
    for each in sets:
        yield bool(each.cases)
        for case in each.cases:
            values = {zero.variable: zero.value for zero in case.zeros}
            for here in placed(values, _special(task), MOST):
                found = rank_at(task.numbers(here))
                yield found == each.rank if each.exact else found <= each.rank


def _special(task: Task) -> Iterator[Values]:
    """Places with all lengths equal, and with each the sum of the others."""
    names, oracle = _names(task), oracle_of(task.problem)
    lengths = [dict.fromkeys(names, 1.0)]
    if len(names) > 2:
        lengths += [{**lengths[0], name: len(names) - 1.0} for name in names]
    for at in random_points(task.symbols, POINTS):
        yield from (dict(oracle.at({**at, **each})) for each in lengths)
