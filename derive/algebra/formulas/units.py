"""Units of measurement: each name with its dimension and its exact size in SI base units."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from typing import Literal, TypeAlias

# Exponents of metre, kilogram, second, ampere, radian. The radian counts in what is said to the
# author ("an angle is wanted"), not in arithmetic: an arc is an angle times a radius.
Dimension: TypeAlias = tuple[int, int, int, int, int]
# What a field takes: one dimension, any unit at all, or (None) no unit but deg and rad.
Wanted: TypeAlias = Dimension | Literal["any"] | None

PLAIN: Dimension = (0, 0, 0, 0, 0)
LENGTH: Dimension = (1, 0, 0, 0, 0)
MASS: Dimension = (0, 1, 0, 0, 0)
TIME: Dimension = (0, 0, 1, 0, 0)
ANGLE: Dimension = (0, 0, 0, 0, 1)
FREQUENCY: Dimension = (0, 0, -1, 0, 0)
SPEED: Dimension = (1, 0, -1, 0, 0)
ACCELERATION: Dimension = (1, 0, -2, 0, 0)
FORCE: Dimension = (1, 1, -2, 0, 0)
TORQUE: Dimension = (2, 1, -2, 0, 0)
INERTIA: Dimension = (2, 1, 0, 0, 0)
ANGULAR_SPEED: Dimension = (0, 0, -1, 0, 1)
ANY: Literal["any"] = "any"

BASE_UNITS = ("m", "kg", "s", "A", "rad")
SPOKEN: dict[Dimension, str] = {
    PLAIN: "a plain number",
    LENGTH: "a length (m)",
    MASS: "a mass (kg)",
    TIME: "a time (s)",
    ANGLE: "an angle (rad or deg)",
    SPEED: "a speed (m/s)",
    ACCELERATION: "an acceleration (m/s^2)",
    FORCE: "a force (N)",
    TORQUE: "a torque (N m)",
    ANGULAR_SPEED: "an angular speed (rad/s or deg/s)",
    INERTIA: "a moment of inertia (kg m^2)",
}


@dataclass(frozen=True, slots=True)
class Unit:
    """`size` in SI base units; `degrees` is the power of pi/180 that comes on top of it."""

    dimension: Dimension
    size: Fraction = Fraction(1)
    degrees: int = 0
    name: str = ""  # what stands behind a number in SI units: "N m", "m/s^2"; "/s" behind degrees


UNITS: dict[str, Unit] = {
    "m": Unit(LENGTH),
    "mm": Unit(LENGTH, Fraction(1, 1000)),
    "cm": Unit(LENGTH, Fraction(1, 100)),
    "km": Unit(LENGTH, Fraction(1000)),
    "kg": Unit(MASS),
    "g": Unit(MASS, Fraction(1, 1000)),
    "s": Unit(TIME),
    "ms": Unit(TIME, Fraction(1, 1000)),
    "rad": Unit(ANGLE),
    "deg": Unit(ANGLE, Fraction(1), 1),
    "N": Unit(FORCE),
    "A": Unit((0, 0, 0, 1, 0)),
    "V": Unit((2, 1, -3, -1, 0)),
    "ohm": Unit((2, 1, -3, -2, 0)),
    "H": Unit((2, 1, -2, -2, 0)),
    "Hz": Unit(FREQUENCY),
}
# Units that are not read, and would otherwise pass for names: `3 ft` is no product.
_OTHER_UNITS = """
    dm um inch inches ft foot feet yd lb lbs oz min hour hours sec degree degrees radian radians rpm
    meter meters metre metres kN mN Nm mA mV kV kohm mH kHz kW
"""
OTHER_UNITS = frozenset(_OTHER_UNITS.split())
# What to write for some of them.
INSTEAD = {
    **dict.fromkeys(("degree", "degrees"), "deg"),
    **dict.fromkeys(("radian", "radians"), "rad"),
    **dict.fromkeys(("meter", "meters", "metre", "metres"), "m"),
    **dict.fromkeys(("sec", "second", "seconds"), "s"),
    **dict.fromkeys(("centimeter", "centimeters", "centimetre", "centimetres"), "cm"),
    **dict.fromkeys(("millimeter", "millimeters", "millimetre", "millimetres"), "mm"),
    **dict.fromkeys(("kilogram", "kilograms", "kilos"), "kg"),
    **dict.fromkeys(("newton", "newtons"), "N"),
    "Nm": "N m",
}
# Units that are printed and not read: W and J are usual names of other things.
_PRINTED: dict[str, Dimension] = {"W": (2, 1, -3, 0, 0), "J": (2, 1, -2, 0, 0)}
# The SI units that have a name of their own, or are usual.
COHERENT: dict[Dimension, str] = {
    PLAIN: "",
    FORCE: "N",
    TORQUE: "N m",
    INERTIA: "kg m^2",
    (2, 1, -3, 0, 0): "W",
    (2, 1, -3, -1, 0): "V",
    (2, 1, -3, -2, 0): "ohm",
    (2, 1, -2, -2, 0): "H",
    (2, 1, -2, -1, 0): "V s",
}
ANGLE_UNITS = frozenset({"deg", "rad"})
# Units that are also the usual names of quantities: mass m, gravity g, Laplace s, current A.
LETTERS = frozenset(name for name in UNITS if len(name) == 1)


def compound(parts: Iterable[tuple[str, int]]) -> Unit:
    """The unit made of named units raised to powers, as `[("m", 1), ("s", -2)]`. Raises KeyError."""
    named, dimension, size, degrees = list(parts), PLAIN, Fraction(1), 0
    for name, exponent in named:
        unit = UNITS[name]
        dimension = times(dimension, power(unit.dimension, exponent))
        size *= unit.size**exponent
        degrees += unit.degrees * exponent
    left = [(name, exponent) for name, exponent in named if name != "deg"]
    coherent = all(UNITS[name].size == 1 for name, _ in left) and degrees in (0, 1)
    return Unit(dimension, size, degrees, _written(left, bool(degrees)) if coherent else unit_of(dimension))


def unit_of(dimension: Dimension) -> str:
    """The SI unit of a quantity, "N m"; "" of a plain number. A radian is named where it is all there is but
    seconds: an arc is in metres."""
    if dimension in COHERENT:
        return COHERENT[dimension]
    m, kg, s, a, rad = dimension
    turns = rad == 1 and not (m or kg or a)
    return COHERENT.get((m, kg, s, a, 0)) or _unit_text((m, kg, s, a, int(turns)))


@cache
def dimension_of(unit: str) -> Dimension:
    """The dimension of a unit as `unit_of` writes it. Raises KeyError for one that is not known."""
    if unit in _PRINTED:
        return _PRINTED[unit]
    above, *below = unit.split("/")
    parts = [*_parts(above, 1), *(part for each in below for part in _parts(each, -1))]
    return compound(parts).dimension


def coherent(unit: str) -> bool:
    """Whether a quantity in this unit has the same number in SI."""
    if unit in _PRINTED:
        return True
    above, *below = unit.split("/")
    try:
        parts = [*_parts(above, 1), *(part for each in below for part in _parts(each, -1))]
        return all(UNITS[name].size == 1 and not UNITS[name].degrees for name, _ in parts)
    except (KeyError, ValueError):
        return False


def _parts(text: str, sign: int) -> Iterator[tuple[str, int]]:
    for each in text.split():
        name, _, exponent = each.partition("^")
        if name != "1":
            yield name, sign * int(exponent or 1)


def times(left: Dimension, right: Dimension) -> Dimension:
    """The dimension of a product."""
    m, kg, s, a, rad = (x + y for x, y in zip(left, right, strict=True))
    return m, kg, s, a, rad


def power(dimension: Dimension, exponent: int) -> Dimension:
    """The dimension of a power."""
    m, kg, s, a, rad = (x * exponent for x in dimension)
    return m, kg, s, a, rad


def agree(left: Dimension, right: Dimension) -> bool:
    """Whether quantities of these dimensions may be added or stand for each other.

    A plain number stands for anything (a length of 2 is 2 m), and radians do not count.
    """
    return PLAIN in (left, right) or left[:4] == right[:4]


def spoken(dimension: Dimension) -> str:
    """What an author calls it: "a length (m)"; for an unusual one its unit, "m^3/s"."""
    return SPOKEN.get(dimension) or f"a quantity in {_unit_text(dimension)}"


def _unit_text(dimension: Dimension) -> str:
    return _written(list(zip(BASE_UNITS, dimension, strict=True)))


def _written(parts: Sequence[tuple[str, int]], bare: bool = False) -> str:
    """`kg m^2/s`; what is only under a line begins with 1, unless it is `bare`, as behind an angle."""
    above = " ".join(_raised(unit, n) for unit, n in parts if n > 0)
    below = "".join("/" + _raised(unit, -n) for unit, n in parts if n < 0)
    return (above or "1" if below and not bare else above) + below


def _raised(unit: str, exponent: int) -> str:
    return unit if exponent == 1 else f"{unit}^{exponent}"
