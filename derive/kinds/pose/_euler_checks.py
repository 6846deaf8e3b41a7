"""Every branch of the angles put back, in numbers, into rotations composed by another route."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, TypeAlias

from derive.algebra.numbers.floats import number
from derive.derivation import Branch, Claim
from derive.expression import Expr, free_symbols
from derive.kinds.checks import agreement
from derive.kinds.pose._euler_steps import Work
from derive.mechanics.euler import SIGNS, Euler

if TYPE_CHECKING:
    from numpy.typing import NDArray

Rotated: TypeAlias = "Callable[[Mapping[str, float]], NDArray[Any]]"


def put_back(euler: Euler, work: Work, solutions: tuple[Branch, ...]) -> Iterator[Claim]:
    """The formulas at random rotations, singular ones at singular rotations; then the answer itself."""
    for sign in SIGNS if work.regular else ():
        routes = _again(euler, euler.regular(sign), {})
        yield agreement("branch-again", euler.names, *routes, sign="+" if sign > 0 else "-")
    for case in work.singular_cases:
        name, value = euler.outer[1], number(case.middle, {})
        routes = _again(euler, euler.singular_angles(case), {name: value})
        yield agreement("singular-again", euler.names, *routes, angle=name, value=f"{value:.3g}")
    yield from _answers(euler, work, solutions)


def composed(euler: Euler, angles: Mapping[str, float]) -> NDArray[Any]:
    """R (3 by 3) in NumPy, each rotation made in its turn."""
    import numpy as np

    from derive.mechanics.oracle import elementary

    R = np.eye(3)
    for move in euler.moves:
        made = elementary(move, angles)[:3, :3]
        R = made @ R if move.about == "world" else R @ made
    return R


def _again(euler: Euler, values: Mapping[str, Expr], fixed: Mapping[str, float]) -> tuple[Rotated, Rotated]:
    """The rotation of the angles found at a rotation, and the rotation itself."""

    def back(point: Mapping[str, float]) -> NDArray[Any]:
        R = there(point)
        known = {f"r_{i + 1}{j + 1}": float(R[i, j]) for i in range(3) for j in range(3)}
        free = {**known, euler.outer[2]: 0.7}
        return composed(euler, {name: number(value, free) for name, value in values.items()})

    def there(point: Mapping[str, float]) -> NDArray[Any]:
        return composed(euler, {**point, **fixed})

    return back, there


def _answers(euler: Euler, work: Work, solutions: tuple[Branch, ...]) -> Iterator[Claim]:
    """The solutions of the subject itself, at random values of its symbols where it is regular."""
    for branch in solutions:
        needed = frozenset().union(*map(free_symbols, branch.values.values()))
        if euler.outer[2] in needed and not (work.numeric or not work.regular):
            continue

        def back(point: Mapping[str, float], branch: Branch = branch) -> NDArray[Any]:
            free = {euler.outer[2]: 0.7, **point}
            return composed(euler, {name: number(value, free) for name, value in branch.values.items()})

        yield agreement(
            "orientation-again",
            work.problem.symbols,
            back,
            lambda point: work.given.oracle(point)[:3, :3],
            when=branch.when,
        )
