"""Where the rank of a matrix falls: where all its minors of full size vanish."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from itertools import combinations, islice
from math import prod
from typing import Any

from derive.algebra.numbers.arrays import arrays
from derive.algebra.numbers.floats import Point
from derive.algebra.scalar import Scalar, common_ring
from derive.algebra.signs import sign_of
from derive.algebra.solving.factors import factored
from derive.expression import Expr, is_negative, multiply
from derive.kinds.spaces._linear_map import LinearMap
from derive.mechanics.minors import minors

MOST_ENTRIES, MOST_KEPT = 24, 3  # of a matrix whose minors are looked at; of those that are said
STEPS, DIFFERENCE, GONE, NEAR, SMALL = 60, 1e-6, 1e-10, 1e-3, 1e-5
Vector = Any


@dataclass(frozen=True, slots=True)
class Falls:
    """The rank of J is lower than in general just where one of `alone` vanishes, or all of `together` do;
    what it is `there`, None where that is not known."""

    alone: tuple[Expr, ...]
    together: tuple[Expr, ...]
    there: int | None


def falls(found: LinearMap, rank: int, nonzero: Collection[str]) -> Falls | None:
    """None where the rank is not full, or more would have to be said than anyone reads."""
    J = found.J
    if rank != min(J.shape) or prod(J.shape) > MOST_ENTRIES:
        return None
    kept = independent([each.value for each in minors(J) if each.value])
    known = frozenset(nonzero)
    parts = [_factors(each, found.variables, known) for each in kept]
    if None in parts or len(kept) > MOST_KEPT:
        return None
    sets = [each or () for each in parts]
    shared = tuple(one for one in sets[0] if all(one in other for other in sets[1:]))
    rest = [[one for one in each if one not in shared] for each in sets]
    said = found.problem.readable
    together = () if len(sets) == 1 or not all(rest) else tuple(_product(each, said) for each in rest)
    there = rank - 1 if _by_one(found, rank, known) else None
    return Falls(tuple(_unsigned(said(one)) for one in shared), together, there)


def independent(values: Sequence[Scalar]) -> list[Scalar]:
    """Those that are no sums of multiples of the others by numbers, the shortest first."""
    home = common_ring(values)
    kept: list[Scalar] = []
    rows: dict[Any, dict[Any, Fraction]] = {}
    for value in sorted((each.into(home) for each in values), key=lambda each: len(each.numerator)):
        terms = {power: Fraction(int(c.p), int(c.q)) for power, c in value.numerator.to_dict().items()}
        for pivot, row in rows.items():
            if factor := terms.get(pivot):
                terms = {
                    k: terms.get(k, Fraction(0)) - factor * row.get(k, Fraction(0)) for k in {*terms, *row}
                }
        terms = {power: size for power, size in terms.items() if size}
        if terms:
            pivot, size = next(iter(terms.items()))
            rows[pivot] = {power: each / size for power, each in terms.items()}
            kept.append(value)
    return kept


def _factors(value: Scalar, variables: tuple[str, ...], nonzero: frozenset[str]) -> tuple[Scalar, ...] | None:
    """Those that may vanish; None where that rests on what is not known."""
    found = factored(value, variables)
    if not _never_zero(found.constant, nonzero):
        return None
    return tuple(each for each, _ in found.factors if not _never_zero(each, nonzero))


def _never_zero(value: Scalar, nonzero: frozenset[str]) -> bool:
    return sign_of(value, nonzero) is not None and value.letters() <= nonzero


def _by_one(found: LinearMap, rank: int, nonzero: frozenset[str]) -> bool:
    """Whether a smaller minor never vanishes."""
    if rank == 1:
        return True
    return rank == 2 and any(_never_zero(entry, nonzero) for row in found.J.rows for entry in row if entry)


def _product(factors: Sequence[Scalar], said: Callable[[Scalar], Expr]) -> Expr:
    return _unsigned(multiply(*map(said, factors)))


def _unsigned(tree: Expr) -> Expr:
    return -tree if is_negative(tree) else tree


# -- in numbers ---------------------------------------------------------------------------------------


def seen(found: LinearMap, told: Falls, rank: int, starts: Iterator[Point]) -> Iterator[bool]:
    """Where what is told vanishes the rank of J by another route is lower, where that is lower what is told
    vanishes, and at general places neither."""
    free = [name for name in found.variables if name in found.symbols]
    cases = [*((one,) for one in told.alone), *([told.together] if told.together else [])]
    for start in islice(starts, 3):
        yield _rank(found.numbers(start)) == rank
        yield not any(_size(_values(case, start)) < GONE for case in cases)
        for case in cases:
            at = _zero(partial(_values, case), start, free, found)
            if at is not None:
                there = _rank(found.numbers(at))
                yield there < rank if told.there is None else there == told.there < rank
        at = _zero(lambda here: _minors(found.numbers(here)), start, free, found)
        if at is not None:
            yield any(_size(_values(case, at)) < NEAR for case in cases)


def _values(trees: Sequence[Expr], at: Point) -> Vector:
    import numpy as np

    return np.array([float(arrays(tree, at)) for tree in trees])


def _size(values: Vector) -> float:
    return float(max(abs(values), default=0.0))


def _minors(J: Vector) -> Vector:
    import numpy as np

    wide = J if J.shape[0] <= J.shape[1] else J.T
    m, n = wide.shape
    return np.array([np.linalg.det(wide[:, list(columns)]) for columns in combinations(range(n), m)])


def _rank(J: Vector) -> int:
    import numpy as np

    sizes = np.linalg.svd(J, compute_uv=False)
    return int((sizes > SMALL * max(1.0, *sizes)).sum())


def _zero(
    values: Callable[[Point], Vector], start: Point, free: Sequence[str], found: LinearMap
) -> Point | None:
    """A place nearby where all of these vanish, by Newton's iteration in the joint variables; None where it
    finds none."""
    import numpy as np

    here: Mapping[str, float] = dict(start)
    for _ in range(STEPS):
        now = values(here)
        if _size(now) < GONE:
            return here
        slopes = [
            (values(found.at({**here, name: here[name] + DIFFERENCE})) - now) / DIFFERENCE for name in free
        ]
        move = np.linalg.lstsq(np.array(slopes).T, -now, rcond=1e-8)[0] if slopes else []
        here = found.at({**here, **{name: here[name] + d for name, d in zip(free, move, strict=True)}})
    return None
