"""What the words about singular configurations need to know."""

from __future__ import annotations

from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.expression import ZERO, Expr, Product, Symbol, transpose
from derive.kinds.problem import Problem
from derive.kinds.robot._singular.determinants import mostly_negative, opposite
from derive.kinds.robot._singular.sets import Analysed, Case, clauses, rooted, written
from derive.kinds.robot._singular.work import Work

WRIST = 3  # the rank of the other block, which is regular there


def facts_of(problem: Problem, work: Work, sets: tuple[Analysed, ...]) -> dict[str, Any]:
    """The way, and each set with its cases as plain values."""
    first = work.parts[0].block
    J, wide = Symbol(first.name), len(first.rows) < len(first.variables)
    return {
        "way": work.way,
        "rows": tuple(map(Symbol, first.rows)),
        "frame": first.frame,
        "frames": tuple(part.block.frame for part in work.parts),
        "rates": tuple(_rates(part.block.variables) for part in work.parts),
        "wide": wide,
        "gram": Product((J, transpose(J)) if wide else (transpose(J), J)),
        "sets": tuple(_set(problem, work, each) for each in sets),
        "none": not sets and all(part.complete for part in work.parts),
        "complete": all(part.complete for part in work.parts),
    }


def _rates(variables: tuple[str, ...]) -> tuple[Symbol, ...]:
    return tuple(Symbol(f"{name}_dot") for name in variables)


def _set(problem: Problem, work: Work, each: Analysed) -> dict[str, Any]:
    cases = tuple(_case(problem, work, each, case) for case in each.cases)
    alike = len(cases) == 2 and not cases[1]["known"] and cases[0]["looks"] == cases[1]["looks"]
    return {
        "equations": tuple((_positive(equation), ZERO) for equation in each.equations),
        "cases": cases[:1] if alike else cases,
        "alike": alike,
        "angular": each.block.name == "J_22" or each.block.rows[0][0] == "w",
        "frame": each.block.frame,
        "places": tuple(value for case in each.cases for value in case.values),
        "conditions": each.cases[0].conditions if each.cases else (),
    }


def _case(problem: Problem, work: Work, each: Analysed, case: Case) -> dict[str, Any]:
    shown = case.J is not None and not rooted(case.J)
    J = Symbol(each.block.name)
    return {
        "places": case.values,
        "looks": clauses(case, each.block, work.point),
        "known": case.J is not None,
        "block": J if each.block.name in ("J_11", "J_22") else None,
        "whole": case.rank + WRIST,
        "rank": case.rank,
        "J": ((J, written(problem, case.J)),) if shown and case.J is not None else (),
        "null": _basis(problem, "N", case.null),
        "range": _basis(problem, "R", case.range if shown else ()),
        "lost": _basis(problem, "U", case.lost),
    }


def _basis(problem: Problem, name: str, columns: tuple[ScalarMatrix, ...]) -> tuple[tuple[Expr, ...], ...]:
    """One chain, the vectors of a basis side by side; nothing where there is none."""
    return ((Symbol(name), written(problem, ScalarMatrix.beside(columns))),) if columns else ()


def _positive(tree: Expr) -> Expr:
    """An equation tree with the sign that reads better."""
    return opposite(tree) if mostly_negative(tree) else tree
