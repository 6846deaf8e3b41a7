"""The values of its variables for which a given matrix, a Jacobian, loses rank."""

from __future__ import annotations

from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.algebra.numbers.arrays import arrays
from derive.algebra.numbers.floats import completed
from derive.algebra.scalar import Scalar
from derive.derivation import Derivation, Phrase, Result
from derive.errors import NotDerivable
from derive.kinds.fields import NoOptions as Options
from derive.kinds.problem import Problem
from derive.kinds.robot._singular.checks import Checked, InNumbers
from derive.kinds.robot._singular.facts import Facts as Facts
from derive.kinds.robot._singular.facts import facts_of
from derive.kinds.robot._singular.graded import graded
from derive.kinds.robot._singular.lengths import at_special_lengths, lengths_told
from derive.kinds.robot._singular.minors import oblong, square
from derive.kinds.robot._singular.saying import branches
from derive.kinds.robot._singular.search import Values
from derive.kinds.robot._singular.sets import Block
from derive.kinds.work import Work
from derive.mechanics.matrices import GivenMatrix
from derive.mechanics.vanishing import Vanishing
from derive.names import named

USES = frozenset({"variables"})
SOUGHT = "singular sets are sought of variables that stand in sines and cosines, or in powers"
EXACT = 1e-7  # a singular value that a search finds to be zero, of a matrix known to the last digit
MOST = 24  # sets that are looked into
CLAIMED = {"det": "determinant-seen", "solutions": "full-rank"}
CLAIMS = ("jacobian-seen", "determinant-seen", "full-rank")


def derive(given: GivenMatrix, options: Options, problem: Problem) -> Derivation:
    """Where det J = 0, factor by factor, or where all minors of full size vanish (Siciliano et al., section
    3.3).

    Raises NotDerivable where no variables are listed, and for a matrix that never has full rank.
    """
    if not given.variables:
        raise NotDerivable("list the names that vary under variables:, as [q1, q2]; the others are constants")
    J = normal_matrix(given.value)
    _refuse_other_functions(given, J)
    rows = tuple(f"v_{k}" for k, _ in enumerate(J.rows, 1))
    block = Block(named("J", given.value, problem.taken).name, J, given.variables, rows)
    make = square if J.shape[0] == J.shape[1] else oblong
    way = make(Work(problem), block, "rows", _search(given, problem), Phrase("end-effector"))
    sets = graded(problem, way, J, _search(given, problem), MOST)
    seen = _in_numbers(given, problem)
    lengths = lengths_told(seen, problem.assumptions, sets, way)
    solutions = branches(problem, sets, way.point)
    facts = facts_of(problem, way, sets, lengths, bool(given.sliding))
    results: dict[str, Result] = {
        "det": problem.final(way.det),
        "solutions": solutions,
        "complete": way.complete,
    }
    work = way.work.claim(*Checked(seen, way, sets, solutions, facts).claims())
    work = work.claim(*at_special_lengths(seen, sets, lengths))
    return work.answer("singularities", results, facts)


def _refuse_other_functions(given: GivenMatrix, J: ScalarMatrix) -> None:
    """Raises NotDerivable where a variable stands below a fraction, in another function than sine and cosine,
    or both in these and alone."""
    home, variables = J.ring, {*given.variables}
    turning = {home.names[place] for k in range(len(home.angles)) for place in home.pair_index(k)}
    for entry in J.entries:
        for name in entry.generators():
            if name not in turning and name not in variables and home.letters(name) & variables:
                raise NotDerivable(f"{SOUGHT}, and here one stands in another function")
        if entry.denominator is not None and not Scalar(home, entry.denominator).letters().isdisjoint(
            variables
        ):
            raise NotDerivable(f"{SOUGHT}, and here one stands below a fraction: multiply that row by it")
    held = {name for entry in J.entries for name in entry.generators()}
    for name in given.variables:
        if name in held and name not in given.sliding:
            raise NotDerivable(f"{SOUGHT}, and here {name} stands both in one of these and alone")


def _search(given: GivenMatrix, problem: Problem) -> Vanishing:
    """For zeros in the variables of the matrix."""
    turning = frozenset(given.variables) - {*given.sliding}
    return Vanishing(given.variables, turning, problem.readable)


def _in_numbers(given: GivenMatrix, problem: Problem) -> InNumbers:
    """The matrix as it was typed."""

    def whole(here: Values) -> Any:
        return arrays(given.value, here)

    def posture(block: Block, said: Phrase, here: Values) -> bool:
        raise TypeError("a matrix has no posture")

    return InNumbers(
        given.variables,
        given.sliding,
        problem.symbols | {*given.variables},
        lambda at: completed(at, problem.where),
        whole,
        lambda _, here: whole(here),
        posture,
        small=EXACT,
    )
