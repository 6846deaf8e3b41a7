"""Linkages of four and five bars and slider-cranks, with their joints; the other assembly is dashed."""

from __future__ import annotations

from cmath import exp, phase
from collections.abc import Iterator
from math import radians, sqrt

from derive.algebra.formulas.quantities import rational
from derive.derivation import Caption, Drawing, Phrase, Place, Stroke, Words
from derive.errors import NotDerivable
from derive.expression import Expr, Symbol
from derive.figures import solids
from derive.figures.view import onto_plane
from derive.mechanics.linkages import FiveBar, FourBar, SliderCrank

FOUR, THREE = ("crank", "coupler", "rocker", "ground"), ("crank", "rod", "offset")
HIGH = 150.0  # points
TYPICAL = {"crank": 1.0, "coupler": 2.4, "rocker": 1.9, "ground": 2.5, "rod": 2.6, "offset": -0.4}
ANGLES = (60, 45, 80, 30, 100, 15, 120, 140, 165, 0)  # of the crank, the first with which the bars meet well
WELL = 0.3  # how far the two assemblies are apart, as a share of the longest bar
JOINT = 0.055  # of the longest bar


def drawn(linkage: FourBar | SliderCrank) -> Drawing:
    """Its lengths where they are numbers, else typical ones. Raises NotDerivable where they do not meet
    well."""
    names = FOUR if isinstance(linkage, FourBar) else THREE
    given = {name: rational(getattr(linkage, name)) for name in names}
    known = all(size is not None for size in given.values())
    bars = {name: float(size or 0) if known else TYPICAL[name] for name, size in given.items()}
    if isinstance(linkage, SliderCrank) and rational(linkage.offset) == 0:
        bars["offset"] = 0.0
    scale = max(map(abs, bars.values()))
    bars = {name: size / scale for name, size in bars.items()}
    for degrees in ANGLES:
        end = bars["crank"] * exp(1j * radians(degrees))
        ways = _four_bar(bars, end) if isinstance(linkage, FourBar) else _slider(bars, end)
        if ways and abs(ways[0] - ways[1]) > WELL:
            return _drawing(linkage, bars, end, ways)
    raise NotDerivable("no position shows this linkage well")


def five_bar(robot: FiveBar) -> Drawing:
    """With both cranks leaning outwards. Raises NotDerivable where no position shows it well."""
    given = [*robot.cranks, *robot.couplers, robot.ground]
    sizes = [rational(tree) for tree in given]
    known = [float(size) for size in sizes if size is not None]
    bars = known if len(known) == len(given) else [1.0, 1.0, 1.6, 1.6, 1.1]
    a_1, a_2, b_1, b_2, ground = (size / max(bars) for size in bars)
    for lean in (120, 100, 140, 80, 60, 160):
        first = a_1 * exp(1j * radians(lean))
        second = ground + a_2 * exp(1j * radians(180 - lean))
        ways = _meeting(first, b_1, second, b_2)
        if ways and abs(ways[0] - ways[1]) > WELL:
            return _of_five(robot, [first, second], ways, complex(ground, 0), lean)
    raise NotDerivable("no position shows this linkage well")


def _meeting(one: complex, reach: float, other: complex, far: float) -> tuple[complex, complex] | None:
    """Where two circles meet: the upper place first."""
    apart = abs(other - one)
    along = (apart**2 + reach**2 - far**2) / (2 * apart) if apart else reach
    if reach <= abs(along):
        return None
    way, root = (other - one) / apart, sqrt(reach**2 - along**2)
    ways = [one + way * complex(along, side * root) for side in (1, -1)]
    return max(ways, key=lambda place: place.imag), min(ways, key=lambda place: place.imag)


def _of_five(
    robot: FiveBar, ends: list[complex], ways: tuple[complex, complex], pivot: complex, lean: float
) -> Drawing:
    view = onto_plane((0.0, 0.0, 1.0))
    assert view is not None
    tip, other = ways
    fixed = [0j, pivot]
    strokes = [each for at in fixed for each in solids.ground(view, (*_place(at), 0.0), 2 * JOINT).strokes]
    strokes += [Stroke((_place(end), _place(other)), "hidden") for end in ends]
    strokes.append(Stroke((_place(0j), _place(pivot + 0.3)), "thin"))
    links = [*zip(fixed, ends, strict=True), *((end, tip) for end in ends)]
    strokes += [Stroke((_place(a), _place(b)), "link") for a, b in links]
    for joint in (*fixed, *ends, tip):
        strokes += solids.cylinder(view, (*_place(joint), 0.0), (0.0, 0.0, 1.0), 2 * JOINT).strokes
    captions = [Caption(_place(tip), Words("P"), (0.0, 1.0), "joint", clear=1.2 * JOINT)]
    for index, (at, turn) in enumerate(zip(fixed, (lean, 180 - lean), strict=True), 1):
        arc = tuple(_place(at + 0.2 * exp(1j * radians(turn) * k / 20)) for k in range(21))
        strokes.append(Stroke(arc, "turn"))
        captions.append(Caption(arc[6], Symbol(f"theta_{index}"), (1.0, 0.4), "joint"))
    names = [
        ("a_1", robot.cranks[0]),
        ("a_2", robot.cranks[1]),
        ("b_1", robot.couplers[0]),
        ("b_2", robot.couplers[1]),
    ]
    for k, ((a, b), (usual, size)) in enumerate(zip(links, names, strict=True)):
        side = (-1.0, 0.2) if k % 2 == 0 else (1.0, 0.2)
        captions.append(Caption(_place((a + b) / 2), _name(usual, size), side, "length", clear=0.4 * JOINT))
    captions.append(Caption(_place(pivot / 2), _name("d", robot.ground), (0.0, -1.0), "length"))
    return Drawing("figure", tuple(strokes), tuple(captions), Phrase("bars"), None, HIGH, schematic=True)


def _four_bar(bars: dict[str, float], end: complex) -> tuple[complex, complex] | None:
    """Where the coupler and the rocker meet: the upper place first."""
    return _meeting(end, bars["coupler"], complex(bars["ground"], 0), bars["rocker"])


def _slider(bars: dict[str, float], end: complex) -> tuple[complex, complex] | None:
    """The places of the slider, the one to the right first."""
    left = bars["rod"] ** 2 - (end.imag - bars["offset"]) ** 2
    if left <= 0:
        return None
    return complex(end.real + sqrt(left), bars["offset"]), complex(end.real - sqrt(left), bars["offset"])


def _drawing(
    linkage: FourBar | SliderCrank, bars: dict[str, float], end: complex, ways: tuple[complex, complex]
) -> Drawing:
    view = onto_plane((0.0, 0.0, 1.0))
    assert view is not None
    tip, other = ways
    four = isinstance(linkage, FourBar)
    pivot = complex(bars["ground"], 0) if four else tip
    fixed = [0j, pivot] if four else [0j]
    strokes = [each for at in fixed for each in solids.ground(view, (*_place(at), 0.0), 2 * JOINT).strokes]
    strokes += [Stroke((_place(end), _place(other)), "hidden")]
    strokes += [Stroke((_place(pivot), _place(other)), "hidden")] if four else [*_block(other, "hidden")]
    if four:
        strokes.append(Stroke(((0.0, 0.0), _place(pivot)), "hidden"))
    strokes.append(Stroke(((0.0, 0.0), (max(0.6 * abs(end), 0.3), 0.0)), "thin"))
    links = [(0j, end), (end, tip), *([(pivot, tip)] if four else [])]
    strokes += [Stroke((_place(a), _place(b)), "link") for a, b in links]
    if not four:
        strokes += [Stroke(((-0.2, tip.imag), (tip.real + 0.35, tip.imag)), "hidden"), *_block(tip, "body")]
    for joint in dict.fromkeys([0j, end, tip, pivot]):
        strokes += solids.cylinder(view, (*_place(joint), 0.0), (0.0, 0.0, 1.0), 2 * JOINT).strokes
    radius = 0.45 * abs(end)
    arc = tuple(_place(radius * exp(1j * phase(end) * k / 20)) for k in range(21))
    strokes.append(Stroke(arc, "turn"))
    angle = linkage.angle if isinstance(linkage.angle, Symbol) else Symbol("theta_2")
    captions = [Caption(arc[8], angle, (1.0, 0.3), "joint"), *_names(linkage, links, fixed)]
    captions += [
        Caption(_place(at), Words(name), (0.0, 1.0), "joint", clear=1.2 * JOINT)
        for name, at in (("A", end), *((("B", tip),) if four else ()))
    ]
    return Drawing("figure", tuple(strokes), tuple(captions), Phrase("bars"), None, HIGH, schematic=True)


def _names(
    linkage: FourBar | SliderCrank, links: list[tuple[complex, complex]], fixed: list[complex]
) -> Iterator[Caption]:
    """Those of the bars, in the middle of each."""
    if isinstance(linkage, FourBar):
        sizes = [("l_2", linkage.crank), ("l_3", linkage.coupler), ("l_4", linkage.rocker)]
        yield Caption(_place(fixed[1] / 2), _name("l_1", linkage.ground), (0.0, -1.0), "length")
    else:
        sizes = [("l_2", linkage.crank), ("l_3", linkage.rod)]
    for (a, b), (usual, size) in zip(links, sizes, strict=True):
        across = (b - a) / abs(b - a) * 1j
        side = across if across.imag >= 0 else -across
        away = _place(side)
        yield Caption(_place((a + b) / 2), _name(usual, size), away, "length", clear=0.4 * JOINT)


def _name(usual: str, size: Expr) -> Expr:
    return size if isinstance(size, Symbol) else Symbol(usual)


def _block(at: complex, role: str) -> Iterator[Stroke]:
    """A slider."""
    x, y = _place(at)
    w, h = 2.4 * JOINT, 1.3 * JOINT
    corners = ((x - w, y - h), (x + w, y - h), (x + w, y + h), (x - w, y + h))
    yield Stroke(corners if role == "body" else (*corners, corners[0]), role)


def _place(at: complex) -> Place:
    return at.real, at.imag
