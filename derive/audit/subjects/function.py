"""Functions: derivatives by SymPy; points where they vanish put back, judged and searched for."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import mpmath
import numpy as np
import sympy

from derive.algebra.function import Function
from derive.audit.asked import Asked, Holds, Same, Test
from derive.audit.conditions import holds
from derive.audit.linear import det, product, transposed
from derive.audit.points import NEAR as SURE
from derive.audit.points import ROUNDED, Number, Point, agree, floating
from derive.audit.putting_back import is_real, placed, rounded, told, vanishes
from derive.audit.roots import found_from_anywhere

NOTHING = 1e-7  # an eigenvalue this small beside the others is none
NEAR = 1e-6


def gradient(asked: Asked, point: Point) -> Iterator[Test]:
    """The partial derivatives."""
    (f,), x = _values(asked), _variables(asked)
    yield Same("gradient", point.each([f.diff(each) for each in x]))


def hessian(asked: Asked, point: Point) -> Iterator[Test]:
    """Their partial derivatives."""
    (f,), x = _values(asked), _variables(asked)
    yield Same("H", told(sympy.hessian(f, x), point))


def jacobian(asked: Asked, point: Point) -> Iterator[Test]:
    """Those of each component, a row for each."""
    J = sympy.Matrix(_values(asked)).jacobian(_variables(asked))
    yield Same("J", told(J, point))
    if "det" in asked.results:
        yield Same("det", det(point.matrix(J.tolist())))


def _values(asked: Asked) -> list[sympy.Expr]:
    function: Function = asked.subject
    return [asked.formula(value) for value in function.values]


def _variables(asked: Asked) -> list[sympy.Symbol]:
    return [sympy.Symbol(name) for name in asked.subject.variables]


# -- where they vanish --------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Stationary:
    """f - sum lambda g, the unknowns in it, and the constraints g = 0."""

    f: sympy.Expr
    g: tuple[sympy.Expr, ...]
    x: tuple[sympy.Symbol, ...]
    multipliers: tuple[sympy.Symbol, ...]

    @property
    def goal(self) -> sympy.Expr:
        return self.f - sum(k * g for k, g in zip(self.multipliers, self.g, strict=True))

    @property
    def equations(self) -> list[sympy.Expr]:
        return [self.goal.diff(name) for name in (*self.x, *self.multipliers)]


def stationary(asked: Asked, point: Point) -> Iterator[Test]:
    """Every point put back, what it is by the curvature there, and none missing that Newton finds."""
    function: Function = asked.subject
    names = {name for each in asked.objects("solutions") for name in each} - {"when"}
    f, g = _values(asked)[0], [asked.formula(c.left) - asked.formula(c.right) for c in function.constraints]
    multipliers, value = _extra_names(names - set(function.variables), len(g))
    task = Stationary(f, tuple(g), tuple(_variables(asked)), multipliers)
    branches = [
        ({n: asked.read(v) for n, v in each.items() if n != "when"}, str(each["when"]))
        for each in asked.objects("solutions")
    ]
    for values, when in branches:
        yield from _put_back(task, values, value, when, point)
        yield from _curvature(task, values, when, asked, point)
    yield from _best(task, branches, point)
    yield _complete(task, [values for values, _ in branches], asked, point)


def _extra_names(names: set[str], count: int) -> tuple[tuple[sympy.Symbol, ...], str]:
    """The multipliers, and what the value of the function is called."""
    greek = sorted(name for name in names if name.split("_")[0] in ("lambda", "mu", "nu"))
    rest = sorted(names - set(greek))
    usual = greek or [f"lambda_{k}" for k in range(1, count + 1)]
    return tuple(map(sympy.Symbol, usual)), rest[0] if rest else "f"


def _put_back(
    task: Stationary, values: Mapping[str, sympy.Expr], value: str, when: str, point: Point
) -> Iterator[Test]:
    """On every constraint and where every derivative vanishes (without multipliers, where the gradients of
    the constraints depend on each other)."""
    places = {sympy.Symbol(name): each for name, each in values.items()}
    said = f"the point {_shown(values)} is none of them"
    regular = all(name in places for name in task.multipliers)
    yield vanishes("solutions", point, task.equations if regular else task.g, places, said)
    if not regular:
        yield Holds("solutions", _dependent(task, places, point), f"{said}: it lacks a multiplier")
        yield Holds("solutions", "singular" in when or "global" in when, "a singular point")
    height = task.f - sympy.Symbol(value)
    yield vanishes("solutions", point, [height], places, f"f is another at {_shown(values)}")


def _dependent(task: Stationary, places: Mapping[sympy.Symbol, sympy.Expr], point: Point) -> bool:
    """Whether the gradients of the constraints are there: what is left of the product of their lengths."""
    there = placed(point, places)
    normals = [[there.at(g.diff(x)) for x in task.x] for g in task.g]
    gram = product(normals, transposed(normals))
    lengths = mpmath.fprod(floating(gram[i][i]) for i in range(len(gram)))
    return agree(det(gram), Fraction(0), lengths, ROUNDED if rounded(list(places.values())) else SURE)


def _curvature(
    task: Stationary, values: Mapping[str, sympy.Expr], when: str, asked: Asked, point: Point
) -> Iterator[Test]:
    """Along the constraints: up everywhere at a minimum, down at a maximum, both at a saddle."""
    said, _, need = when.partition(" where ")
    kind, _, condition = said.partition(" if ")
    there = _numbers(values, point)
    if there is None or any(name not in there for name in task.multipliers):
        return
    if need and holds(need, asked, point) is False:
        yield Holds("solutions", False, f"{_shown(values)} is real although {need} does not hold")
    up, down, flat = _signs(task, there, point)
    words = {
        "local minimum": up and not down and not flat,
        "local maximum": down and not up and not flat,
        "saddle point": up and down,
        "not decided by the second derivatives": flat and not (up and down),
        "isolated point": not (up or down or flat),
    }
    if kind in words and (not condition or holds(condition, asked, point)):
        yield Holds("solutions", bool(words[kind]), f"{_shown(values)} is no {when}")


def _signs(task: Stationary, there: Mapping[sympy.Symbol, Number], point: Point) -> tuple[bool, bool, bool]:
    """Whether the second derivatives along the constraints are positive, negative, zero in some direction."""
    here = {name: sympy.Float(floating(value), 30) for name, value in there.items()}

    def floats(matrix: sympy.Matrix) -> np.ndarray[Any, Any]:
        entries = matrix.subs(here)
        return np.array([[float(floating(point.at(e))) for e in row] for row in entries.tolist()])

    H = floats(sympy.hessian(task.goal, task.x))
    along = np.eye(len(task.x))
    if task.g:
        normals = floats(sympy.Matrix(task.g).jacobian(task.x))
        _, sizes, rows = np.linalg.svd(normals)
        along = rows[int((sizes > NOTHING * max(1.0, *sizes)).sum()) :].T
    found = np.linalg.eigvalsh(along.T @ H @ along) if along.size else np.array([])
    small = NOTHING * max(1.0, abs(H).max())
    return bool((found > small).any()), bool((found < -small).any()), bool((abs(found) <= small).any())


def _best(
    task: Stationary, branches: list[tuple[dict[str, sympy.Expr], str]], point: Point
) -> Iterator[Test]:
    """A global extreme is one among the points."""
    heights = {}
    for k, (values, _) in enumerate(branches):
        there = _numbers(values, point)
        if there is not None:
            value = point.at(task.f.subs({sympy.Symbol(n): v for n, v in values.items()}))
            heights[k] = float(mpmath.re(floating(value)))
    for k, height in heights.items():
        when, small = branches[k][1], NEAR * (1 + abs(height))
        if "global maximum" in when:
            yield Holds("solutions", height >= max(heights.values()) - small, "another point is higher")
        if "global minimum" in when or "maximum and minimum" in when:
            yield Holds("solutions", height <= min(heights.values()) + small, "another point is lower")


def _complete(task: Stationary, branches: list[dict[str, sympy.Expr]], asked: Asked, point: Point) -> Holds:
    """No real point found by Newton's method is missing, but where a variable should be positive."""
    unknowns = (*task.x, *task.multipliers)
    for found in found_from_anywhere(task.equations, unknowns, point):
        place = dict(zip(task.x, found, strict=False))
        positive = [x for x in task.x if asked.assumptions.get(x.name) == "positive"]
        if any(place[x] <= NEAR for x in positive):
            continue
        if not any(_is_among(values, place, point) for values in branches):
            shown = ", ".join(f"{name} = {value:.6g}" for name, value in place.items())
            return Holds("solutions", False, f"{shown} is another point")
    return Holds("solutions", True, "")


def _is_among(values: Mapping[str, sympy.Expr], place: Mapping[sympy.Symbol, float], point: Point) -> bool:
    """Whether a branch is at this place, its free variables as they are there."""
    free = {x: sympy.Float(value) for x, value in place.items() if values[x.name] == x}
    there = [floating(point.at(values[x.name].subs(free))) for x in place]
    return all(abs(a - b) <= NEAR * (1 + abs(b)) for a, b in zip(there, place.values(), strict=True))


def _numbers(values: Mapping[str, sympy.Expr], point: Point) -> dict[sympy.Symbol, Number] | None:
    """The place in numbers; None where it is not real."""
    found = {sympy.Symbol(name): point.at(value) for name, value in values.items()}
    return found if all(map(is_real, found.values())) else None


def _shown(values: Mapping[str, sympy.Expr]) -> str:
    return ", ".join(f"{name} = {value}" for name, value in values.items())


KINDS = {
    "gradient": gradient,
    "hessian": hessian,
    "jacobian": jacobian,
    "stationary-points": stationary,
    "lagrange-multipliers": stationary,
}
