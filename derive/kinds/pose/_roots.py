"""Square roots of exact numbers as a person writes them: 2 where it is 2, else the root of a short number."""

from __future__ import annotations

from derive.algebra.kernels import root
from derive.algebra.normal import normal
from derive.algebra.scalar import Scalar
from derive.expression import Call, Expr, Product, Quotient, multiply, sqrt
from derive.kinds.problem import Problem


def size(square: Scalar, problem: Problem) -> Expr:
    """The root of a number: taken where it is a number itself, else as a root of what stands below it."""
    taken = root(square)
    return problem.readable(taken) if is_plain(taken) else sqrt(problem.readable(square))


def over(part: Scalar, square: Scalar, problem: Problem) -> Expr:
    """A number divided by the root of another."""
    taken = root(square)
    if is_plain(taken):
        return problem.readable(part / taken)
    return Quotient(problem.readable(part), size(square, problem)) if part else problem.readable(part)


def shortened(expr: Expr, problem: Problem) -> Expr:
    """A number in its shortest form; a root of roots keeps its sign outside and a short number inside."""
    match expr:
        case Product((factor, Call("sqrt", (inside,)))):
            return multiply(factor, size(normal(inside), problem))
        case Call("sqrt", (inside,)):
            return size(normal(inside), problem)
    return problem.readable(normal(expr))


def is_plain(value: Scalar) -> bool:
    """Whether no root stands for the root of an expression."""
    return not any(name.startswith(("sqrt((", "abs(")) for name in value.generators())
