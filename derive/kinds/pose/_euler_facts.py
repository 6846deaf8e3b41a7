"""What the words read of three angles that are read off a rotation matrix, beside the steps."""

from __future__ import annotations

from typing import TypeAlias

from derive.derivation import PageFacts, Phrase, Record
from derive.expression import Expr, Symbol

Equation: TypeAlias = tuple[Expr, Expr]


class Regular(Record):
    sign: int
    steps: tuple[str, ...]


class Case(Record):
    """A singular case."""

    matrix: str  # a step
    determined: str  # a step
    sum: Expr  # of the outer angles
    middle: Equation
    entry: Equation
    relations: tuple[Equation, Equation]


class Entries(Record):
    middle: Equation
    pairs: tuple[tuple[Equation, ...], ...]  # of the first and the last angle
    size: Expr  # of g


class Facts(PageFacts):
    rotation: Symbol
    order: Phrase  # in which the rotations are multiplied
    first: Symbol
    middle: Symbol
    last: Symbol
    entries: Entries | None  # where they determine the angles
    g: Expr  # vanishes in the singular cases
    branches: tuple[Regular, ...]
    cases: tuple[Case, ...]
    free: Phrase | None  # what is left open in these
    chosen: tuple[Equation, ...] = ()  # of a rotation of numbers: the angles where the open one is zero
    turns: tuple[Symbol, ...] = ()  # names in angles that are told up to full turns
    same: tuple[Equation, ...] = ()  # angles of the subject that stand in its matrix just so
