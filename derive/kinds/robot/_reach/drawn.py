"""A limited workspace as it lies in a plane of the base frame, or in section through its first axis."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from derive.algebra.numbers import floats as numeric
from derive.derivation import Plot
from derive.errors import NotDerivable
from derive.expression import Expr
from derive.figures.limited_workspaces import Corners, from_along, in_section, outline
from derive.kinds.fields import Place
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import oracle_of
from derive.kinds.robot._lengths import unit_of_lengths
from derive.kinds.robot._point import Tracked
from derive.kinds.robot._reach.sampled import Sampled
from derive.kinds.robot._reach.shapes import Shape
from derive.kinds.robot._reach.spans import Span
from derive.kinds.values_at import point_of
from derive.mechanics.chain import Chain

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

NOTHING, STRAIGHT = 1e-9, 1e-9
CORNERS = 121
Ends = tuple[float, float]


def plots(
    problem: Problem, found: Chain, point: Tracked, shape: Shape, told: Mapping[str, Expr], place: Place
) -> Iterator[Plot]:
    """With the lengths that are given; nothing of what has no end, is a line or a box, or lies askew."""
    known = dict(point_of(dict(place), problem.where))
    unit = unit_of_lengths(problem, dict(place).values())
    try:
        near, far = (
            numeric.number(told[name], known) if name in told else 0.0 for name in ("r_min", "r_max")
        )
        if shape.kind == "ball":
            yield in_section(_of_shell(shape, known, near, far), unit)
            return
        arm = Sampled(problem, found, point, shape, dict(oracle_of(problem).at(known)))
        parts = [*_parts(arm, near, far)]
    except (KeyError, NotDerivable):
        return
    if parts and (axes := _axes(arm)):
        flat = [[(float(x), float(y)) for x, y in each @ axes[0].T] for each in parts]
        yield from_along(flat, axes[1], unit)


def _of_shell(shape: Shape, known: Mapping[str, float], near: float, far: float) -> Corners:
    """Half of it, by the distance from the first axis."""
    if "r_max" not in shape.formulas:
        raise NotDerivable("it has no end")
    low, high = (numeric.number(each, known) for each in shape.rise[1:]) if shape.rise else (-1.0, 1.0)
    side = numeric.number(shape.side, known)
    near, far = (math.sqrt(max(0.0, each**2 - side**2)) for each in (near, far))
    return [
        (math.hypot(x, side), y) for x, y in outline(near, far, (math.asin(low), math.asin(high)), (0.0, 0.0))
    ]


def _axes(arm: Sampled) -> tuple[Array, tuple[str, str]] | None:
    """The two axes of the base (2 by 3) that span the plane, and their names; None where none do."""
    import numpy as np

    basis = np.array(arm.lines[arm.first][0]) if arm.shape.kind != "box" else np.cross(*arm.basis)
    across = int(np.abs(basis).argmax())
    if abs(abs(basis[across]) - 1) > STRAIGHT:
        return None
    kept = [k for k in range(3) if k != across]
    return np.eye(3)[kept], ("xyz"[kept[0]], "xyz"[kept[1]])


def _parts(arm: Sampled, near: float, far: float) -> Iterator[Array]:
    """The outlines (N by 3) of what is filled."""
    import numpy as np

    shape = arm.shape
    if shape.kind == "box" and len(shape.rows) != 2:
        return
    if shape.kind == "box":
        (a, b), (c, d) = (_ends(arm, span) for span in shape.sides)
        yield arm.moved(dict(zip(shape.rows, np.array([[a, b, b, a], [c, c, d, d]]), strict=True)))
        return
    if shape.kind == "bent":
        yield from _bent(arm)
        return
    z = arm.lines[arm.first][0]
    rail = _ends(arm, shape.rail) if shape.rail else (0.0, 0.0)
    turn = (
        (numeric.number(shape.turn[0], arm.at), numeric.number(shape.turn[1], arm.at)) if shape.turn else None
    )
    if far - near < NOTHING and not shape.rail:
        return
    if "r_max" not in shape.formulas:
        raise NotDerivable("it has no end")
    corners = np.array(outline(near, far, turn or (0.0, 2 * math.pi), rail))
    if shape.rail:
        row = shape.rows[arm.rail]
        across, own = arm.lines[row][0], arm.here[arm.variable(row)]
        yield arm.center + (corners[:, :1] - own) * across + corners[:, 1:] * np.cross(z, across)
        return
    start, side = arm.planar(arm.start - arm.center, z)
    own = arm.here[arm.variable(arm.first)]
    across = math.cos(own) * start - math.sin(own) * side
    yield arm.center + corners[:, :1] * across + corners[:, 1:] * np.cross(z, across)


def _bent(arm: Sampled) -> Iterator[Array]:
    """Of each bend of the elbow where both joints go along the edges of their ranges."""
    import numpy as np

    first, second = (row for row in arm.shape.rows if arm.found.joint(row).type == "revolute")
    (low, high), t = arm.limits[first], np.linspace(0.0, 1.0, CORNERS)
    for a, b in arm.bends(second):
        q = a + (b - a) * t
        one = np.concatenate([np.full(CORNERS, high), high + (low - high) * t])
        other = np.concatenate([q, np.full(CORNERS, b)])
        back = np.concatenate([np.full(CORNERS, low), low + (high - low) * t])
        yield arm.moved({
            first: np.concatenate([one, back]),
            second: np.concatenate([other, q[::-1], np.full(CORNERS, a)]),
        })  # fmt: skip


def _ends(arm: Sampled, span: Span) -> Ends:
    """Raises NotDerivable where one is missing."""
    if span.low is None or span.high is None:
        raise NotDerivable("there is no end")
    return numeric.number(span.low, arm.at), numeric.number(span.high, arm.at)
