"""The sets on which a Jacobian loses rank: det J, the rank in a configuration of each, none outside them."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from itertools import pairwise
from typing import Any, TypeAlias

import mpmath
import sympy

from derive.audit.asked import Asked, Beyond, Holds, Same, Test
from derive.audit.budget import spend
from derive.audit.linear import Rows, det, product, transposed
from derive.audit.points import Irrational, Number, Point, floating, shown
from derive.audit.text import Json

APART = re.compile(", | and ")
SEARCHES = 4  # lines on which zeros of det J are sought
ZERO = mpmath.mpf(10) ** -20
Jacobian: TypeAlias = Callable[[Point], Rows]


def size(J: Rows) -> Number:
    """det J, or det of the smaller of J J^T and J^T J."""
    if len(J) == len(J[0]):
        return det(J)
    wide = len(J) < len(J[0])
    return det(product(J, transposed(J)) if wide else product(transposed(J), J))


def singular_sets(asked: Asked, point: Point, J: Jacobian) -> Iterator[Test]:
    """det J; the rank of J in a random configuration of each set; and no zero of det J outside them."""
    yield Same("det", size(J(point)))
    if point.exact:
        raise Irrational
    sets = asked.objects("solutions")
    for k, each in enumerate(sets, 1):
        if asked.subject_name == "matrix":
            told = {f"{equation} = 0" for equation in each["equations"]}
            said = each["when"].rpartition(": ")[2]  # behind "inside larger sets"
            yield Holds("solutions", {*APART.split(said)} == told, f"set {k} is said to be another one")
        yield _ranked(asked, each, f"set {k}", point, J)
    if not sets and asked.results.get("complete"):
        yield Holds("solutions", True, "")
    if asked.results.get("complete") and not point.seed:
        yield from _complete(asked, point, J, sets)
    else:
        yield Holds("complete", True, "")


def rank_near(J: Rows) -> int:
    """The rank of a matrix of numbers that are known to 20 digits."""
    J = [[entry if abs(floating(entry)) > ZERO else mpmath.mpf(0) for entry in row] for row in J]
    values = mpmath.svd_r(mpmath.matrix([list(row) for row in J]), compute_uv=False)
    return sum(value > ZERO * max(values) for value in values)


def _ranked(asked: Asked, each: Mapping[str, Any], set_k: str, point: Point, J: Jacobian) -> Test:
    """The rank of J in a random configuration of a set: by the values it gives, and by Newton's method for
    what its equations ask beyond them."""
    joints = asked.subject.variables
    values = {name: asked.read(each[name]) for name in joints if name in each}
    given = {sympy.Symbol(name): value for name, value in values.items()}
    equations = [equation.subs(given) for equation in asked.read(each["equations"])]
    left = [equation for equation in equations if abs(floating(point.at(equation))) > ZERO]
    free = {name: point[name] for name in joints if name not in values}
    if any(not equation.has(*map(sympy.Symbol, free)) for equation in left):
        return Holds("solutions", False, f"{set_k} has values that its equations forbid")
    there = solved(left, free, point) if left else point
    if there is None:
        return Beyond("solutions", f"no configuration was found in {set_k}")
    rows = J(there.where(**values))
    if any(isinstance(entry, mpmath.mpc) for row in rows for entry in row):
        return Beyond("solutions", f"{set_k} is not real at this point")
    found = rank_near(rows)
    right = found == each["rank"] if "rank" in each else found <= each["rank_at_most"]
    return Holds("solutions", right, f"{set_k} has rank {found}")


def solved(equations: list[sympy.Expr], here: Mapping[str, Number], point: Point) -> Point | None:
    """A configuration near here where equations hold: Newton's steps of least length."""
    q = {name: mpmath.mpf(value) for name, value in here.items()}
    slopes = [[each.diff(sympy.Symbol(name)) for name in q] for each in equations]
    for _ in range(60):
        there = point.where(**q)
        errors = there.vector(equations)
        if max(abs(floating(error)) for error in errors) < ZERO**2:
            return there
        J = mpmath.matrix(there.matrix(slopes))
        try:
            step = J.T * mpmath.lu_solve(J * J.T, mpmath.matrix(errors))
        except ZeroDivisionError:
            return None
        longest = max(abs(each) for each in step)
        for name, change in zip(q, step, strict=True):
            q[name] -= change / max(1, longest)
    return None


def _complete(asked: Asked, point: Point, J: Jacobian, sets: list[Mapping[str, Json]]) -> Iterator[Test]:
    """Zeros of det J on random lines through the configurations: each lies in one of the sets."""
    equations = [asked.read(each["equations"]) for each in sets]
    for k in range(SEARCHES):
        other = Point(500 + k, False, point.angles, point.assumptions)
        lines = {name: (other[name], other[f"{name}_ddot"]) for name in asked.subject.variables}
        root = _zero_on(point, J, lines)
        if root is None:
            continue
        there = point.where(**{name: start + root * along for name, (start, along) in lines.items()})
        inside = any(all(abs(floating(there.at(each))) < ZERO for each in some) for some in equations)
        where = {name: shown(there[name]) for name in asked.subject.variables}
        yield Holds("complete", inside, f"J is singular at {where}, in none of the sets")
    yield Holds("complete", True, "")


def _zero_on(point: Point, J: Jacobian, lines: Mapping[str, tuple[Number, Number]]) -> Number | None:
    """Where det J is zero on a line, if it is found."""

    def at(s: Number) -> Number:
        spend(2000)
        there = point.where(**{name: start + s * along for name, (start, along) in lines.items()})
        return size(J(there))

    samples = [(mpmath.mpf(i) / 10, at(mpmath.mpf(i) / 10)) for i in range(-10, 11)]
    for (a, left), (b, right) in pairwise(samples):
        if left * right < 0:
            return mpmath.findroot(at, (a, b), solver="anderson", tol=ZERO**2.5, verify=False, maxsteps=200)
    return None
