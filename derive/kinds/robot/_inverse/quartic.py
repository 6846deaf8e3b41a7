"""Pieper's quartic, written out: a distance and a height, squared and added; a tangent of half an angle."""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce
from operator import add as add_values

from derive.algebra.angles import Form
from derive.algebra.normal import normal
from derive.algebra.scalar import Scalar
from derive.derivation import Phrase
from derive.expression import (
    ONE,
    ZERO,
    Call,
    Expr,
    Symbol,
    add,
    cos,
    factors_of,
    multiply,
    number,
    sin,
    sqrt,
    terms_of,
)
from derive.kinds.robot._inverse.facts import Method, Polynomial
from derive.kinds.robot._inverse.signs import begins_negative, leaves, opposite, over, square, times, total
from derive.kinds.robot._inverse.solving import Solving
from derive.kinds.robot._inverse.subproblem import Choice
from derive.mechanics.inverse.subproblems import Quartic, TrigEquation

SHORT = 6  # likewise without a name, where it falls apart
LONGEST = 24  # names and numbers in a coefficient of the polynomial that is still written
Linear = tuple[Scalar, Scalar, Scalar]  # of 1, the cosine and the sine of the unknown


def write(solving: Solving, found: Quartic) -> None:
    """The steps, and the angle by the root."""
    q, second = (solving.progress.angle(each) for each in (found.unknown, found.second))
    u = Symbol(found.root)
    _distance_and_height(solving, found)
    rows = found.distance, found.turned
    sides = [_linear(solving, row.c, found.unknown) for row in rows]
    arms = [_linear(solving, each, found.unknown) for each in (rows[0].a, rows[0].b) if each]
    for side, row in zip(sides, rows, strict=True):
        left, right = _in_angle(solving, side, q), _turning(solving, row, found.unknown, second)
        solving.add("split", *((opposite(left), opposite(right)) if begins_negative(left) else (left, right)))
    solving.add("joined", *(total(square(_in_angle(solving, e, q)) for e in each) for each in (sides, arms)))
    half, ones = q / number(2), ONE + u**2
    solving.add("half", u, Call("tan", (half,)))
    solving.add("half", cos(q), (ONE - u**2) / ones)
    solving.add("half", sin(q), multiply(number(2), u) / ones)
    solving.add("quartic", *(total(square(_in_root(solving, e, u)) for e in each) for each in (sides, arms)))
    _by_powers(solving, found, u)
    told_rules = ("split", "joined", "half", "quartic", "aside", "expanded", "squared")
    steps = {rule: solving.by(rule) for rule in told_rules}
    height = solving.progress.tree(found.height.left)
    height = opposite(height) if begins_negative(height) else height
    told = Polynomial(root=u, height=height, first=Symbol(found.first), second=second, **steps)
    value, when = multiply(number(2), Call("atan", (u,))), Phrase("root-of-the-quartic", {"root": u})
    solving.solved(q, [Choice(value, when=when)], Method(name="quartic", quartic=told))


def _distance_and_height(solving: Solving, found: Quartic) -> None:
    """The coordinates, and the sum of their squares; the height, where it is none of these."""
    readable, tree = solving.problem.readable, solving.progress.tree
    for each in found.coordinates:
        turned = begins_negative(tree(each.known))
        known, unknown = (-each.known, -each.unknown) if turned else (each.known, each.unknown)
        solving.equation((tree(known), readable(unknown)))
    if all(each.equation is not found.height for each in found.coordinates):
        solving.equation((tree(found.height.left), readable(found.height.right)))
    known, unknown = (
        reduce(add_values, (side * side for side in sides))
        for sides in zip(*((each.known, each.unknown) for each in found.coordinates), strict=True)
    )
    solving.add("squares", tree(known), readable(unknown))


def _linear(solving: Solving, value: Scalar, angle: Form) -> Linear:
    """The coefficients of 1, cosine and sine, where they are long by a name."""
    names = f"cos({angle})", f"sin({angle})"
    bottom = Scalar(value.ring, value.ring.one, value.denominator)
    parts = value.ring.grouped(value.numerator, names)
    one, c, s = (
        normal(solving.short(Scalar(value.ring, parts.get(powers, value.ring.zero)) * bottom))
        for powers in ((0, 0), (1, 0), (0, 1))
    )
    return one, c, s


def _in_angle(solving: Solving, side: Linear, q: Expr) -> Expr:
    one, c, s = map(solving.progress.tree, side)
    return add(*terms_of(one), times(c, cos(q)), times(s, sin(q)))


def _in_root(solving: Solving, side: Linear, u: Symbol) -> Expr:
    """The same times 1 + u^2."""
    one, c, s = side
    if not (c or s):
        return times(solving.progress.tree(one), ONE + u**2)
    parts = map(solving.progress.tree, (one - c, 2 * s, one + c))
    terms = (_times(part, power) for part, power in zip(parts, (u**2, u, ONE), strict=True))
    return add(*(each for term in terms for each in terms_of(term)))


def _times(part: Expr, power: Expr) -> Expr:
    """A power with what stands before it, functions last."""
    front = [each for each in factors_of(part) if not isinstance(each, Call)]
    return times(multiply(*front), multiply(power, *(e for e in factors_of(part) if isinstance(e, Call))))


def _turning(solving: Solving, row: TrigEquation, third: Form, second: Expr) -> Expr:
    """a c + b s of the second angle, with the coefficients as they are in the third."""
    q = solving.progress.angle(third)
    a, b = (_in_angle(solving, _linear(solving, each, third), q) for each in (row.a, row.b))
    return add(times(a, cos(second)), times(b, sin(second)))


def _by_powers(solving: Solving, found: Quartic, u: Symbol) -> None:
    """By its factors, where it has some or is short; of one in the square of the root, that."""
    tree = solving.progress.tree
    factors = [
        tuple(-each for each in factor) if begins_negative(tree(factor[0])) else factor
        for factor in found.factors
    ]
    biquadratic = len(factors) == 1 and len(factors[0]) > 3 and not any(factors[0][1::2])
    falls_apart = biquadratic or len(factors) > 1
    if not falls_apart and any(leaves(tree(each)) > LONGEST for factor in factors for each in factor):
        return
    written = [
        [_named(solving, each) if falls_apart else tree(each) for each in factor] for factor in factors
    ]
    solving.add("expanded", multiply(*(_polynomial(each, u) for each in written)), ZERO)
    if biquadratic:
        a, _, b, _, c = written[0]
        root = sqrt(b**2 - multiply(number(4), a, c))
        for signed_root in (root, -root):
            solving.add("squared", u**2, over(add(opposite(b), signed_root), multiply(number(2), a)))


def _named(solving: Solving, value: Scalar) -> Expr:
    """A coefficient, where it is long by a name."""
    written = solving.progress.tree(value)
    return written if leaves(written) <= SHORT else solving.name(written)


def _polynomial(coefficients: Sequence[Expr], u: Symbol) -> Expr:
    powers = [u**n for n in range(len(coefficients) - 1, 1, -1)]
    return add(*(_times(each, power) for each, power in zip(coefficients, [*powers, u, ONE], strict=True)))
