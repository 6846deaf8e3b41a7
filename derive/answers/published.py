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
        tight = None if self.tight is None else change(self.tight)
        chain = tuple(part.each(change) for part in self.chain)
        measured = None if self.measured is None else change(self.measured)
        return Published(change(self.tree), tight, chain, self.note, measured)

    def entry(self, i: int, j: int) -> Published:
        """That of a matrix, counted from 0."""
        tree = _entry(self.tree, i, j)
        tight = None if self.tight is None else _entry(self.tight, i, j)
        parts = [part.entry(i, j) for part in self.chain if _shape(part.tree) == _shape(self.tree)]
        chain = tuple(part for part in parts if part.tree != tree)
        measured = None if self.measured is None else _entry(self.measured, i, j)
        return Published(
            tree, None if tight == tree else tight, chain, self.note, None if measured == tree else measured
        )


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
    return Published(
        tree,
        None if tight == tree else tight,
        chain,
        notes[0] if notes else "",
        None if measured == tree else measured,
    )


def _link(entry: Published, k: int) -> Published:
    """The k-th part of its chain, or what it ends in."""
    return entry.chain[k] if k < len(entry.chain) else replace(entry, chain=())


def _shape(tree: Expr) -> tuple[int, int] | None:
    return tree.shape if isinstance(tree, Matrix) else None


def _entry(tree: Expr, i: int, j: int) -> Expr:
    assert isinstance(tree, Matrix)
    return tree.rows[i][j]
