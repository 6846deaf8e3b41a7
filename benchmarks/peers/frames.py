"""A robot in the terms of sympy.physics.mechanics: frames, points and rigid bodies."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import sympy
from sympy.physics.mechanics import Point, ReferenceFrame, RigidBody, dynamicsymbols, inertia

from benchmarks import peers
from benchmarks.rows import Row, Rows


@dataclass(frozen=True, slots=True)
class Tree:
    """`speeds` are q_dot for Lagrange; symbols of their own for Kane."""

    base: ReferenceFrame
    origin: Point
    bodies: tuple[RigidBody, ...]
    q: tuple[Any, ...]
    gravity: Any
    names: tuple[str, ...]


def tree(rows: Rows) -> Tree:
    """Frames by successive rotations, points by their positions; velocities are derived by SymPy."""
    q = {name: dynamicsymbols(name) for name in rows.variables}
    base, origin = ReferenceFrame("N"), Point("O")
    origin.set_vel(base, 0)
    frame, point, bodies = base, origin, []
    for i, row in enumerate(rows.rows, 1):
        theta, d, a, alpha = (_expr(text, q) for text in (row.theta, row.d, row.a, row.alpha))
        turned = frame.orientnew(f"A{i}", "Axis", (theta, frame.z))
        point = point.locatenew(f"o{i}", d * frame.z + a * turned.x)
        frame = turned.orientnew(f"B{i}", "Axis", (alpha, turned.x))
        bodies.append(_body(i, row, frame, point, base, origin, q))
    gravity = _vector(rows.gravity, base, q)
    return Tree(base, origin, tuple(bodies), tuple(q.values()), gravity, rows.variables)


def value(entry: Any, names: tuple[str, ...], point: peers.Point) -> float:
    """An entry at a point."""
    known = {dynamicsymbols(name): point[name] for name in names}
    return float(entry.subs(known).subs({sympy.Symbol(name): at for name, at in point.items()}))


def _body(
    i: int,
    row: Row,
    frame: ReferenceFrame,
    point: Point,
    base: ReferenceFrame,
    origin: Point,
    q: dict[str, Any],
) -> RigidBody:
    com = point.locatenew(f"c{i}", _vector(row.weight.com, frame, q))
    com.set_vel(base, com.pos_from(origin).dt(base))
    moments = [_expr(text, q) for text in row.weight.moments]
    return RigidBody(f"L{i}", com, frame, _expr(row.weight.mass, q), (inertia(frame, *moments), com))


def _vector(parts: tuple[str, ...], frame: ReferenceFrame, q: dict[str, Any]) -> Any:
    x, y, z = (_expr(text, q) for text in parts)
    return x * frame.x + y * frame.y + z * frame.z


def _expr(text: str, q: dict[str, Any]) -> Any:
    return sympy.sympify(text, locals=q)
