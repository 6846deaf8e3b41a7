"""A motion of all joints over a time: from rest to rest by one law, or as functions of the time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

from derive.algebra.normal import normal
from derive.algebra.numbers.compiled import Compiled, compiled
from derive.algebra.numbers.floats import Point
from derive.derivation import Step
from derive.errors import NotDerivable
from derive.expression import ONE, Expr, Matrix, Symbol, add, column, free_symbols, multiply, number
from derive.kinds.fields import Place
from derive.kinds.path._timing import T as MOMENT
from derive.kinds.problem import Problem
from derive.names import free, named

Law = Literal["cubic", "quintic"]
POWERS: Mapping[Law, tuple[tuple[int, int], ...]] = {
    "cubic": ((3, 2), (-2, 3)),
    "quintic": ((10, 3), (-15, 4), (6, 5)),
}
ENDS = ("", "_dot", "_ddot")
ONCE = "give the motion by from:, to: and law:, or by joints: as functions of t"


@dataclass(frozen=True)
class Planned:
    """`by_time` are the joint variables, rates and accelerations as functions of t (n by 1 each), `steps` how
    they are told, in terms of what is `given` by these names; `law` is None where functions were typed."""

    problem: Problem
    time: Expr
    T: Symbol
    law: Law | None
    given: tuple[tuple[Symbol, Expr], ...]
    shares: tuple[Step, ...]
    joints: tuple[Step, ...]
    by_time: tuple[Matrix, ...]

    @cached_property
    def _functions(self) -> tuple[tuple[Compiled, ...], ...]:
        return tuple(tuple(compiled(entry) for (entry,) in each.rows) for each in self.by_time)

    def at(self, moment: float, point: Point) -> dict[str, float]:
        """The joint variables, rates and accelerations by their names, beside what is known."""
        there = {**point, MOMENT.name: moment}
        variables: Sequence[str] = self.problem.subject.variables
        found = {
            f"{name}{end}": function(there)
            for end, row in zip(ENDS, self._functions, strict=True)
            for name, function in zip(variables, row, strict=True)
        }
        return {**point, **found}


def planned(
    problem: Problem, law: Law | None, start: Place, end: Place, joints: tuple[Expr, ...], time: Expr
) -> Planned:
    """Raises NotDerivable where it is given twice or not at all, or a joint is left out."""
    if MOMENT.name in problem.taken:
        raise NotDerivable("the time is called t here, and the arm has another t")
    if bool(joints) == bool(start or end) or (joints and law is not None):
        raise NotDerivable(ONCE)
    return _typed(problem, joints, time) if joints else _at_rest(problem, law or "cubic", start, end, time)


def _typed(problem: Problem, joints: tuple[Expr, ...], time: Expr) -> Planned:
    """Functions of t, differentiated."""
    n = len(problem.subject.variables)
    if len(joints) != n:
        raise NotDerivable(f"{len(joints)} functions for {n} joint{'s' if n > 1 else ''}", "joints")
    letters = problem.taken | {name for tree in joints for name in free_symbols(tree)}
    T = named("T", time, letters)
    slopes = [normal(tree, problem.names).diff(MOMENT.name) for tree in joints]
    rates = column(problem.readable(each) for each in slopes)
    rises = column(problem.readable(each.diff(MOMENT.name)) for each in slopes)
    by_time = (column(joints), rates, rises)
    names = (Symbol(free(letters, each, f"{each}_e")) for each in ("q", "q_dot", "q_ddot"))
    told = tuple(
        Step(name.name, (name, tree), "in-numbers") for name, tree in zip(names, by_time, strict=True)
    )
    given = () if time == T else ((T, time),)
    return Planned(problem, time, T, None, given, (), told, by_time)


def _at_rest(problem: Problem, law: Law, start: Place, end: Place, time: Expr) -> Planned:
    """All joints share one law from one place to another."""
    letters = problem.taken
    T = named("T", time, letters)
    variables = problem.subject.variables
    first, last = (_place(each, key, variables) for each, key in ((start, "from"), (end, "to")))
    q_0, q_f, *names = (
        Symbol(free(letters, each, f"{each}_e")) for each in ("q_0", "q_f", "q", "q_dot", "q_ddot")
    )
    s, *rates = shares = tuple(Symbol(free(letters, each, f"{each}_e")) for each in ("s", "s_dot", "s_ddot"))
    way = q_f - q_0
    formulas = (q_0 + multiply(s, way), *(multiply(each, way) for each in rates))
    laws = [polynomial(law, time, order) for order in range(3)]
    ways = [b - a for a, b in zip(first, last, strict=True)]
    by_time = (
        column(add(a, multiply(laws[0], d)) for a, d in zip(first, ways, strict=True)),
        *(column(multiply(each, d) for d in ways) for each in laws[1:]),
    )
    return Planned(
        problem,
        time,
        T,
        law,
        ((q_0, column(first)), (q_f, column(last)), *(() if time == T else ((T, time),))),
        tuple(
            Step(name.name, (name, polynomial(law, T, order)), "in-numbers")
            for order, name in enumerate(shares)
        ),
        tuple(
            Step(name.name, (name, tree), "in-numbers") for name, tree in zip(names, formulas, strict=True)
        ),
        by_time,
    )


def _place(given: Place, key: str, variables: Sequence[str]) -> tuple[Expr, ...]:
    """A value for each joint variable. Raises NotDerivable where one is left out, or is none."""
    found = dict(given)
    listed = ", ".join(variables)
    if unknown := sorted(found.keys() - {*variables}):
        raise NotDerivable(f"'{unknown[0]}' is no joint variable; they are {listed}", key)
    if missing := [name for name in variables if name not in found]:
        raise NotDerivable(f"no value for {', '.join(missing)}; give each of {listed} one", key)
    return tuple(found[name] for name in variables)


def polynomial(law: Law, T: Expr, order: int) -> Expr:
    """The share of the way, or a derivative of it by the time t."""
    terms = []
    for coefficient, k in POWERS[law]:
        for step in range(order):
            coefficient *= k - step
        power = k - order
        above = ONE if not power else MOMENT if power == 1 else MOMENT ** number(power)
        terms.append(multiply(number(coefficient), above) / T ** number(k))
    return add(*terms)
