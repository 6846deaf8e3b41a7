"""A mass at a fixed distance from the origin, in space: its angles about the vertical and from it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import acos, cos, pi, sin

from derive.algebra.normal import normal
from derive.algebra.numbers.floats import number
from derive.algebra.readable.form import readable
from derive.derivation import Caption, Drawing, Phrase, Stroke
from derive.errors import NotDerivable
from derive.expression import (
    ONE,
    Call,
    Expr,
    Symbol,
    free_symbols,
    is_negative,
    negate,
    replace,
    terms_of,
    walk,
)
from derive.figures.pendulums import BENT, said
from derive.figures.swings import TURNS, UNKNOWN, moving_angles
from derive.figures.typical import completed, names_in
from derive.figures.view import Vector, View, along, around, cross, dot, in_space, length, unit
from derive.mechanics.lagrangian import LagrangianSystem

HIGH = 185.0  # points
FROM_Z, ABOUT_Z = 0.87, 1.2  # rad
AXIS, ARC, SIZE, PATH = 0.55, 0.36, 0.035, 72  # of the distance: axes, arcs, a mass; pieces of a path
TRIED = ((0.4, 0.9), (1.3, 0.2), (0.7, 2.1))  # angles at which the distance has to be the same
SHARES = 24
Z: Vector = (0.0, 0.0, 1.0)
Marked = tuple[list[Stroke], list[Caption]]


def drawn(system: LagrangianSystem, where: Mapping[str, Expr]) -> Drawing:
    """In a general position. Raises NotDerivable where its place is not given by a distance and angles."""
    (body,) = system.bodies
    angles = moving_angles(body.position, system)
    if body.inertia is not None or not 0 < len(angles) <= 2:
        raise NotDerivable(UNKNOWN)
    point = _values(body.position, angles, where)
    far = _distance(body.position, angles, point)
    view = in_space()
    at = _place(body.position, point)
    size = number(far, point)
    axes = [_axis(view, k, size) for k in range(3)]
    upright = [*_upright(view, at, size)]
    bound = len(system.coordinates) == 1  # to a path, which is drawn
    arcs = [_angle(view, body.position, angle, point, size, bound) for angle in angles]
    mass = Stroke(_disc(view, at, SIZE * size), "pin")
    rod = Stroke((view.place((0.0, 0.0, 0.0)), view.place(at)), "edge")
    middle = view.place(along((0.0, 0.0, 0.0), (0.6, at)))
    end = view.place(at)
    side = -end[1], end[0]
    fall, its_name = gravity(system, view, size)
    strokes = (
        [*fall] + [s for lines, _ in axes for s in lines] + upright + [s for lines, _ in arcs for s in lines]
    )
    captions = [c for _, texts in (*axes, *arcs) for c in texts]
    captions += [
        *its_name,
        Caption(middle, far, side, "length", ((middle, (-side[0], -side[1])),)),
        Caption(end, body.mass, end, "joint", clear=SIZE * size),
    ]
    seen = Phrase("masses-seen", {"masses": said(system)})
    return Drawing(
        "figure", (*strokes, rod, mass), tuple(captions), Phrase("masses"), seen, HIGH, schematic=True
    )


def gravity(system: LagrangianSystem, view: View, size: float) -> Marked:
    """An arrow the way in which things fall, beside everything; nothing where that is not one letter."""
    names = {name for part in system.gravity for name in free_symbols(part)}
    if len(names) != 1 or len(system.gravity) != 3:
        return [], []
    (name,) = names
    x, y = view.place([number(part, {name: 0.4 * size}) for part in system.gravity])
    start = 1.1 * size, 0.4 * size
    end = start[0] + x, start[1] + y
    return [Stroke((start, end), "arrow")], [Caption(end, Symbol(name), (1.0, 0.3), "joint")]


def _values(position: tuple[Expr, ...], angles: list[Expr], where: Mapping[str, Expr]) -> dict[str, float]:
    """Of every name: lengths of one, and angles that show, those about the vertical seen from the side."""
    found = {name: 1.0 for part in position for name in sorted(names_in(part, where))}
    for angle in angles:
        first, *_ = sorted(names_in(angle, where))
        found[first] = FROM_Z if any(angle in each.arguments for each in _turns(position[2])) else ABOUT_Z
    return completed(found, where)


def _turns(part: Expr) -> Iterator[Call]:
    return (node for node in walk(part) if isinstance(node, Call) and node.function in TURNS)


def _place(position: tuple[Expr, ...], point: Mapping[str, float]) -> Vector:
    x, y, z = (number(part, point) for part in position)
    return x, y, z


def _distance(position: tuple[Expr, ...], angles: list[Expr], point: Mapping[str, float]) -> Expr:
    """How far from the origin the mass is at all angles: what a sine or cosine is multiplied by."""
    named = {angle: Symbol(f"{BENT.name}{k}") for k, angle in enumerate(angles)}
    vertical = replace(position[2], named)
    free = {name.name for name in named.values()}
    turned = [part for part in terms_of(vertical) if free_symbols(part) & free]
    if len(turned) != 1 or len(terms_of(vertical)) != 1:
        raise NotDerivable(UNKNOWN)
    calls: dict[Expr, Expr] = dict.fromkeys(_turns(vertical), ONE)
    factor = readable(normal(replace(turned[0], calls)))
    far = negate(factor) if is_negative(factor) else factor
    for values in TRIED:
        here = {**point, **dict(zip(sorted(free), values, strict=False))}
        reached = [number(replace(part, named), here) for part in position]
        if abs(dot(reached, reached) ** 0.5 - number(far, here)) > 1e-9:
            raise NotDerivable(UNKNOWN)
    return far


def _angle(
    view: View,
    position: tuple[Expr, ...],
    angle: Expr,
    point: Mapping[str, float],
    size: float,
    bound: bool,
) -> Marked:
    """An arc from where an angle is zero: in the level plane where it turns about the vertical, with the path
    of a mass that is `bound` to one where it does not."""
    moved = tuple(replace(part, {angle: BENT}) for part in position)
    value = number(angle, point)

    def turned(by: float) -> Vector:
        return _place(moved, {**point, BENT.name: by})

    start, now = turned(0.0), turned(value)
    about_z = abs(start[2] - now[2]) < 1e-9 and abs(turned(1.0)[2] - now[2]) < 1e-9
    a, b = ((x, y, 0.0) if about_z else (x, y, z) for x, y, z in (start, now))
    arc = tuple(map(view.place, _between(a, b, ARC * size)))
    middle = arc[SHARES // 2]
    zero = (view.place((0.0, 0.0, 0.0)), view.place(along((0.0, 0.0, 0.0), (1.0, a))))
    lines = [Stroke(zero, "hidden"), Stroke(arc, "arc")]
    if bound and not about_z:
        path = tuple(view.place(turned(2 * pi * k / PATH)) for k in range(PATH + 1))
        lines.append(Stroke(path, "hidden"))
    return lines, [Caption(middle, angle, middle, "angle")]


def _between(a: Vector, b: Vector, radius: float) -> Iterator[Vector]:
    """An arc about the origin from one direction to another, the short way."""
    first, last = unit(a), unit(b)
    whole = acos(max(-1.0, min(1.0, dot(first, last))))
    if whole < 1e-6 or whole > pi - 1e-6:
        raise NotDerivable(UNKNOWN)
    side = unit(cross(cross(first, last), first))
    for k in range(SHARES + 1):
        turn = whole * k / SHARES
        yield along((0.0, 0.0, 0.0), (radius * cos(turn), first), (radius * sin(turn), side))


def _axis(view: View, k: int, size: float) -> Marked:
    way = (float(k == 0), float(k == 1), float(k == 2))
    end = view.place(along((0.0, 0.0, 0.0), (AXIS * size, way)))
    letter = "xyz"[k]
    return [Stroke((view.place((0.0, 0.0, 0.0)), end), letter)], [Caption(end, Symbol(letter), end, letter)]


def _upright(view: View, at: Vector, size: float) -> Iterator[Stroke]:
    """From the mass up or down to the level plane through the origin, and from there to the origin."""
    foot = (at[0], at[1], 0.0)
    if length(view.place(foot)) > 0.05 * size:
        yield Stroke((view.place(at), view.place(foot)), "leader")
        yield Stroke((view.place((0.0, 0.0, 0.0)), view.place(foot)), "leader")


def _disc(view: View, at: Vector, radius: float) -> tuple[tuple[float, float], ...]:
    return tuple(around(view.place(at), radius, 2 * pi * k / SHARES) for k in range(SHARES))
