"""By lengths: the law of cosines at an elbow, the length of a sliding joint, and what is linear in one."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from functools import reduce
from math import lcm
from operator import add as add_values

from derive.algebra.rationals import as_fraction
from derive.algebra.scalar import Scalar
from derive.expression import (
    ONE,
    ZERO,
    Expr,
    Number,
    Power,
    Product,
    Relation,
    Symbol,
    add,
    cos,
    multiply,
    number,
    sin,
    sqrt,
    terms_of,
)
from derive.expression import replace as put_in
from derive.kinds.robot._inverse.facts import Method
from derive.kinds.robot._inverse.one_equation import SIGNS, of_sign, solve
from derive.kinds.robot._inverse.signs import (
    begins_negative,
    leaves,
    opposite,
    ordered,
    over,
    square,
    times,
    total,
)
from derive.kinds.robot._inverse.solving import Solving
from derive.kinds.robot._inverse.subproblem import Choice
from derive.mechanics.inverse.subproblems import Coordinate, Elbow, Reach, Slide, TrigEquation


def elbow(solving: Solving, found: Elbow) -> None:
    """The sum of squares in one angle, which is then one equation in it."""
    readable, q = solving.problem.readable, solving.progress.angle(found.unknown)
    if found.across:
        squares = list(terms_of(_as_they_stand(solving, found.coordinates, found.across)))
    else:
        squares = [square(side) for side in _known_sides(solving, found.coordinates)]
    row, common = _reduced(found.row)
    rest = terms_of(readable(-row.c))
    cosine, sine = (readable(each * common) for each in (row.a, row.b))
    solving.add("squares", total(squares), add(*rest, times(cosine, cos(q)), times(sine, sin(q))))
    c = _without(squares, rest, readable(common))
    a, b = (solving.short(each) if each else ZERO for each in (row.a, row.b))
    if row.a and row.b:
        c = solving.name(c)
    solve(solving, found.unknown, (a, b, c), row)


def reach(solving: Solving, found: Reach) -> None:
    """The sum of squares in one displacement."""
    progress, d = solving.progress, Symbol(found.unknown)
    squares = [square(side) for side in _known_sides(solving, found.coordinates)]
    P, Q, D = (solving.problem.readable(v) for v in (found.square, found.linear, found.constant))
    solving.add("squares", total(squares), add(times(P, d**2), times(Q, d), *terms_of(D)))
    rest = total((*squares, *map(opposite, terms_of(D))))
    values: tuple[Expr, Expr]
    signed_part: Expr
    if not found.linear:
        size, signed_part = sqrt(over(rest, P)), d
        values = (size, -size)
    else:
        half, middle = found.linear / 2, found.square * Scalar.symbol(d.name) + found.linear / 2
        h = solving.problem.readable(half)
        known = reduce(add_values, (each.known * each.known for each in found.coordinates))
        alone = P == ONE  # then what is subtracted on both sides of the root goes out
        whole = total(_cancelled((square(h), *terms_of(rest)))) if alone else square(h) + multiply(P, rest)
        rest = min(
            whole,
            progress.tree(half * half + found.square * (known - found.constant)),
            key=leaves,
        )
        values = (over(ordered(opposite(h) + sqrt(rest)), P), over(opposite(h) - sqrt(rest), P))
        signed_part = progress.tree(middle)
        progress.sums.append((middle, len(progress.solved)))
    choices = [Choice(v, sign, of_sign(signed_part, sign)) for v, sign in zip(values, SIGNS, strict=True)]
    positive = not found.linear and solving.problem.assumptions.get(d.name) in ("positive", "nonnegative")
    method = Method(name="reach", positive=positive, bound=_doubtful(rest))
    solving.solved(d, choices[:1] if positive else choices, method)


def slide(solving: Solving, found: Slide) -> None:
    """slope d = value."""
    progress, d = solving.progress, Symbol(found.unknown)
    shown = progress.tree(found.equation.left), progress.tree(found.equation.right)
    result, slope = slid(solving, found)
    if d not in shown or result not in shown:
        solving.equation(shown)
    else:
        solving.equations.append(shown)
    solving.solved(d, [Choice(result)], Method(name="slide", unless=progress.may_vanish(slope)))


def slid(solving: Solving, found: Slide) -> tuple[Expr, Expr]:
    """The displacement, and by what it is divided."""
    progress = solving.progress
    fixed = not any(not name.startswith("sqrt(") for name in found.slope.generators())
    amount = found.value / found.slope if fixed else found.value
    slope = ONE if fixed else solving.short(found.slope)
    return over(ordered(put_in(progress.tree(amount), progress.by_name)), slope), slope


def _known_sides(solving: Solving, coordinates: Iterable[Coordinate]) -> list[Expr]:
    """The known side of each equation, with a step that says what it equals."""
    progress, sides = solving.progress, list[tuple[Expr, Expr]]()
    for each in coordinates:
        turn = begins_negative(progress.known_as(each.known) or progress.tree(each.known))
        value, unknown = (-each.known, -each.unknown) if turn else (each.known, each.unknown)
        sides.append((solving.short(value), solving.problem.readable(unknown)))
    solving.equation(*sides)
    return [known for known, _ in sides]


def _as_they_stand(solving: Solving, coordinates: Iterable[Coordinate], square: Scalar) -> Expr:
    """The sum of the squares of the known sides, after the equations as they are."""
    readable = solving.problem.readable
    solving.equation(*((readable(each.unknown), readable(each.known)) for each in coordinates))
    return readable(square)


def _cancelled(terms: Iterable[Expr]) -> list[Expr]:
    """Without those that stand there with either sign."""
    found: list[Expr] = []
    for term in terms:
        if (other := opposite(term)) in found:
            found.remove(other)
        else:
            found.append(term)
    return found


def _doubtful(rest: Expr) -> Relation | None:
    """That what stands under a root is not negative; nothing to say of a sum of squares."""
    squares = all(isinstance(term, Power) and term.exponent == number(2) for term in terms_of(rest))
    return None if squares else Relation(rest, ">=", ZERO)


def _reduced(row: TrigEquation) -> tuple[TrigEquation, Scalar]:
    """The coefficients without their common factor, and that factor."""
    one = Scalar.of(1)
    if not (row.a and row.b):
        return replace(row, a=one if row.a else row.a, b=one if row.b else row.b), row.a or row.b
    common = Scalar(row.a.ring, row.a.numerator.gcd(row.b.numerator))
    if (row.a / common).constant is None and (row.b / common).constant is None:
        common = common * abs(as_fraction((row.a / common).numerator.leading_coefficient()))
    return replace(row, a=row.a / common, b=row.b / common), common


def _without(squares: Sequence[Expr], rest: Sequence[Expr], common: Expr) -> Expr:
    """(the squares less the constant terms) / the common factor, without fractions in fractions."""
    n = _common_denominator((*rest, common))
    top = total(
        (*(_multiplied(n, each) for each in squares), *(opposite(_multiplied(n, each)) for each in rest))
    )
    return over(top, _multiplied(n, common))


def _common_denominator(trees: Iterable[Expr]) -> int:
    """What makes the fractions in front of these whole; 1 where they are decimals."""
    found = [tree.factors[0] if isinstance(tree, Product) else tree for tree in trees]
    fractions = [each for each in found if isinstance(each, Number)]
    if any(each.decimal for each in fractions):
        return 1
    return lcm(*(each.value.denominator for each in fractions)) if fractions else 1


def _multiplied(n: int, tree: Expr) -> Expr:
    """n times a term, numbers worked out."""
    match tree:
        case _ if n == 1:
            return tree
        case Number(value, decimal):
            return Number(value * n, decimal)
        case Product((Number(value, decimal), *rest)):
            return multiply(Number(value * n, decimal), *rest)
        case _:
            return multiply(number(n), tree)
