"""What of SymPy's algebra may be dear, each for a price that is known before it begins.

Auditors put numbers in first, so that little is left to algebra; no other module of the audit calls these
routines of SymPy.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import comb, prod

import sympy
from sympy.polys.matrices import DomainMatrix

from derive.audit.budget import spend


def expanded(expr: sympy.Expr) -> sympy.Expr:
    """Without products of sums. Raises Exhausted."""
    spend(terms(expr))
    return sympy.expand(expr)


def terms(expr: sympy.Expr) -> int:
    """How many terms an expression has at most when it is expanded."""
    if expr.is_Add:
        return sum(map(terms, expr.args))
    if expr.is_Mul:
        return prod(map(terms, expr.args))
    if expr.is_Pow and expr.exp.is_Integer:
        n, power = terms(expr.base), abs(int(expr.exp))
        return comb(n + power - 1, power)
    return max(map(terms, expr.args), default=1)


def solution(equations: Sequence[sympy.Expr], unknowns: Sequence[sympy.Symbol]) -> tuple[sympy.Expr, ...]:
    """Of linear equations; nothing where there is none. Raises Exhausted."""
    n = len(unknowns)
    others = sympy.Matrix(equations).free_symbols - set(unknowns)
    spend(sum(map(terms, equations)) + n**3 * (n + 1) ** len(others))
    found: tuple[sympy.Expr, ...] = next(iter(sympy.linsolve(equations, *unknowns)), ())
    return found


def cancelled(ratio: sympy.Expr) -> tuple[sympy.Expr, sympy.Expr]:
    """Numerator and denominator of a ratio without common factors, among the roots that are in it. Raises
    Exhausted."""
    whole = sympy.together(ratio)
    indices = [power.exp.q for power in whole.atoms(sympy.Pow) if power.exp.is_Rational]
    degree = prod(indices)  # of the field of these roots
    spend(degree**3 * sum(map(terms, sympy.fraction(whole))) ** max(1, len(whole.free_symbols)))
    cancel = sympy.cancel(whole, extension=True) if degree > 1 else sympy.cancel(whole)
    found: tuple[sympy.Expr, sympy.Expr] = sympy.fraction(cancel)
    return found


def determinant(M: sympy.Matrix, s: sympy.Symbol) -> list[sympy.Expr]:
    """Of a matrix of polynomials in s with numbers: its coefficients, the highest power first. Raises
    Exhausted."""
    spend(M.rows**3 * sum(map(terms, M)))
    rows = DomainMatrix.from_Matrix(M)
    found: list[sympy.Expr] = sympy.Poly(rows.domain.to_sympy(rows.det()), s).all_coeffs()
    return found
