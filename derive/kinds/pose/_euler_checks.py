"""Every branch of the angles put back, in numbers, into rotations composed by another route."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, TypeAlias

from derive.algebra.numbers.floats import Point, number
from derive.derivation import Branch
from derive.expression import Expr, free_symbols
from derive.kinds.pose._euler_steps import Comparison
from derive.kinds.work import Work
from derive.mechanics.euler import SIGNS, Euler
from derive.mechanics.oracle import made

if TYPE_CHECKING:
    from numpy.typing import NDArray

Route: TypeAlias = "Callable[[Point], NDArray[Any]]"
FREE = 0.7  # rad, an angle that may be chosen


def put_back(work: Work, compared: Comparison, solutions: tuple[Branch, ...]) -> Work:
    """The formulas at random rotations, singular ones at singular rotations; then the answer itself."""
    euler = compared.euler
    for sign in SIGNS if compared.regular else ():
        routes = _again(euler, euler.regular(sign), {})
        work = work.agrees("branch-again", euler.names, *routes, sign="+" if sign > 0 else "-")
    for case in compared.singular_cases:
        name, value = euler.outer[1], number(case.middle, {})
        routes = _again(euler, euler.singular_angles(case), {name: value})
        work = work.agrees("singular-again", euler.names, *routes, angle=name, value=f"{value:.3g}")
    return _answers(work, compared, solutions)


def rotation_at(euler: Euler, at: Point) -> NDArray[Any]:
    """R (3 by 3) in NumPy, each rotation made in its turn."""
    return made(euler.moves, at)[:3, :3]


def _again(euler: Euler, values: Mapping[str, Expr], fixed: Point) -> tuple[Route, Route]:
    """The rotation of the angles found at a rotation, and the rotation itself."""

    def there(at: Point) -> NDArray[Any]:
        return rotation_at(euler, {**at, **fixed})

    def back(at: Point) -> NDArray[Any]:
        R = there(at)
        known = {f"r_{i + 1}{j + 1}": float(R[i, j]) for i in range(3) for j in range(3)}
        return _of_values(euler, values, {**known, euler.outer[2]: FREE})

    return back, there


def _of_values(euler: Euler, values: Mapping[str, Expr], at: Point) -> NDArray[Any]:
    return rotation_at(euler, {name: number(value, at) for name, value in values.items()})


def _answers(work: Work, compared: Comparison, solutions: tuple[Branch, ...]) -> Work:
    """The solutions of the subject itself, at random values of its symbols where it is regular."""
    euler, given = compared.euler, compared.given
    for branch in solutions:
        needed = frozenset().union(*map(free_symbols, branch.values.values()))
        if euler.outer[2] in needed and not (given.numeric or not compared.regular):
            continue

        def back(at: Point, values: Mapping[str, Expr] = branch.values) -> NDArray[Any]:
            return _of_values(euler, values, {euler.outer[2]: FREE, **at})

        symbols = given.problem.symbols
        work = work.agrees("orientation-again", symbols, back, given.turns, when=branch.when)
    return work
