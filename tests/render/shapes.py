"""Trees of every node and shape, each in every place of each other: what a printer has to write."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from fractions import Fraction

from derive.expression import (
    MINUS_ONE,
    PI,
    Approximate,
    Call,
    Degrees,
    Derivative,
    Expr,
    Indexed,
    Matrix,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
    atan2,
    cos,
    cross,
    negate,
    number,
    sin,
    sqrt,
    squared,
    symbols,
    transpose,
)

a, b, m, phi, theta1, theta2, q2 = symbols("a b m phi theta1 theta2 q2")
A, B, T_10, v_dot, L_c = symbols("A B T_1^0 theta1_ddot L_c")

LEAVES: dict[str, Expr] = {
    "a letter": a, "a joint angle": theta1, "a name with scripts": T_10, "a rate": v_dot,
    "a word": Symbol("mass"), "a starred name": Symbol("theta2*"), "pi": PI, "a name with an index": L_c,
    "a whole number": number(3), "a negative number": number(-2), "a fraction": number("2/3"),
    "a negative fraction": number("-1/2"), "a decimal": number("0.25", True),
    "minus a decimal": number("-1.5", True),
    "a large number": Number(Fraction(10**9), True), "a small number": Number(Fraction(1, 10**9), True),
    "a rounded number": Approximate(0.43301), "a rounded power of ten": Approximate(-1.25e-7),
    "degrees": Degrees(Fraction(30)), "minus degrees": Degrees(Fraction(-45)),
    "a part of a degree": Degrees(Fraction(45, 2)),
    "an axis and an angle": Indexed("R", (Symbol("z"), Degrees(Fraction(30)))),
    "a numbered name": Indexed("M", (number(2),)),
}  # fmt: skip

Shape = Callable[[Expr], Expr]

SHAPES: dict[str, Shape] = {
    "the first term": lambda x: Sum((x, b)),
    "the last term": lambda x: Sum((b, x)),
    "what is subtracted": lambda x: Sum((b, Product((MINUS_ONE, x)))),
    "a negated term": lambda x: Sum((b, negate(x), m)),
    "the first factor": lambda x: Product((x, b)),
    "the last factor": lambda x: Product((b, x)),
    "a factor in between": lambda x: Product((m, x, cos(phi))),
    "beside a number": lambda x: Product((number(2), x)),
    "beside a half": lambda x: Product((number("1/2"), m, x)),
    "beside minus a half": lambda x: Product((number("-1/2"), x, m)),
    "beside a decimal": lambda x: Product((number("0.5", True), x)),
    "beside a rounded number": lambda x: Product((Approximate(-2.46), x)),
    "the opposite": negate,
    "behind a minus sign": lambda x: Product((MINUS_ONE, x)),
    "before a sine": lambda x: Product((x, sin(theta2))),
    "after a cosine written out": lambda x: Product((cos(phi), x)),
    "a numerator": lambda x: Quotient(x, b),
    "a denominator": lambda x: Quotient(b, x),
    "a fraction and more": lambda x: Product((Quotient(x, b), m)),
    "a square": squared,
    "a cube": lambda x: Power(x, number(3)),
    "an inverse power": lambda x: Power(x, number(-1)),
    "a power of a letter": lambda x: Power(x, b),
    "an exponent": lambda x: Power(b, x),
    "the root of a power": lambda x: Power(x, number("1/2")),
    "a power of a third": lambda x: Power(x, number("1/3")),
    "a root": sqrt,
    "the argument of a cosine": cos,
    "of a squared sine": lambda x: squared(sin(x)),
    "of an inverse sine": lambda x: Power(sin(x), number(-1)),
    "of a tangent": lambda x: Call("tan", (x,)),
    "of an arc": lambda x: Call("acos", (x,)),
    "of a squared arc": lambda x: squared(Call("atan", (x,))),
    "the first of atan2": lambda x: atan2(x, b),
    "the second of atan2": lambda x: atan2(b, x),
    "of exp": lambda x: Call("exp", (x,)),
    "of a logarithm": lambda x: Call("log", (x,)),
    "of a sign": lambda x: Call("sign", (x,)),
    "between bars": lambda x: Call("abs", (x,)),
    "in brackets": lambda x: Call("bracket", (x,)),
    "of a determinant": lambda x: Call("det", (x,)),
    "of an adjugate": lambda x: Call("adj", (x,)),
    "of a function": lambda x: Call("V_a", (x,)),
    "transposed": transpose,
    "a transposed factor": lambda x: Product((transpose(x), B, x)),
    "inverted": lambda x: Call("inverse", (x,)),
    "left of a cross": lambda x: cross(x, b),
    "right of a cross": lambda x: cross(b, x),
    "a cross and more": lambda x: Product((m, cross(x, b))),
    "an entry": lambda x: Matrix(((x, b), (m, a))),
    "a row": lambda x: Matrix(((b, x),)),
    "a column": lambda x: Matrix(((b,), (x,))),
    "a matrix and a factor": lambda x: Product((x, Matrix(((b,), (m,))))),
    "derived by a name": lambda x: Derivative(x, theta1),
    "derived by time": lambda x: Derivative(x, Symbol("t")),
    "half of a derivative": lambda x: Product((number("1/2"), Derivative(x, q2))),
    "an index": lambda x: Indexed("S", (x,)),
    "the second index": lambda x: Indexed("R", (Symbol("z"), x)),
    "above an e": lambda x: Indexed("e", (), (x,)),
}  # fmt: skip


def nested() -> Iterator[tuple[str, Expr]]:
    """Each leaf and each shape of a leaf, in each shape."""
    for leaf, tree in LEAVES.items():
        for outer, within in SHAPES.items():
            yield f"{leaf} as {outer}", within(tree)
    for inner, shape in SHAPES.items():
        for outer, within in SHAPES.items():
            yield f"{inner} as {outer}", within(shape(a))
