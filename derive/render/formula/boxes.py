"""What a formula is made of when it is set: letters and signs, one beside, above or around the other."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

Kind: TypeAlias = Literal[
    "ordinary", "binary", "prefix", "relation", "opening", "closing", "punctuation", "large"
]


@dataclass(frozen=True, slots=True)
class Letter:
    """A letter that stands for something, in italics."""

    char: str


@dataclass(frozen=True, slots=True)
class Digits:
    """A number as typed, `0.25`."""

    text: str


@dataclass(frozen=True, slots=True)
class Word:
    """Upright text; an `operator` has room around as a function has, `cos`."""

    text: str
    operator: bool = False


@dataclass(frozen=True, slots=True)
class Sign:
    """A character that is no letter; how much room it has beside others is its kind."""

    char: str
    kind: Kind = "ordinary"


@dataclass(frozen=True, slots=True)
class Gap:
    """Room, in em."""

    em: float


@dataclass(frozen=True, slots=True)
class Row:
    """One after the other."""

    boxes: tuple[Box, ...]


@dataclass(frozen=True, slots=True)
class Scripts:
    """What stands below and above on the right of a base."""

    base: Box
    below: Box | None = None
    above: Box | None = None


@dataclass(frozen=True, slots=True)
class Fraction:
    """A fraction; its size is that of what is around unless it is said. A binomial has no bar."""

    above: Box
    below: Box
    size: Literal["", "display", "text"] = ""
    bar: bool = True


@dataclass(frozen=True, slots=True)
class Root:
    inside: Box
    degree: Box | None = None


@dataclass(frozen=True, slots=True)
class Fenced:
    """Between fences as tall as what they hold; "" for none."""

    opening: str
    inside: Box
    closing: str


@dataclass(frozen=True, slots=True)
class Accent:
    """A mark over a box, called as TeX calls it: `dot`, `vec`, `overline`."""

    mark: str
    over: Box


@dataclass(frozen=True, slots=True)
class Stacked:
    """Something small right over or under a base."""

    base: Box
    over: Box | None = None
    under: Box | None = None


@dataclass(frozen=True, slots=True)
class Styled:
    """Letters of another alphabet, or all in another size: `bold`, `cal`, `display`."""

    style: str
    inside: Box


@dataclass(frozen=True, slots=True)
class Grid:
    """Cells in rows: the entries of a matrix between its fences, or, `aligned`, equations on lines of their
    own that meet at their signs. `loose` rows have room for tall fractions."""

    rows: tuple[tuple[Box, ...], ...]
    opening: str = ""
    closing: str = ""
    aligned: bool = False
    loose: bool = False


Box: TypeAlias = (
    Letter | Digits | Word | Sign | Gap | Row | Scripts | Fraction | Root | Fenced | Accent | Stacked | Styled
    | Grid
)  # fmt: skip
