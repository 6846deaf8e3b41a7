"""A system in state space, with the names of its states."""

from __future__ import annotations

from dataclasses import dataclass

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.readable.form import readable_matrix
from derive.control.rational import Rational
from derive.control.states import MOST, StateSpace, canonical, physical, symbols_of
from derive.errors import NotDerivable
from derive.expression import Matrix, Symbol
from derive.kinds.fields import Place
from derive.kinds.problem import Problem
from derive.kinds.system._plant import Plant, plant

MATRICES = ("A", "B", "C", "D")


@dataclass(frozen=True, slots=True)
class Answer:
    """`state` are the names of the states, `letter` that of their vector; G is what the matrices make up."""

    plant: Plant
    space: StateSpace
    transfer: Rational
    state: tuple[Symbol, ...]
    letter: Symbol

    @property
    def is_physical(self) -> bool:
        return bool(self.space.states)

    def matrix(self, name: str) -> ScalarMatrix:
        found: ScalarMatrix = getattr(self.space, name)
        return found


def answered(problem: Problem, point: Place | None) -> Answer:
    """By the equations, or else by the transfer function. Raises NotDerivable."""
    solved = plant(problem, None, point)
    transfer = solved.rational.reduced()
    if not transfer.proper:
        raise NotDerivable("the transfer function is improper: no state can follow a jump of the input")
    space = physical(solved.system, solved.style)
    letter = Symbol(next((x for x in ("x", "z", "xi") if not _begins(solved, x)), "chi"))
    if space is not None:
        return Answer(solved, space, transfer, tuple(symbols_of(space)), letter)
    order = len(transfer.den) - 1
    if not 0 < order <= MOST:
        many = (
            f"{order} states, and at most {MOST} are written out" if order else "no states: it has no memory"
        )
        raise NotDerivable(f"this system has {many}")
    names = tuple(Symbol(f"{letter.name}_{k}") for k in range(1, order + 1))
    return Answer(solved, canonical(transfer), transfer, names, letter)


def _begins(solved: Plant, letter: str) -> bool:
    """Whether the equations use this letter, alone or with an index."""
    return any(
        name == letter or (name[:1] == letter and not name[1:2].isalpha()) for name in solved.system.names
    )


def readable_form(answer: Answer, name: str) -> Matrix:
    """A matrix as it is written."""
    return readable_matrix(answer.matrix(name), answer.plant.style)
