"""Names for entries of a matrix: d_12, c_121, and of a pose r_11, ..., p_z."""

from __future__ import annotations

from collections.abc import Collection

from derive.expression import Symbol
from derive.names import free


def entry_symbol(letter: str, *indices: int) -> Symbol:
    """d_12, c_121; with an index of two digits d_1,11: without commas c_1111 would be three symbols."""
    between = "" if all(index < 10 for index in indices) else ","
    return Symbol(f"{letter}_{between.join(map(str, indices))}")


def pose_entries(taken: Collection[str]) -> dict[tuple[int, int], Symbol]:
    """The rotation r_11, ... and the position p_x, p_y, p_z of a pose, by row and column from 0; by other
    letters where these stand for something else."""
    turn = {(i, j): f"_{i + 1}{j + 1}" for i in range(3) for j in range(3)}
    shift = {(i, 3): f"_{axis}" for i, axis in enumerate("xyz")}
    r, p = free(taken, "r", "R", indices=turn.values()), free(taken, "p", "P", indices=shift.values())
    named = [(place, r + end) for place, end in turn.items()]
    named += [(place, p + end) for place, end in shift.items()]
    return {place: Symbol(name) for place, name in named}
