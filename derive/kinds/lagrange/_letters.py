"""Letters for positions, energies and multipliers that mean nothing else in the problem."""

from __future__ import annotations

from dataclasses import dataclass

from derive.expression import Symbol
from derive.kinds.problem import Problem
from derive.mechanics.lagrangian import LagrangianSystem
from derive.names import free


@dataclass(frozen=True, slots=True)
class Letters:
    """The letters of one problem; `indexed` where there are several bodies."""

    position: str
    velocity: str
    spin: str
    kinetic: str
    potential: str
    lagrangian: str
    dissipation: str
    multiplier: str
    energy: str
    jacobi: str  # what is conserved beside it
    indexed: bool

    @staticmethod
    def of(system: LagrangianSystem, problem: Problem) -> Letters:
        """The usual ones where they are free."""
        taken = problem.taken | set(system.coordinates)
        choices = (
            ("r", "p", "calR"), ("v", "u", "calV"), ("omega", "Omega", "w"), ("T", "K", "calT"),
            ("P", "V", "calP"), ("L", "calL"), ("D", "R", "calD"), ("lambda", "mu", "nu"), ("E", "H", "calE"),
            ("h", "H", "calH"),
        )  # fmt: skip
        indices = ("", *map(str, range(1, max(len(system.bodies), len(system.constraints), 1) + 1)))
        r, v, omega, T, P, L, D, multiplier, E, h = (free(taken, *each, indices=indices) for each in choices)
        return Letters(r, v, omega, T, P, L, D, multiplier, E, h, len(system.bodies) > 1)

    def of_body(self, letter: str, number: int) -> Symbol:
        """r_1, r_2, ...; r alone for the only body."""
        return Symbol(f"{letter}_{number}" if self.indexed else letter)

    def multipliers(self, count: int) -> tuple[Symbol, ...]:
        """lambda, or lambda_1, lambda_2, ..."""
        if count == 1:
            return (Symbol(self.multiplier),)
        return tuple(Symbol(f"{self.multiplier}_{k}") for k in range(1, count + 1))
