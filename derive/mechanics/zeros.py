"""Where an equation in the joint variables vanishes, by named sub-problems.

s = 0: q = 0 or pi. c = 0: q = pi/2 or -pi/2. a c + b s = 0: q = atan2(-a, b) or the opposite direction.
a c + b s + d = 0: q = atan2(b, a) +- acos(-d / sqrt(a^2 + b^2)). A sliding joint q with a q + d = 0:
q = -d/a. (Siciliano et al., section 2.12; Spong et al., appendix A.)
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

from derive.algebra.angles import Form
from derive.algebra.exact_values import Pair
from derive.algebra.normal import Walk
from derive.algebra.numbers.floats import scalar_number
from derive.algebra.rationals import as_fraction
from derive.algebra.readable.operation_count import operations
from derive.algebra.roots_and_functions import absolute, root
from derive.algebra.scalar import Scalar, trig
from derive.algebra.solving.factors import depends
from derive.algebra.solving.fixed_directions import direction
from derive.algebra.substitution import pinned
from derive.expression import (
    MINUS_ONE,
    PI,
    ZERO,
    Call,
    Expr,
    Sum,
    Symbol,
    add,
    factors_of,
    is_negative,
    multiply,
    negate,
    number,
    sqrt,
    terms_of,
)

Write: TypeAlias = Callable[[Scalar], Expr]

MOST_TERMS = 16  # of an equation whose value can be short enough
LONGEST = 30  # operations of a value; nobody reads a longer one
RIGHT = multiply(number("1/2"), PI)
NOUGHT = (Scalar.of(1), Scalar.of(0))
HALF_TURN = (Scalar.of(-1), Scalar.of(0))
QUARTERS = ((Scalar.of(0), Scalar.of(1)), (Scalar.of(0), Scalar.of(-1)))


@dataclass(frozen=True, slots=True, eq=False)
class Zero:
    """A joint variable, the value at which the equation holds (`value` as written, `at` to be put in: a
    pair of cosine and sine, or a length), the name of the sub-problem, and what has to hold for it to be
    real (`condition`, not negative), where something has to."""

    variable: str
    value: Expr
    at: Pair | Scalar
    rule: str
    condition: Expr | None = None


def zeros(
    equation: Scalar, variables: tuple[str, ...], write: Write, by: str | None = None
) -> tuple[Zero, ...] | None:
    """All zeros by one variable, () where there is none; None where no sub-problem fits, or only with values
    too long to read. `variables` in order of preference, or the one it has to be."""
    if never_zero(equation, variables):
        return ()
    held = [name for name in variables if equation.diff(name)]
    if not held:
        return ()
    ways = (_by(equation, name, held, write) for name in held if by in (None, name))
    found = [way for way in ways if way is not None]
    if not found:
        return None
    if not all(found):  # one of them is never real
        return ()
    best = min(found, key=_awkward)
    return best if all(operations(zero.value) <= LONGEST for zero in best) else None


def never_zero(equation: Scalar, variables: tuple[str, ...]) -> bool:
    """Whether a number in it is larger than all its sines and cosines can make up for; or it is a sum of
    squares one of which, of lengths alone, is not zero."""
    home, terms = equation.ring, dict(equation.numerator.terms())
    moving = {place for place, name in enumerate(home.names) if home.letters(name) & set(variables)}
    turning = {place for k in range(len(home.angles)) for place in home.pair_index(k)}
    numbers = [as_fraction(k) for k in terms.values()]
    even = not any(int(power) % 2 for powers in terms for power in powers)
    if even and (all(k > 0 for k in numbers) or all(k < 0 for k in numbers)):
        return any(not any(powers[place] for place in moving) for powers in terms)
    if any(power and place not in turning for powers in terms for place, power in enumerate(powers)):
        return False
    alone = sum(abs(k) for powers, k in zip(terms, numbers, strict=True) if not any(powers))
    return alone > sum(map(abs, numbers)) - alone


def _awkward(zero: tuple[Zero, ...]) -> int:
    """What is preferred: a fixed value, then an angle by others, then a direction, then a triangle."""
    order = ("slide", "sine", "cosine", "turn", "sum", "direction", "triangle")
    return order.index(zero[0].rule)


def _by(equation: Scalar, name: str, held: list[str], write: Write) -> tuple[Zero, ...] | None:
    """None where the variable turns and slides in one equation, as that of a spindle may."""
    home, used = equation.ring, set(equation.generators())
    turns = any(
        name in {atom for atom, _ in form.parts}
        for k, form in enumerate(home.angles)
        if used & {home.names[place] for place in home.pair_index(k)}
    )
    if not turns:
        return _slide(equation, name, write)
    return None if name in used else _angle(equation, name, held, write)


def _slide(equation: Scalar, name: str, write: Write) -> tuple[Zero, ...] | None:
    """a q + d = 0."""
    a = equation.diff(name)
    if depends(a, (name,)) or not a:
        return None
    value = -pinned(equation, name, Scalar.of(0)) / a
    return (Zero(name, write(value), value, "slide"),)


def _angle(equation: Scalar, name: str, held: list[str], write: Write) -> tuple[Zero, ...] | None:
    """a c + b s + d = 0, in whichever form it is."""
    front, back, side = (pinned(equation, name, at) for at in (NOUGHT, HALF_TURN, QUARTERS[0]))
    a, d = (front - back) / 2, (front + back) / 2
    b = side - d
    c_s = pinned(equation, name, QUARTERS[1])
    if c_s != d - b or not _is_linear(equation, name, (a, b, d)):
        return None
    if sum(len(part.numerator) for part in (a, b, d)) > MOST_TERMS:
        return None
    if d:
        return _with_constant(name, a, b, d, write)
    if not a:
        return (Zero(name, ZERO, NOUGHT, "sine"), Zero(name, PI, HALF_TURN, "sine"))
    if not b:
        up, down = (multiply(number(part), PI) for part in ("1/2", "-1/2"))
        return (Zero(name, up, QUARTERS[0], "cosine"), Zero(name, down, QUARTERS[1], "cosine"))
    return _as_sum(name, held, write(equation)) or _direction(name, a, b, write)


def _is_linear(equation: Scalar, name: str, parts: tuple[Scalar, Scalar, Scalar]) -> bool:
    """Whether it is a c + b s + d: known at four angles it could still hold higher multiples."""
    a, b, d = parts
    c, s = trig(Form.of({name: 1}))
    return equation == a * c + b * s + d


def _direction(name: str, a: Scalar, b: Scalar, write: Write) -> tuple[Zero, ...]:
    """a c + b s = 0."""
    length = root(a * a + b * b)
    one, other = (b / length, -a / length), (-b / length, a / length)
    return (
        Zero(name, direction(write(-a), write(b)), one, "direction"),
        Zero(name, direction(write(a), write(-b)), other, "direction"),
    )


def _as_sum(name: str, held: list[str], tree: Expr) -> tuple[Zero, ...]:
    """sin(q + p) = 0 or cos(q + p) = 0, p a sum of other angles."""
    angle, function = _single(tree)
    rest = _without(angle, Symbol(name)) if angle is not None and len(held) > 1 else None
    if rest is None:
        return ()
    quarters = tuple(multiply(number(part), PI) for part in ("1/2", "-1/2"))
    values = (ZERO, PI) if function == "sin" else quarters
    trees = [_plus(value, _opposite(rest)) for value in values]
    return tuple(Zero(name, tree, Walk({}).trig(tree), "sum") for tree in trees)


def _single(tree: Expr) -> tuple[Expr | None, str]:
    """The angle and the function of k sin(...) or k cos(...)."""
    factors = factors_of(tree)
    calls = [f for f in factors if isinstance(f, Call) and f.function in ("cos", "sin")]
    others = [f for f in factors if isinstance(f, Sum)]
    if len(calls) != 1 or others:
        return None, ""
    return calls[0].arguments[0], calls[0].function


def _without(angle: Expr, name: Symbol) -> Expr | None:
    """What is added to the name in an angle; None where it is not added once."""
    if not isinstance(angle, Sum) or name not in angle.terms:
        return None
    rest = tuple(term for term in angle.terms if term != name)
    return add(*rest) if len(rest) == len(angle.terms) - 1 else None


def _plus(value: Expr, expr: Expr) -> Expr:
    """Their sum, what has no minus sign first."""
    terms = terms_of(expr)
    return add(value, *terms) if is_negative(terms[0]) else add(*terms, value)


def _opposite(expr: Expr) -> Expr:
    return add(*map(negate, terms_of(expr)))


def _with_constant(name: str, a: Scalar, b: Scalar, d: Scalar, write: Write) -> tuple[Zero, ...] | None:
    """a c + b s + d = 0 with d not zero; () where no angle is real."""
    if not b and a == d:
        return (Zero(name, PI, HALF_TURN, "turn"),)
    if not b and a == -d:
        return (Zero(name, ZERO, NOUGHT, "turn"),)
    if not a and b == d:
        return (Zero(name, -RIGHT, QUARTERS[1], "turn"),)
    if not a and b == -d:
        return (Zero(name, RIGHT, QUARTERS[0], "turn"),)
    square = a * a + b * b
    inside = square - d * d
    if (size := _number(inside)) is not None and size < 0:
        return ()
    values = zip((1, -1), _values(a, b, d, square, write), strict=True)
    return tuple(
        Zero(name, value, _triangle(a, b, d, square, sign * root(inside)), "triangle", write(inside))
        for sign, value in values
    )


def _triangle(a: Scalar, b: Scalar, d: Scalar, square: Scalar, height: Scalar) -> Pair:
    """(cosine, sine) of a value; an arc sine has a cosine above zero, an arc cosine a sine."""
    if not a:
        return -height / absolute(b), -d / b
    if not b:
        return -d / a, height / absolute(a)
    return (-a * d - b * height) / square, (-b * d + a * height) / square


def _values(a: Scalar, b: Scalar, d: Scalar, square: Scalar, write: Write) -> tuple[Expr, Expr]:
    """The angle of (b, a) and the spread to both sides of it; an arc sine where there is no cosine."""
    if not a:
        first = _ratio("asin", -d, b, write)
        return _plus(PI, -first), first
    if not b:
        spread = _ratio("acos", -d, a, write)
        return spread, -spread
    spread = Call("acos", (_over(write(-d), _length(square, write)),))
    middle = direction(write(b), write(a))
    return middle + spread, middle + -spread


def _ratio(function: str, top: Scalar, bottom: Scalar, write: Write) -> Expr:
    whole = top / bottom
    inside = write(whole) if whole.denominator is None else _over(write(top), write(bottom))
    return Call(function, (inside,))


def _over(top: Expr, bottom: Expr) -> Expr:
    """The quotient, one sign in front."""
    if is_negative(bottom):
        top, bottom = _opposite(top), -bottom
    if all(map(is_negative, terms_of(top))):
        return MINUS_ONE * (_opposite(top) / bottom)
    return top / bottom


def _length(square: Scalar, write: Write) -> Expr:
    """Its root, lengths taken out of it where nothing else is left."""
    length = root(square)
    left = any(name.startswith("sqrt(") for name in length.generators())
    return sqrt(write(square)) if left else write(length)


def _number(value: Scalar) -> float | None:
    """Where it holds no letters."""
    try:
        return scalar_number(value, {})
    except (KeyError, ValueError):
        return None
