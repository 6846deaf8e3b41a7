"""Which places lie in a limited workspace, as it is told."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from derive.algebra.numbers import floats as numeric
from derive.kinds.robot._reach.in_numbers import SMALL, InNumbers, Limits
from derive.kinds.robot._reach.spans import Span

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]


CURVE, LOOSE = 20_001, 2e-3  # values of the second joint; radians, where a place is read off between two


@dataclass(frozen=True)
class Inside(InNumbers):
    """A shape in numbers."""

    def holds(self, places: Array, margin: float) -> Array:
        """Which places (N by 3) lie within the shape as told, by at least a margin."""
        import numpy as np

        shape, inside = self.shape, np.ones(len(places), dtype=bool)
        if shape.kind == "box":
            for row, span in zip(shape.rows, shape.sides, strict=True):
                inside &= self._between(self.along(row, places), span, margin)
            return inside
        if shape.kind == "ball":
            return self._in_ball(places, margin)
        z = self.lines[self.first][0]
        lift = next((row for row in shape.rows if row != self.first and self.lifts(row)), None)
        if lift and shape.lift:
            inside &= self._between(self.along(lift, places), shape.lift, margin)
        else:
            inside &= np.abs((places - self.start) @ z) < SMALL
        away = places - self.center
        away = away - (away @ z)[:, None] * z
        if shape.kind == "bent":
            return inside & self._in_reach_of_bends(away, z, margin)
        if shape.rail is None:
            inside &= self._between(np.linalg.norm(away, axis=1), shape.distance, margin)
            return inside & self._turned_so(away, z, margin)
        u, own = self.lines[shape.rows[self.rail]][0], self.variable(shape.rows[self.rail])
        low, high = self.ends(shape.rail)
        x = away @ u + self.here[own]
        y2 = np.sum(away**2, axis=1) - (away @ u) ** 2
        nearest = np.hypot(np.maximum(0.0, np.maximum(low - x, x - high)), np.sqrt(np.maximum(y2, 0.0)))
        furthest = np.hypot(np.maximum(np.abs(x - low), np.abs(x - high)), np.sqrt(np.maximum(y2, 0.0)))
        r_min, r_max = self.ends(shape.distance)
        slack = margin or -SMALL
        swept: Array = inside & (nearest <= r_max - slack) & (furthest >= r_min + slack)
        return swept

    def _in_reach_of_bends(self, away: Array, z: Array, margin: float) -> Array:
        """Which of these (N by 3), square to the first axis, two links reach by one of their bends, the
        second joint moved through its range and the first one then to where the place is."""
        import numpy as np

        first, second = (row for row in self.shape.rows if self.found.joint(row).type == "revolute")
        start, side = self.planar(self.start - self.center, z)
        (low, high), own = self.limits[first], self.here[self.variable(first)]
        q = np.linspace(*self.limits[second], CURVE)
        places = self.moved({second: q}) - self.center
        r = np.linalg.norm(places - (places @ z)[:, None] * z, axis=1)
        angles = np.arctan2(places @ side, places @ start)
        rho, phi = np.linalg.norm(away, axis=1), np.arctan2(away @ side, away @ start)
        slack = margin / np.maximum(rho, margin + SMALL) if margin > 0 else -np.full(len(rho), LOOSE)
        found = np.zeros(len(away), dtype=bool)
        for a, b in pairwise(_turns(r)):
            branch = slice(a, b + 1) if r[b] > r[a] else slice(b, a - 1 if a else None, -1)
            bent = np.interp(rho, r[branch], np.unwrap(angles[branch]))
            off = own + phi - bent - (low + high) / 2
            off = np.abs(off - math.tau * np.round(off / math.tau))
            within = (rho >= r[branch][0] + (margin or -SMALL)) & (rho <= r[branch][-1] - (margin or -SMALL))
            found |= within & (off <= (high - low) / 2 - slack)
        return found

    def bends(self, second: int) -> Iterator[Limits]:
        """The parts of a range in which the distance from the first axis only grows or only shrinks."""
        import numpy as np

        q = np.linspace(*self.limits[second], CURVE)
        z = self.lines[self.first][0]
        places = self.moved({second: q}) - self.center
        r = np.linalg.norm(places - (places @ z)[:, None] * z, axis=1)
        for a, b in pairwise(_turns(r)):
            yield float(q[a]), float(q[b])

    @staticmethod
    def planar(start: Array, z: Array) -> tuple[Array, Array]:
        """The direction of a place, seen along an axis, and what is to the left of it."""
        import numpy as np

        flat = start - (start @ z) * z
        flat = flat / np.linalg.norm(flat)
        return flat, np.cross(z, flat)

    def _in_ball(self, places: Array, margin: float) -> Array:
        import numpy as np

        shape = self.shape
        away = places - self.center
        z = self.lines[self.first][0]
        r, height = np.linalg.norm(away, axis=1), away @ z
        flat = away - height[:, None] * z
        inside = self._between(r, shape.distance, margin)
        inside &= np.linalg.norm(flat, axis=1) >= self.number(shape.side) + (margin or -SMALL)
        if shape.rise:
            low, high = (self.number(each) for each in shape.rise[1:])
            rise = height / np.maximum(r, SMALL)
            angle = np.arcsin(np.clip(rise, -1, 1))
            slack = margin / np.maximum(r, margin + SMALL) if margin > 0 else SMALL * 10
            least, most = math.asin(max(-1.0, low)), math.asin(min(1.0, high))
            sign = 1 if margin > 0 else -1
            poles = (least + math.pi / 2 < SMALL, math.pi / 2 - most < SMALL)
            inside &= poles[0] | (angle >= least + sign * slack)
            inside &= poles[1] | (angle <= most - sign * slack)
        held: Array = inside & self._turned_so(flat, z, margin)
        return held

    def _turned_so(self, away: Array, z: Array, margin: float) -> Array:
        """Which of these (N by 3), square to the first axis, are between the ends of its joint."""
        import numpy as np

        if self.shape.turn is None:
            return np.ones(len(away), dtype=bool)
        start = self.start - self.center
        start = start - (start @ z) * z
        side = np.cross(z, start)
        own = self.here[self.variable(self.first)]
        low, high = (self.number(each) for each in self.shape.turn)
        length = np.linalg.norm(away, axis=1)
        slack = (
            margin / np.maximum(length, margin + SMALL) if margin > 0 else -SMALL / np.maximum(length, SMALL)
        )
        angle = own + np.arctan2(away @ side, away @ start)
        off = angle - (low + high) / 2
        off = np.abs(off - math.tau * np.round(off / math.tau))
        inside: Array = off <= (high - low) / 2 - slack
        return inside

    def _between(self, values: Array, span: Span, margin: float) -> Array:
        low, high = self.ends(span)
        slack = margin or -SMALL * max(1.0, low if math.isfinite(low) else 1.0)
        if high - low < SMALL:  # a surface
            slack = -SMALL * 10
        inside: Array = (values >= low + slack if low > SMALL or low < 0 else values >= low - SMALL) & (
            values <= high - slack
        )
        return inside

    def ends(self, span: Span) -> Limits:
        low = -math.inf if span.low is None else self.number(span.low)
        return low, math.inf if span.high is None else self.number(span.high)

    def along(self, row: int, places: Array) -> Array:
        """The value of a joint that slides, by how far a place is along its way."""
        found: Array = (places - self.start) @ self.lines[row][0] + self.here[self.variable(row)]
        return found

    @property
    def rail(self) -> int:
        return next(k for k, row in enumerate(self.shape.rows) if row < self.first and not self.lifts(row))

    @cached_property
    def center(self) -> Array:
        """From where distances count, in the configuration that is looked at."""
        import numpy as np

        if self.shape.center is not None:
            return np.array(numeric.matrix_numbers(self.shape.center, self.here)).ravel()
        if self.shape.kind == "box":
            return self.start
        through = self.lines[self.first][1]
        assert through is not None
        return through


def _turns(values: Array) -> list[int]:
    """Where these begin, turn round, and end."""
    import numpy as np

    return [0, *(int(k) + 1 for k in np.flatnonzero(np.diff(np.sign(np.diff(values))))), len(values) - 1]
