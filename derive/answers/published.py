"""A published formula as it is understood: its tree, what else it says of it, how else it can be read."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from derive.expression import Expr, Matrix


@dataclass(frozen=True, slots=True)
class Published:
    """`tree` is what it ends in. `tight` is the other reading of a quotient a/b c, as a/(b c). `chain` are
    the parts before the last of a = b = c, all claimed to be the answer; `note` says what was not read.
    `measured` is the other reading of 0.5 s, with a unit, where s is a name of the problem too, and of 25 %.

    A matrix is one tree; each of the others then is a matrix as well, with the entries that have no other.
    """

    tree: Expr
    tight: Expr | None = None
    chain: tuple[Published, ...] = ()
    note: str = ""
    measured: Expr | None = None

    def each(self, change: Callable[[Expr], Expr]) -> Published:
        """The same with every tree changed."""
        tree = change(self.tree)
        tight, measured = (
            None if other is None else _unless(tree, change(other)) for other in (self.tight, self.measured)
        )
        return Published(tree, tight, tuple(part.each(change) for part in self.chain), self.note, measured)

    def entry(self, i: int, j: int) -> Published:
        """That of a matrix, counted from 0."""
        alike = tuple(part for part in self.chain if _shape(part.tree) == _shape(self.tree))
        found = replace(self, chain=alike).each(lambda matrix: _entry(matrix, i, j))
        return replace(found, chain=tuple(part for part in found.chain if part.tree != found.tree))


def gathered(rows: Sequence[Sequence[Published]]) -> Published:
    """The matrix of entries that were each read on their own."""
    every = [entry for row in rows for entry in row]
    notes = [entry.note for entry in every if entry.note]
    tree = Matrix(tuple(tuple(entry.tree for entry in row) for row in rows))
    tight = Matrix(tuple(tuple(entry.tight or entry.tree for entry in row) for row in rows))
    measured = Matrix(tuple(tuple(entry.measured or entry.tree for entry in row) for row in rows))
    chain = tuple(
        gathered([[_link(entry, k) for entry in row] for row in rows])
        for k in range(max(len(entry.chain) for entry in every))
    )
    note = notes[0] if notes else ""
    return Published(tree, _unless(tree, tight), chain, note, _unless(tree, measured))


def _unless(tree: Expr, other: Expr) -> Expr | None:
    """Another reading; None where it comes to the same."""
    return None if other == tree else other


def _link(entry: Published, k: int) -> Published:
    """The k-th part of its chain, or what it ends in."""
    return entry.chain[k] if k < len(entry.chain) else replace(entry, chain=())


def _shape(tree: Expr) -> tuple[int, int] | None:
    return tree.shape if isinstance(tree, Matrix) else None


def _entry(tree: Expr, i: int, j: int) -> Expr:
    assert isinstance(tree, Matrix)
    return tree.rows[i][j]
