"""The equations of motion held to differences: every line and every result of the page, as it is written."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

from derive.derivation import Claim, LinearSystem, Phrase, Record, Result, as_matrix
from derive.expression import ZERO, Derivative, Expr, Matrix, Symbol, column
from derive.kinds.lagrange._meanings import (
    INERTIAL,
    LEFT,
    RIGHT,
    TOTAL,
    Meanings,
    across,
    left_side,
    right_side,
)
from derive.kinds.lagrange._model import Model
from derive.kinds.lagrange._oracle import Differences
from derive.kinds.meanings import Chain, told
from derive.kinds.work import Work
from derive.mechanics.lagrangian import TIME

SOLVED = ("acceleration", "multiplier")


class Conserved(Record):
    said: Phrase  # "conserved" of the energy, "jacobi" of what is only Jacobi's integral


def as_told(
    model: Model,
    work: Work,
    results: Mapping[str, Result],
    forces: Sequence[Chain],
    cyclic: Sequence[tuple[Symbol, Expr]],
    reactions: Sequence[tuple[Symbol, Chain]],
) -> Iterator[Claim]:  # fmt: skip
    """Every line and every result in numbers, by differences along a motion; what was solved for against
    the solution of the equations so found."""
    system, problem = model.system, model.problem
    means = Meanings(Differences(system, problem.where), model.letters, model.multipliers)
    moving = {*system.coordinates, *system.rates, *system.accelerations, TIME}
    names = problem.symbols | moving | {name.name for name in model.multipliers}
    chains = [*_told_chains(model, work), *forces]
    chains += [*_reaction_chains(model, reactions)]
    chains += [*_cyclic_chains(model, cyclic), *_result_chains(model, results)]
    yield told(chains, means.along_a_motion, names, problem.where, "along-a-motion")
    found = [step.chain for step in work.steps if step.rule in SOLVED]
    if found:
        heads = [column(map(Symbol, system.accelerations)), column(model.multipliers)]
        pairs = zip(heads, (results.get(key) for key in ("accelerations", "multipliers")), strict=True)
        found += [chain for _, chain in reactions if len(chain) > 1]
        found += [(head, tree) for head, tree in pairs if isinstance(tree, Matrix)]
        yield told(found, means.of_the_solution, names, problem.where, "solved-again", points=1)


def _told_chains(model: Model, work: Work) -> Iterator[Chain]:
    """The lines of the page; the sides of an equation, which holds of the true motion alone, each by
    itself."""
    for step in work.steps:
        match re.split(r"_(?=\d+$)", step.name):
            case ["equation", k]:
                yield left_side(int(k)), step.chain[0]
                yield right_side(int(k)), step.chain[1]
            case ["lagrange"]:
                yield LEFT, step.chain[0]
                yield RIGHT, step.chain[1]
            case ["constraint", k]:
                yield across(int(k)), step.chain[0]
            case _ if step.rule not in SOLVED:
                yield step.chain
                if isinstance(step.facts, Conserved) and step.facts.said.key == "conserved":
                    yield Symbol(step.name), TOTAL


def _reaction_chains(model: Model, reactions: Sequence[tuple[Symbol, Chain]]) -> Iterator[Chain]:
    """What the constraints add to the force along a coordinate, which is all of it but what is given."""
    for q, (force, *_) in reactions:
        k = model.system.coordinates.index(q.name)
        yield right_side(k + 1), Symbol(f"Q_{q.name}") + force


def _cyclic_chains(model: Model, cyclic: Sequence[tuple[Symbol, Expr]]) -> Iterator[Chain]:
    """What is conserved: the Lagrangian does not hold the coordinate, and nothing acts along it."""
    L = Symbol(model.letters.lagrangian)
    for q, told_of in cyclic:
        k = model.system.coordinates.index(q.name)
        momentum = Derivative(L, Symbol(model.system.rates[k]))
        yield momentum, told_of
        yield Derivative(L, q), ZERO
        yield right_side(k + 1), ZERO
        yield left_side(k + 1), Derivative(momentum, Symbol(TIME))


def _result_chains(model: Model, results: Mapping[str, Result]) -> Iterator[Chain]:
    """The results as they are told, by what they mean."""
    letters, n = model.letters, len(model.system.coordinates)
    lefts, rights = (column(side(k) for k in range(1, n + 1)) for side in (left_side, right_side))
    meant: dict[str, Expr] = {
        "T": Symbol(letters.kinetic), "P": Symbol(letters.potential), "L": Symbol(letters.lagrangian),
        "E": Symbol(letters.energy), "tau": lefts, "equations": lefts + -rights,
    }  # fmt: skip
    accelerations = column(map(Symbol, model.system.accelerations))
    yield INERTIAL, as_matrix(results["M"], "M") * accelerations
    for name, meaning in meant.items():
        result = results.get(name, meaning)
        if not isinstance(result, tuple | LinearSystem | Phrase | float | str):
            yield meaning, result
