"""What turns in time, a motion or a rotation matrix that is given: how it depends on what changes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.algebra.numbers.arrays import arrays
from derive.algebra.numbers.floats import Point, completed
from derive.derivation import Derivation
from derive.errors import NotDerivable
from derive.expression import ONE, Derivative, Expr, Symbol, add, multiply
from derive.kinds.problem import Problem
from derive.mechanics.lagrangian import TIME
from derive.mechanics.motion import Motion
from derive.mechanics.oracle import made
from derive.mechanics.poses import composed, homogeneous, position_part, rotation_part
from derive.mechanics.rotations import GivenRotation
from derive.mechanics.sequences import in_product_order

if TYPE_CHECKING:
    from numpy.typing import NDArray


@dataclass(frozen=True)
class Turning:
    """A pose (4 by 4), the names that change in time, and the same pose in numbers by another route."""

    problem: Problem
    T: ScalarMatrix
    varying: tuple[str, ...]
    pose: Callable[[Point], NDArray[Any]]

    @cached_property
    def R(self) -> ScalarMatrix:
        return rotation_part(self.T)

    @cached_property
    def p(self) -> ScalarMatrix:
        return position_part(self.T)

    @cached_property
    def turning(self) -> tuple[str, ...]:
        """The names with which the rotation changes. Raises NotDerivable where nothing turns."""
        found = tuple(name for name in self.varying if self.R.diff(name))
        if not found:
            raise NotDerivable("nothing turns: no rotation is by an angle that changes, as theta or omega*t")
        return found

    @cached_property
    def shifting(self) -> tuple[str, ...]:
        """Those with which the origin moves."""
        return tuple(name for name in self.varying if self.p.diff(name))

    @property
    def uses(self) -> tuple[Derivation, ...]:
        """What a motion comes to; a matrix that is given rests on nothing."""
        if isinstance(self.problem.subject, GivenRotation):
            return ()
        return (self.problem.ask("transform" if self.shifting else "rotation-matrix"),)


def turning_of(subject: Motion | GivenRotation, rates: tuple[str, ...], problem: Problem) -> Turning:
    """The subject with what changes: as asked; else the time, or all names that it is by.

    Raises NotDerivable where nothing changes.
    """
    names = tuple(name for name in subject.variables if name not in problem.where)
    if unknown := set(rates) - set(names):
        what = "no move is by" if isinstance(subject, Motion) else "no entry depends on"
        raise NotDerivable(f"{what} {min(unknown)}, so it has no rate here")
    varying = rates or tuple(name for name in names if name == TIME) or names
    if isinstance(subject, Motion):
        T = composed(in_product_order(subject.moves))
        return Turning(problem, T, varying, lambda at: made(subject.moves, completed(at, problem.where)))
    if subject.names:
        raise NotDerivable("the entries are names, and nothing says how these change in time")
    T = homogeneous(problem.exact(normal_matrix(subject.matrix)), (0, 0, 0))
    return Turning(problem, T, varying, lambda at: _written(subject, completed(at, problem.where)))


def _written(given: GivenRotation, at: Point) -> NDArray[Any]:
    """T (4 by 4) of a matrix that is given, entry by entry."""
    import numpy as np

    T = np.eye(4)
    T[:3, :3] = arrays(given.matrix, at)
    return T


def rate_of(name: str) -> Expr:
    """How fast a name changes: the time itself by 1."""
    return ONE if name == TIME else Symbol(f"{name}_dot")


def by_chain_rule(of: Symbol, names: Sequence[str]) -> Expr:
    """The sum of the derivatives by each name times its rate."""
    return add(*(multiply(Derivative(of, Symbol(name)), rate_of(name)) for name in names))
