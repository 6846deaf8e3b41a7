"""A wheel that rolls along a line: on the level, or down an incline."""

from __future__ import annotations

from collections.abc import Mapping
from math import atan2, hypot, pi

from derive.algebra.numbers.floats import number
from derive.derivation import Caption, Drawing, Phrase, Place, Stroke
from derive.errors import NotDerivable
from derive.expression import Call, Expr, Symbol, factors_of, free_symbols, walk
from derive.figures.pendulums import SHARES, Marked, axes, disc, gravity, said
from derive.figures.swings import TURNS, UNKNOWN, moving_angles
from derive.figures.typical import completed, names_in
from derive.figures.view import around
from derive.mechanics.lagrangian import LagrangianSystem, MovingBody

FAR, RADIUS, STEEP, ROLLED = 1.3, 0.36, 0.5, 0.95  # how far it has rolled, and by which angles (rad)
BEFORE, BEYOND = 0.45, 1.0  # how far its line goes on
SIZE = 0.13
HIGH = 165.0  # points


def drawn(system: LagrangianSystem, where: Mapping[str, Expr]) -> Drawing:
    """In a general position. Raises NotDerivable for what is no wheel that rolls along a line."""
    (body,) = system.bodies
    slid, radius = _wheel(system, body)
    names = {name for part in body.position for name in names_in(part, where)}
    point = completed({**dict.fromkeys(names, STEEP), slid: FAR}, where)
    x, y = (number(part, point) for part in body.position)
    far = hypot(x, y)
    u = x / far, y / far
    n = (-u[1], u[0]) if u[0] > 0 else (u[1], -u[0])

    def spot(along: float, up: float) -> Place:
        return along * u[0] + up * n[0], along * u[1] + up * n[1]

    places = [spot(-BEFORE, -RADIUS), spot(far + BEYOND, -RADIUS), spot(far, RADIUS)]
    parts = [
        _ground(body, places[0], places[1]),
        _rolled(system, body, spot(far, 0.0), n, 1.0 if u[0] > 0 else -1.0, radius),
        _measured(
            spot(0.0, 1.5 * RADIUS), spot(far, 1.5 * RADIUS), [spot(0.0, 0.0), spot(far, RADIUS)], slid, n
        ),
        axes(SIZE) if slid not in ("x", "y") or body.position[0] == Symbol(slid) else ([], []),
        gravity(system, places, point, SIZE),
    ]
    strokes = tuple(stroke for lines, _ in parts for stroke in lines)
    captions = tuple(caption for _, texts in parts for caption in texts)
    seen = Phrase("masses-seen", {"masses": said(system)})
    return Drawing("figure", strokes, captions, Phrase("masses"), seen, HIGH, schematic=True)


def _wheel(system: LagrangianSystem, body: MovingBody) -> tuple[str, Expr]:
    """The coordinate along its line, and its radius: x = r phi, or the rates."""
    slid = {name for part in body.position for name in free_symbols(part)} & {*system.coordinates}
    turned = body.angle
    if len(body.position) != 2 or len(slid) != 1 or not isinstance(turned, Symbol) or body.inertia is None:
        raise NotDerivable(UNKNOWN)
    (name,) = slid
    if moving_angles(body.position, system):
        raise NotDerivable(UNKNOWN)
    for end in ("", "_dot"):
        along, angle = Symbol(name + end), Symbol(turned.name + end)
        for constraint in system.constraints:
            for one, other in ((constraint.left, constraint.right), (constraint.right, constraint.left)):
                rest = [factor for factor in factors_of(other) if factor != angle]
                if (
                    one == along
                    and len(rest) == 1 == len(factors_of(other)) - 1
                    and isinstance(rest[0], Symbol)
                ):
                    return name, rest[0]
    raise NotDerivable(UNKNOWN)


def _ground(body: MovingBody, top: Place, end: Place) -> Marked:
    """The line it rolls along; an incline as a wedge with its angle."""
    if abs(top[1] - end[1]) < 1e-9:
        return [Stroke((top, end), "edge")], []
    high, low = (top, end) if top[1] > end[1] else (end, top)
    strokes = [Stroke((high, low, (high[0], low[1])), "face")]
    angles = {
        node.arguments[0]
        for part in body.position
        for node in walk(part)
        if isinstance(node, Call) and node.function in TURNS
    }
    if len(angles) != 1:
        return strokes, []
    side = 1.0 if high[0] > low[0] else -1.0
    slope = atan2(high[1] - low[1], high[0] - low[0])
    level = 0.0 if side > 0 else pi
    arc = tuple(around(low, 0.5, level + (slope - level) * k / SHARES) for k in range(SHARES + 1))
    middle = arc[SHARES // 2]
    name = Caption(middle, angles.pop(), (middle[0] - low[0], middle[1] - low[1]), "angle")
    return [*strokes, Stroke(arc, "thin")], [name]


def _rolled(
    system: LagrangianSystem, body: MovingBody, at: Place, n: Place, sense: float, radius: Expr
) -> Marked:
    """The wheel with its mass, its radius, and the angle it has turned by, the way in which it rolls."""
    first = atan2(n[1], n[0])
    turn = -sense * ROLLED
    arc = tuple(around(at, 0.62 * RADIUS, first + turn * k / SHARES) for k in range(SHARES + 1))
    foot = around(at, RADIUS, first + pi)
    strokes = [
        Stroke(disc(at, RADIUS), "body"),
        Stroke((at, around(at, RADIUS, first)), "hidden"),
        Stroke((at, around(at, RADIUS, first + turn)), "thin"),
        Stroke((at, foot), "thin"),
        Stroke(arc, "arc"),
        Stroke(disc(at, 0.25 * SIZE), "pin"),
    ]
    half = (at[0] + foot[0]) / 2, (at[1] + foot[1]) / 2
    aside = around((0.0, 0.0), 1.0, first + turn / 2)
    edge = around(at, RADIUS, first + pi / 2 * sense)
    return strokes, [
        Caption(around(at, RADIUS, first + turn / 2), body.angle or radius, aside, "angle"),
        Caption(
            half, radius, (-n[1] * sense, n[0] * sense), "length", ((half, (n[1] * sense, -n[0] * sense)),)
        ),
        Caption(edge, body.mass, (edge[0] - at[0], edge[1] - at[1]), "joint"),
    ]


def _measured(start: Place, end: Place, feet: list[Place], name: str, n: Place) -> Marked:
    """How far it has rolled."""
    middle = (start[0] + end[0]) / 2, (start[1] + end[1]) / 2
    strokes = [Stroke((middle, start), "measure"), Stroke((middle, end), "measure")]
    strokes += [Stroke((foot, top), "leader") for foot, top in zip(feet, (start, end), strict=True)]
    return strokes, [Caption(middle, name, n, "length")]
