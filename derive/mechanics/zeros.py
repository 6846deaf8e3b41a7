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
from derive.algebra.factors import depends
from derive.algebra.kernels import root
from derive.algebra.normal import Walk
from derive.algebra.operations import operations
from derive.algebra.pairs import Pair
from derive.algebra.pinned import pinned
from derive.algebra.scalar import Scalar, trig
from derive.expression import (
    PI,
    ZERO,
    Call,
    Expr,
    Product,
    Quotient,
    Sum,
    Symbol,
    add,
    atan2,
    multiply,
    negate,
    number,
    sqrt,
)

Write: TypeAlias = Callable[[Scalar], Expr]

LONGEST = 30  # operations of a value; nobody reads a longer one
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


def zeros(equation: Scalar, variables: tuple[str, ...], write: Write) -> tuple[Zero, ...]:
    """All zeros by one variable; none where no sub-problem fits, or only with values too long to read.
    `variables` in order of preference."""
    held = [name for name in variables if equation.diff(name)]
    found = [zero for name in held if (zero := _by(equation, name, held, write))]
    best: tuple[Zero, ...] = min(found, key=_awkward, default=())
    return best if all(operations(zero.value) <= LONGEST for zero in best) else ()


def _awkward(zero: tuple[Zero, ...]) -> int:
    """What is preferred: a fixed value, then an angle by others, then a direction, then a triangle."""
    order = ("slide", "sine", "cosine", "turn", "sum", "direction", "triangle")
    return order.index(zero[0].rule)


def _by(equation: Scalar, name: str, held: list[str], write: Write) -> tuple[Zero, ...]:
    if any(name in {atom for atom, _ in form.parts} for form in equation.ring.angles):
        return _angle(equation, name, held, write)
    return _slide(equation, name, write)


def _slide(equation: Scalar, name: str, write: Write) -> tuple[Zero, ...]:
    """a q + d = 0."""
    a = equation.diff(name)
    if depends(a, (name,)) or not a:
        return ()
    value = -pinned(equation, name, Scalar.of(0)) / a
    return (Zero(name, write(value), value, "slide"),)


def _angle(equation: Scalar, name: str, held: list[str], write: Write) -> tuple[Zero, ...]:
    """a c + b s + d = 0, in whichever form it is."""
    front, back, side = (pinned(equation, name, at) for at in (NOUGHT, HALF_TURN, QUARTERS[0]))
    a, d = (front - back) / 2, (front + back) / 2
    b = side - d
    c_s = pinned(equation, name, QUARTERS[1])
    if c_s != d - b or not _is_linear(equation, name, (a, b, d)):
        return ()
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
        Zero(name, atan2(write(-a), write(b)), one, "direction"),
        Zero(name, atan2(write(a), write(-b)), other, "direction"),
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
    factors = tree.factors if isinstance(tree, Product) else (tree,)
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
    return add(value, *(expr.terms if isinstance(expr, Sum) else (expr,)))


def _opposite(expr: Expr) -> Expr:
    return add(*map(negate, expr.terms)) if isinstance(expr, Sum) else negate(expr)


def _with_constant(name: str, a: Scalar, b: Scalar, d: Scalar, write: Write) -> tuple[Zero, ...]:
    """a c + b s + d = 0 with d not zero."""
    if not b and a == d:
        return (Zero(name, PI, HALF_TURN, "turn"),)
    if not b and a == -d:
        return (Zero(name, ZERO, NOUGHT, "turn"),)
    square = a * a + b * b
    inside = square - d * d
    height = root(inside)
    middle = atan2(write(b), write(a))
    spread = Call("acos", (Quotient(write(-d), sqrt(write(square))),))
    found = []
    for sign in (1, -1):
        c, s = (-a * d - sign * b * height) / square, (-b * d + sign * a * height) / square
        turn = multiply(number(sign), spread if b else _acos(-d / a, write))
        value = add(middle, turn) if b else turn
        found.append(Zero(name, value, (c, s), "triangle", write(inside)))
    return tuple(found)


def _acos(cosine: Scalar, write: Write) -> Expr:
    return Call("acos", (write(cosine),))
