"""The ways in which a linkage can be put together for a position of its crank."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from derive.derivation import Branch, Phrase
from derive.expression import Expr, Symbol, replace
from derive.kinds.problem import Problem
from derive.kinds.work import Work


@dataclass(frozen=True)
class Assembly:
    """One of them: on which `side`, and the names of its working with their formulas, each in those before
    it; `unknown` are the coordinates that are sought."""

    side: Phrase
    formulas: Mapping[Symbol, Expr]
    unknown: tuple[Symbol, ...]

    def branch(self, problem: Problem, given: Mapping[Expr, Expr]) -> Branch:
        """As a result: with everything put in, and in short formulas. `given` are the names of what the
        author typed."""
        own = {name: replace(value, problem.names) for name, value in given.items()} | dict(problem.names)
        short = {name: replace(formula, own) for name, formula in self.formulas.items()}
        values: dict[Expr, Expr] = {}
        for name, formula in short.items():
            values[name] = replace(formula, values)
        whole = {name.name: values[name] for name in self.unknown}
        return Branch(whole, (self.side,), {name.name: formula for name, formula in short.items()})


@dataclass(frozen=True)
class Closed:
    """The board with the steps, the assemblies, and names: of the root `w` that has two signs, and of all
    that the words speak of."""

    work: Work
    assemblies: tuple[Assembly, ...]
    w: Symbol
    s: Symbol  # the place of a slider
    names: Mapping[str, Symbol]
