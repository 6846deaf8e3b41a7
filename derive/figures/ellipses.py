"""The velocity and the force ellipse of an arm that moves in a plane, drawn at its tip, and the circle of
joint rates of which the first is the image."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

from derive.derivation import Curve, Label, Panels, Phrase, Place, Plot
from derive.expression import Expr, Relation, number
from derive.figures.axes import axis, short
from derive.figures.view import around

CORNERS = 181  # of an ellipse
SHARE, LONGEST = 0.4, 0.5  # of the arm's reach: how large an ellipse is drawn at most; of several compared
STEPS = (5.0, 2.0, 1.0)  # scales are these times a power of ten
Points = Sequence[Place]


@dataclass(frozen=True, slots=True)
class Tip:
    """An arm by its places in the plane, from the base to the tip, with what the axes are called and the unit
    of lengths; `sizes` are the semi-axes of the velocity ellipse along two unit vectors, `compared` those of
    the other configurations with which it is compared, drawn to the same scale; `at` is the configuration."""

    arm: Points
    axes: tuple[Expr, Expr]
    unit: str
    sizes: tuple[float, float]
    directions: Points
    compared: Sequence[tuple[float, float]] = ()
    at: tuple[Relation, ...] = ()

    def velocities(self) -> tuple[Label, Curve]:
        """The ellipse as it is drawn, and what it is with its scale."""
        scale = self.scale(self._all())
        return self._ellipse("velocity-ellipse", self.sizes, scale, f"{self.unit}/s" if self.unit else "")

    def forces(self) -> tuple[Label, Curve]:
        """Likewise."""
        strong = 1 / self.sizes[0], 1 / self.sizes[1]
        scale = self.scale(1 / size for size in self._all() if size)
        return self._ellipse("force-ellipse", strong, scale, "N" if self.unit else "")

    def _all(self) -> Iterator[float]:
        yield from self.sizes
        for sizes in self.compared:
            yield from sizes

    def scale(self, sizes: Iterable[float]) -> float:
        """How long a velocity or a force of 1 is drawn: a round number, the largest that has room."""
        reach = sum(math.dist(a, b) for a, b in pairwise(self.arm)) or 1.0
        room = (LONGEST if self.compared else SHARE) * reach / max(sizes)
        power = 10.0 ** math.floor(math.log10(room))
        return next(step * power for step in STEPS if step * power <= room * (1 + 1e-9))

    def half_axes(self) -> dict[Label, tuple[Place, Place]]:
        """Of the ellipse of velocities, numbered as the directions are."""
        (x, y), scale = self.arm[-1], self.scale(self._all())
        return {
            number(k): ((x, y), (x + scale * size * u, y + scale * size * w))
            for k, (size, (u, w)) in enumerate(zip(self.sizes, self.directions, strict=True), 1)
        }

    def _ellipse(self, key: str, sizes: tuple[float, float], scale: float, unit: str) -> tuple[Label, Curve]:
        (a, b), (u, w), (x, y) = sizes, self.directions, self.arm[-1]
        along = (around((0.0, 0.0), scale, 2 * math.pi * k / (CORNERS - 1)) for k in range(CORNERS))
        points = [(x + a * p * u[0] + b * q * w[0], y + a * p * u[1] + b * q * w[1]) for p, q in along]
        about = {"one": f"1 {unit}".rstrip(), "drawn": f"{short(scale)} {self.unit}".rstrip()}
        return Phrase(key, about), _coordinates(points)


@dataclass(frozen=True, slots=True)
class Rates:
    """Two joint rates by their names, and those of size one that become the half axes of the ellipse."""

    names: tuple[Label, Label]
    directions: Points


def at_the_tip(tip: Tip, rates: Rates | None) -> Panels:
    """The arm with both ellipses; beside it the circle of joint rates of size one, where there are two."""
    (velocity, faster), (force, stronger) = tip.velocities(), tip.forces()
    right = Plot(
        "ellipsoids", axis(tip.axes[0], tip.unit), axis(tip.axes[1], tip.unit),
        {velocity: faster, force: stronger}, arms={Phrase("arm"): _coordinates(tip.arm)},
        arrows=tip.half_axes(), equal=True,
    )  # fmt: skip
    sizes = {"long": short(max(tip.sizes)), "short": short(min(tip.sizes))}
    if rates is None:
        return Panels(
            "ellipsoids", (right,), True, _at(tip, "drawn-at-the-tip"), Phrase("seen-at-the-tip", sizes)
        )
    plots = (_circle(rates), right)
    return Panels("ellipsoids", plots, True, _at(tip, "drawn-mapped"), Phrase("seen-mapped", sizes))


def _at(tip: Tip, key: str) -> Phrase:
    """A caption that begins with the configuration, where that is known by its values."""
    return Phrase("drawn-there", {"at": tip.at, "drawn": Phrase(key)}) if tip.at else Phrase(key)


def _circle(rates: Rates) -> Plot:
    turns = (around((0.0, 0.0), 1.0, 2 * math.pi * k / (CORNERS - 1)) for k in range(CORNERS))
    arrows: dict[Label, tuple[Place, Place]] = {
        number(k): ((0.0, 0.0), place) for k, place in enumerate(rates.directions, 1)
    }
    return Plot(
        "rates", *rates.names, {Phrase("unit-circle"): _coordinates([*turns])}, arrows=arrows, equal=True
    )


def _coordinates(points: Points) -> Curve:
    xs, ys = zip(*points, strict=True)
    return xs, ys
