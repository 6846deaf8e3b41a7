"""An arm with masses, as the kinds of its dynamics see it: D, the rates and accelerations of its joints by
name, and the second route."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.algebra.numbers.compiled import compiled
from derive.algebra.readable.operation_count import operations
from derive.algebra.scalar import Scalar
from derive.derivation import Derivation
from derive.errors import TooManyTerms
from derive.expression import Expr, Matrix, Symbol
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import chain_of, oracle_of
from derive.kinds.robot._dynamics.bodies import weighted
from derive.kinds.robot._dynamics.drives import rigid, with_rotors
from derive.kinds.robot.inertia_matrix import Facts
from derive.kinds.work import Work
from derive.mechanics.dynamics import Christoffel, christoffel, inertia_matrix
from derive.mechanics.oracle import Oracle

MOST_WRITTEN_OUT = 200  # operations of D; what follows from a longer one is worked in names
DOTS = ("dot", "ddot")


@dataclass(frozen=True)
class Arm:
    """The arm of a problem. Every question about it rests on its inertia matrix."""

    problem: Problem

    @cached_property
    def inertia(self) -> Derivation:
        """The derivation of D."""
        return self.problem.ask("inertia-matrix")

    @property
    def variables(self) -> tuple[str, ...]:
        """The joint variables q, in the order of the joints (n)."""
        names: tuple[str, ...] = self.problem.subject.variables
        return names

    @property
    def rates(self) -> tuple[Symbol, ...]:
        """theta1_dot, ... (n)"""
        return tuple(Symbol(f"{name}_dot") for name in self.variables)

    @property
    def accelerations(self) -> tuple[Symbol, ...]:
        """theta1_ddot, ... (n)"""
        return tuple(Symbol(f"{name}_ddot") for name in self.variables)

    @property
    def D(self) -> ScalarMatrix:
        """The inertia matrix (n by n), names of shapes' moments and of `where` kept."""
        return self.problem.normal_matrix(self.inertia.definitions[Symbol("D")])

    @property
    def christoffel(self) -> Christoffel:
        """Every c_ijk of that matrix."""
        return christoffel(self.D, self.variables)

    @property
    def exact_christoffel(self) -> Christoffel:
        """The same with the names of moments and of `where` replaced: a cylinder's I_xx - I_yy is zero."""
        known = {**self.problem.names, **self.moments}
        if not known:
            return self.christoffel
        return christoffel(normal_matrix(self.problem.readable_matrix(self.D), known), self.variables)

    def refuse_vast(self, most: int) -> None:
        """Raises TooManyTerms where the Christoffel symbols have more terms together than these."""
        symbols = christoffel(self._undone, self.variables).items()
        terms = sum(len(value.numerator) for (i, j, _), value in symbols if i <= j)
        _refuse(terms, most, "Christoffel symbols of this arm have")

    def refuse_long(self, most: int) -> None:
        """Raises TooManyTerms where D has more terms than these."""
        terms = sum(len(entry.numerator) for entry in self._undone.entries)
        _refuse(terms, most, "inertia matrix of this arm has")

    @cached_property
    def _undone(self) -> ScalarMatrix:
        """D before it is derived for a page."""
        links = [body.motion for body in weighted(self.problem, chain_of(self.problem))]
        return with_rotors(inertia_matrix(links), self.problem.subject)

    @property
    def long(self) -> bool:
        """Whether what follows from D would fill pages: it is then left in its names."""
        big = self.inertia.told(Facts).big
        return big or operations(self.inertia.definitions[Symbol("D")]) > MOST_WRITTEN_OUT

    @cached_property
    def moments(self) -> dict[Expr, Expr]:
        """The names of shapes' moments used while working, and what they stand for."""
        steps = (step for step in self.inertia.steps if step.rule == "moment")
        names = (name for step in steps for name in step.chain if isinstance(name, Symbol))
        return {name: self.inertia.definitions[name] for name in names}

    def final(self, value: Scalar | ScalarMatrix | Expr) -> Expr:
        """As a person writes it, with the names of moments and of `where` replaced."""
        match value:
            case ScalarMatrix():
                value = self.problem.readable_matrix(value)
            case Scalar():
                value = self.problem.readable(value)
        return self.problem.final(value, self.moments)

    # -- the second route: each body by Newton's and Euler's laws -----------------------------------

    @property
    def rigid(self) -> Oracle:
        """The arm in numbers, without friction."""
        return Oracle(rigid(self.problem.subject), self.problem.where)

    @property
    def rubbing(self) -> Oracle:
        """The arm in numbers, friction included."""
        return oracle_of(self.problem)

    @property
    def still(self) -> frozenset[str]:
        """Every name that a point of rest needs: those of the arm, and g."""
        return self.problem.symbols | {"g"}

    @property
    def moving(self) -> frozenset[str]:
        """Those of a point in motion: rates and accelerations too."""
        return self.still | {f"{name}_{dots}" for name in self.variables for dots in DOTS}

    def moved(self, work: Work, tau: Matrix) -> Work:
        """Torques as printed (n by 1) against those of the motion of each body."""
        torques = [compiled(entry) for (entry,) in tau.rows]
        return work.agrees(
            "motion-of-each-body",
            self.moving,
            lambda at: [torque(at) for torque in torques],
            self.rubbing.torques,
        )

    def agrees(self, work: Work, name: str, ours: Expr) -> Work:
        """`ours` (n by 1) against the torques at those rates less the torques at rest."""
        return work.agrees("rates-alone", self.moving, ours, self.rigid.torques_of_rates, name=name)


def _refuse(terms: int, most: int, what: str) -> None:
    if terms > most:
        raise TooManyTerms(
            f"the {what} {terms} terms, too many (more than {most}); give "
            "numbers to some of the symbols, or leave out moments that do not matter"
        )
