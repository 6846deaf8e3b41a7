"""Trees for tests: random ones, rewritten ones, and their values by other programs than ours."""

from __future__ import annotations

import math
from collections.abc import Mapping
from fractions import Fraction
from typing import Any

import sympy
from hypothesis import strategies as st

from derive.algebra.formulas.grammar import parse
from derive.expression import (
    MINUS_ONE,
    Call,
    Degrees,
    Expr,
    Matrix,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
    cos,
    free_symbols,
    negate,
    number,
    rebuild,
    sin,
    squared,
)

HALF = number("1/2")


def formula(text: str) -> Expr:
    """A formula as an author types it."""
    return parse(text)


def matrix(rows: str) -> Matrix:
    """One row a line, entries separated by `;`."""
    lines = [line for line in rows.strip().splitlines() if line.strip()]
    return Matrix(tuple(tuple(parse(entry.strip()) for entry in line.split(";")) for line in lines))


# -- what SymPy makes of a tree, node by node ---------------------------------------------------------

FUNCTIONS = {
    "cos": sympy.cos, "sin": sympy.sin, "tan": sympy.tan, "sqrt": sympy.sqrt, "atan2": sympy.atan2,
    "acos": sympy.acos, "asin": sympy.asin, "atan": sympy.atan, "abs": sympy.Abs, "sign": sympy.sign,
    "exp": sympy.exp, "log": sympy.log,
}  # fmt: skip


def sympy_of(expr: Expr) -> Any:
    """The same in SymPy, by a walk that shares nothing with derive.algebra."""
    match expr:
        case Number(value):
            return sympy.Rational(value.numerator, value.denominator)
        case Degrees(value):
            return sympy.Rational(value.numerator, value.denominator) * sympy.pi / 180
        case Symbol("pi"):
            return sympy.pi
        case Symbol(name):
            return sympy.Symbol(name, real=True)
        case Sum(terms):
            return sympy.Add(*map(sympy_of, terms))
        case Product(factors):
            return sympy.Mul(*map(sympy_of, factors))
        case Quotient(top, bottom):
            return sympy_of(top) / sympy_of(bottom)
        case Power(base, exponent):
            return sympy_of(base) ** sympy_of(exponent)
        case Call(function, arguments):
            return FUNCTIONS[function](*map(sympy_of, arguments))
    raise TypeError(expr)


def value(expr: Expr, at: Mapping[str, float]) -> float:
    """The value of a tree in plain Python, node by node."""
    match expr:
        case Number(exact):
            return float(exact)
        case Degrees(degrees):
            return math.radians(degrees)
        case Symbol(name):
            return math.pi if name == "pi" else at[name]
        case Sum(terms):
            return sum(value(term, at) for term in terms)
        case Product(factors):
            return math.prod(value(factor, at) for factor in factors)
        case Quotient(top, bottom):
            return value(top, at) / value(bottom, at)
        case Power(base, exponent):
            return float(value(base, at) ** value(exponent, at))
        case Call("abs", (argument,)):
            return abs(value(argument, at))
        case Call(function, arguments):
            return float(getattr(math, function)(*(value(argument, at) for argument in arguments)))
    raise TypeError(expr)


def points(*exprs: Expr, count: int = 3) -> list[dict[str, float]]:
    """Fixed points, no two coordinates related; the symbols are those of the trees."""
    names = sorted(set().union(*map(free_symbols, exprs)))
    return [
        {name: 0.3 + math.fmod((k + 1) * math.sqrt(7 * i + 3), 1.3) for i, name in enumerate(names)}
        for k in range(count)
    ]


def same_value(left: Expr, right: Expr) -> bool:
    """Whether both have the same value at every one of the points."""
    pairs = [(value(left, at), value(right, at)) for at in points(left, right)]
    return all(math.isclose(a, b, rel_tol=1e-9, abs_tol=1e-9) for a, b in pairs)


# -- random trees --------------------------------------------------------------------------------------

LENGTHS = tuple(map(Symbol, ("a", "b", "L_c")))
ANGLES = tuple(map(Symbol, ("x", "y", "z")))
TURNS = (Degrees(Fraction(30)), Degrees(Fraction(45)), Degrees(Fraction(90)), Degrees(Fraction(-60)))


def angles() -> st.SearchStrategy[Expr]:
    """x, x + y, 2 x, x - 45 deg, ..."""
    atom = st.sampled_from(ANGLES)
    sums = st.builds(lambda p, q: Sum((p, q)), atom, st.sampled_from((*ANGLES, *map(negate, ANGLES), *TURNS)))
    doubles = st.builds(lambda n, p: Product((number(n), p)), st.sampled_from((2, 3, -1, -2)), atom)
    return st.one_of(atom, atom, sums, doubles)


def trigonometric() -> st.SearchStrategy[Expr]:
    return st.builds(lambda f, angle: Call(f, (angle,)), st.sampled_from(("cos", "sin")), angles())


def leaves() -> st.SearchStrategy[Expr]:
    numbers = st.sampled_from((number(2), number(-1), number(3), number("1/2"), number("0.1", decimal=True)))
    return st.one_of(trigonometric(), trigonometric(), st.sampled_from(LENGTHS), numbers)


def polynomials(most: int = 8) -> st.SearchStrategy[Expr]:
    """Sums and products of lengths, numbers, sines and cosines."""
    return st.recursive(leaves(), _larger, max_leaves=most)


def _larger(parts: st.SearchStrategy[Expr]) -> st.SearchStrategy[Expr]:
    several = st.lists(parts, min_size=2, max_size=3).map(tuple)
    return st.one_of(several.map(Sum), several.map(Product), parts.map(squared))


def fractions() -> st.SearchStrategy[Expr]:
    """A polynomial over one that vanishes nowhere."""
    below = st.builds(lambda p: Sum((number(2), squared(p))), trigonometric())
    return st.builds(Quotient, polynomials(5), below)


# -- rewriting: the same value in another form ---------------------------------------------------------


@st.composite
def rewritten(draw: st.DrawFn, expr: Expr) -> Expr:
    """The tree with nodes replaced by others that mean the same."""
    found = rebuild(expr, lambda part: draw(rewritten(part))) if not _is_trig(expr) else expr
    match found:
        case Call("cos", (angle,)):
            return draw(st.sampled_from(_cosines(angle)))
        case Call("sin", (angle,)):
            return draw(st.sampled_from(_sines(angle)))
        case Product((first, second)) if _is_trig(first) and _is_trig(second):
            return draw(st.sampled_from((found, Product((second, first)), _as_sum(first, second))))
        case Product((first, Sum(terms))):
            return draw(st.sampled_from((found, Sum(tuple(Product((first, term)) for term in terms)))))
        case Sum(terms):
            return Sum(tuple(draw(st.permutations(terms))))
        case Product(factors):
            return Product(tuple(draw(st.permutations(factors))))
        case Power(base, Number(two)) if two == 2:
            return draw(st.sampled_from((found, Product((base, base)))))
    return found


def _is_trig(expr: Expr) -> bool:
    return isinstance(expr, Call) and expr.function in ("cos", "sin")


def _cosines(a: Expr) -> tuple[Expr, ...]:
    half = Product((HALF, a))
    third = Product((number("1/3"), a))
    found = (
        cos(a),
        cos(negate(a)),
        Sum((number(1), negate(Product((number(2), squared(sin(half))))))),
        Sum((squared(cos(half)), negate(squared(sin(half))))),
        Sum((Product((number(4), Power(cos(third), number(3)))), Product((number(-3), cos(third))))),
        sin(Sum((a, Degrees(Fraction(90))))),
        negate(cos(Sum((a, Symbol("pi"))))),
    )
    return (*found, *_by_addition(a, cos))


def _sines(a: Expr) -> tuple[Expr, ...]:
    half = Product((HALF, a))
    found = (
        sin(a),
        negate(sin(negate(a))),
        Product((number(2), sin(half), cos(half))),
        cos(Sum((Degrees(Fraction(90)), negate(a)))),
        sin(Sum((Symbol("pi"), negate(a)))),
    )
    return (*found, *_by_addition(a, sin))


def with_tangents(expr: Expr) -> Expr:
    """Every cosine and sine by the tangent of half its angle."""
    match expr:
        case Call("cos" | "sin" as function, (angle,)):
            t = Call("tan", (Product((HALF, angle)),))
            top = Sum((number(1), negate(squared(t)))) if function == "cos" else Product((number(2), t))
            return Quotient(top, Sum((number(1), squared(t))))
    return rebuild(expr, with_tangents)


def _by_addition(angle: Expr, function: Any) -> tuple[Expr, ...]:
    if not (isinstance(angle, Sum) and len(angle.terms) == 2):
        return ()
    p, q = angle.terms
    if function is cos:
        return (Sum((Product((cos(p), cos(q))), Product((MINUS_ONE, sin(p), sin(q))))),)
    return (Sum((Product((sin(p), cos(q))), Product((cos(p), sin(q))))),)


def _as_sum(first: Expr, second: Expr) -> Expr:
    """Product to sum."""
    assert isinstance(first, Call)
    assert isinstance(second, Call)
    (p,), (q,) = first.arguments, second.arguments
    minus, plus = Sum((p, negate(q))), Sum((p, q))
    parts = {
        ("cos", "cos"): Sum((cos(minus), cos(plus))),
        ("sin", "sin"): Sum((cos(minus), negate(cos(plus)))),
        ("sin", "cos"): Sum((sin(plus), sin(minus))),
        ("cos", "sin"): Sum((sin(plus), negate(sin(minus)))),
    }
    return Product((HALF, parts[first.function, second.function]))


def sympy_letters(expr: Expr) -> Any:
    """The same in SymPy, unevaluated, each sine and cosine one letter as it is printed (c_12)."""
    names: dict[Expr, Any] = {}

    def read(node: Expr) -> Any:
        match node:
            case Call("cos" | "sin"):
                return names.setdefault(node, sympy.Symbol(f"letter{len(names)}"))
            case Sum(terms):
                return sympy.Add(*map(read, terms), evaluate=False)
            case Product((Number(lead), *rest)) if lead == -1 and rest:
                return -read(Product(tuple(rest)))
            case Product((only,)):
                return read(only)
            case Product(factors):
                return sympy.Mul(*map(read, factors), evaluate=False)
            case Quotient(top, bottom):
                return sympy.Mul(read(top), sympy.Pow(read(bottom), -1, evaluate=False), evaluate=False)
            case Power(base, exponent):
                return sympy.Pow(read(base), read(exponent), evaluate=False)
        return sympy_of(node)

    return read(expr)
