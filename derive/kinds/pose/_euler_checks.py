"""Three angles in numbers: the branches at a point, and every one of them put back into rotations composed by
another route."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, TypeAlias

from derive.algebra.numbers.floats import Point, number, numbers
from derive.derivation import Branch
from derive.expression import Expr, free_symbols
from derive.kinds.fields import Place
from derive.kinds.pose._euler_steps import Comparison
from derive.kinds.values_at import point_of
from derive.kinds.work import Work
from derive.mechanics.euler import SIGNS, Euler
from derive.mechanics.oracle import made

if TYPE_CHECKING:
    from numpy.typing import NDArray

Route: TypeAlias = "Callable[[Point], NDArray[Any]]"
NEARLY_SINGULAR = 1e-9
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


def branches_at(place: Place | None, compared: Comparison, solutions: tuple[Branch, ...]) -> dict[str, Any]:
    """The solutions in floats at a point, nothing where symbols are left; the case that does not occur there
    is not real. A free angle is chosen zero."""
    point = point_of(dict(place or ()), compared.problem.where)
    try:
        R = numbers(compared.problem.readable_matrix(compared.given.R), point)
    except KeyError:
        return {}
    pair = (compared.euler.first.sine, compared.euler.first.cosine)
    singular = sum(R[entry.row][entry.col] ** 2 for entry in pair) < NEARLY_SINGULAR**2
    here = R[compared.euler.middle.row][compared.euler.middle.col]
    regular = len(solutions) - len(compared.singular_cases)
    found: list[dict[str, Any]] = []
    for k, branch in enumerate(solutions):
        case = compared.singular_cases[k - regular] if k >= regular else None
        occurs = singular and here * case.entry > 0 if case else not singular
        free = {compared.euler.outer[2]: 0.0, **point}
        values = {name: number(value, free) for name, value in branch.values.items()} if occurs else {}
        found.append({**values, "when": branch.when, **({} if occurs else {"real": False})})
    return {"R": R, "solutions": found}
