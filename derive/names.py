"""Names that an answer gives: one policy for which are free, and what is said where one is not.

A name is taken where the author means something by it, or by one that looks like it on a page: I1 and I_1 are
printed alike. A kind offers its candidates, the usual letter of the books first; where all of them are
taken the last letter of the last is doubled, F_x to FF_x, until it is free.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable

from derive.errors import NotDerivable
from derive.expression import PI, Expr, Symbol

UNDERSCORE = re.compile(r"_(?=.)")
NAMESAKE = "the sheet's own '{}' is also a name of this answer; choose another name for it"


def printed(name: str) -> str:
    """A name as it looks on the page, where I1 and I_1 are one."""
    return UNDERSCORE.sub("", name)


def free(taken: Collection[str], *candidates: str, indices: Iterable[str] = ("",)) -> str:
    """The first candidate that stands for nothing else, alone or with any of the `indices` behind it."""
    looks, ends = {*map(printed, taken)}, tuple(indices)
    pending = list(candidates)
    for name in pending:
        if not any(printed(name + end) in looks for end in ends):
            return name
        if name == pending[-1]:
            stem, mark, index = name.partition("_")
            pending.append(f"{stem}{stem[-1]}{mark}{index}")
    raise ValueError("a name has no candidate")


def named(usual: str, value: Expr, taken: Collection[str]) -> Symbol:
    """What a given quantity is called: as its author calls it, else by its usual name, with a mark where the
    author means something else by that."""
    if isinstance(value, Symbol) and value != PI:
        return value
    return Symbol(free(taken, usual, f"{usual}_g"))


def require_free(taken: Collection[str], *names: str) -> None:
    """Raises NotDerivable where the author means something else by one of the names of an answer."""
    if clash := sorted({*names} & {*taken}):
        raise NotDerivable(NAMESAKE.format(clash[0]))


def entry_symbol(letter: str, *indices: int) -> Symbol:
    """d_12, c_121; with an index of two digits d_1,11: without commas c_1111 would be three symbols."""
    between = "" if all(index < 10 for index in indices) else ","
    return Symbol(f"{letter}_{between.join(map(str, indices))}")


def pose_entries(taken: Collection[str], known: bool = False) -> dict[tuple[int, int], Symbol]:
    """The rotation r_11, ... and the position p_x, p_y, p_z of a pose, by row and column from 0; by other
    letters where these stand for something else, and t_11, ... t_34 where r_11, ... are `known` values."""
    if known:
        places = {(i, j): f"_{i + 1}{j + 1}" for i in range(3) for j in range(4)}
        letter = free(taken, "t", "h", indices=places.values())
        return {place: Symbol(letter + end) for place, end in places.items()}
    turn = {(i, j): f"_{i + 1}{j + 1}" for i in range(3) for j in range(3)}
    shift = {(i, 3): f"_{axis}" for i, axis in enumerate("xyz")}
    r, p = free(taken, "r", "R", indices=turn.values()), free(taken, "p", "P", indices=shift.values())
    named = [(place, r + end) for place, end in turn.items()]
    named += [(place, p + end) for place, end in shift.items()]
    return {place: Symbol(name) for place, name in named}
