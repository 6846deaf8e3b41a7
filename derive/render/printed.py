"""What a page says in mathematics, with the trees it was printed from, for whoever reads it back."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from derive.errors import Place
from derive.expression import Expr, Relation
from derive.render.layout import Chain, Display, Link
from derive.render.notation import Notation


@dataclass(frozen=True, slots=True)
class Naming:
    """A matrix that is shown with names for its long entries, and what is said of each name. `head` is what
    the matrix is called."""

    head: Expr
    whole: Expr
    shown: Expr
    listed: tuple[tuple[Expr, Expr], ...]


@dataclass(frozen=True, slots=True)
class Printed:
    """A formula as it stands on a page, in the lines of a display or in one line of text; it says the chains
    side by side, in which entries of matrices may be named. One that was typed says none."""

    lines: tuple[str, ...]
    chains: tuple[Chain, ...]
    notation: Notation
    namings: tuple[Naming, ...] = ()
    evaluated: bool = True  # whether the numbers in it are those that were evaluated

    @classmethod
    def display(cls, display: Display, notation: Notation, namings: tuple[Naming, ...] = ()) -> Printed:
        """A display, as it was laid out."""
        return cls(display.lines, display.chains, notation, namings)

    @classmethod
    def inline(cls, latex: str, chain: Chain, notation: Notation) -> Printed:
        """A formula in a line of text."""
        return cls((latex,), (chain,), notation)


@dataclass(frozen=True, slots=True)
class Reading:
    """How many formulas of a page were read back and found right, those that could not be read, and how many
    its words have as they were typed."""

    read: int = 0
    unread: tuple[str, ...] = ()
    typed: int = 0


@dataclass(frozen=True, slots=True)
class Said:
    """The mathematics of one question, called as `1.2`; `place` is that of the question in its sheet."""

    question: str
    place: Place | None
    printed: tuple[Printed, ...]


Reader: TypeAlias = Callable[[Sequence[Said]], Reading]


def unread(said: Sequence[Said]) -> Reading:
    """Reads nothing: for a page that nobody is given."""
    return Reading()


def links_of(relation: Relation) -> Chain:
    """The trees of a relation with the signs before them."""
    left = relation.left
    before = links_of(left) if isinstance(left, Relation) else (Link("=", "", left),)
    return (*before, Link(relation.sign, "", relation.right))


def says(tree: Expr, latex: str) -> Chain:
    """A formula that is one tree."""
    return (Link("=", latex, tree),)
