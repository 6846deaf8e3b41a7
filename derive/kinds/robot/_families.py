"""What the words say once of all things of a sort: the ways r_1, r_2, r_3 are told as r_i."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from string import digits

from derive.derivation import Phrase
from derive.expression import Expr, Indexed, Symbol

I = Symbol("i")


def said_of_each(keys: Mapping[str, str], names: Iterable[Expr]) -> tuple[Phrase, ...]:
    """The phrase of each letter among these names, which is told with the index i, in their order."""
    sorts = dict.fromkeys(map(_sort, names))
    return tuple(Phrase(keys[letter.rstrip("_")], {"name": name}) for letter, name in sorts)


def of_each(base: str) -> Indexed:
    """MX_i."""
    return Indexed(base, (I,))


def _sort(name: Expr) -> tuple[str, Expr]:
    """The letter of a name and what it is with the index i; one without a number is called as it is."""
    match name:
        case Indexed(base, _):
            return base, of_each(base)
        case Symbol(written):
            stem = written.rstrip(digits)
            if stem == written:  # k_e, of the end-effector
                return written.partition("_")[0], name
            return stem, Symbol(f"{stem}{I.name}")
    raise TypeError(f"{name} is no name")
