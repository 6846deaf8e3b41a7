"""Where an arm is singular, and how well it moves elsewhere."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import pairwise
from typing import Any

import mpmath
import sympy

from derive.audit.asked import Asked, Beyond, Holds, Same, Test
from derive.audit.budget import spend
from derive.audit.linear import Rows, det, product, transposed
from derive.audit.points import Irrational, Number, Point, agree, floating, shown
from derive.audit.putting_back import put_back
from derive.audit.subjects.robot.arm import Arm
from derive.audit.subjects.robot.task import Task
from derive.audit.text import Json

SEARCHES = 4  # lines on which zeros of det J are sought
ZERO = mpmath.mpf(10) ** -20


def size(J: Rows) -> Number:
    """det J, or det of the smaller of J J^T and J^T J."""
    if len(J) == len(J[0]):
        return det(J)
    wide = len(J) < len(J[0])
    return det(product(J, transposed(J)) if wide else product(transposed(J), J))


def singularities(asked: Asked, point: Point) -> Iterator[Test]:
    """det J; the rank of J in a random configuration of each set; and no zero of det J outside them."""
    task = Task(Arm(asked, point, 1))
    J = task.J
    names = task.names
    yield Same("det", size(J))
    if point.exact:
        raise Irrational
    sets = asked.objects("solutions")
    for k, each in enumerate(sets, 1):
        yield _ranked(asked, each, f"set {k}", point, names)
    if not sets and asked.results.get("complete"):
        yield Holds("solutions", True, "")
    if asked.results.get("complete") and not point.seed:
        yield from _complete(asked, point, names, sets)
    else:
        yield Holds("complete", True, "")


def rank_near(J: Rows) -> int:
    """The rank of a matrix of numbers that are known to 20 digits."""
    J = [[entry if abs(floating(entry)) > ZERO else mpmath.mpf(0) for entry in row] for row in J]
    values = mpmath.svd_r(mpmath.matrix([list(row) for row in J]), compute_uv=False)
    return sum(value > ZERO * max(values) for value in values)


def _ranked(asked: Asked, each: Mapping[str, Any], set_k: str, point: Point, names: tuple[str, ...]) -> Test:
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
    found = rank_near(Task(Arm(asked, there.where(**values), 1)).rows_in(names))
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


def _complete(
    asked: Asked, point: Point, names: tuple[str, ...], sets: list[Mapping[str, Json]]
) -> Iterator[Test]:
    """Zeros of det J on random lines through the configurations: each lies in one of the sets."""
    equations = [asked.read(each["equations"]) for each in sets]
    for k in range(SEARCHES):
        other = Point(500 + k, False, point.angles, point.assumptions)
        lines = {name: (other[name], other[f"{name}_ddot"]) for name in asked.subject.variables}
        root = _zero_on(asked, point, names, lines)
        if root is None:
            continue
        there = point.where(**{name: start + root * along for name, (start, along) in lines.items()})
        inside = any(all(abs(floating(there.at(each))) < ZERO for each in some) for some in equations)
        where = {name: shown(there[name]) for name in asked.subject.variables}
        yield Holds("complete", inside, f"J is singular at {where}, in none of the sets")
    yield Holds("complete", True, "")


def _zero_on(
    asked: Asked, point: Point, names: tuple[str, ...], lines: Mapping[str, tuple[Number, Number]]
) -> Number | None:
    """Where det J is zero on a line, if it is found."""

    def at(s: Number) -> Number:
        spend(2000)
        there = point.where(**{name: start + s * along for name, (start, along) in lines.items()})
        return size(Task(Arm(asked, there, 1)).rows_in(names))

    samples = [(mpmath.mpf(i) / 10, at(mpmath.mpf(i) / 10)) for i in range(-10, 11)]
    for (a, left), (b, right) in pairwise(samples):
        if left * right < 0:
            return mpmath.findroot(at, (a, b), solver="anderson", tol=ZERO**2.5, verify=False, maxsteps=200)
    return None


def manipulability(asked: Asked, point: Point) -> Iterator[Test]:
    """w; the semi-axes of both ellipsoids where numbers are given, by the eigenvectors of J J^T."""
    task = Task(Arm(asked, point, 1))
    square = len(task.J) == len(task.J[0])
    if point.exact and not square:
        raise Irrational
    yield Same("w", abs(size(task.J)) if square else mpmath.sqrt(size(task.J)))
    if "axes" not in asked.results:
        return
    if point.exact:
        raise Irrational
    fixed = {name: asked.formula(value) for name, value in asked.options.evaluate}
    J = mpmath.matrix(Task(Arm(asked, point.where(**fixed), 1)).rows_in(task.names))
    eigenvalues, vectors = mpmath.eigsy(J * J.T)
    sizes = [mpmath.sqrt(abs(value)) for value in eigenvalues][::-1]
    order = list(range(len(sizes)))[::-1]
    yield Same("axes", sizes)
    forces = asked.results["force_axes"]
    for told, each in zip(forces if isinstance(forces, list) else [], reversed(sizes), strict=True):
        if each <= ZERO:
            yield Holds("force_axes", told == "infinite", "a force there is infinite")
        else:
            yield put_back("force_axes", point, asked.read(told), 1 / each, f"it is {shown(1 / each)}")
    for name, expected in (("directions", order), ("force_directions", order[::-1])):
        ours = point.matrix(asked.result(name))
        for k, direction in zip(expected, ours, strict=True):
            part = [vectors[i, k] for i in range(len(sizes))]
            along = sum(a * b for a, b in zip(part, direction, strict=True))
            alone = sum(abs(other - sizes[order.index(k)]) < 1e-6 for other in sizes) == 1
            right = agree(abs(along), 1, 1, mpmath.mpf(10) ** -9) or not alone
            yield Holds(name, right, f"{shown(part)} is one of them")
