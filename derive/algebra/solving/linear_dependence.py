"""Which vectors of functions are linear combinations of others, with constants as coefficients."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import TypeAlias

from derive.algebra.multivariate import grouped
from derive.algebra.numbers.floats import scalar_number
from derive.algebra.ring import Ring
from derive.algebra.scalar import Scalar, common_ring
from derive.errors import NotDerivable

# (place in the vector, powers of the generators that vary) -> what stands before them, a constant
Coefficients: TypeAlias = dict[tuple[int, tuple[int, ...]], Scalar]
TINY = 1e-9


def dependencies(
    vectors: Sequence[Sequence[Scalar]], variables: Collection[str]
) -> dict[int, dict[int, Scalar]]:
    """For each vector that depends on those before it: the vectors it is made of, and how much of each.

    `variables` are the symbols that vary; all others are constants. Found in numbers at a random point,
    then solved and proven exactly. Raises NotDerivable where an entry has variables below a fraction.
    """
    home = common_ring(entry for vector in vectors for entry in vector)
    split = [_split([entry.into(home) for entry in vector], variables, home) for vector in vectors]
    supports = _supports(split, home)
    return {j: _solved(split, j, support) for j, support in supports.items()}


def _split(vector: Sequence[Scalar], variables: Collection[str], home: Ring) -> Coefficients:
    moving = [i for i, name in enumerate(home.names) if not home.letters(name).isdisjoint(variables)]
    found: Coefficients = {}
    for place, entry in enumerate(vector):
        below = Scalar(home, home.one if entry.denominator is None else entry.denominator)
        if any(home.index[name] in moving for name in below.generators()):
            raise NotDerivable("the joint variables stand below a fraction here")
        for powers, part in grouped(entry.numerator, moving).items():
            found[place, powers] = Scalar(home, part) / below
    return found


def _supports(split: Sequence[Coefficients], home: Ring) -> dict[int, list[int]]:
    """For each dependent vector, in numbers, the independent ones it is made of."""
    import numpy as np

    keys = {key: row for row, key in enumerate(dict.fromkeys(key for each in split for key in each))}
    point = _point(home)
    table = np.zeros((len(keys), len(split)))
    for j, each in enumerate(split):
        for key, value in each.items():
            table[keys[key], j] = scalar_number(value, point)
    free: list[int] = []
    found: dict[int, list[int]] = {}
    for j in range(len(split)):
        column = table[:, j]
        weights = np.linalg.lstsq(table[:, free], column, rcond=None)[0] if free else np.zeros(0)
        if np.linalg.norm(table[:, free] @ weights - column) > TINY * (1 + np.linalg.norm(column)):
            free.append(j)
        else:
            found[j] = [i for i, weight in zip(free, weights, strict=True) if abs(weight) > TINY]
    return found


def _point(home: Ring) -> dict[str, float]:
    """Anyone gets the same values; irrational-looking ones, so that nothing cancels by chance."""
    import random

    draw = random.Random(len(home.names))
    names = {*home.symbols, *(atom for form in home.angles for atom, _ in form.parts)}
    parts = {part.partition("^")[0] for name in names for part in name.split("*")}
    return {name: draw.uniform(0.3, 1.7) for name in sorted(names | parts)}


def _solved(split: Sequence[Coefficients], j: int, support: Sequence[int]) -> dict[int, Scalar]:
    """vector j = the sum of weight * vector, exactly. Raises NotDerivable where that fails."""
    rows = _equations(split, j, support)
    weights = _eliminated(rows, len(support))
    for *parts, whole in rows:
        if whole != sum((weight * part for weight, part in zip(weights, parts, strict=True)), Scalar.of(0)):
            raise NotDerivable("the dependencies of the parameters could not be proven")
    return dict(zip(support, weights, strict=True))


def _equations(split: Sequence[Coefficients], j: int, support: Sequence[int]) -> list[list[Scalar]]:
    """One row a monomial: the coefficients of the vectors, then that of vector j; shortest first."""
    zero = Scalar.of(0)
    keys = dict.fromkeys(key for i in (*support, j) for key in split[i])
    rows = [[split[i].get(key, zero) for i in (*support, j)] for key in keys]
    return sorted(rows, key=lambda row: sum(len(entry.numerator) for entry in row if entry))


def _eliminated(rows: list[list[Scalar]], unknowns: int) -> list[Scalar]:
    """The solution of more equations than unknowns, by elimination in exact numbers."""
    pivots: list[list[Scalar]] = []
    for row in rows:
        if len(pivots) == unknowns:
            break
        for k, pivot in enumerate(pivots):
            place = _leading(pivot)
            if row[place]:
                row = _less(row, pivots[k], row[place])
        place = _leading(row)
        if place < unknowns:
            whole = [entry / row[place] for entry in row]
            pivots = [_less(each, whole, each[place]) if each[place] else each for each in pivots]
            pivots.append(whole)
    found = {_leading(pivot): pivot[-1] for pivot in pivots}
    return [found.get(k, Scalar.of(0)) for k in range(unknowns)]


def _leading(row: Sequence[Scalar]) -> int:
    return next((k for k, entry in enumerate(row) if entry), len(row))


def _less(row: Sequence[Scalar], other: Sequence[Scalar], factor: Scalar) -> list[Scalar]:
    return [a - factor * b if b else a for a, b in zip(row, other, strict=True)]
