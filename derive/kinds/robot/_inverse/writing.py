"""What a plan of sub-problems found, written as a person would on the board."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from derive.algebra.angles import Form
from derive.derivation import Step
from derive.expression import ONE, Symbol, add, is_negative, negate
from derive.kinds.robot._inverse import pairs, single, squares
from derive.kinds.robot._inverse.board import Board, Draft
from derive.kinds.robot._inverse.moves import Move, Option, shares
from derive.kinds.robot._inverse.trees import over
from derive.mechanics.inverse.search import Found, Stage
from derive.mechanics.inverse.slide import Slide
from derive.mechanics.inverse.squares import Elbow, Reach
from derive.mechanics.inverse.trigonometric import OneEquation, TwoEquations


def write(board: Board, stage: Stage, found: Found, facts: Mapping[str, Any]) -> None:
    """The next move on the board, the names it needs before it."""
    match found:
        case TwoEquations():
            move = pairs.write(board, found)
        case OneEquation(angle, row):
            move = single.write(board, angle, row, stage)
        case Elbow():
            move = squares.elbow(board, found)
        case Reach():
            move = squares.reach(board, found)
        case Slide():
            move = slide(board, found)
    _learn(board, move, {**facts, **move.facts, "unknown": move.head})


def slide(board: Board, found: Slide) -> Move:
    """slope d = value."""
    draft, d = Draft(board), Symbol(found.slide)
    fixed = not any(not name.startswith("sqrt(") for name in found.slope.generators())
    amount = found.value / found.slope if fixed else found.value
    slope = ONE if fixed else draft.short(found.slope)
    shown = board.tree(found.equation.left), board.tree(found.equation.right)
    result = over(board.tree(amount), slope)
    if d not in shown or result not in shown:
        draft.equation(*shown)
    facts = {"method": "slide", "unless": board.may_vanish(slope)}
    return draft.move(found.slide, d, [Option(result)], facts)


def _learn(board: Board, move: Move, facts: Mapping[str, Any]) -> None:
    """The move is made: joints and signs it decides are known from now on."""
    chosen = move.chosen
    left: list[Step] = []
    if isinstance(move.of, Form):
        left = _differences(board, move.of)
        if chosen and move.trig:
            function = "sin" if facts["method"] == "cosine" else "cos"
            board.signs[f"{function}({move.of})"] = move.number
    elif chosen and facts.get("symmetric"):
        board.signs[move.of] = move.number
    orientation = board.goal.R is not None and None in board.goal.p
    told = {
        **facts,
        "target": "orientation" if orientation else "position",
        "differences": [step.name for step in left],
    }
    board.items.append(replace(move, steps=(*move.steps, *left), facts=told))


def _differences(board: Board, form: Form) -> list[Step]:
    """The joints that a sum determines together with those known before it."""
    before = board.determined()
    board.forms.append(form)
    fresh = [joint for joint in board.determined() if joint not in before]
    return [_difference(board, joint) for joint in fresh if Form.of({joint: 1}) not in board.forms]


def _difference(board: Board, joint: str) -> Step:
    """A joint angle as what is left of a sum."""
    weights = shares(joint, tuple(board.forms), board.turning) or ()
    parts = [(form, n) for form, n in zip(board.forms, weights, strict=True) if n]
    parts.sort(key=lambda part: (-len(part[0].parts), board.turning.index(part[0].parts[0][0])))
    terms = [board.angle(form) if n > 0 else negate(board.angle(form)) for form, n in parts]
    return Step(f"{joint}_left", (Symbol(joint), add(*sorted(terms, key=is_negative))), "difference")
