"""Two equations in one angle, written out: no choice is left, unless signs were chosen before."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

from derive.algebra.normal import trig_of
from derive.algebra.scalar import Scalar
from derive.expression import ZERO, Call, Degrees, Expr, Number, Symbol, atan2, cos, multiply, number, sin
from derive.kinds.robot._inverse.facts import Method, zero
from derive.kinds.robot._inverse.progress import Progress
from derive.kinds.robot._inverse.signs import opposite, over, times, unsigned
from derive.kinds.robot._inverse.solving import Solving
from derive.kinds.robot._inverse.subproblem import Choice
from derive.mechanics.inverse.subproblems import TrigEquation, TwoEquations

SIGNS = (1, -1)
Sides = tuple[Expr, Expr, Expr]  # a, b, c of a cos q + b sin q = c
Answer = tuple[Sequence[Choice], Method]


def write(solving: Solving, found: TwoEquations) -> None:
    """The two equations, and the angle."""
    angle, found = solving.progress.angle(found.unknown), _plainest(solving.progress, found)
    first, second = _collected(solving, (found.first, found.second), angle)
    ways = {"direction": _direction, "difference": _difference, "determinant": _cramer}
    choices, method = ways[found.method](solving, found, first, second)
    solving.solved(angle, choices, method)


def _plainest(progress: Progress, found: TwoEquations) -> TwoEquations:
    """With as few minus signs in the known sides and coefficients as can be."""
    one, two = found.first, found.second
    alike = found.method == "difference"
    if alike:
        pairs = [(one, two), (one.negated(), two.negated()), (two, one.negated()), (two.negated(), one)]
    else:
        pairs = [(a, b) for a in (one, one.negated()) for b in (two, two.negated())]

    def minuses(pair: tuple[TrigEquation, TrigEquation]) -> int:
        first, second = pair
        return progress.minuses(first.c, second.c, first.a, second.a if alike else second.b)

    first, second = min(pairs, key=minuses)
    return replace(found, first=first, second=second)


def _collected(solving: Solving, rows: Sequence[TrigEquation], angle: Expr) -> list[Sides]:
    """(a, b, c) of each as trees, with a step c = a cos q + b sin q, or as it stands in the product of poses
    where nothing has to be collected."""
    sides: list[Sides] = []
    for row in rows:
        c, a, b = (solving.short(value) for value in (row.c, row.a, row.b))
        sides.append((a, b, c))
    plain = all(_is_plain(solving.progress, row, c) for row, (_, _, c) in zip(rows, sides, strict=True))
    read = [solving.problem.readable(row.equation.right) for row in rows]
    collected = [times(a, cos(angle)) + times(b, sin(angle)) for a, b, _ in sides]
    known = [c for _, _, c in sides]
    solving.equation(*zip(known, read if plain else collected, strict=True))
    return sides


def _is_plain(progress: Progress, row: TrigEquation, known: Expr) -> bool:
    """Whether the unknown has no sums before it, and all that is known was so from the first."""
    short = all(len(value.numerator) <= 1 for value in (row.a, row.b))
    return short and progress.tree(row.equation.left) == known


def _direction(solving: Solving, found: TwoEquations, first: Sides, second: Sides) -> Answer:
    """cos = c1 / a, sin = c2 / b."""
    progress = solving.progress
    (a, _, c1), (_, b, c2) = first, second
    ratio = (found.second.b / found.first.a).constant
    sign, earlier = progress.sign_of(found.first.a) if ratio is not None else (0, ())
    if ratio is None or not sign:
        value = atan2(over(c2, b), over(c1, a))
        return [Choice(value)], Method(name="direction", unless=progress.may_vanish(a, b))
    given = _given_angle(progress, found)
    if given is not None:
        return [Choice(given)], Method(name="direction", by_name=True)
    sine = c2 if abs(ratio) == 1 else c2 / number(abs(ratio))
    choices = _turned(sine if ratio > 0 else opposite(sine), c1, sign, earlier)
    if not earlier:  # a factor of known sign does not vanish
        return choices, Method(name="direction")
    return choices, Method(name="direction", unless=zero(unsigned(a)), factor=unsigned(a))


def _turned(y: Expr, x: Expr, sign: int, earlier: tuple[int, ...]) -> list[Choice]:
    """A direction, or the opposite one, by the signs chosen at earlier sub-problems."""
    values = {1: atan2(y, x), -1: atan2(opposite(y), opposite(x))}
    if not earlier:
        return [Choice(values[sign])]
    return [Choice(values[sign * each], earlier=earlier, product=each) for each in SIGNS]


def _given_angle(progress: Progress, found: TwoEquations) -> Expr | None:
    """The given angle itself, where its cosine and sine stand alone."""
    name = progress.goal.angle
    if name is None:
        return None
    c, s = found.first.c / found.first.a, found.second.c / found.second.b
    for sign in SIGNS:
        for quarters in (0, 1, 2, -1):
            turned = Scalar.symbol(name) * sign + Scalar.symbol("pi") * Fraction(quarters, 2)
            if trig_of(turned) == (c, s):
                given = Symbol(name) if sign > 0 else -Symbol(name)
                return given + _quarters(quarters, progress)
    return None


def _quarters(n: int, progress: Progress) -> Expr:
    """n times a right angle."""
    if n == 0:
        return ZERO
    if progress.problem.style.degrees:
        return Degrees(Fraction(90 * n))
    return multiply(Number(Fraction(n, 2)), Symbol("pi"))


def _difference(solving: Solving, found: TwoEquations, first: Sides, second: Sides) -> Answer:
    """c1 = k1 cos - k2 sin, c2 = k2 cos + k1 sin."""
    (k1, _, c1), (k2, _, c2) = first, second
    value = _heading(c2, c1) - _heading(k2, k1)
    unless = solving.progress.may_vanish(k1, k2)
    both = len(unless) == len({unsigned(k1), unsigned(k2)})
    return [Choice(value)], Method(name="difference", unless=unless if both else (), vector=(k1, k2))


def _heading(y: Expr, x: Expr) -> Expr:
    """The direction of a point; where these are the sine and cosine of an angle, that angle, up to turns."""
    match y, x:
        case Call("sin", (angle,)), Call("cos", (other,)) if angle == other:
            return angle
    return atan2(y, x)


def _cramer(solving: Solving, found: TwoEquations, first: Sides, second: Sides) -> Answer:
    """By the determinant of the coefficients."""
    (a1, b1, c1), (a2, b2, c2) = first, second
    D = solving.short(found.determinant)
    cosine, sine = multiply(c1, b2) - times(c2, b1), multiply(a1, c2) - times(a2, c1)
    sign, earlier = solving.progress.sign_of(found.determinant)
    unless = solving.progress.may_vanish(D)
    if sign:
        method = Method(name="determinant", unless=unless, factor=unsigned(D))
        return _turned(sine, cosine, sign, earlier), method
    return [Choice(atan2(over(sine, D), over(cosine, D)))], Method(name="determinant", unless=unless)
