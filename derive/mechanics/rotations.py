"""A rotation matrix that is given as such: in numbers, in formulas, or by the names of its entries."""

from __future__ import annotations

from dataclasses import dataclass

from derive.expression import Matrix, Symbol, free_symbols


@dataclass(frozen=True, slots=True)
class GivenRotation:
    """R (3 by 3). `rounded`: the places to which its author rounded it, where the nearest rotation stands for
    what was typed."""

    matrix: Matrix
    rounded: int = 0

    @property
    def names(self) -> tuple[str, ...]:
        """Those of the entries, row by row, where they are nine names: then it is any rotation, and they
        depend on each other. None else."""
        found = [entry.name for row in self.matrix.rows for entry in row if isinstance(entry, Symbol)]
        return tuple(found) if len(set(found)) == 9 else ()

    @property
    def variables(self) -> tuple[str, ...]:
        """The names in the entries, row by row."""
        entries = (entry for row in self.matrix.rows for entry in row)
        return tuple(dict.fromkeys(name for entry in entries for name in sorted(free_symbols(entry))))
