"""The sets where a determinant vanishes, each with its rank, and the sets of lower rank inside them."""

from __future__ import annotations

from derive.algebra.matrix import ScalarMatrix
from derive.kinds.problem import Problem
from derive.kinds.robot._singular.minors import Way
from derive.kinds.robot._singular.sets import Analysed, analysed
from derive.mechanics.strata import MOST_LOCI, Strata
from derive.mechanics.vanishing import Vanishing


def graded(
    problem: Problem, way: Way, J: ScalarMatrix, search: Vanishing, most: int = MOST_LOCI
) -> tuple[Analysed, ...]:
    """Every set of J with its rank, those inside others last; beyond so many none is looked into."""
    strata = Strata(J, search, loci=most)
    found = strata.below([place for part in way.parts for place in part.sets], min(J.shape))
    inner = [
        each for each in found if any(strata.inclusion.strictly(each.locus, other.locus) for other in found)
    ]
    outer = [each for each in found if each not in inner]
    made = []
    for each in (*outer, *inner):
        block = next((part.block for part in way.parts if each.locus in part.sets), way.parts[0].block)
        made.append(analysed(problem, block, each, each in inner))
    return tuple(each for each in made if each is not None)
