"""The velocity and the force ellipse of an arm that moves in a plane, drawn at its tip."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from itertools import pairwise

from derive.derivation import Curve, Label, Phrase, Plot

Points = Sequence[tuple[float, float]]
CORNERS = 181  # of an ellipse
SHARE = 0.35  # of the arm's reach: how large an ellipse is drawn


def at_the_tip(
    arm: Points, ellipses: Mapping[Label, Sequence[float]], directions: Points, labels: Sequence[str]
) -> Plot:
    """An arm by its places in the plane, from the base to the tip, and ellipses by their semi-axes along two
    unit vectors, each drawn to a scale of its own."""
    reach = sum(math.dist(a, b) for a, b in pairwise(arm)) or 1.0
    series: dict[Label, Curve] = {Phrase("arm"): _coordinates(arm)}
    for name, axes in ellipses.items():
        scale = SHARE * reach / max(axes)
        series[name] = _coordinates(_ellipse(arm[-1], [scale * axis for axis in axes], directions))
    return Plot("ellipsoids", labels[0], labels[1], series, equal=True)


def _ellipse(center: tuple[float, float], axes: Sequence[float], directions: Points) -> Points:
    turns = [2 * math.pi * k / (CORNERS - 1) for k in range(CORNERS)]
    (a, b), (u, w), (x, y) = axes, directions, center
    along = [(a * math.cos(t), b * math.sin(t)) for t in turns]
    return [(x + p * u[0] + q * w[0], y + p * u[1] + q * w[1]) for p, q in along]


def _coordinates(points: Points) -> tuple[tuple[float, ...], tuple[float, ...]]:
    xs, ys = zip(*points, strict=True)
    return xs, ys
