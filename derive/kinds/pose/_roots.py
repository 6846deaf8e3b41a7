"""Square roots of exact numbers as a person writes them: 2 where it is 2, else the root of a short number."""

from __future__ import annotations

from math import lcm

from derive.algebra.normal import normal
from derive.algebra.rationals import as_fraction
from derive.algebra.roots_and_functions import root
from derive.algebra.scalar import Scalar
from derive.expression import Call, Expr, Product, Quotient, multiply, number, sqrt
from derive.kinds.problem import Problem


def size(square: Scalar, problem: Problem) -> Expr:
    """The root of a number: taken where it is a number itself, else as a root of what stands below it."""
    taken = root(square)
    return problem.readable(taken) if is_plain(taken) else sqrt(problem.readable(square))


def over(part: Scalar, square: Scalar, problem: Problem) -> Expr:
    """A number divided by the root of another; its own denominator stands before the root."""
    taken = root(square)
    if is_plain(taken) or not part:
        return problem.readable(part / taken)
    below = lcm(*(as_fraction(each).denominator for each in part.numerator.coeffs()))
    return Quotient(problem.readable(part * below), multiply(number(below), size(square, problem)))


def shortened(expr: Expr, problem: Problem) -> Expr:
    """A number in its shortest form; a root of roots keeps its sign outside and a short number inside."""
    match expr:
        case Product((factor, Call("sqrt", (inside,)))):
            return multiply(factor, size(normal(inside), problem))
        case Call("sqrt", (inside,)):
            return size(normal(inside), problem)
    return problem.readable(normal(expr))


def is_plain(value: Scalar) -> bool:
    """Whether no root stands for the root of an expression; a size |x| may be left."""
    return not any(name.startswith("sqrt((") for name in value.generators())
