"""Typed trees, the formulas of a subject's records, as SymPy expressions."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

import sympy

from derive.audit.text import FUNCTIONS, Names
from derive.expression import (
    PI,
    Approximate,
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
    free_symbols,
)

OTHER_NAMES = {"abs": "Abs", "max": "Max", "min": "Min"}


def sympy_of(tree: Expr, names: Names) -> sympy.Expr:
    """The tree in SymPy; a name of `names` stands for its value. Raises TypeError for what is no scalar."""
    match tree:
        case Number(value):
            return rational(value)
        case Approximate(approximate):
            return sympy.Float(approximate)
        case Degrees(value):
            return rational(value) * sympy.pi / 180
        case Symbol(name):
            return sympy.pi if tree == PI else names.get(name, sympy.Symbol(name))
        case Sum(terms):
            return sympy.Add(*(sympy_of(term, names) for term in terms))
        case Product(factors):
            return sympy.Mul(*(sympy_of(factor, names) for factor in factors))
        case Quotient(top, bottom):
            return sympy_of(top, names) / sympy_of(bottom, names)
        case Power(base, exponent):
            return sympy_of(base, names) ** sympy_of(exponent, names)
        case Call(function, arguments) if (known := OTHER_NAMES.get(function, function)) in FUNCTIONS:
            return FUNCTIONS[known](*(sympy_of(argument, names) for argument in arguments))
        case _:
            raise TypeError(f"no scalar: {tree!r}")


def rows_of(matrix: Matrix, names: Names) -> list[list[sympy.Expr]]:
    """The entries of a typed matrix."""
    return [[sympy_of(entry, names) for entry in row] for row in matrix.rows]


def rational(value: Fraction) -> sympy.Rational:
    return sympy.Rational(value.numerator, value.denominator)


def names_of(where: Mapping[str, Expr]) -> Names:
    """The values of `where`, each in terms of names that stand for nothing else."""
    found: dict[str, sympy.Expr] = {}

    def resolved(name: str) -> sympy.Expr:
        if name not in found:
            for other in free_symbols(where[name]) & where.keys():
                resolved(other)
            found[name] = sympy_of(where[name], found)
        return found[name]

    for name in where:
        resolved(name)
    return found
