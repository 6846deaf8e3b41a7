"""Unit vectors along symbolic directions, as a person finds them: common factors first, roots last."""

from __future__ import annotations

from functools import reduce

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.roots_and_functions import root
from derive.algebra.scalar import Scalar


def unit(vector: ScalarMatrix) -> ScalarMatrix:
    """The unit vector along a column (3 by 1) that is not zero. Factors that all its entries share are left
    out, and a length sqrt(sin^2) is taken as the sine: where such a factor is negative, the result points the
    other way."""
    parts = _without_common_factor(_without_denominators(vector))
    length = _length((parts.T @ parts)[0, 0])
    square = length * length
    return ScalarMatrix.column([entry * length / square for entry in parts.entries])


def _without_denominators(vector: ScalarMatrix) -> ScalarMatrix:
    bottoms = [Scalar(e.ring, e.denominator) for e in vector.entries if e.denominator is not None]
    for bottom in bottoms:
        if any(entry.denominator is not None for entry in vector.entries):
            vector = ScalarMatrix.column([entry * bottom for entry in vector.entries])
    return vector


def _without_common_factor(vector: ScalarMatrix) -> ScalarMatrix:
    common = reduce(lambda a, b: a.gcd(b), (entry.numerator for entry in vector.entries if entry))
    if common.is_constant():
        return vector
    lead = common.leading_coefficient()
    common = common / lead
    return ScalarMatrix.column(
        [Scalar(entry.ring, divmod(entry.numerator, common)[0]) for entry in vector.entries]
    )


def _length(square: Scalar) -> Scalar:
    """The root of a sum of squares; that of a squared sine or cosine is the sine or the cosine."""
    if square.constant is not None:
        return root(square)
    for k in range(len(square.ring.angles)):
        for generator in square.ring.pair(k):
            known = Scalar(square.ring, generator)
            ratio = (square / (known * known)).constant
            if ratio is not None and ratio > 0:
                return root(Scalar.of(ratio)) * known
    return root(square)
