"""States of rest: put back, looked for, judged by how small motions grow, and the linear equations there."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, TypeAlias

import mpmath
import numpy as np
import sympy

from derive.audit.asked import Asked, Holds, Same, Test
from derive.audit.conditions import holds
from derive.audit.points import Point, floating
from derive.audit.putting_back import array, is_real, placed, put_back, told, vanishes
from derive.audit.roots import found_from_anywhere
from derive.audit.subjects.lagrange.energies import TIME, Energies, as_bodies_are

Values: TypeAlias = Mapping[sympy.Symbol, sympy.Expr]
ZERO = sympy.Integer(0)
GROWS = 1e-5  # of the fastest motion: one that grows slower may not grow
NEAR = 1e-6
PLACES = 20  # where masses are looked for that are positive
OPEN = "stability not decided by the terms of second order"
NEUTRAL = re.compile(r"^in .+? ((?:un)?stab.*), in .+ indifferent$")
CASES = re.compile(r"(stable|unstable) if (.+?)(?=, unstable if |$)")


def equilibria(asked: Asked, point: Point) -> Iterator[Test]:
    """No equation is left over at any of them, none is missing, and small motions grow or do not."""
    system = Energies(asked)
    there = _of_masses(system, point)
    given = {sympy.Symbol(name): asked.formula(value) for name, value in asked.options.inputs or ()}
    still = {**dict.fromkeys((*inputs(system), *system.rates, *system.accelerations), ZERO), **given}
    equations = [left - force for left, force in zip(system.lefts, system.forces, strict=True)]
    left = [equation.subs(still) for equation in equations]
    slopes = [sympy.Matrix(equations).jacobian(by) for by in (system.accelerations, system.rates, system.q)]
    branches = [
        ({q: asked.read(each[q.name]) for q in system.q}, str(each["when"]))
        for each in asked.objects("solutions")
    ]
    for place, when in branches:
        yield vanishes("solutions", there, left, place, f"it does not rest at {_shown(place)}")
        strange = sympy.Matrix(list(place.values())).free_symbols - sympy.Matrix(left).free_symbols
        yield Holds("solutions", strange <= set(place), f"{strange} stands nowhere on the sheet")
        if all(is_real(there.at(value)) for value in place.values()):
            growth = _growth(slopes, placed(there, {**still, **place}))
            if growth is not None:
                yield from _judged(when, growth, _shown(place), asked, there)
    yield _complete(system, left, [place for place, _ in branches], there)


def _of_masses(system: Energies, point: Point) -> Point:
    """A point near this one where every motion has kinetic energy, if there is one."""
    for place in range(PLACES):
        there = as_bodies_are(system, Point(point.seed + 100 * place, point.exact, (), point.assumptions))
        free = Point(there.seed, False, (), there.assumptions)
        M = np.array(system.mass.applyfunc(lambda e, at=free: float(floating(at.at(e)))).tolist(), float)
        if np.linalg.eigvalsh(M).min() > 0:
            break
    return there


def inputs(system: Energies) -> list[sympy.Symbol]:
    """Names that drive: they stand in forces and nowhere else, beside no rate, time or coordinate of theirs,
    and are not declared positive."""
    lost = system.asked.formula(system.system.dissipation)
    known = {*(system.lagrangian + lost).free_symbols, *system.q, *system.rates, TIME}
    found: dict[sympy.Symbol, bool] = {}
    for q, force in zip(system.q, system.forces, strict=True):
        for name in sorted(force.free_symbols - known, key=str):
            beside = force.diff(name).free_symbols & {q, *system.rates, TIME}
            declared = system.asked.assumptions.get(name.name) == "positive"
            found[name] = found.get(name, True) and not beside and not declared
    return [name for name, drives in found.items() if drives]


def _growth(slopes: Sequence[sympy.Matrix], rest: Point) -> float | None:
    """The largest real part among the eigenvalues of the linear motion, the fastest of them being 1; None
    where the names have values that no mass has. The slopes are by accelerations, rates and coordinates."""
    M, C, K = (np.array(_real(each.tolist(), rest), float) for each in slopes)
    if np.linalg.eigvalsh(M + M.T).min() <= 0:
        return None
    n = len(K)
    below = -np.linalg.solve(M, np.hstack([K, C]))
    found = np.linalg.eigvals(np.vstack([np.hstack([np.zeros((n, n)), np.eye(n)]), below]))
    return float(found.real.max() / max(abs(found).max(), 1e-300))


def _real(rows: Sequence[Sequence[sympy.Expr]], point: Point) -> list[list[float]]:
    return [[float(mpmath.re(floating(point.at(entry)))) for entry in row] for row in rows]


def _judged(when: str, growth: float, place: str, asked: Asked, point: Point) -> Iterator[Test]:
    """The word, or each word whose condition holds."""
    said, _, need = when.partition(" where ")
    said = NEUTRAL.sub(r"\1", said)
    if need and holds(need, asked, point) is False:
        yield Holds("solutions", False, f"{place} is real although {need} does not hold")
    cases = CASES.findall(said) or [(said, "")]
    for word, condition in cases:
        if not condition or holds(condition, asked, point):
            right = {"stable": growth <= GROWS, "unstable": growth > GROWS, OPEN: True}.get(word, False)
            yield Holds("solutions", right, f"{place} is not {when}")


def _complete(system: Energies, left: list[sympy.Expr], branches: list[Values], point: Point) -> Holds:
    """No state of rest that Newton's method finds is missing, angles counted up to full turns."""
    rows = [each for each in left if each.free_symbols & set(system.q)]
    if not rows or len(rows) < len(system.q):
        return Holds("solutions", True, "")
    angles = {q for q in system.q if all(_turns(each, q, point) for each in rows)}
    for found in found_from_anywhere(rows, system.q, point):
        place = dict(zip(system.q, found, strict=True))
        if not any(_is_at(values, place, angles, point) for values in branches):
            shown = ", ".join(f"{q} = {value:.6g}" for q, value in place.items())
            return Holds("solutions", False, f"it rests at {shown} too")
    return Holds("solutions", True, "")


def _turns(expr: sympy.Expr, q: sympy.Symbol, point: Point) -> bool:
    """Whether a full turn of this coordinate changes nothing."""
    again = expr.subs(q, q + 2 * sympy.pi)
    return put_back("", point, again, expr, "").holds


def _is_at(
    values: Values, place: Mapping[sympy.Symbol, float], angles: set[sympy.Symbol], point: Point
) -> bool:
    """Whether a branch is at this place, its free coordinates as they are there."""
    free = {q: sympy.Float(value) for q, value in place.items() if values[q] == q}
    for q, value in place.items():
        gap = floating(point.at(values[q].subs(free))) - value
        if q in angles and is_real(gap):
            gap = (mpmath.re(gap) + mpmath.pi) % (2 * mpmath.pi) - mpmath.pi
        if abs(gap) > NEAR * (1 + abs(value)):
            return False
    return True


def _shown(place: Values) -> str:
    return ", ".join(f"{q} = {value}" for q, value in place.items())


# -- linear equations ---------------------------------------------------------------------------------


def linearisation(asked: Asked, point: Point) -> Iterator[Test]:
    """The derivatives of the equations at the state, and A, B with M_0 times their lower rows."""
    system, options = Energies(asked), asked.options
    named = options.inputs
    u = inputs(system) if named is None else [sympy.Symbol(name) for name in named]
    at = dict.fromkeys((*u, *system.rates, *system.accelerations), ZERO)
    at |= {sympy.Symbol(name): asked.formula(value) for name, value in options.at or ()}
    equations = [left - force for left, force in zip(system.lefts, system.forces, strict=True)]
    rest = placed(point, at)
    yield put_back("K_0", rest, equations, [ZERO] * len(equations), "the state is none of rest")
    by = {"M_0": system.accelerations, "C_0": system.rates, "K_0": system.q, "F_0": u}
    found = {name: sympy.Matrix(equations).jacobian(names) for name, names in by.items() if names}
    for name, matrix in found.items():
        told_ = name in asked.results
        if told_ or name != "C_0":
            yield Same(name, told(-matrix if name == "F_0" else matrix, rest))
        else:
            yield put_back("A", rest, matrix, sympy.zeros(*matrix.shape), "there is a C_0")
    yield from _in_states({name: array(matrix, rest) for name, matrix in found.items()}, asked, point)


def _in_states(found: Mapping[str, np.ndarray[Any, Any]], asked: Asked, point: Point) -> Iterator[Test]:
    """z' = A z + B u: the rates on top, M_0 times what is below them."""
    M, C, K = (found[name] for name in ("M_0", "C_0", "K_0"))
    n = len(M)
    A = array(asked.result("A"), point)
    top = [ZERO] * (n * n) + [ZERO + (i == j) for i in range(n) for j in range(n)]
    yield put_back("A", point, [A[:n, :n], A[:n, n:]], top, "its upper rows are not the rates")
    yield put_back("A", point, [M @ A[n:, :n], M @ A[n:, n:]], [-K, -C], "M_0 times its lower rows")
    if "B" in asked.results:
        B = array(asked.result("B"), point).reshape(2 * n, -1)
        yield put_back("B", point, B[:n], [ZERO] * B[:n].size, "its upper rows are not zero")
        yield put_back("B", point, M @ B[n:], -found["F_0"], "M_0 times its lower rows")
