"""How a spline bends: tangent, normal, binormal and curvature by its velocity and acceleration (do Carmo,
Differential Geometry of Curves and Surfaces, section 1.5)."""

from __future__ import annotations

from collections.abc import Iterator

from derive.derivation import Step
from derive.expression import Call, Expr, Matrix, Symbol, add, column, cross, multiply, number
from derive.kinds.path._frenet import E_B, E_N, E_T, KAPPA, abs_of
from derive.kinds.path._shapes import QUARTER
from derive.kinds.work import Work
from derive.mechanics.paths import Via

FRAME = ("normal", "binormal")  # steps
BENDS = ("goes-straight", "bends-in-the-plane", "bends-in-space")  # by how many of these there are


def bend(names: tuple[Symbol, Symbol, Symbol], frame: tuple[str, ...], size: int) -> Iterator[Step]:
    """Laws of the velocity and the acceleration; tried with (3, 4) and (1, 2)."""
    _, v, a = names
    speed = abs_of(v)
    across = Call("det", (Matrix(((v, a),)),)) if size == 2 else cross(v, a)
    at: dict[Expr, Expr] = {v: _column(size, 3, 4), a: _column(size, 1, 2), E_T: _column(size, 3, 4) / 5}
    yield Step("tangent", (E_T, v / speed), "law", instance=at)
    yield Step(
        "curvature", (KAPPA, abs_of(across) / speed**3), "law", instance={**at, KAPPA: number(2) / 125}
    )
    if not frame:
        return
    if size == 3:
        at[E_B] = column(map(number, (0, 0, 1)))
        yield Step("binormal", (E_B, across / abs_of(across)), "law", instance=at)
    normal = across / abs_of(across) * QUARTER * E_T if size == 2 else cross(E_B, E_T)
    yield Step("normal", (E_N, normal), "law", instance={**at, E_N: _column(size, -4, 3) / 5})


def _column(size: int, *parts: int) -> Matrix:
    return column(map(number, (*parts, *(0,) * (size - len(parts)))))


def in_line(shape: Via, work: Work) -> bool:
    """Whether all points lie on a line, and with them the whole spline."""
    places = [[work.scalar(part) for part in place] for place in shape.places]
    ways = [[b - a for a, b in zip(places[0], place, strict=True)] for place in places[1:]]
    first = next((way for way in ways if any(way)), ways[0])
    pairs = [(i, j) for j in range(len(first)) for i in range(j)]
    return all(first[i] * way[j] == first[j] * way[i] for way in ways for i, j in pairs)


def unit_vectors(v: Matrix, a: Matrix, speed: Expr) -> dict[str, Expr]:
    """The normal, towards the side to which the path turns, and in space the binormal."""
    t = [entry / speed for (entry,) in v.rows]
    parts, size = _across(v, a), sized(v, a)
    if len(parts) == 1:
        side = parts[0] / size
        return {"n": column((multiply(-side, t[1]), multiply(side, t[0])))}
    b = [part / size for part in parts]
    n = (multiply(b[i], t[j]) - multiply(b[j], t[i]) for i, j in ((1, 2), (2, 0), (0, 1)))
    return {"n": column(n), "b": column(b)}


def sized(v: Matrix, a: Matrix) -> Expr:
    """The size of the vector product of velocity and acceleration."""
    parts = _across(v, a)
    return Call("abs", parts) if len(parts) == 1 else Call("sqrt", (add(*(part**2 for part in parts)),))


def _across(v: Matrix, a: Matrix) -> tuple[Expr, ...]:
    """Their vector product; in the plane the one part that it has."""
    left, right = ([entry for (entry,) in each.rows] for each in (v, a))
    pairs = ((0, 1),) if len(left) == 2 else ((1, 2), (2, 0), (0, 1))
    return tuple(multiply(left[i], right[j]) - multiply(left[j], right[i]) for i, j in pairs)
