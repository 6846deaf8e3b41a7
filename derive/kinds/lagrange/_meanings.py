"""What the names of a system mean in numbers: everything by differences along a motion of its energies and
constraints, and the accelerations that solve the equations so found."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from flint import arb

from derive.algebra.ball_arithmetic import precise, slope
from derive.algebra.function import Constraint
from derive.algebra.numbers.floats import Point
from derive.errors import NotReal
from derive.expression import Derivative, Expr, Symbol, free_symbols
from derive.kinds.lagrange._letters import Letters
from derive.kinds.lagrange._oracle import Differences, Numbers
from derive.kinds.meanings import Names, column_of
from derive.mechanics.lagrangian import TIME, LagrangianSystem

if TYPE_CHECKING:
    from numpy.typing import NDArray


def left_side(k: int) -> Symbol:
    """A name for the left side of equation k, without the forces."""
    return Symbol(f"left side {k}")


def right_side(k: int) -> Symbol:
    """A name for the forces of equation k, those of the constraints included."""
    return Symbol(f"right side {k}")


def across(k: int) -> Symbol:
    """A name for constraint k, differentiated until the accelerations stand in it."""
    return Symbol(f"constraint {k} on the accelerations")


SOME_FORCE = 0.7
LEFT, RIGHT = Symbol("the left side for any coordinate"), Symbol("the right side for any coordinate")
INERTIAL, TOTAL = Symbol("the left sides less those without accelerations"), Symbol("T + P")


def slope_of(constraint: int, coordinate: str, multipliers: Sequence[Symbol]) -> Symbol:
    """a_q, or a_1,q, a_2,q, ...: the derivative of a constraint by a coordinate or its rate."""
    return Symbol(f"a_{constraint}_{coordinate}" if len(multipliers) > 1 else f"a_{coordinate}")


@dataclass(frozen=True, slots=True)
class Meanings:
    """Of the names on the page of one system."""

    differences: Differences
    letters: Letters
    multipliers: tuple[Symbol, ...]

    @property
    def system(self) -> LagrangianSystem:
        return self.differences.system

    def along_a_motion(self, at: Point) -> Names:
        """Of positions, velocities, energies, momenta, and of the sides of every equation."""
        with self.differences.digits(at) as point:
            found = {**dict(self._of_bodies(point)), **dict(self._of_energies(point))}
            numbers = {name: _floats(value) for name, value in found.items()}
        return {**numbers, **self._of_equations(at)}

    def of_the_solution(self, at: Point) -> Names:
        """The accelerations and the multipliers at the place and with the rates of a point."""
        import numpy as np

        M, rest, push = self._linear(at)
        m = len(self.multipliers)
        A, (D, c) = self._along_constraints(at), self._linear_constraints(at)
        whole = np.block([[M, -A.T], [D, np.zeros((m, m))]])
        found = np.linalg.solve(whole, np.concatenate([push - rest, -c]))
        names: tuple[Expr, ...] = (*map(Symbol, self.system.accelerations), *self.multipliers)
        return dict(zip(names, found, strict=True))

    # -- by differences ----------------------------------------------------------------------------

    def _of_bodies(self, at: Numbers) -> Iterator[tuple[Expr, Any]]:
        difference, letters = self.differences, self.letters
        known = difference.completed(at)
        for k, body in enumerate(self.system.bodies, 1):
            yield letters.of_body(letters.position, k), [[precise(part, known)] for part in body.position]
            speed = [[difference.speed(part, at)] for part in body.position]
            yield letters.of_body(letters.velocity, k), speed
            if body.inertia is not None and body.angle is not None:
                yield letters.of_body(letters.spin, k), difference.speed(body.angle, at)
            yield Symbol(f"{letters.kinetic}_{k}"), difference.kinetic(body, at)

    def _of_energies(self, at: Numbers) -> Iterator[tuple[Expr, Any]]:
        difference, letters, L = self.differences, self.letters, Symbol(self.letters.lagrangian)
        potential, whole = difference.potential(at), difference.lagrangian(at)
        yield Symbol(letters.kinetic), whole + potential
        yield Symbol(letters.potential), potential
        yield L, whole
        yield TOTAL, whole + 2 * potential
        yield Symbol(letters.dissipation), precise(self.system.dissipation, difference.completed(at))
        jacobi = -whole
        for k, (q, along) in enumerate(zip(self.system.coordinates, self.system.rates, strict=True)):
            momentum, outer = difference.momentum(k, at), Derivative(L, Symbol(along))
            jacobi = jacobi + at[along] * momentum
            yield outer, momentum
            yield Derivative(outer, Symbol(TIME)), difference.momentum_rate(k, at)
            yield Derivative(L, Symbol(q)), difference.force(k, at)
        yield Symbol(letters.energy), jacobi
        yield Symbol(letters.jacobi), jacobi

    def _of_equations(self, at: Point) -> Names:
        push, A = self.differences.forces(at), self._along_constraints(at)
        lefts, crossed = self.differences.left_sides(at), self._crossed(at)
        names: dict[Expr, Any] = {across(k): value for k, value in enumerate(crossed, 1)}
        for k, q in enumerate(self.system.coordinates):
            held = sum(at[name.name] * A[i, k] for i, name in enumerate(self.multipliers))
            names[left_side(k + 1)], names[right_side(k + 1)] = lefts[k], push[k] + held
            names[Symbol(f"Q_{q}")] = push[k]
            names |= {slope_of(i, q, self.multipliers): row[k] for i, row in enumerate(A, 1)}
        names |= dict(self._of_any_coordinate(at, A, lefts))
        still = self.differences.left_sides(self._accelerated(at))
        return {**names, INERTIAL: column_of([a - b for a, b in zip(lefts, still, strict=True)])}

    def _of_any_coordinate(self, at: Point, A: Any, lefts: Sequence[float]) -> Iterator[tuple[Expr, Any]]:
        """What the letters of Lagrange's equation are for the coordinate that shows most of them, with some
        force along it."""
        along, L, D = Symbol("q_dot"), Symbol(self.letters.lagrangian), Symbol(self.letters.dissipation)
        with self.differences.digits(at) as point:
            pairs = [
                (_floats(self.differences.momentum_rate(k, point)), _floats(self.differences.force(k, point)))
                for k in range(len(lefts))
            ]
            k = max(range(len(pairs)), key=lambda each: min(map(abs, pairs[each])))
            name = self.system.rates[k]
            lost = slope(lambda x: self._lost({**point, name: x}), point[name])
            yield Derivative(D, along), _floats(lost)
        yield Derivative(Derivative(L, along), Symbol(TIME)), pairs[k][0]
        yield Derivative(L, Symbol("q")), pairs[k][1]
        yield Symbol("Q_q"), SOME_FORCE
        for i, row in enumerate(A, 1):
            yield slope_of(i, "q", self.multipliers), row[k]
        held = sum(at[each.name] * A[i, k] for i, each in enumerate(self.multipliers))
        yield LEFT, lefts[k]
        yield RIGHT, SOME_FORCE + held

    def _lost(self, at: Numbers) -> arb:
        return precise(self.system.dissipation, self.differences.completed(at))

    # -- the constraints ---------------------------------------------------------------------------

    def _crossed(self, at: Point) -> list[float]:
        """Each constraint differentiated along the motion: once where the rates stand in it, else twice."""
        with self.differences.digits(at) as point:
            return [float(self._across(each, point).mid()) for each in self.system.constraints]

    def _across(self, constraint: Constraint, at: Numbers) -> arb:
        def later(s: arb) -> arb:
            return self._vanishing(constraint, self.differences.later(at, s))

        if self._of_rates(constraint):
            return slope(later, arb(0))
        return slope(lambda s: slope(later, s), arb(0))

    def _vanishing(self, constraint: Constraint, at: Numbers) -> arb:
        known = self.differences.completed(at)
        return precise(constraint.left, known) - precise(constraint.right, known)

    def _of_rates(self, constraint: Constraint) -> bool:
        """Whether it is one for the rates, names of `where` put in."""
        names, where = free_symbols(constraint.left) | free_symbols(constraint.right), self.differences.where
        while more := {part for name in names if name in where for part in free_symbols(where[name])} - names:
            names |= more
        return bool(names & set(self.system.rates))

    def _along_constraints(self, at: Point) -> NDArray[Any]:
        """a_ik (m by n): the derivatives of the constraints by the rates, or by the coordinates."""
        import numpy as np

        rows = []
        with self.differences.digits(at) as point:
            for each in self.system.constraints:
                names = self.system.rates if self._of_rates(each) else self.system.coordinates
                rows.append([self._slope(each, name, point) for name in names])
        return np.array(rows).reshape(len(rows), len(self.system.coordinates))

    def _slope(self, constraint: Constraint, name: str, at: Numbers) -> float:
        return float(slope(lambda x: self._vanishing(constraint, {**at, name: x}), at[name]).mid())

    # -- what is linear in the accelerations -------------------------------------------------------

    def _linear(self, at: Point) -> tuple[NDArray[Any], NDArray[Any], NDArray[Any]]:
        """M (n by n), what is left without accelerations (n), and the forces (n)."""
        import numpy as np

        rest = np.array(self.differences.left_sides(self._accelerated(at)))
        columns = [
            np.array(self.differences.left_sides(self._accelerated(at, name))) - rest
            for name in self.system.accelerations
        ]
        return np.array(columns).T, rest, np.array(self.differences.forces(at))

    def _linear_constraints(self, at: Point) -> tuple[NDArray[Any], NDArray[Any]]:
        import numpy as np

        rest = np.array(self._crossed(self._accelerated(at)))
        columns = [
            np.array(self._crossed(self._accelerated(at, name))) - rest for name in self.system.accelerations
        ]
        return np.array(columns).T, rest

    def _accelerated(self, at: Point, by: str = "") -> Mapping[str, float]:
        """The point with one acceleration 1 and the others 0."""
        return {**at, **{name: float(name == by) for name in self.system.accelerations}}


def _floats(value: Any) -> Any:
    """A ball or rows of balls as floats. Raises NotReal."""
    if isinstance(value, list):
        return column_of([_floats(row[0]) for row in value])
    if not value.is_finite():
        raise NotReal("the Lagrangian is not real here")
    return float(value.mid())
