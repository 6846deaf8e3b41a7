"""Which vectors of functions are linear combinations of others, with constants as coefficients."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import Any, TypeAlias

from derive.algebra.multivariate import grouped
from derive.algebra.numbers.floats import scalar_number
from derive.algebra.rationals import as_fraction
from derive.algebra.ring import Ring
from derive.algebra.scalar import Scalar, common_ring
from derive.errors import NotDerivable

# (place in the vector, powers of the generators that vary) -> what stands before them, a constant
Coefficients: TypeAlias = dict[tuple[int, tuple[int, ...]], Scalar]
TINY = 1e-9
SPARE = 3  # sums of coefficients for each vector


def dependencies(
    vectors: Sequence[Sequence[Scalar]], variables: Collection[str]
) -> dict[int, dict[int, Scalar]]:
    """For each vector that depends on those before it: the vectors it is made of, and how much of each.

    `variables` are the symbols that vary; all others are constants. Found in numbers at a random point,
    then solved and proven exactly. Raises NotDerivable where an entry has variables below a fraction.
    """
    home = common_ring(entry for vector in vectors for entry in vector)
    brought = [[entry.into(home) for entry in vector] for vector in vectors]
    moving = [i for i, name in enumerate(home.names) if not home.letters(name).isdisjoint(variables)]
    _refuse_below(brought, moving, home)
    supports = _supports(brought, moving, home)
    wanted = {*supports, *(i for support in supports.values() for i in support)}
    split = {j: _split(brought[j], moving, home) for j in wanted}
    return {j: _solved(split, j, support) for j, support in supports.items()}


def _refuse_below(vectors: Sequence[Sequence[Scalar]], moving: Sequence[int], home: Ring) -> None:
    """Raises NotDerivable where variables stand below a fraction."""
    below = (e.denominator for vector in vectors for e in vector if e.denominator is not None)
    if any(home.index[name] in moving for each in below for name in Scalar(home, each).generators()):
        raise NotDerivable("the joint variables stand below a fraction here")


def _split(vector: Sequence[Scalar], moving: Sequence[int], home: Ring) -> Coefficients:
    found: Coefficients = {}
    for place, entry in enumerate(vector):
        for powers, part in grouped(entry.numerator, moving).items():
            constant = Scalar(home, part)
            if entry.denominator is not None:
                constant = constant / Scalar(home, entry.denominator)
            found[place, powers] = constant
    return found


def _supports(vectors: Sequence[Sequence[Scalar]], moving: Sequence[int], home: Ring) -> dict[int, list[int]]:
    """For each dependent vector, in numbers, the independent ones it is made of."""
    import numpy as np

    table = _table(vectors, moving, home)
    free: list[int] = []
    found: dict[int, list[int]] = {}
    for j, column in enumerate(table.T):
        weights = np.linalg.lstsq(table[:, free], column, rcond=None)[0] if free else np.zeros(0)
        if np.linalg.norm(table[:, free] @ weights - column) > TINY * (1 + np.linalg.norm(column)):
            free.append(j)
        else:
            found[j] = [i for i, weight in zip(free, weights, strict=True) if abs(weight) > TINY]
    return found


def _table(vectors: Sequence[Sequence[Scalar]], moving: Sequence[int], home: Ring) -> Any:
    """The coefficients of each vector at a point, a column for each; where they are many more than the
    vectors, as many sums of them at random, among which there are no other dependencies."""
    import numpy as np

    point = _point(home)
    values = np.array([_value(home, name, point) for name in home.names])
    constant = np.ones(len(home.names), dtype=bool)
    constant[list(moving)] = False
    rows: dict[tuple[int, bytes], int] = {}
    entries: list[tuple[list[int], Any]] = []
    for vector in vectors:
        at, numbers = [], [np.zeros(0)]
        for place, entry in enumerate(vector):
            terms = entry.numerator.to_dict()
            if not terms:
                continue
            powers = np.array([[int(p) for p in each] for each in terms], dtype=np.int64)
            size = np.array([float(as_fraction(k)) for k in terms.values()])
            size = size * np.prod(np.where(constant, values, 1.0) ** np.where(constant, powers, 0), axis=1)
            if entry.denominator is not None:
                size = size / scalar_number(Scalar(home, entry.denominator), point)
            at += [rows.setdefault((place, each.tobytes()), len(rows)) for each in powers[:, ~constant]]
            numbers.append(size)
        entries.append((at, np.concatenate(numbers)))
    table = np.zeros((len(rows), len(vectors)))
    for j, (at, each) in enumerate(entries):
        np.add.at(table[:, j], at, each)
    most = SPARE * len(vectors)
    if len(rows) <= most:
        return table
    return np.random.default_rng(len(rows)).normal(size=(most, len(rows))) @ table


def _value(home: Ring, name: str, point: dict[str, float]) -> float:
    """That of a generator."""
    return scalar_number(Scalar(home, home.gen(name)), point)


def _point(home: Ring) -> dict[str, float]:
    """Anyone gets the same values; irrational-looking ones, so that nothing cancels by chance."""
    import random

    draw = random.Random(len(home.names))
    names = {*home.symbols, *(atom for form in home.angles for atom, _ in form.parts)}
    parts = {part.partition("^")[0] for name in names for part in name.split("*")}
    return {name: draw.uniform(0.3, 1.7) for name in sorted(names | parts)}


def _solved(split: Mapping[int, Coefficients], j: int, support: Sequence[int]) -> dict[int, Scalar]:
    """vector j = the sum of weight * vector, exactly. Raises NotDerivable where that fails."""
    rows = _equations(split, j, support)
    weights = _eliminated(rows, len(support))
    for *parts, whole in rows:
        held = ((weight, part) for weight, part in zip(weights, parts, strict=True) if part.numerator)
        if whole != sum((weight * part for weight, part in held), Scalar.of(0)):
            raise NotDerivable("the dependencies of the parameters could not be proven")
    return dict(zip(support, weights, strict=True))


def _equations(split: Mapping[int, Coefficients], j: int, support: Sequence[int]) -> list[list[Scalar]]:
    """One row a monomial: the coefficients of the vectors, then that of vector j; shortest first."""
    zero = Scalar.of(0)
    keys = dict.fromkeys(key for i in (*support, j) for key in split[i])
    rows = [[split[i].get(key, zero) for i in (*support, j)] for key in keys]
    return sorted(rows, key=lambda row: sum(len(entry.numerator) for entry in row if entry))


def _eliminated(rows: list[list[Scalar]], unknowns: int) -> list[Scalar]:
    """The solution of more equations than unknowns, by elimination in exact numbers."""
    pivots: dict[int, list[Scalar]] = {}
    for row in rows:
        if len(pivots) == unknowns:
            break
        for place, pivot in pivots.items():
            if row[place].numerator:
                row = _less(row, pivot, row[place])
        place = _leading(row)
        if place < unknowns:
            whole = [entry / row[place] for entry in row]
            for k, each in pivots.items():
                if each[place].numerator:
                    pivots[k] = _less(each, whole, each[place])
            pivots[place] = whole
    return [pivots[k][-1] if k in pivots else Scalar.of(0) for k in range(unknowns)]


def _leading(row: Sequence[Scalar]) -> int:
    return next((k for k, entry in enumerate(row) if entry.numerator and entry), len(row))


def _less(row: Sequence[Scalar], other: Sequence[Scalar], factor: Scalar) -> list[Scalar]:
    return [a - factor * b if b.numerator else a for a, b in zip(row, other, strict=True)]
