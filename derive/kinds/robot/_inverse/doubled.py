"""An equation in twice an angle, and the angle, written out."""

from __future__ import annotations

from fractions import Fraction

from derive.derivation import Phrase
from derive.expression import PI, ZERO, Degrees, Expr, Relation, Symbol, cos, multiply, number, sin
from derive.kinds.robot._inverse.facts import Method
from derive.kinds.robot._inverse.one_equation import general, opposite_directions, squares_of
from derive.kinds.robot._inverse.signs import opposite, square, times
from derive.kinds.robot._inverse.solving import Solving
from derive.kinds.robot._inverse.subproblem import Choice
from derive.mechanics.inverse.subproblems import Coordinate, DoubleAngle, HalfAngle

SIGNS = (1, -1)
HALF_TURN = 180


def double(solving: Solving, found: DoubleAngle) -> None:
    """The equations, their products, and these in twice the angle: two values."""
    readable, phi = solving.progress.tree, Symbol(found.unknown)
    for each in (*found.first, *found.second):
        solving.equation((readable(each.known), readable(each.unknown)))
    left, right = (_product(solving, pair) for pair in (found.first, found.second))
    solving.add("squares", left, times(solving.progress.tree(found.ratio), right))
    a, b, c = (solving.short(each) if each else ZERO for each in found.coefficients)
    angle = solving.progress.angle(found.angle)
    solving.add("twice", phi, number(2) * angle)
    solving.add("solved", times(a, cos(phi)) + times(b, sin(phi)), c)
    x, y = opposite(b), a
    values = opposite_directions(x, y) if c == ZERO else general(x, y, c, by_sines=True)
    bound = None if c == ZERO else Relation(squares_of(x, y), ">=", square(c))
    choices = [
        Choice(value, sign, Phrase("first-value" if sign > 0 else "second-value", {"angle": phi}))
        for value, sign in zip(values, SIGNS, strict=True)
    ]
    solving.solved(phi, choices, Method(name="double", bound=bound, half=angle))


def half(solving: Solving, found: HalfAngle) -> None:
    """Half of the angle, or that and half a turn."""
    angle, phi = solving.progress.angle(found.unknown), Symbol(found.double)
    degrees = solving.problem.style.degrees
    turn: Expr = Degrees(Fraction(HALF_TURN)) if degrees else PI
    values = (phi / number(2), phi / number(2) + turn)
    choices = [
        Choice(value, sign, Phrase("first-value" if sign > 0 else "second-value", {"angle": angle}))
        for value, sign in zip(values, SIGNS, strict=True)
    ]
    solving.solved(angle, choices, Method(name="half"))


def _product(solving: Solving, pair: tuple[Coordinate, Coordinate]) -> Expr:
    return multiply(*(solving.progress.tree(each.known) for each in pair))
