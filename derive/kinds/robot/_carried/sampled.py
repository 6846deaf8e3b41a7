"""The joints over time in numbers: a table, a picture, and both held to the arm and the path in numbers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from derive.derivation import Cell, Label, Panels, Phrase, Plot, Table
from derive.expression import Approximate, Symbol, symbols
from derive.figures.axes import IN_TIME, axis, short
from derive.kinds.path._moving import Driven
from derive.kinds.robot._units import of_variables
from derive.mechanics.robot import Robot

if TYPE_CHECKING:
    from numpy.typing import NDArray

ROWS, SAMPLES = 9, 160  # of the table, of the picture
RATES = ("", "_dot", "_ddot")
NAMES = symbols("q q_dot q_ddot")
WIDE = 7  # columns of a table
ROUNDING = 1e-8  # of the greatest value: what rounding leaves of zero
BESIDE = 1e-9  # of the whole time: how near to a joint of two laws a sample is taken


@dataclass(frozen=True)
class Sampled:
    """`values` holds q, its rates and its accelerations (each k by n) at the `times`."""

    robot: Robot
    times: NDArray[Any]
    values: tuple[NDArray[Any], NDArray[Any], NDArray[Any]]

    @property
    def names(self) -> tuple[tuple[Symbol, ...], ...]:
        """Of the joint variables, rates and accelerations."""
        return tuple(tuple(Symbol(name + end) for name in self.robot.variables) for end in RATES)

    def table(self, rows: Sequence[int]) -> Table:
        """Joint variables at some of the times, with rates and accelerations as far as there is room."""
        n = len(self.robot.variables)
        orders = range(max(1, min(3, (WIDE - 1) // n)))
        headings = [Symbol("t"), *(name for order in orders for name in self.names[order])]
        return Table(tuple(headings), tuple(self._row(k, orders) for k in rows))

    def _row(self, k: int, orders: range) -> tuple[Cell, ...]:
        found = [self.times[k], *(value for order in orders for value in cleared(self.values[order])[k])]
        return tuple(Approximate(float(value)) for value in found)

    def panels(self, in_degrees: bool) -> Panels:
        """Joint variables, rates and accelerations one above the other."""
        units = of_variables(self.robot)
        plots = []
        for letter, names, values in zip(NAMES, self.names, self.values, strict=True):
            plain = [units[name.name] for name in names]
            turned = [in_degrees and unit.startswith("rad") for unit in plain]
            shown = [_spelt(unit, turn) for unit, turn in zip(plain, turned, strict=True)]
            alike = len(set(shown)) == 1
            series: dict[Label, Any] = {
                name if alike else axis(name, unit): (tuple(self.times), tuple(_drawn(values[:, j], turn)))
                for j, (name, unit, turn) in enumerate(zip(names, shown, turned, strict=True))
            }
            plots.append(Plot(letter.name, IN_TIME, axis(letter, shown[0] if alike else ""), series))
        told = {"whole": short(float(self.times[-1]))}
        return Panels(
            "joints", tuple(plots), caption=Phrase("drawn-joints"), alt=Phrase("seen-joints", {**told})
        )


def cleared(values: NDArray[Any]) -> NDArray[Any]:
    """With zeros where rounding left something else."""
    import numpy as np

    size = np.abs(values)
    found: NDArray[Any] = np.where(size < ROUNDING * size.max(), 0.0, values)
    return found


def _spelt(unit: str, turned: bool) -> str:
    """As it stands at an axis."""
    return (unit.replace("rad", "°") if turned else unit).replace("^2", "²")


def _drawn(values: NDArray[Any], turned: bool) -> NDArray[Any]:
    import numpy as np

    found: NDArray[Any] = np.degrees(values) if turned else values
    return found


def moments(driven: Driven) -> NDArray[Any]:
    """Times over the whole motion, each table's among them; on both sides of where a law ends."""
    import numpy as np

    begin, end = driven.ends or (0.0, 1.0)
    times = np.linspace(begin, end, SAMPLES + 1)
    beside = [t + side * BESIDE * (end - begin) for t in driven.joints for side in (-1, 1)]
    return np.array(sorted({*(float(t) for t in times if not _near(float(t), driven.joints)), *beside}))


def _near(t: float, joints: Sequence[float]) -> bool:
    return any(abs(t - each) < BESIDE * max(1.0, abs(each)) for each in joints)


def rows_of(times: NDArray[Any]) -> list[int]:
    """The places of the times of a table."""
    import numpy as np

    wanted = np.linspace(times[0], times[-1], ROWS)
    return [int(np.abs(times - each).argmin()) for each in wanted]
