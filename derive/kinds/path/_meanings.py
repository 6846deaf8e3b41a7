"""What the names of a path mean, in numbers: the place made from the sheet alone, all else by differences."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import pi, remainder, tau
from typing import TYPE_CHECKING, Any

from derive.algebra.numbers.floats import Point, completed, number
from derive.expression import Derivative, Expr, Symbol
from derive.kinds.meanings import Names, column_of
from derive.kinds.path._frenet import E_B, E_N, E_T, KAPPA, Bent
from derive.kinds.path._length import SIGMA
from derive.kinds.path._shapes import AXES, E_1, E_2, E_3
from derive.kinds.path._splines import Solved
from derive.kinds.problem import Problem
from derive.mechanics.oracle import exponential
from derive.mechanics.paths import Arc, Curve, Line, Path, Via

if TYPE_CHECKING:
    from numpy.typing import NDArray

STEP = 2e-3  # of what the parameter is measured by
CHORDS = 128


@dataclass(frozen=True, slots=True)
class Made:
    """The place by the parameter, by what that is measured, and between which values, if they are given."""

    place: Callable[[float], NDArray[Any]]
    unit: float
    ends: tuple[float, float] | None
    axes: tuple[NDArray[Any], ...] = ()  # e_1, e_2, e_3 of an arc

    def derivatives(self, s: float) -> tuple[NDArray[Any], NDArray[Any]]:
        """The first and the second, by five points."""
        h = STEP * self.unit
        a, b, c, d, e = (self.place(s + k * h) for k in (-2, -1, 0, 1, 2))
        return (a - 8 * b + 8 * d - e) / (12 * h), (-a + 16 * b - 30 * c + 16 * d - e) / (12 * h * h)

    def length(self, low: float, high: float) -> float:
        """By chords: their sum with half and a quarter as many, extrapolated (Richardson)."""
        import numpy as np

        places = np.array([self.place(low + (high - low) * k / CHORDS) for k in range(CHORDS + 1)])
        once, twice, four = (
            float(np.linalg.norm(np.diff(places[::every], axis=0), axis=1).sum()) for every in (1, 2, 4)
        )
        finer, coarser = (4 * once - twice) / 3, (4 * twice - four) / 3
        return (16 * finer - coarser) / 15


def made(path: Path, s: str, at: Point) -> Made:
    """The path in numbers."""
    import numpy as np

    def value(parts: Any) -> NDArray[Any]:
        return np.array([number(part, at) for part in parts])

    match path.shape:
        case Line(start, end):
            begin, way = value(start), value(end) - value(start)
            size = float(np.linalg.norm(way))
            return Made(lambda t: begin + way * t / size, size, (0.0, size))
        case Curve(value=typed, between=between):
            places = [entry for (entry,) in typed.rows]
            ends = None if between is None else (number(between[0], at), number(between[1], at))
            return Made(lambda t: np.array([number(part, {**at, s: t}) for part in places]), 1.0, ends)
        case Via(times=times) as via:
            spline = Solved(via, at)
            first, *_, last = (number(time, at) for time in times)
            return Made(spline.at, last - first, (first, last))
        case Arc() as arc:
            away = value(arc.start) - (value(arc.center) if arc.placed else 0.0)
            return _round(arc, value(arc.center), away, at)
    raise TypeError(f"no path: {path!r}")


def _round(arc: Arc, center: NDArray[Any], away: NDArray[Any], at: Point) -> Made:
    """Turned by the exponential of the rotation, in the plane by that of an imaginary number."""
    import numpy as np

    size = float(np.linalg.norm(away))
    r = size if arc.radius is None else number(arc.radius, at)
    first = away / size
    angle = number(arc.angle, at)
    back = -1.0 if angle < 0 else 1.0
    if arc.axis is None:
        toward = complex(*first) * r

        def flat(t: float) -> NDArray[Any]:
            turned = toward * np.exp(1j * back * t / r)
            place: NDArray[Any] = center + np.array([turned.real, turned.imag])
            return place

        return Made(flat, r, (0.0, r * abs(angle)), (first, np.array([-first[1], first[0]])))
    axis = np.array(
        [number(part, at) for part in (AXES[arc.axis] if isinstance(arc.axis, str) else arc.axis)]
    )
    x, y, z = axis = axis / np.linalg.norm(axis)
    spin = back * np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    per, climb = (r, 0.0) if arc.pitch is None else (1.0, back * number(arc.pitch, at) / (2 * pi))

    def turned(t: float) -> NDArray[Any]:
        by = remainder(t / per, tau)  # of many turns the exponential is not exact enough for differences
        place: NDArray[Any] = center + exponential(spin * by) @ (first * r) + climb * t * axis
        return place

    return Made(turned, per, (0.0, per * abs(angle)), (first, np.cross(axis, first), axis))


def meant(problem: Problem, found: Bent, at: Point) -> Names:
    """Every name of the board at a point of the symbols and the parameter."""
    import numpy as np

    along = found.along
    known = completed(at, problem.where)
    s = known[along.s.name]
    path = made(problem.subject, along.s.name, known)
    first, second = path.derivatives(s)
    speed = float(np.linalg.norm(first))
    tangent = first / speed
    bend = (second - tangent * (second @ tangent)) / speed**2
    kappa = float(np.linalg.norm(bend))
    names: dict[Expr, Any] = {
        along.p: column_of(path.place(s)), found.first: column_of(first), found.second: column_of(second),
        Derivative(along.p, along.s): column_of(first),
        Derivative(found.first, along.s): column_of(second),
        found.speed: speed, E_T: column_of(tangent), KAPPA: kappa,
    }  # fmt: skip
    if not found.straight:
        names[E_N] = column_of(bend / kappa)
        if not found.flat:
            names[E_B] = column_of(np.cross(tangent, bend / kappa))
        if not found.steady and not found.flat:
            names[found.across] = column_of(np.cross(first, second))
    if path.ends is not None:
        low, high = path.ends
        names[along.L] = path.length(low, high)
        if not found.steady:
            names[SIGMA] = path.length(low, s)
    axes: dict[Expr, Any] = {
        name: column_of(axis) for name, axis in zip((E_1, E_2, E_3), path.axes, strict=False)
    }
    return {**names, **axes, **_given(problem.subject, along.given, known)}


def _given(path: Path, names: dict[str, Symbol], at: Point) -> Names:
    """What was given, by the name that it has on the page."""
    import numpy as np

    shape = path.shape
    found: dict[Expr, Any] = {}
    for key, name in names.items():
        value = getattr(shape, key)
        if isinstance(value, tuple):
            found[name] = column_of([number(part, at) for part in value])
        elif value is not None:
            found[name] = number(value, at)
        elif isinstance(shape, Arc):  # a radius that its start says
            away = [number(a, at) - number(b, at) for a, b in zip(shape.start, shape.center, strict=True)]
            found[name] = float(np.linalg.norm(away))
    return found
