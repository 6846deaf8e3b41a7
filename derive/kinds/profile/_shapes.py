"""Laws of motion from rest to rest that keep one shape: q = d s(tau) with tau = t/T, and their peaks."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from derive.derivation import Step
from derive.expression import (
    ONE,
    PI,
    Expr,
    Number,
    Quotient,
    Symbol,
    add,
    factors_of,
    multiply,
    number,
    sin,
    sqrt,
    squared,
)
from derive.expression import cos as cosine
from derive.kinds.meanings import Names
from derive.mechanics.shapes import FINE, Law, peaks, places, rates

TAU, TIME, WAY = Symbol("tau"), Symbol("T"), Symbol("d")
RATES = ("q", "qdot", "qddot")
PEAKS = ("v_peak", "a_peak")
AT = 1000  # the moment at which a law is looked at, as a place among those that are sampled


@dataclass(frozen=True, slots=True)
class Shape:
    """s and its derivatives by tau, the greatest of each, and c in d = c v^2/a, over which both limits need
    the same time."""

    laws: tuple[Expr, Expr, Expr]
    fast: Expr
    strong: Expr
    border: Expr


def _powers(*pairs: tuple[int, int]) -> Expr:
    """A polynomial in tau by coefficients and exponents."""
    return add(
        *(number(c) if not k else multiply(number(c), TAU if k == 1 else TAU ** number(k)) for c, k in pairs)
    )


TURN = 2 * PI
AROUND = sin(multiply(number(2), PI, TAU))
SHAPES: Mapping[Law, Shape] = {
    "cubic": Shape(
        (_powers((3, 2), (-2, 3)), _powers((6, 1), (-6, 2)), _powers((6, 0), (-12, 1))),
        number("3/2"),
        number(6),
        number("8/3"),
    ),
    "quintic": Shape(
        (
            _powers((10, 3), (-15, 4), (6, 5)),
            _powers((30, 2), (-60, 3), (30, 4)),
            _powers((60, 1), (-180, 2), (120, 3)),
        ),
        number("15/8"),
        number(10) / sqrt(number(3)),
        128 / (45 * sqrt(number(3))),
    ),
    "cycloidal": Shape(
        (
            TAU - AROUND / TURN,
            1 - cosine(multiply(number(2), PI, TAU)),
            multiply(number(2), PI, AROUND),
        ),
        number(2),
        TURN,
        PI / 2,
    ),
}


def over(coefficient: Expr, top: Expr, bottom: Expr) -> Expr:
    """A coefficient times a quotient, with one line for both: 3 d/(2 T)."""
    n, m = parts(coefficient)
    above = top if n == ONE else n if top == ONE else multiply(*factors_of(n), top)
    below = bottom if m == ONE else m if bottom == ONE else multiply(m, bottom)
    return above if below == ONE else above / below


def parts(coefficient: Expr) -> tuple[Expr, Expr]:
    """What stands above and below its line."""
    match coefficient:
        case Quotient(top, bottom):
            return top, bottom
        case Number(value):
            return number(value.numerator), number(value.denominator)
    return coefficient, ONE


def peak(shape: Shape, rate: int, d: Expr, T: Expr) -> Expr:
    """The greatest velocity or acceleration over a distance in a time."""
    return over(shape.fast, d, T) if rate == 1 else over(shape.strong, d, squared(T))


def needed(shape: Shape, rate: int, d: Expr, limit: Expr) -> Expr:
    """The time in which a limit is just reached."""
    return over(shape.fast, d, limit) if rate == 1 else sqrt(over(shape.strong, d, limit))


def laws(shape: Shape, d: Symbol, T: Symbol) -> Iterator[Step]:
    """The motion and its derivatives, and the peaks of these, as they depend on the time."""
    for rate, (name, law) in enumerate(zip(RATES, shape.laws, strict=True)):
        front = d if not rate else d / T if rate == 1 else d / squared(T)
        yield Step(f"law_{rate}", (Symbol(name), multiply(front, law)), "in-numbers")
    for rate, name in enumerate(PEAKS, 1):
        yield Step(f"peak_{rate}", (Symbol(name), peak(shape, rate, d, T)), "in-numbers")


def meanings(law: Law, d: Symbol, T: Symbol, way: float, time: float) -> Names:
    """What the names of the laws are in numbers at one moment of a motion."""
    fast, strong = rates(law, way, time)
    v, a = peaks(law, way, time)
    return {
        d: way, T: time, TAU: AT / (FINE - 1), Symbol("q"): float(way * places(law)[AT]),
        Symbol("qdot"): float(fast[AT]), Symbol("qddot"): float(strong[AT]),
        Symbol("v_peak"): v, Symbol("a_peak"): a,
    }  # fmt: skip
