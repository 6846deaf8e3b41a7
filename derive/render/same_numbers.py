"""Whether a tree that is printed has the numbers that stand in the JSON under `evaluated`."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, get_args

from derive.algebra.numbers.floats import number
from derive.expression import Expr, Matrix, Measured

TREES = get_args(Expr)
CLOSE = 1e-8  # relative; whole degrees are printed whole where they are by less
LETTERS = {"j": 0.37, "s": 0.71}  # what these are put for on both sides


def same_numbers(tree: Expr, value: Any) -> bool:
    """The value is a number, a list or rows of them, {"re", "im"}, {"num", "den"} in s, or a tree in letters
    that are left."""
    tree = tree.value if isinstance(tree, Measured) else tree
    entries = [entry for row in tree.rows for entry in row] if isinstance(tree, Matrix) else [tree]
    values = [*_flat(value)]
    return len(entries) == len(values) and all(map(_same, entries, values))


def _same(entry: Expr, value: Any) -> bool:
    if isinstance(value, TREES):
        return bool(entry == value)
    ours, its = number(entry, LETTERS), _number(value)
    return ours == its or abs(ours - its) <= CLOSE * max(1.0, abs(its))


def _flat(value: Any) -> Iterator[Any]:
    """Row by row."""
    match value:
        case Matrix(rows) | list(rows) | tuple(rows):
            for part in rows:
                yield from _flat(part)
        case _:
            yield value


def _number(value: Any) -> float:
    match value:
        case {"re": re, "im": im}:
            return float(re + im * LETTERS["j"])
        case {"num": num, "den": den}:
            return _polynomial(num) / _polynomial(den)
        case _:
            return float(value)


def _polynomial(coefficients: Sequence[float]) -> float:
    """Highest power first."""
    total = 0.0
    for coefficient in coefficients:
        total = total * LETTERS["s"] + coefficient
    return total
