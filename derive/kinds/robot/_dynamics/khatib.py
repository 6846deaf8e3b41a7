"""The symbols b_ijk of the mass matrix and what is made of them, in Khatib's notation."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import combinations, combinations_with_replacement, product

from derive.algebra.normal import normal_matrix
from derive.algebra.scalar import Scalar
from derive.derivation import Record, Step
from derive.expression import (
    ZERO,
    Derivative,
    Expr,
    Matrix,
    Product,
    Sum,
    Symbol,
    add,
    multiply,
    negate,
    number,
)
from derive.kinds.naming import entry_symbol
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import moment_names
from derive.kinds.robot._dynamics.rates import pairs, rates, squares, symbols_of, velocity_terms

Index = tuple[int, int, int]
MOST_SHOWN = 3  # joints; with more, the symbols that vanish are only counted
HALF, TWO = number("1/2"), number(2)


@dataclass(frozen=True, slots=True)
class Velocity:
    """The velocity terms of an arm: b_ijk for j <= k as `symbols` and, on the page, as `values`; the
    matrices C and B (None of one joint), and v."""

    symbols: Mapping[Index, Scalar]
    values: Mapping[Index, Expr]
    C: Matrix
    B: Matrix | None
    v: Matrix


def velocity_of(problem: Problem, big: bool) -> Velocity:
    """Every b_ijk = c_jki, with what it makes."""
    named, variables = moment_names(problem.ask("inertia-matrix")), problem.subject.variables
    found = symbols_of(problem)

    def shown(value: Scalar) -> Expr:
        return problem.final(problem.readable(value), named) if value else ZERO

    b = {(i, j, k): found[j, k, i] for i, j, k in sorted((i, j, k) for j, k, i in found if j <= k)}
    values = {ijk: shown(value) for ijk, value in b.items()}
    n = range(1, len(variables) + 1)
    C = Matrix(tuple(tuple(values[i, j, j] for j in n) for i in n))
    doubled = {ijk: multiply(TWO, values[ijk]) if big else shown(2 * b[ijk]) for ijk in b}
    columns = list(combinations(n, 2))
    B = Matrix(tuple(tuple(doubled[i, j, k] for j, k in columns) for i in n)) if columns else None
    if big:
        v = Matrix(tuple((_sum(values, doubled, variables, i),) for i in n))
    else:
        v = Matrix(tuple((shown(entry),) for entry in velocity_terms(found, variables).entries))
    return Velocity(b, values, C, B, v)


def _sum(
    values: Mapping[Index, Expr], doubled: Mapping[Index, Expr], variables: tuple[str, ...], i: int
) -> Expr:
    """v_i as it comes, where it is too long to be written better."""
    n, rate = range(1, len(variables) + 1), rates(variables)
    alone = [multiply(values[i, j, j], rate[j - 1], rate[j - 1]) for j in n]
    mixed = [multiply(doubled[i, j, k], rate[j - 1], rate[k - 1]) for j, k in combinations(n, 2)]
    return add(*alone, *mixed)


def entry_steps(problem: Problem, D: Expr) -> tuple[Step, ...]:
    """m_ijk, the derivative of m_ij by q_k, for i <= j; those that vanish are left out."""
    M, variables, named = (
        normal_matrix(D),
        problem.subject.variables,
        moment_names(problem.ask("inertia-matrix")),
    )
    n, steps = len(variables), []
    for (i, j), k in product(combinations_with_replacement(range(n), 2), range(n)):
        value = M[i, j].diff(variables[k])
        if value:
            names = [m(i + 1, j + 1, k + 1)] + ([m(j + 1, i + 1, k + 1)] if i != j else [])
            partial = Derivative(entry_symbol("m", i + 1, j + 1), Symbol(variables[k]))
            final = problem.final(problem.readable(value), named)
            steps.append(Step(names[0].name, (*names, partial, final), "entry-derivative"))
    return tuple(steps)


class OfRow(Record):
    row: int


def symbol_steps(velocity: Velocity, n: int) -> tuple[Step, ...]:
    """b_ijk = (m_ijk + m_ikj - m_jki) / 2; of long arms only those that do not vanish."""
    steps = []
    for (i, j, k), value in velocity.symbols.items():
        if value or n <= MOST_SHOWN:
            names = [entry_symbol("b", i, j, k)] + ([entry_symbol("b", i, k, j)] if j != k else [])
            raw = Sum((m(i, j, k), m(i, k, j), negate(m(j, k, i))))
            steps.append(
                Step(
                    names[0].name, (*names, multiply(HALF, raw), velocity.values[i, j, k]), "b", OfRow(row=i)
                )
            )
    return tuple(steps)


def matrix_steps(velocity: Velocity, variables: tuple[str, ...], big: bool) -> tuple[Step, ...]:
    """C, B and v in names, and written out where that is not too long."""
    n, columns = range(1, len(variables) + 1), list(combinations(range(1, len(variables) + 1), 2))
    C = Matrix(tuple(tuple(entry_symbol("b", i, j, j) for j in n) for i in n))
    whole: Expr = Product((Symbol("C"), squares(variables)))
    steps = [_step("C", C, velocity.C, big)]
    others = pairs(variables)
    if velocity.B and others:
        B = Matrix(tuple(tuple(multiply(TWO, entry_symbol("b", i, j, k)) for j, k in columns) for i in n))
        steps.append(_step("B", B, velocity.B, big))
        whole = Sum((whole, Product((Symbol("B"), others))))
    return (*steps, _step("v", whole, velocity.v, big))


def definitions_of(D: Expr, steps: tuple[Step, ...], velocity: Velocity) -> dict[Expr, Expr]:
    """m_ij, m_ijk, b_ijk, C, B and v."""
    found: dict[Expr, Expr] = {Symbol("C"): velocity.C, Symbol("v"): velocity.v}
    if velocity.B:
        found[Symbol("B")] = velocity.B
    rows = D.rows if isinstance(D, Matrix) else ()
    for i, row in enumerate(rows, 1):
        for j, entry in enumerate(row, 1):
            found[entry_symbol("m", i, j)] = entry
            found |= {m(i, j, k): ZERO for k in range(1, len(rows) + 1)}
    for step in steps:
        if step.rule == "entry-derivative":
            found |= {name: step.result for name in step.chain if isinstance(name, Symbol)}
    for (i, j, k), value in velocity.values.items():
        found |= {entry_symbol("b", i, j, k): value, entry_symbol("b", i, k, j): value}
    return found


def m(i: int, j: int, k: int) -> Symbol:
    return entry_symbol("m", i, j, k)


def _step(name: str, named: Expr, value: Expr, big: bool) -> Step:
    return Step(name, (Symbol(name), named) if big else (Symbol(name), named, value), "matrix")
