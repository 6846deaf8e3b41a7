"""The sets in which a Jacobian loses rank: of a square one where a factor of its determinant vanishes; of any
other where all its minors of full size vanish together."""

from __future__ import annotations

from collections.abc import Sequence

from derive.algebra.scalar import Scalar
from derive.algebra.solving.factors import Factored, common_factor, factored
from derive.mechanics.chain import Chain
from derive.mechanics.vanishing import Locus, Vanishing
from derive.mechanics.zeros import Write


def searching(chain: Chain, write: Write) -> Vanishing:
    """For zeros in the joint variables of an arm."""
    turning = frozenset(joint.variable for _, joint in chain.moving if joint.type != "prismatic")
    return Vanishing(chain.variables, turning, write)


def of_determinant(det: Factored, search: Vanishing) -> tuple[Locus, ...]:
    """Factor by factor, the shortest first."""
    factors = sorted(det.factors, key=lambda pair: len(pair[0].numerator))
    return tuple(place for factor, _ in factors for place in search.solve([factor], Locus()))


def of_minors(values: Sequence[Scalar], search: Vanishing) -> tuple[Locus, ...]:
    """First their common factor, then the rest together."""
    factor, rest = common_factor([value for value in values if value], search.variables)
    shared = of_determinant(factored(factor, search.variables), search)
    return (*shared, *search.solve(rest, Locus()))
