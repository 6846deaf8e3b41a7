"""One equation in one angle, a cos q + b sin q = c, written out: two values."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from derive.algebra.angles import Form
from derive.algebra.infix import text
from derive.algebra.normal import normal, trig_of
from derive.algebra.solving.fixed_directions import direction, sum_of_squares
from derive.expression import (
    ONE,
    ZERO,
    Expr,
    Number,
    add,
    atan2,
    cos,
    is_negative,
    negate,
    sin,
    sqrt,
    subtract,
)  # fmt: skip
from derive.kinds.robot._inverse.board import Board, Draft
from derive.kinds.robot._inverse.moves import Move, Option
from derive.kinds.robot._inverse.trees import length, minus, over, signed, square, times, total, unsigned
from derive.mechanics.inverse.equation import Equation
from derive.mechanics.inverse.search import Stage
from derive.mechanics.inverse.trigonometric import Row

SIGNS = (1, -1)
LONG_CONDITION = 60  # letters
Trees = tuple[Expr, Expr, Expr]  # of a, b, c


def write(board: Board, angle: Form, row: Row, stage: Stage) -> Move:
    """The equation as it is seen, and its two solutions."""
    draft, seen = Draft(board), row
    row = min(
        (_scaled(row), _scaled(row).negated()), key=lambda r: min(_by_sines(board, r), _by_cosines(board, r))
    )
    a, b, c = (draft.short(value) if value else ZERO for value in (row.a, row.b, row.c))
    draft.equation(*_as_seen(board, row.equation, angle, (a, b, c)))
    size = _size(draft, seen, stage)
    return solved(draft, angle, (a, b, c), row, size=size, zero=not row.c)


def _scaled(row: Row) -> Row:
    """With the coefficient one, where cosine or sine stands alone and has a number before it."""
    alone = row.a or row.b
    if (row.a and row.b) or any(not name.startswith("sqrt(") for name in alone.generators()):
        return row
    return replace(row, a=row.a / alone, b=row.b / alone, c=row.c / alone)


def _as_seen(board: Board, equation: Equation, angle: Form, trees: Trees) -> tuple[Expr, Expr]:
    """The known side and the other; as they stand in the view where the angle is on the known pose's side."""
    a, b, c = trees
    if any(equation.left.diff(atom) for atom, _ in angle.parts):
        return board.tree(equation.left), board.tree(equation.right)
    q = board.angle(angle)
    return c, add(times(a, cos(q)), times(b, sin(q)))


def _size(draft: Draft, row: Row, stage: Stage) -> Expr | None:
    """sqrt(k1^2 + k2^2) of the other two entries in the row or column of a rotation matrix whose third entry
    is, up to its sign, the cosine or sine: the size of the other function."""
    alone = row.a if row.b == 0 else row.b
    if row.equation.is_position or alone.constant not in (1, -1) or (row.a and row.b):
        return None
    entries = {one.equation.place: one.equation for one in stage.equations}
    view, i, j = row.equation.place
    lines = ([(view, i, k) for k in range(3) if k != j], [(view, k, j) for k in range(3) if k != i])
    sides = [[entries[place].left for place in line] for line in lines if all(p in entries for p in line)]
    open_ones = [name for name in draft.board.turning if name not in draft.board.determined()]
    known = [line for line in sides if not any(value.diff(name) for value in line for name in open_ones)]
    if not known:
        return None
    line = min(known, key=lambda values: sum(len(v.numerator) for v in values))
    return length(*map(draft.short, line))


def solved(
    draft: Draft, angle: Form, trees: Trees, row: Row, size: Expr | None = None, zero: bool = False,
    extra: Mapping[str, Any] | None = None,
) -> Move:  # fmt: skip
    """The two solutions by the form of the equation; `row` holds a and b, `trees` also c."""
    if row.b == 0 or row.a == 0:
        return _alone(draft, angle, trees, row, size, extra or {})
    q = draft.board.angle(angle)
    a, b, c = trees
    x, y = (minus(b), a) if zero or _sines(draft.board, row) else (a, b)
    values: tuple[Expr, Expr]
    if zero:
        values = (direction(y, x), direction(minus(y), minus(x)))
        facts: dict[str, Any] = {"method": "zero", "both": [unsigned(b), unsigned(a)]}
    else:
        values = _general(x, y, c, _sines(draft.board, row))
        facts = {"method": "general", "least": _squares(x, y), "c": square(c)}
        facts["form"] = (add(times(a, cos(q)), times(b, sin(q))), c) if extra else None
    options = [
        Option(value, sign, _side(draft.board, q, row, sign))
        for value, sign in zip(values, SIGNS, strict=True)
    ]
    return draft.move(angle, q, options, {**facts, **(extra or {})})


def _alone(
    draft: Draft, angle: Form, trees: Trees, row: Row, size: Expr | None, extra: Mapping[str, Any]
) -> Move:
    """cos q = u or sin q = u: q by the sign of the other function."""
    q, even = draft.board.angle(angle), row.b == 0
    u = over(trees[2], trees[0] if even else trees[1])
    own, other = (cos(q), sin(q)) if even else (sin(q), cos(q))
    plain = draft.holds(u, own)
    if not plain:
        draft.add("solved", own, u)
    options, shown = [], []
    trig: dict[int, dict[Expr, Expr]] = {}
    for sign in SIGNS:
        when = f"{text(q if even else cos(q))} {'>' if sign > 0 else '<'} 0"
        value, page = (signed(sign, size or sqrt(subtract(ONE, square(each)))) for each in (u, own))
        options += _options(draft.board, row, trees, sign, when) or [
            Option(_angle(u, value, even), sign, when)
        ]
        shown.append(Option(_angle(own, page, even), sign, when))
        trig[sign] = {own: u, other: value}
    facts = {
        "method": "cosine" if even else "sine",
        "exists": u if plain else own,
        "sizes": size is not None,
        **extra,
    }
    return draft.move(angle, q, options, facts, shown, trig)


def _options(board: Board, row: Row, trees: Trees, sign: int, when: str) -> list[Option]:
    """Without a fraction, for each sign of the coefficient, where those are known: a cos q = c is
    q = atan2(sqrt(a^2 - c^2), c) for a positive a."""
    even = row.b == 0
    a, c = trees[0] if even else trees[1], trees[2]
    positive, earlier = board.sign_of(row.a if even else row.b)
    if not positive or isinstance(a, Number):
        return []
    root = signed(sign, sqrt(subtract(square(a), square(c))))
    values = [(each, _angle(c if positive * each > 0 else minus(c), root, even)) for each in SIGNS]
    if not earlier:
        return [Option(value, sign, when) for each, value in values if each > 0]
    return [Option(value, sign, when, earlier, each) for each, value in values]


def _angle(own: Expr, other: Expr, even: bool) -> Expr:
    return atan2(other, own) if even else atan2(own, other)


def _general(x: Expr, y: Expr, c: Expr, by_sines: bool) -> tuple[Expr, Expr]:
    """By the sine of a difference, as Craig does, or by its cosine."""
    squares = _squares(x, y)
    whole = isinstance(squares, Number)
    root = sqrt(subtract(squares, square(c)) if whole else total((square(x), square(y), negate(square(c)))))
    if by_sines:
        join = add if is_negative(c) else subtract
        plus, less = (join(direction(y, x), atan2(unsigned(c), signed(sign, root))) for sign in SIGNS)
    else:
        plus, less = (add(direction(y, x), signed(sign, atan2(root, c))) for sign in SIGNS)
    return plus, less


def _squares(x: Expr, y: Expr) -> Expr:
    """x^2 + y^2."""
    found = sum_of_squares(y, x)
    return total((square(x), square(y))) if found is None else found


def _sines(board: Board, row: Row) -> bool:
    return _by_sines(board, row) <= _by_cosines(board, row)


def _by_sines(board: Board, row: Row) -> int:
    return board.minuses(row.a, -row.b) if row.a and row.b else board.minuses(row.a, row.b, row.c)


def _by_cosines(board: Board, row: Row) -> int:
    return board.minuses(row.b, row.a, row.c)


def _side(board: Board, q: Expr, row: Row, sign: int) -> str:
    """Which of two angles: the sign of a sin q - b cos q, where that is short."""
    c, s = trig_of(normal(q))
    names = {symbol.name: value for symbol, value in board.named}
    condition = text(board.problem.readable((row.a * s - row.b * c).substitute(names)))
    if len(condition) <= LONG_CONDITION and not re.search(r"\d{5}", condition):
        return f"{condition} {'>' if sign > 0 else '<'} 0"
    return f"{'first' if sign > 0 else 'second'} value of {text(q)}"
