"""Warnings about a whole problem: values that are angles in this subject, typed as if in degrees."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from derive.algebra.formulas.grammar import parse
from derive.algebra.formulas.likely_mistakes import doubtful_angle
from derive.algebra.formulas.tokens import tokens
from derive.algebra.formulas.units import ANY
from derive.errors import FormulaError, SheetError
from derive.expression import Call, Expr, Number, Product, Symbol, every, terms_of, walk
from derive.kinds.problem import expressions
from derive.mechanics.lagrangian import MovingBody
from derive.mechanics.motion import Move
from derive.mechanics.robot import DHRow, ScrewRow
from derive.sheet.source import At

POINTS = ("evaluate", "start", "at")  # options of questions that give names their values
CIRCULAR = ("cos", "sin", "tan")


def doubts_about(values: At, key: str, angles: frozenset[str]) -> Iterator[SheetError]:
    """What is strange about the values of angles in a mapping under a key."""
    given = values.value((key,))
    for name, typed in given.items() if isinstance(given, dict) else ():
        if not isinstance(typed, str) or tokens(name)[0].text not in angles:
            continue
        try:
            strange = doubtful_angle(typed, parse(typed, dimension=ANY))
        except FormulaError:  # an option of this name that is no point
            continue
        if strange:
            place = values.place((key, name), strange.offset)
            yield SheetError(strange.message, place, strange.hint)


def angles_of(subject: Any) -> frozenset[str]:
    """The names that are angles in a subject: those turned by, and those inside sines and cosines."""
    turned = [tree for part in every(subject) for tree in _turned(part)]
    inside = [
        argument
        for tree in expressions(subject)
        for node in walk(tree)
        if isinstance(node, Call) and node.function in CIRCULAR
        for argument in node.arguments
    ]
    return frozenset(name for tree in (*turned, *inside) for name in _names(tree))


def _turned(part: Any) -> tuple[Expr | None, ...]:
    """The angles of one part of a subject."""
    match part:
        case Move("rotate", _, by):
            return (by,)
        case DHRow(theta, _, _, alpha):
            return (theta, alpha)
        case ScrewRow(by=by, slide=False):
            return (by,)
        case MovingBody(angle=angle):
            return (angle,)
    return ()


def _names(tree: Expr | None) -> Iterator[str]:
    """The names that are themselves terms of an angle, or multiples of one: no speed times the time."""
    for term in terms_of(tree) if tree else ():
        match term:
            case Symbol(name) | Product((Number(), Symbol(name))):
                yield name
