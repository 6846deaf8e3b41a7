"""The angular velocity of a motion whose angles and lengths change, and the velocity of its origin."""

from __future__ import annotations

from collections.abc import Mapping
from functools import reduce
from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.algebra.numbers.floats import matrix_numbers, number
from derive.derivation import Claim, Derivation, PageFacts, Result, Step
from derive.errors import NotDerivable
from derive.expression import ONE, Derivative, Expr, Product, Symbol, add, free_symbols, multiply, transpose
from derive.kinds.checks import agreement, law, links
from derive.kinds.fields import Name, OptionsModel
from derive.kinds.naming import fits
from derive.kinds.problem import Problem
from derive.kinds.values_at import completed
from derive.mechanics.lagrangian import TIME
from derive.mechanics.motion import Motion
from derive.mechanics.poses import pose, position_part, rotation_part
from derive.mechanics.sequences import in_product_order
from derive.names import free

RESULTS = {
    "omega": "the angular velocity in the axes of the world (3); rates are written phi_dot",
    "S": "the skew-symmetric matrix dR/dt R^T (3 by 3)",
    "v": "the velocity of the origin (3), where the motion moves it",
}
EXAMPLE = """\
title: How fast it turns
problems:
- motion:
  - {rotate: z, by: phi}
  - {rotate: x, by: theta}
  find: velocity
"""
STEP = 1e-6  # of differences
DIFFERENCES = 1e-6
R, P, S, V = Symbol("R"), Symbol("p"), Symbol("S"), Symbol("v")


class Options(OptionsModel):
    """`rates`: the names that change in time. If left out, those are all that the moves are by, and where
    the time t is among them the others are constants."""

    rates: tuple[Name, ...] = ()


class Facts(PageFacts):
    rates: tuple[Symbol, ...]
    shifted: bool


def derive(motion: Motion, options: Options, problem: Problem) -> Derivation:
    """S(omega) = dR/dt R^T (Spong et al., eq. 4.18; Siciliano et al., eq. 3.6). Raises NotDerivable where
    nothing changes."""
    varying = _varying(motion, options, problem)
    moves = in_product_order(motion.moves)
    T = reduce(ScalarMatrix.__matmul__, map(pose, moves), ScalarMatrix.identity(4))
    work = _Velocity(problem, T, varying)
    shifted = any(work.v)
    uses = (problem.ask("transform" if shifted else "rotation-matrix"),)
    steps = work.steps(shifted)
    definitions = work.definitions()
    results: dict[str, Result] = {
        "omega": problem.final(problem.readable_matrix(work.omega)),
        "S": problem.final(problem.readable_matrix(work.S)),
    }
    if shifted:
        results["v"] = problem.final(problem.readable_matrix(ScalarMatrix.column(work.v)))
    claims = (
        *links(steps, {**problem.names, **definitions}),
        law("skew-symmetric", not work.S + work.S.T),
        work.second_route(moves),
    )
    turning = tuple(Symbol(name) for name in varying if work.R.diff(name))
    facts = Facts(rates=turning, shifted=shifted)
    return Derivation("velocity", steps, results, claims, definitions, uses=uses, facts=facts)


def _varying(motion: Motion, options: Options, problem: Problem) -> tuple[str, ...]:
    names = tuple(name for name in motion.variables if name not in problem.where)
    if unknown := set(options.rates) - set(names):
        raise NotDerivable(f"no move is by {min(unknown)}, so it has no rate here")
    if not any(move.kind == "rotate" and set(names) & free_symbols(move.by) for move in motion.moves):
        raise NotDerivable("no rotation is by a symbol, so nothing turns")
    return options.rates or tuple(name for name in names if name == TIME) or names


def rate_of(name: str) -> Expr:
    """How fast a name changes: the time itself by 1."""
    return ONE if name == TIME else Symbol(f"{name}_dot")


class _Velocity:
    """The time derivatives of a pose."""

    def __init__(self, problem: Problem, T: ScalarMatrix, varying: tuple[str, ...]) -> None:
        self.problem, self.varying = problem, varying
        self.name = Symbol(free(problem.taken, "omega", "w", "omega_R"))  # omega*t is a common angle
        self.R = rotation_part(T)
        if not any(self.R.diff(name) for name in varying):
            raise NotDerivable("no rotation changes with the names it is by, so nothing turns")
        self.rate = self._rate(self.R)
        self.S = self.rate @ self.R.T
        self.omega = ScalarMatrix.column((self.S[2, 1], self.S[0, 2], self.S[1, 0]))
        self.p = position_part(T)
        self.v = self._rate(self.p).entries

    def _rate(self, matrix: ScalarMatrix) -> ScalarMatrix:
        """The derivative by time, by the chain rule."""
        parts = (matrix.diff(name).scaled(normal(rate_of(name))) for name in self.varying)
        return reduce(ScalarMatrix.__add__, parts)

    def steps(self, shifted: bool) -> tuple[Step, ...]:
        """dR/dt, S, omega read off it, and v."""
        read = self.problem.readable_matrix
        written = (read(self.rate),) if fits(read(self.rate)) else ()
        rate = Step("R_dot", (Symbol("R_dot"), self._by_chain_rule(R, self.R), *written), "chain-rule")
        product = Product((Symbol("R_dot"), transpose(R)))
        turn = Step("S", (S, product, read(self.S)), "skew")
        omega = Step("omega", (self.name, read(self.omega)), "read-off")
        if not shifted:
            return rate, turn, omega
        return (
            rate,
            turn,
            omega,
            Step("v", (V, self._by_chain_rule(P, self.p), read(ScalarMatrix.column(self.v))), "chain-rule"),
        )

    def _by_chain_rule(self, of: Symbol, value: ScalarMatrix) -> Expr:
        """The sum of the derivatives by each name times its rate."""
        names = (name for name in self.varying if value.diff(name))
        return add(*(multiply(Derivative(of, Symbol(name)), rate_of(name)) for name in names))

    def definitions(self) -> dict[Expr, Expr]:
        read = self.problem.readable_matrix
        return {
            R: read(self.R),
            P: read(self.p),
            Symbol("R_dot"): read(self.rate),
            S: read(self.S),
            self.name: read(self.omega),
        }

    def second_route(self, moves: tuple[Any, ...]) -> Claim:
        """S by differences of rotations composed in numbers."""
        from derive.mechanics.oracle import compose

        names = [f"{name}_dot" for name in self.varying if name != TIME]

        def differences(point: Mapping[str, float]) -> Any:
            def at(h: float) -> Any:
                moved = {name: point[name] + h * number(rate_of(name), point) for name in self.varying}
                return compose(moves, completed({**point, **moved}, self.problem.where))[:3, :3]

            return (at(STEP) - at(-STEP)) / (2 * STEP) @ at(0).T

        return agreement(
            "differences",
            {*self.problem.symbols, *names},
            lambda point: matrix_numbers(self.S, completed(point, self.problem.where)),
            differences,
            DIFFERENCES,
        )
