"""The Christoffel symbols of the inertia matrix, each from its partial derivatives."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from fractions import Fraction

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.scalar import Scalar
from derive.derivation import Claim, Derivation, PageFacts, Step
from derive.expression import (
    ZERO,
    Derivative,
    Expr,
    Number,
    Sum,
    Symbol,
    add,
    multiply,
    negate,
    number,
)
from derive.kinds.checks import law, links
from derive.kinds.fields import OptionsModel
from derive.kinds.naming import entry_symbol
from derive.kinds.problem import Problem
from derive.kinds.robot import inertia_matrix
from derive.kinds.robot._chain import moment_names
from derive.mechanics.dynamics import christoffel
from derive.mechanics.robot import Robot

RESULTS = {"c_111, c_121, ...": "every one of the n^3, c_ijk = (d_kj,i + d_ki,j - d_ij,k) / 2"}
NEEDS = ("bodies",)
EXAMPLE = """\
title: Christoffel symbols
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: a1, alpha: 0, mass: m1, com: [-a1/2, 0, 0], inertia: {rod: a1, axis: x}}
    - {theta: theta2*, d: 0, a: a2, alpha: 0, mass: m2, com: [-a2/2, 0, 0], inertia: {rod: a2, axis: x}}
  find: christoffel
"""
Index = tuple[int, int, int]
MOST_SHOWN = 3  # joints; with more, the symbols that vanish are only counted
HALF = number("1/2")


class Options(OptionsModel):
    """None."""


class Facts(PageFacts):
    big: bool
    count: int
    vanish: int  # of those not shown


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """c_ijk = (d_kj,i + d_ki,j - d_ij,k) / 2 (Spong et al., eq. 6.38)."""
    base = problem.ask("inertia-matrix")
    D = problem.normal_matrix(base.definitions[Symbol("D")])
    symbols = christoffel(D, robot.variables)
    big = base.told(inertia_matrix.Facts).big
    named = moment_names(base)
    values = {ijk: value for ijk, value in symbols.items() if ijk[0] <= ijk[1]}
    shown = () if big else _shown(values, len(robot.variables))
    steps = tuple(_step(problem, ijk, values[ijk], robot.variables, named) for ijk in shown)
    found = {ijk: step.result for ijk, step in zip(shown, steps, strict=True)}
    found |= {ijk: _final(problem, value, named) for ijk, value in values.items() if ijk not in found}
    definitions: dict[Expr, Expr] = {**base.definitions}
    definitions |= {Symbol(_name(ijk)): found[_ordered(ijk)] for ijk in symbols}
    results = {_name(ijk): found[_ordered(ijk)] for ijk in sorted(symbols)}
    claims = (*links(steps, {**problem.names, **definitions}), *_laws(D, symbols, robot.variables))
    facts = Facts(
        big=big,
        count=len(symbols),
        vanish=sum(not value for ijk, value in symbols.items() if big or _ordered(ijk) not in shown),
    )
    return Derivation("christoffel", steps, results, claims, definitions, uses=(base,), facts=facts)


def _shown(values: Mapping[Index, Scalar], n: int) -> tuple[Index, ...]:
    """Grouped by equation of motion; of an arm with many joints only those that do not vanish."""
    ordered = sorted(values, key=lambda ijk: (ijk[2], ijk))
    return tuple(ijk for ijk in ordered if values[ijk] or n <= MOST_SHOWN)


def _final(problem: Problem, value: Scalar, named: Mapping[Expr, Expr]) -> Expr:
    return problem.final(problem.readable(value), named) if value else ZERO


def _step(
    problem: Problem, ijk: Index, value: Scalar, variables: tuple[str, ...], named: Mapping[Expr, Expr]
) -> Step:
    """c_121 = c_211 = (three partial derivatives) / 2 = (those that are left) / 2 = value."""
    i, j, k = ijk
    names = [Symbol(_name(ijk))] + ([Symbol(_name((j, i, k)))] if i != j else [])
    raw = [
        (_partial(k, j, i, variables), 1),
        (_partial(k, i, j, variables), 1),
        (_partial(i, j, k, variables), -1),
    ]
    written = problem.readable(value)
    final = problem.final(written, named)
    chain = [*names, multiply(HALF, Sum(tuple(negate(d) if n < 0 else d for d, n in raw)))]
    left = _collected(raw)
    if left is not None:
        chain.append(left)
    chain += [written] if written != chain[-1] else []
    chain += [final] if final != written else []
    return Step(names[0].name, tuple(chain), "christoffel")


def _partial(a: int, b: int, by: int, variables: tuple[str, ...]) -> Expr:
    return Derivative(entry_symbol("d", min(a, b), max(a, b)), Symbol(variables[by - 1]))


def _collected(raw: list[tuple[Expr, int]]) -> Expr | None:
    """Half the sum with equal derivatives collected; None where none are equal."""
    counts: Counter[Expr] = Counter()
    for derivative, sign in raw:
        counts[derivative] += sign
    kept = [(derivative, n) for derivative, n in counts.items() if n]
    if len(kept) == len(raw):
        return None
    return add(*(multiply(Number(Fraction(n, 2)), derivative) for derivative, n in kept))


def _laws(D: ScalarMatrix, symbols: Mapping[Index, Scalar], variables: tuple[str, ...]) -> tuple[Claim, ...]:
    """c_ijk = c_jik, and dD/dt - 2C skew-symmetric for every rate."""
    n = len(variables)
    skew = True
    for i, name in enumerate(variables, 1):
        rate = D.diff(name)
        entries = {
            (k, j): rate[k - 1, j - 1] - 2 * symbols[i, j, k]
            for k in range(1, n + 1)
            for j in range(1, n + 1)
        }
        skew &= all(entries[k, j] == -entries[j, k] for k in range(1, n + 1) for j in range(k, n + 1))
    return (
        law("symmetric", all(value == symbols[j, i, k] for (i, j, k), value in symbols.items())),
        law("skew-symmetric", skew),
    )


def _name(ijk: Index) -> str:
    return entry_symbol("c", *ijk).name


def _ordered(ijk: Index) -> Index:
    i, j, k = ijk
    return (min(i, j), max(i, j), k)
