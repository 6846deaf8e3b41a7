"""Roots by NumPy, and which verdicts about them are possible in floating point."""

from __future__ import annotations

from collections.abc import Sequence
from math import pi

VERDICTS = frozenset({"stable", "integrator", "oscillator", "unstable"})
NEAR = 1e-5  # of its size: how far a root lies from the axis that may lie on it, repeated ones among them
SEEN = 0.1  # of the last value: how large a mode is that is seen
ON = 1e-11  # what a polynomial comes to at a root on the axis, as a share of its terms


def roots_of(coefficients: Sequence[float]) -> tuple[complex, ...]:
    """Of a polynomial, highest power first: eigenvalues of its companion matrix."""
    import numpy

    return tuple(complex(each) for each in numpy.roots(coefficients))


def possible(coefficients: Sequence[float]) -> frozenset[str]:
    """The verdicts that the roots leave: all left of the axis; one at the origin besides; pairs on the
    axis, each once; or else unstable. Several where a root lies too close to the axis to be told from one
    on it."""
    found = roots_of(coefficients)
    if any(root.real > NEAR * abs(root) for root in found):
        return frozenset({"unstable"})
    near = [root for root in found if root.real >= -NEAR * abs(root)]
    zeros = sum(root == 0 for root in near)
    if zeros > 1:
        return frozenset({"unstable"})
    if not near:
        return frozenset({"stable"})
    if zeros == len(near):
        return frozenset({"integrator"})
    if all(_is_simple(root, found) and _is_on_axis(coefficients, root) for root in near if root):
        return frozenset({"oscillator"})
    return VERDICTS - {"integrator"}


def on_right(coefficients: Sequence[float]) -> tuple[int, int]:
    """How many roots lie right of the axis, at least and at most: some lie too close to it to be told."""
    found = roots_of(coefficients)
    least = sum(root.real > NEAR * abs(root) for root in found)
    return least, sum(root.real > -NEAR * abs(root) for root in found if root)


def worth_seeing(num: Sequence[float], den: Sequence[float]) -> float:
    """The least time over which a step response shows what it does [s]: the longest time constant of what is
    seen to decay, or twenty periods of the fastest swing; zero where something grows."""
    import numpy

    found = [root for root in roots_of(den) if root]
    if any(root.real > NEAR * abs(root) for root in found):
        return 0.0
    with numpy.errstate(divide="ignore"):  # a root that comes twice: it is seen
        slopes = numpy.abs(numpy.polyval(numpy.polyder(numpy.array(den)), found) * found)
        sizes = numpy.abs(numpy.polyval(numpy.array(num), found)) / slopes
    seen = [
        root for root, size in zip(found, sizes, strict=True) if size > SEEN * abs(num[-1] / (den[-1] or 1))
    ]
    slow = max((1 / -root.real for root in seen if root.real < -NEAR * abs(root)), default=0.0)
    swing = max((abs(root.imag) for root in found), default=0.0)
    return min(slow, 40 * pi / swing) if swing else slow


def is_zero_at(coefficients: Sequence[float], root: complex) -> bool:
    """Whether a polynomial vanishes there, as far as its terms tell."""
    terms = [k * root ** (len(coefficients) - 1 - place) for place, k in enumerate(coefficients)]
    return abs(sum(terms)) <= ON * sum(map(abs, terms))


def product(lead: complex, roots: Sequence[complex], s: complex) -> complex:
    """lead (s - r_1) (s - r_2) ..."""
    for root in roots:
        lead = lead * (s - root)
    return lead


def _is_simple(root: complex, found: Sequence[complex]) -> bool:
    return sum(abs(other - root) <= 1e-3 * abs(root) for other in found) == 1


def _is_on_axis(coefficients: Sequence[float], root: complex) -> bool:
    """Whether the polynomial vanishes where its circle meets the axis."""
    return is_zero_at(coefficients, complex(0.0, root.imag))
