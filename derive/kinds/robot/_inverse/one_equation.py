"""One equation in one angle, a cos q + b sin q = c, written out: two values."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace

from derive.algebra.angles import Form
from derive.algebra.infix import text
from derive.algebra.normal import normal, trig_of
from derive.algebra.rationals import significant_digits
from derive.algebra.scalar import Scalar
from derive.algebra.solving.fixed_directions import direction, sum_of_squares
from derive.derivation import Condition, Phrase
from derive.expression import (
    ONE,
    ZERO,
    Approximate,
    Expr,
    Number,
    Relation,
    add,
    atan2,
    cos,
    is_negative,
    rebuild,
    sin,
    sqrt,
    subtract,
    terms_of,
)  # fmt: skip
from derive.kinds.robot._inverse.facts import Method, zero
from derive.kinds.robot._inverse.progress import Progress
from derive.kinds.robot._inverse.signs import opposite, over, signed, square, times, total, unsigned
from derive.kinds.robot._inverse.solving import Solving
from derive.kinds.robot._inverse.subproblem import Choice
from derive.mechanics.inverse.paul import Equation
from derive.mechanics.inverse.search import Stage
from derive.mechanics.inverse.subproblems import Elbow, OneEquation, TrigEquation

SIGNS = (1, -1)
LONG_CONDITION = 60  # letters
LONG_FRACTION = 1000  # denominator
MANY = 4  # digits, more than a page has
Trees = tuple[Expr, Expr, Expr]  # of a, b, c


def write(solving: Solving, found: OneEquation, stage: Stage) -> None:
    """The equation as it is read, and its two solutions."""
    progress = solving.progress
    row = _scaled(found.row)
    row = min((row, row.negated()), key=lambda r: min(_by_sines(progress, r), _by_cosines(progress, r)))
    a, b, c = (solving.short(value) if value else ZERO for value in (row.a, row.b, row.c))
    solving.equation(_as_read(progress, found, (a, b, c)))
    solve(solving, found.unknown, (a, b, c), row, _length(solving, found.row, stage))


def _scaled(row: TrigEquation) -> TrigEquation:
    """With the coefficient one, where cosine or sine stands alone and has a number before it."""
    alone = row.a or row.b
    if (row.a and row.b) or any(not name.startswith("sqrt(") for name in alone.generators()):
        return row
    return replace(row, a=row.a / alone, b=row.b / alone, c=row.c / alone)


def _as_read(progress: Progress, found: OneEquation, trees: Trees) -> tuple[Expr, Expr]:
    """The known side and the other; as they stand where the angle is on the side of the known pose."""
    a, b, c = trees
    equation: Equation = found.row.equation
    if any(equation.left.diff(atom) for atom, _ in found.unknown.parts):
        return progress.tree(equation.left), progress.tree(equation.right)
    q = progress.angle(found.unknown)
    return c, times(a, cos(q)) + times(b, sin(q))


def _length(solving: Solving, row: TrigEquation, stage: Stage) -> Expr | None:
    """sqrt(k1^2 + k2^2) of the other two entries in the row or column of a rotation matrix whose third entry
    is, up to its sign, the cosine or sine: the size of the other function."""
    alone = row.a if row.b == 0 else row.b
    if row.equation.is_position or alone.constant not in (1, -1) or (row.a and row.b):
        return None
    entries = {one.equation.place: one.equation for one in stage.equations}
    between, i, j = row.equation.place
    lines = ([(between, i, k) for k in range(3) if k != j], [(between, k, j) for k in range(3) if k != i])
    sides = [[entries[place].left for place in line] for line in lines if all(p in entries for p in line)]
    determined = solving.progress.determined()
    open_ones = [name for name in solving.progress.turning if name not in determined]
    known = [line for line in sides if not any(value.diff(name) for value in line for name in open_ones)]
    if not known:
        return None
    line = min(known, key=lambda values: sum(len(v.numerator) for v in values))
    return sqrt(total(map(square, map(solving.short, line))))


def solve(solving: Solving, angle: Form, trees: Trees, row: TrigEquation, length: Expr | None = None) -> None:
    """The two solutions by the form of the equation; `row` holds a and b, `trees` also c, which is zero only
    where it is written so."""
    if row.b == 0 or row.a == 0:
        _alone(solving, angle, trees, row, length)
    else:
        _both(solving, angle, trees, row)


def _both(solving: Solving, angle: Form, trees: Trees, row: TrigEquation) -> None:
    """Two opposite directions where c is zero; else the sine or the cosine of a difference."""
    progress, q = solving.progress, solving.progress.angle(angle)
    a, b, c = trees
    by_sines = _by_sines(progress, row) <= _by_cosines(progress, row)
    x, y = (opposite(b), a) if c == ZERO or by_sines else (a, b)
    if c == ZERO:
        values = opposite_directions(x, y)
        method = Method(name="zero", unless=zero(*dict.fromkeys((unsigned(b), unsigned(a)))))
    else:
        values = general(x, y, c, by_sines)
        if isinstance(solving.found, Elbow):
            solving.add("form", times(a, cos(q)) + times(b, sin(q)), c)
        method = Method(name="general", bound=Relation(_short(squares_of(x, y)), ">=", square(c)))
    told = shortened(progress.tree(_sided(row, q)))
    sides = [_side(progress, q, row, sign) for sign in SIGNS]
    choices = [Choice(v, s, when, told=told) for v, s, when in zip(values, SIGNS, sides, strict=True)]
    solving.solved(q, choices, method)


def opposite_directions(x: Expr, y: Expr) -> tuple[Expr, Expr]:
    """That of a point, and that away from it."""
    return direction(y, x), direction(opposite(y), opposite(x))


def _alone(solving: Solving, angle: Form, trees: Trees, row: TrigEquation, length: Expr | None) -> None:
    """cos q = u or sin q = u: q by the sign of the other function."""
    q, even = solving.progress.angle(angle), row.b == 0
    u = over(trees[2], trees[0] if even else trees[1])
    own, other = (cos(q), sin(q)) if even else (sin(q), cos(q))
    plain = any(step.chain == (u, own) for step in solving.steps)
    if not plain:
        solving.add("solved", own, u)
    choices: list[Choice] = []
    shown: list[Choice] = []
    trig: dict[int, dict[Expr, Expr]] = {}
    for sign in SIGNS:
        when = of_sign(q if even else cos(q), sign)
        value, page = (signed(sign, length or sqrt(ONE - square(each))) for each in (u, own))
        whole = list(_without_fraction(solving.progress, row, trees, sign, when))
        choices += whole or [Choice(_angle(u, value, even), sign, when)]
        shown.append(Choice(_angle(own, page, even), sign, when))
        trig[sign] = {own: u, other: value}
    coefficient = trees[0] if even else trees[1]
    bound = None if length else _within_reach(solving.progress, coefficient, trees[2])
    method = Method(
        name="cosine" if even else "sine",
        unless=solving.progress.may_vanish(coefficient),
        exists=None if length or bound else u if plain else own,
        bound=bound,
        by_length=length is not None,
    )
    solving.solved(q, choices, method, shown, trig)


def _within_reach(progress: Progress, a: Expr, c: Expr) -> Relation | None:
    """That c^2 is at most a^2, where a is the length of a joint and was found as a root: in what is given,
    which says that the root is real too."""
    found = progress.reached(unsigned(a))
    if found is None or found[0].facts.method.bound is None:
        return None
    solved, inside = found
    terms = terms_of(progress.problem.readable(normal(inside) - normal(c) ** 2))
    more, less = ([t for t in terms if is_negative(t) == sign] for sign in (False, True))
    if not (more and less):
        return None
    progress.implied(solved)
    return Relation(add(*more), ">=", add(*map(opposite, less)))


def _without_fraction(
    progress: Progress, row: TrigEquation, trees: Trees, sign: int, when: Condition
) -> Iterator[Choice]:
    """For each sign of the coefficient, where those are known: a cos q = c is q = atan2(sqrt(a^2 - c^2), c)
    for a positive a."""
    even = row.b == 0
    a, c = trees[0] if even else trees[1], trees[2]
    positive, earlier = progress.sign_of(row.a if even else row.b)
    if not positive or isinstance(a, Number):
        return
    root = signed(sign, sqrt(square(a) - square(c)))
    for each in SIGNS if earlier else (1,):
        value = _angle(c if positive * each > 0 else opposite(c), root, even)
        yield Choice(value, sign, when, earlier, each)


def _angle(own: Expr, other: Expr, even: bool) -> Expr:
    return atan2(other, own) if even else atan2(own, other)


def general(x: Expr, y: Expr, c: Expr, by_sines: bool) -> tuple[Expr, Expr]:
    """By the sine of a difference, as Craig does, or by its cosine."""
    squares = squares_of(x, y)
    whole = isinstance(squares, Number)
    root = sqrt(squares - square(c) if whole else total((square(x), square(y), -square(c))))
    if by_sines:
        bare = unsigned(c)
        join = subtract if bare == c else add
        plus, less = (join(direction(y, x), atan2(bare, signed(sign, root))) for sign in SIGNS)
    else:
        plus, less = (direction(y, x) + signed(sign, atan2(root, c)) for sign in SIGNS)
    return plus, less


def squares_of(x: Expr, y: Expr) -> Expr:
    """x^2 + y^2."""
    found = sum_of_squares(y, x)
    return total((square(x), square(y))) if found is None else found


def shortened(tree: Expr) -> Expr:
    """With its numbers of many digits as a page rounds them; 0.0823 stays as it is."""
    if isinstance(tree, Number) and (significant_digits(tree.value) or MANY) < MANY:
        return tree
    short = _short(tree)
    return rebuild(tree, shortened) if short is tree else short


def _short(tree: Expr) -> Expr:
    """A number of many digits as a page rounds it."""
    if isinstance(tree, Number) and tree.value.denominator > LONG_FRACTION:
        return Approximate(float(tree.value))
    return tree


def _by_sines(progress: Progress, row: TrigEquation) -> int:
    return progress.minuses(row.a, -row.b) if row.a and row.b else progress.minuses(row.a, row.b, row.c)


def _by_cosines(progress: Progress, row: TrigEquation) -> int:
    return progress.minuses(row.b, row.a, row.c)


def of_sign(tree: Expr, sign: int) -> Relation:
    """That it is positive, or negative."""
    return Relation(tree, ">" if sign > 0 else "<", ZERO)


def _side(progress: Progress, q: Expr, row: TrigEquation, sign: int) -> Condition:
    """Which of two angles: the sign of a sin q - b cos q, where that is short."""
    names = {symbol.name: value for symbol, value in progress.named}
    tree = progress.problem.readable(_sided(row, q).substitute(names))
    if len(written := text(tree)) <= LONG_CONDITION and not re.search(r"\d{5}", written):
        return of_sign(tree, sign)
    return Phrase("first-value" if sign > 0 else "second-value", {"angle": q})


def _sided(row: TrigEquation, q: Expr) -> Scalar:
    """a sin q - b cos q, which is positive for one of the two angles."""
    c, s = trig_of(normal(q))
    return row.a * s - row.b * c
