"""A path by its parameter: lines and circles by the arc length, helices by the angle (Siciliano et al.,
section 4.3.1)."""

from __future__ import annotations

from dataclasses import dataclass, field

from derive.algebra.values import Value
from derive.expression import (
    ONE,
    PI,
    ZERO,
    Call,
    Degrees,
    Expr,
    Matrix,
    Symbol,
    add,
    column,
    cos,
    cross,
    multiply,
    number,
    sin,
    symbols,
)
from derive.kinds.path._naming import parameter_name, place_name
from derive.kinds.path._sizes import settled, told
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.paths import Arc, Curve, Line, Path, Place
from derive.names import free

E_1, E_2, E_3 = symbols("e_1 e_2 e_3")
AXES = {"x": (ONE, ZERO, ZERO), "y": (ZERO, ONE, ZERO), "z": (ZERO, ZERO, ONE)}
QUARTER = Matrix(((ZERO, -ONE), (ONE, ZERO)))  # turns a vector of the plane by a right angle


@dataclass(frozen=True, slots=True)
class Along:
    """The place p by the parameter s between two values of it, if they are given, on a board."""

    work: Work
    p: Symbol
    s: Symbol
    L: Symbol
    between: tuple[Expr, Expr] | None
    lines: tuple[str, ...]  # told before p
    given: dict[str, Symbol] = field(default_factory=dict)  # by the fields of the shape


def along(path: Path, problem: Problem) -> Along:
    """The path on a new board."""
    p, s = place_name(problem), Symbol(parameter_name(path, problem))
    L = Symbol(free(problem.taken, "L", "L_p", "ell"))
    match path.shape:
        case Line() as line:
            return _line(line, Work(problem), p, s, L)
        case Arc() as arc:
            return _arc(arc, Work(problem), p, s, L)
        case Curve(value=value, between=between):
            return Along(Work(problem).given(p, value, "place"), p, s, L, between, ())
    raise TypeError(f"no formula of one parameter: {path.shape!r}")


def _line(line: Line, work: Work, p: Symbol, s: Symbol, L: Symbol) -> Along:
    work, (start, end) = work.naming(p_0=column(line.start), p_f=column(line.end))
    work = told(work, L, Call("abs", (end - start,)))
    work = work.line(p, start + multiply(s / L, end - start), rule="place")
    return Along(work, p, s, L, (ZERO, L), (L.name,), {"start": start, "end": end})


def _arc(arc: Arc, work: Work, p: Symbol, s: Symbol, L: Symbol) -> Along:
    work, (center,) = work.naming(p_c=column(arc.center))
    given = {"center": center}
    away: Expr = column(arc.start)
    if arc.placed:
        work, (start,) = work.naming(p_0=column(arc.start))
        away, given["start"] = start - center, start
    lines = []
    if arc.radius is None:
        r = Symbol(free(work.problem.taken, "r", "R", "rho"))
        work, lines = told(work, r, Call("abs", (away,))), [r.name]
    else:
        work, (r,) = work.naming(r=arc.radius)
    given["radius"] = r
    work = told(work, E_1, away / r) if arc.placed else work.line(E_1, value=_unit(work, away))
    if arc.axis is None:
        work = work.line(E_2, QUARTER * E_1)
    else:
        axis = column(_direction(arc))
        work = work.line(E_3, value=_unit(work, axis))
        work = work.line(E_2, cross(E_3, E_1))
    lines += [name.name for name in ((E_1, E_2) if arc.axis is None else (E_1, E_3, E_2))]
    back = work.sign(arc.angle) == -1
    angle = _in_radians(-arc.angle if back else arc.angle)
    turned: Expr = s if arc.pitch is not None else s / r
    across = multiply(r, sin(turned), E_2)
    parts = [center, multiply(r, cos(turned), E_1), -across if back else across]
    if arc.pitch is None:
        work = work.line(p, add(*parts), rule="place")
        return Along(work, p, s, L, (ZERO, multiply(angle, r)), tuple(lines), given)
    work, (h,) = work.naming(h=arc.pitch)
    given["pitch"] = h
    climbed = multiply(h, s) / multiply(number(2), PI)
    work = work.line(p, add(*parts, multiply(-climbed if back else climbed, E_3)), rule="place")
    return Along(work, p, s, L, (ZERO, angle), tuple(lines), given)


def _direction(arc: Arc) -> Place:
    return AXES[arc.axis] if isinstance(arc.axis, str) else arc.axis or AXES["z"]


def _unit(work: Work, direction: Expr) -> Value:
    """A direction over its length."""
    return settled(work.value(direction / Call("abs", (direction,))), work.problem)


def _in_radians(angle: Expr) -> Expr:
    """Degrees as multiples of pi: what is multiplied by a radius."""
    return multiply(number(angle.value / 180), PI) if isinstance(angle, Degrees) else angle
