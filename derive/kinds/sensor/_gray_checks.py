"""The Gray code as it is made by hand: a column of numbers written down, and below it the same reflected."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from derive.algebra.numbers.floats import number as at
from derive.derivation import Phrase, Table
from derive.expression import Matrix
from derive.kinds.fields import TREES


def by_reflection(position: int, bits: int) -> list[int]:
    """The digits at a position: 0 before the upper half, 1 before the lower, which is the upper reflected."""
    if not bits:
        return []
    half = 2 ** (bits - 1)
    below = position >= half
    return [int(below), *by_reflection(2 * half - 1 - position if below else position, bits - 1)]


def reflected(results: Mapping[str, object], bits: int, code: str | None) -> Iterator[bool]:
    """The code is that of the position by reflection, its neighbors differ in one digit; the binary digits
    come to the position; a code that was read is this one."""
    position, binary, gray = (
        _number(results["position"]),
        _digits(results["binary"]),
        _digits(results["gray"]),
    )
    yield gray == by_reflection(position, bits)
    for other in ((position + 1) % 2**bits, (position - 1) % 2**bits):
        yield sum(a != b for a, b in zip(gray, by_reflection(other, bits), strict=True)) == 1
    yield int("".join(map(str, binary)), 2) == position and len(binary) == bits
    yield code is None or gray == [*map(int, code)]


def as_told(table: Table, results: Mapping[str, object], bits: int) -> Iterator[bool]:
    """The digits that the table shows, each at its place."""
    rows = [table.headings, *table.rows]
    if isinstance(table.headings[1], Phrase):
        rows = [*zip(*rows, strict=True)]
    told = {row[0].key: [*map(_number, row[1:])] for row in rows if isinstance(row[0], Phrase)}
    yield told["place"] == [*reversed(range(bits))]
    yield told["binary"] == _digits(results["binary"]) and told["gray"] == _digits(results["gray"])


def _digits(column: object) -> list[int]:
    return [_number(row[0]) for row in column.rows] if isinstance(column, Matrix) else []


def _number(tree: object) -> int:
    return round(at(tree, {})) if isinstance(tree, TREES) else -1
