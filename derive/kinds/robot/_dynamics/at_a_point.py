"""The equations of motion at the point of `evaluate`, of an arm whose equations in letters are too long."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from derive.algebra.normal import normal
from derive.algebra.numbers.floats import Point, matrix_numbers, numbers, scalar_number
from derive.derivation import Claim
from derive.errors import NotDerivable, TooManyTerms
from derive.expression import Approximate, Expr, Matrix, Symbol, column, free_symbols
from derive.kinds.checks import close, route
from derive.kinds.fields import Place
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import chain_of, oracle_of
from derive.kinds.robot._dynamics.bodies import com_in_link
from derive.kinds.values_at import point_of
from derive.mechanics.chain import Chain
from derive.mechanics.dynamics import gravity_of
from derive.mechanics.dynamics_in_numbers import Instantaneous, Load, Screw
from derive.mechanics.moments import moments
from derive.mechanics.oracle.heavy import Heavy
from derive.names import free

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

NEAR = 1e-7
ENTRIES = ((0, 3, 5), (3, 1, 4), (5, 4, 2))  # of the matrix of inertia, among its six elements


@dataclass(frozen=True)
class AtAPoint:
    """An arm with a value for every name."""

    problem: Problem
    found: Chain
    at: Point

    @cached_property
    def motion(self) -> Instantaneous:
        """Its joints and bodies there."""
        import numpy as np

        rates = np.array([self.at[f"{name}_dot"] for name in self.found.variables])
        gravity = np.array([self._number(each) for each in gravity_of(self.problem.subject)])
        return Instantaneous([*self._joints()], [*self._loads()], rates, gravity)

    @property
    def forces(self) -> Array:
        """tau (n)."""
        import numpy as np

        return np.array([self.at[f"tau_{k}"] for k, _ in enumerate(self.found.variables, 1)])

    @property
    def named(self) -> dict[Expr, Expr]:
        """The joint forces and gravity by their letters, whose values count."""
        forces = column(Symbol(f"tau_{k}") for k, _ in enumerate(self.found.variables, 1))
        gravity = Symbol(free(self.problem.taken, "g_0", "gamma"))
        return {Symbol("tau"): forces, gravity: column(gravity_of(self.problem.subject))}

    @property
    def accelerations(self) -> Array:
        """qddot (n)."""
        return self.motion.accelerations(self.forces)

    def claim(self, **told: Expr) -> Claim:
        """That D, h and qddot as they are told are those by Newton and Euler."""
        heavy = Heavy(oracle_of(self.problem), self.at)
        seen = {"D": heavy.D}
        if len(told) > 1:
            seen |= {"h": heavy.tau_without_acceleration, "qddot": heavy.accelerations(self.forces)}
        return route(
            "at-a-point", (close(numbers(told[name], {}), each, NEAR) for name, each in seen.items())
        )

    def _number(self, tree: Expr) -> float:
        return float(numbers(tree, self.at))

    def _joints(self) -> Iterable[Screw]:
        import numpy as np

        for i, joint in self.found.moving:
            z, o = (
                np.array(matrix_numbers(each, self.at)).ravel()
                for each in (self.found.axis(i), self.found.point(i))
            )
            yield Screw(i, joint.type == "revolute", z, o)

    def _loads(self) -> Iterable[Load]:
        import numpy as np

        for i, link in enumerate(self.problem.subject.links, 1):
            if link.body is None:
                continue
            T = np.array(matrix_numbers(self.found.T[i], self.at))
            com = np.array(matrix_numbers(com_in_link(self.found, i, link.body), self.at)).ravel()
            six = [scalar_number(normal(each), self.at) for each in moments(link.body)]
            R = T[:3, :3]
            I = R @ np.array([[six[k] for k in row] for row in ENTRIES]) @ R.T
            yield Load(i, self._number(link.body.mass), R @ com + T[:3, 3], I)


def at_a_point(problem: Problem, place: Place | None, error: TooManyTerms, *, forces: bool) -> AtAPoint:
    """The arm where its author wants numbers. Raises the error where none are wanted, and where joints are
    coupled or rub or have motors; NotDerivable where a name has no value, those of rates and joint forces
    where `forces` are asked for."""
    found, robot = chain_of(problem), problem.subject
    plain = found.coupling is None and not any(
        link.motor or link.friction or (link.variable and link.joint == "helical") for link in robot.links
    )
    if not plain:
        raise error
    if place is None:
        raise TooManyTerms(
            f"{error}; with a value for every name under evaluate its numbers are found"
        ) from error
    at = dict(point_of(dict(place), problem.where))
    wanted = {*problem.symbols}
    if forces:
        wanted = wanted.union(*map(free_symbols, gravity_of(robot)))
        wanted |= {f"{name}_dot" for name in found.variables}
        wanted |= {f"tau_{k}" for k, _ in enumerate(found.variables, 1)}
    if missing := sorted(wanted - at.keys()):
        raise NotDerivable(
            "in letters the equations of this arm are too long, and for numbers every name needs a value "
            f"under evaluate; {', '.join(missing)} {'has' if len(missing) == 1 else 'have'} none",
            "evaluate",
        )
    still = {f"{name}_dot": 0.0 for name in found.variables} | {"g": 0.0}
    return AtAPoint(problem, found, {**still, **at})


def rounded(values: Any) -> Matrix:
    """A matrix, or a column, of numbers as they were computed."""
    if getattr(values, "ndim", 1) == 1:
        return column(Approximate(float(each)) for each in values)
    return Matrix(tuple(tuple(Approximate(float(each)) for each in row) for row in values))
