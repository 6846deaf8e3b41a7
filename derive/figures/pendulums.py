"""Masses on rods in a plane: what slides, the rods with their angles from where these are zero, gravity."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import atan2, hypot, pi, remainder

from derive.algebra.numbers.floats import number
from derive.derivation import Caption, Drawing, Phrase, Place, Said, Stroke
from derive.errors import NotDerivable
from derive.expression import Expr, Symbol, free_symbols, replace
from derive.figures.held import Misdrawn
from derive.figures.swings import UNKNOWN, Hung, Rod, between_angles, hung
from derive.figures.typical import completed, names_in
from derive.figures.view import around
from derive.mechanics.lagrangian import LagrangianSystem

LENGTHS, TURNED, SLID = (1.0, 0.8, 0.65, 0.5), (0.61, 1.0, 0.45, 0.8), 1.25
SIZE = 0.09  # of the whole: a mass, twice
HIGH = 165.0  # points
SHARES = 24
ROUND = 72  # pieces of a circle
NEAR = 1e-9
BENT = Symbol("bent")  # stands for an angle while its rod is turned
Marked = tuple[list[Stroke], list[Caption]]


def drawn(system: LagrangianSystem, where: Mapping[str, Expr]) -> Drawing:
    """In a general position. Raises NotDerivable where it is not known what joins the masses."""
    chains = [hung(body, system) for body in system.bodies]
    if not any(chain.rods for chain in chains):
        raise NotDerivable(UNKNOWN)
    point = _values(system, chains, where)
    places = [spot for chain in chains for spot in _spots(chain, point)] + [(0.0, 0.0)]
    xs, ys = zip(*places, strict=True)
    size = SIZE * max(max(xs) - min(xs), max(ys) - min(ys))
    strokes: list[Stroke] = []
    captions: list[Caption] = []
    told: set[object] = set()
    for chain in chains:
        for key, (lines, texts) in _parts(system, chain, chains, point, size):
            if key not in told:
                told.add(key)
                strokes += lines
                captions += texts
    for lines, texts in (*_masses(chains, point, size), axes(size), gravity(system, places, point, size)):
        strokes += lines
        captions += texts
    seen = Phrase("masses-seen", {"masses": said(system)})
    return Drawing("figure", tuple(strokes), tuple(captions), Phrase("masses"), seen, HIGH, schematic=True)


def said(system: LagrangianSystem) -> tuple[Said, ...]:
    """Where each mass is."""
    return tuple(Phrase("mass-at", {"m": body.mass, "at": body.position}) for body in system.bodies)


def _values(system: LagrangianSystem, chains: list[Hung], where: Mapping[str, Expr]) -> dict[str, float]:
    """Of every name that a place rests on: angles that show, lengths one shorter than the other."""
    turned = dict.fromkeys(n for c in chains for rod in c.rods for n in sorted(names_in(rod.angle, where)))
    rest = dict.fromkeys(n for c in chains for rod in c.rods for n in sorted(names_in(rod.long, where)))
    slid = {name for c in chains for part in c.slide for name in names_in(part, where)}
    found = {name: LENGTHS[k % len(LENGTHS)] for k, name in enumerate(rest)}
    found |= {name: SLID if name in system.coordinates else TURNED[0] for name in slid}
    found |= {name: TURNED[k % len(TURNED)] for k, name in enumerate(turned)}
    return completed(found, where)


def _spots(chain: Hung, point: Mapping[str, float]) -> list[Place]:
    """What slides, and the ends of the rods. Raises Misdrawn where a mass is elsewhere."""
    x, y = (number(part, point) for part in chain.slide)
    found = [(x, y)]
    for rod in chain.rods:
        dx, dy = _way(rod, point)
        x, y = x + dx, y + dy
        found.append((x, y))
    if any(abs(number(part, point) - there) > NEAR for part, there in zip(chain.at, (x, y), strict=True)):
        raise Misdrawn("a mass is drawn where it is not")
    return found


def _way(rod: Rod, point: Mapping[str, float], turned: float | None = None) -> Place:
    """Its vector, at another angle where one is said."""
    if turned is None:
        x, y = (number(part, point) for part in rod.vector)
        return x, y
    x, y = (number(replace(part, {rod.angle: BENT}), {**point, BENT.name: turned}) for part in rod.vector)
    return x, y


def _parts(
    system: LagrangianSystem, chain: Hung, chains: list[Hung], point: Mapping[str, float], size: float
) -> Iterator[tuple[object, Marked]]:
    """What is drawn of a chain, each part with what tells it from others."""
    spots = _spots(chain, point)
    moved = [name for name in system.coordinates if any(name in free_symbols(p) for p in chain.slide)]
    cart = any(other.slide == chain.slide and not other.rods for other in chains)
    if moved:
        yield chain.slide, _slid(system, moved[0], spots[0], cart, size)
    for k in range(len(chain.rods)):
        yield (chain.slide, chain.rods[: k + 1]), _turned(chain, k, spots[k], spots[k + 1], point, size)
    if not cart:
        pin = [Stroke(disc(spots[0], 0.3 * size), "cap"), Stroke(disc(spots[0], 0.08 * size), "pin")]
        yield (chain.slide, "pin"), (pin, [])


def _slid(system: LagrangianSystem, name: str, at: Place, cart: bool, size: float) -> Marked:
    """A track, what stands on it, how far it is from the origin, and what pushes it."""
    far = hypot(*at)
    u = at[0] / far, at[1] / far
    n = -u[1], u[0]

    def spot(along: float, up: float) -> Place:
        return along * u[0] + up * size * n[0], along * u[1] + up * size * n[1]

    low, wide = (-0.8, 1.5) if cart else (0.0, 0.5)
    strokes = [Stroke((spot(-0.3 * far, low), spot(1.5 * far, low)), "thin")]
    if cart:
        corners = ((-wide, low), (wide, low), (wide, -low), (-wide, -low))
        strokes.append(Stroke(tuple(spot(far + a * size, b) for a, b in corners), "body"))
    start, end, middle = spot(0.0, low - 1.0), spot(far, low - 1.0), spot(0.5 * far, low - 1.0)
    strokes += [Stroke((middle, start), "measure"), Stroke((middle, end), "measure")]
    strokes += [Stroke((spot(a, low), spot(a, low - 1.3)), "leader") for a in (0.0, far)]
    captions = [Caption(middle, name, (-n[0], -n[1]), "length")]
    force = dict(system.forces).get(name)
    if isinstance(force, Symbol):
        tail, head = spot(far + wide * size, 0.0), spot(far + (wide + 2.2) * size, 0.0)
        strokes.append(Stroke((tail, head), "arrow"))
        captions.append(Caption(head, force, u, "joint"))
    return strokes, captions


def _turned(chain: Hung, k: int, start: Place, end: Place, point: Mapping[str, float], size: float) -> Marked:
    """A rod with its length, and its angle: from where that is zero, or from the rod before."""
    rod = chain.rods[k]
    way = end[0] - start[0], end[1] - start[1]
    far, now = hypot(*way), atan2(way[1], way[0])
    name: Expr = rod.angle
    zero = _way(rod, point, 0.0)
    if k and (more := between_angles(rod.angle, chain.rods[k - 1].angle)):
        name, zero = more, _way(rod, point, number(chain.rods[k - 1].angle, point))
    first = atan2(zero[1], zero[0])
    sweep = remainder(now - first, 2 * pi)
    radius = 0.42 * far
    arc = tuple(around(start, radius, first + sweep * i / SHARES) for i in range(SHARES + 1))
    strokes = [
        Stroke((start, around(start, 0.62 * far, first)), "hidden"),
        Stroke((start, end), "bar"),
        Stroke(arc, "arc"),
    ]
    spots = [around(start, radius, first + sweep * share) for share in (0.5, 0.35, 0.65)]
    (at, out), *others = [(spot, (spot[0] - start[0], spot[1] - start[1])) for spot in spots]
    middle = start[0] + 0.62 * way[0], start[1] + 0.62 * way[1]
    side = (-way[1], way[0]) if sweep > 0 else (way[1], -way[0])
    back = (-side[0], -side[1])
    return strokes, [
        Caption(at, name, out, "angle", tuple(others)),
        Caption(middle, rod.long, side, "length", ((middle, back),)),
    ]


def _masses(chains: list[Hung], point: Mapping[str, float], size: float) -> Iterator[Marked]:
    """A point at the end of rods; of what slides the name alone."""
    for chain in chains:
        at = _spots(chain, point)[-1]
        if chain.rods:
            name = Caption(at, chain.mass, (1.0, -0.5), "joint", clear=0.4 * size)
            yield [Stroke(disc(at, 0.4 * size), "pin")], [name]
        else:
            corner = at[0] + 1.5 * size, at[1] + 0.8 * size
            yield [], [Caption(corner, chain.mass, (0.3, 1.0), "joint")]


def axes(size: float) -> Marked:
    """x and y at the origin."""
    ends = {"x": (3.0 * size, 0.0), "y": (0.0, 3.0 * size)}
    strokes = [Stroke(((0.0, 0.0), end), name) for name, end in ends.items()]
    return strokes, [Caption(end, Symbol(name), end, name) for name, end in ends.items()]


def gravity(system: LagrangianSystem, places: list[Place], point: Mapping[str, float], size: float) -> Marked:
    """An arrow the way in which things fall, beside everything."""
    names = {name for part in system.gravity for name in free_symbols(part)}
    if len(names) != 1 or len(system.gravity) != 2:
        return [], []
    (name,) = names
    x, y = (number(part, {**point, name: 1.0}) for part in system.gravity)
    start = max(p[0] for p in places) + 4.0 * size, max(0.0, *(p[1] for p in places)) + 1.5 * size
    end = start[0] + 2.6 * size * x, start[1] + 2.6 * size * y
    return [Stroke((start, end), "arrow")], [Caption(end, Symbol(name), (1.0, 0.3), "joint")]


def disc(at: Place, radius: float) -> tuple[Place, ...]:
    """A circle, without corners that are seen."""
    return tuple(around(at, radius, 2 * pi * k / ROUND) for k in range(ROUND))
