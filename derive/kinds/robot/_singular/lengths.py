"""What is taken for granted of the lengths of an arm, or of the constants of a matrix, where singular sets
are told."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from derive.derivation import Claim, Phrase
from derive.kinds.checks import random_points, route
from derive.kinds.robot._singular.checks import InNumbers
from derive.kinds.robot._singular.minors import Way
from derive.kinds.robot._singular.search import Values, placed, rank_at
from derive.kinds.robot._singular.sets import Analysed

POINTS, MOST = 2, 20
OTHER = 2.7  # than a constant is at a point
NOT_ZERO = ("positive", "nonzero")


def lengths_told(
    J: InNumbers, assumptions: Mapping[str, str], sets: Sequence[Analysed], way: Way
) -> Phrase | None:
    """Nothing where the matrix has none, or where the sheet says that they are not zero, and the ranks hold
    at special lengths too."""
    letters = frozenset[str]().union(
        *(entry.letters() for each in way.parts for entry in each.block.J.entries)
    )
    names = [name for name in _names(J) if name in letters or way.name == "wrist"]
    if not names:
        return None
    if not all(_ranks(J, sets)):
        return Phrase("lengths-in-general")
    return None if all(assumptions.get(name) in NOT_ZERO for name in names) else Phrase("lengths")


def at_special_lengths(J: InNumbers, sets: Sequence[Analysed], told: Phrase | None) -> Iterator[Claim]:
    """That the ranks are as told wherever lengths are not zero, unless more is said of them."""
    if _names(J) and (told is None or told.key == "lengths") and (tried := [*_ranks(J, sets)]):
        yield route("at-special-lengths", tried)


def _names(J: InNumbers) -> list[str]:
    """Constants on which the matrix depends: of gravity it does not."""
    at = next(J.points)
    here = J.whole(at)
    return [name for name in sorted(J.symbols - {*J.variables}) if _moves(J.whole({**at, name: OTHER}), here)]


def _moves(there: Any, here: Any) -> bool:
    import numpy as np

    return not np.array_equal(there, here)


def _ranks(J: InNumbers, sets: Sequence[Analysed]) -> Iterator[bool]:
    """Whether each choice of values has the rank of its set at lengths that are special; of a set that is
    told without values nothing is known."""
    for each in sets:
        yield bool(each.cases)
        for case in each.cases:
            values = {zero.variable: zero.value for zero in case.zeros}
            for here in placed(values, _special(J), MOST):
                found = rank_at(J.whole(here))
                yield found == each.rank if each.exact else found <= each.rank


def _special(J: InNumbers) -> Iterator[Values]:
    """Places with all lengths equal, and with each the sum of the others."""
    names = _names(J)
    lengths = [dict.fromkeys(names, 1.0)]
    if len(names) > 2:
        lengths += [{**lengths[0], name: len(names) - 1.0} for name in names]
    for at in random_points(J.symbols, POINTS):
        yield from (dict(J.completed({**at, **each})) for each in lengths)
