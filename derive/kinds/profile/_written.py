"""A trajectory as it is written, in numbers: its places, and by their differences how fast and how hard."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol

from derive.algebra.fold import fold
from derive.algebra.numbers.floats import Point
from derive.algebra.numbers.floats import number as value_of
from derive.expression import Expr, Relation
from derive.kinds.function._newton import Arrays

if TYPE_CHECKING:
    from numpy.typing import NDArray

FINE = 4001  # moments looked at
STEP = 1e-4  # of differences, as a part of the whole time
SOON = 4e-3  # after the limit is exceeded, as a part of the whole time
LOOSE = 1e-3  # what the moments between those leave


class Told(Protocol):
    """What is told of a limit."""

    @property
    def rate(self) -> int: ...
    @property
    def kept(self) -> bool: ...
    @property
    def reached(self) -> Expr | None: ...
    @property
    def first(self) -> Expr | None: ...
    @property
    def until(self) -> Expr | None: ...


@dataclass(frozen=True, slots=True)
class Written:
    """Laws of t with when they hold (None: all the time), at a point, from 0 to the end of the motion."""

    pieces: Sequence[tuple[Expr, Relation | None]]
    point: Point
    end: float

    def place(self, t: Any) -> Any:
        """q at times (an array or a number), each by the law that is told for it."""
        import numpy as np

        times = np.atleast_1d(np.asarray(t, dtype=float))
        found = np.full_like(times, np.nan)
        for law, when in self.pieces:
            inside = self._inside(when, times) & np.isnan(found)
            values = fold(law, Arrays({**self.point, "t": times}))
            found = np.where(inside, values, found)
        return found if np.ndim(t) else found[0]

    def _inside(self, when: Relation | None, times: NDArray[Any]) -> Any:
        """start <= t <= end, as it is told."""
        import numpy as np

        if when is None:
            return np.ones_like(times, dtype=bool)
        if not isinstance(when.left, Relation) or isinstance(when.left.left, Relation):
            return np.zeros_like(times, dtype=bool)
        start, end = value_of(when.left.left, self.point), value_of(when.right, self.point)
        slack = 1e-9 * self.end
        return (times >= start - slack) & (times <= end + slack)

    def rates(self, order: int) -> tuple[NDArray[Any], NDArray[Any]]:
        """Moments, and the size of the velocity or the acceleration there by differences; where pieces meet
        they are left out."""
        import numpy as np

        h = STEP * self.end
        times = np.linspace(h, self.end - h, FINE)
        before, now, after = (self.place(times + shift) for shift in (-h, 0.0, h))
        size = abs(after - before) / (2 * h) if order == 1 else abs(after - 2 * now + before) / h**2
        apart = np.ones_like(times, dtype=bool)
        for _, when in self.pieces:
            if when is not None:
                apart &= abs(times - value_of(when.right, self.point)) > 2 * h
        return times[apart], size[apart]

    def keeps(self, told: Told, most: float) -> bool:
        """Whether what is told to be reached is, whether the limit is kept, and from when until when it is
        not, the first time."""
        times, size = self.rates(told.rate)
        reached, slack = float(size.max()), LOOSE * max(most, float(size.max()))
        beyond = times[size > most + slack]
        right = abs((most if told.reached is None else value_of(told.reached, {})) - reached) <= 2 * slack
        if told.kept:
            return right and not len(beyond) and told.first is told.until is None
        first = 0.0 if told.first is None else value_of(told.first, {})
        until = self.end if told.until is None else value_of(told.until, {})
        near = 4 * STEP * self.end
        early = size[times < first - near]
        inside = size[(times > first + near) & (times < until - near)]
        after = size[(times > until) & (times < until + SOON * self.end)]
        return (
            right
            and told.reached is not None
            and reached > most - slack
            and bool((early <= most + slack).all())
            and bool((inside >= most - slack).all())
            and (told.until is None or bool((after <= most + slack).any()))
        )
