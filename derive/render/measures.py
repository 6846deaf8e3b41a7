"""A value is said as it was found, and in what its name measures: rounded, a decimal or with a common factor
it is the same number; a speed is in metres per second, a rate said in degrees in degrees per second. Held
of every chain that is shown, entry by entry of a matrix."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from math import isclose, pi, prod

from derive.algebra.formulas.dimensions import comparable
from derive.algebra.formulas.units import UNITS, Unit, dimension_of
from derive.algebra.numbers.floats import number, somewhere
from derive.derivation import Phrase
from derive.errors import NotAsWritten, NotDerivable
from derive.expression import (
    ZERO,
    Call,
    Degrees,
    Expr,
    Matrix,
    Measured,
    Product,
    Symbol,
    free_symbols,
    replace,
    walk,
)

ALIKE, NEARLY = 1e-6, 1e-9  # of what is exact; what is rounded has all its digits still
BASE = (1.7, 2.3, 0.6, 3.1, 1.0)  # sizes of our own: of a metre, a kilogram, a second, an ampere, a radian

Chain = Sequence[Expr]


def hold_as_said(found: Chain, said: Chain, units: Mapping[Expr | Phrase, str]) -> None:
    """Raises NotAsWritten where what a chain ends in is said as another number, or its value in what the name
    at its head does not measure."""
    hold_number(found[-1], said[-1])
    for each in said[1:-1]:
        if each not in found and not any(_alike(one, each) for one in found[1:]):
            raise NotAsWritten(f"{each!r} is none of what {said[0]!r} is equal to")
    if len(said) > 1 and not _measures(said[0], said[-1], units):
        raise NotAsWritten(f"{said[0]!r} is not measured in what its value is said in")
    if said[0] not in units and _has_degrees(said[-1]) and not any(map(_has_degrees, found)):
        raise NotAsWritten(f"{said[0]!r} is no angle, and its value is said in degrees")
    if any(map(_is_twice, said)):
        raise NotAsWritten(f"{said[0]!r} has a unit behind names that have theirs")
    if not _are_alike([*filter(None, map(_sized, said))]):
        raise NotAsWritten(f"what {said[0]!r} is equal to is not measured alike")


# -- the number ---------------------------------------------------------------------------------------


def hold_number(found: Expr, said: Expr) -> None:
    """Raises NotAsWritten where a value is said as another number."""
    if not _alike(found, said):
        raise NotAsWritten(f"{found!r} is said as another value")


def _alike(found: Expr, said: Expr) -> bool:
    """The same numbers, letters having any."""
    if found is said or found == said:
        return True
    ours, theirs = [*_entries(found)], [*_entries(said)]
    return len(ours) == len(theirs) and all(map(_is_near, ours, theirs))


def _is_near(one: Expr, other: Expr) -> bool:
    at = {name: somewhere(name) for name in free_symbols(one) | free_symbols(other)}
    try:
        return isclose(number(one, at), number(other, at), rel_tol=NEARLY, abs_tol=NEARLY)
    except (NotDerivable, ArithmeticError, ValueError):
        return True  # no number: what it is, is said where it is made


def _entries(tree: Expr) -> Iterator[Expr]:
    """Those of a matrix, with the factor before it; any other tree alone."""
    match tree:
        case Measured(value):
            yield from _entries(value)
        case Matrix(rows):
            yield from (entry for row in rows for entry in row)
        case Product((*factors, Matrix() as matrix)):
            yield from (Product((*factors, entry)) for entry in _entries(matrix))
        case _:
            yield tree


# -- what it measures ---------------------------------------------------------------------------------


def _measures(name: Expr, said: Expr, units: Mapping[Expr | Phrase, str]) -> bool:
    if isinstance(name, Matrix) and name not in units:
        whole, unit = (said.value, said.unit) if isinstance(said, Measured) else (said, "")
        return not isinstance(whole, Matrix) or all(
            _measures(part, Measured(entry, unit) if unit else entry, units)
            for part, entry in zip(_entries(name), _entries(whole), strict=True)
        )
    wanted, value = units.get(name), said.value if isinstance(said, Measured) else said
    if not wanted or free_symbols(value) or all(entry == ZERO for entry in _entries(value)):
        return True
    return comparable(dimension_of(wanted), dimension_of(_unit(said)))


def _has_degrees(tree: Expr) -> bool:
    return any(isinstance(node, Degrees) for node in walk(tree))


def _is_twice(tree: Expr) -> bool:
    """Whether a unit stands behind names, which measure something by themselves."""
    return any(isinstance(node, Measured) and free_symbols(node.value) for node in walk(tree))


def _are_alike(sizes: Sequence[float]) -> bool:
    return all(isclose(each, sizes[0], rel_tol=ALIKE) for each in sizes)


def _sized(tree: Expr) -> float | None:
    """A formula of quantities where the units that are printed in it have sizes of our own: an equation holds
    whatever they are. None where no unit stands in it, or names are left."""
    quantities: dict[Expr, Expr] = {
        node: Product((node.value, Symbol(node.unit))) for node in walk(tree) if isinstance(node, Measured)
    }
    turned = {type(node) for node in walk(tree)} & {Degrees, Call} == {Degrees}  # no cos 120 deg
    if not (quantities or turned) or free_symbols(tree):
        return None
    sizes = {node.unit: _size(node.unit) for node in walk(tree) if isinstance(node, Measured)}
    try:
        return number(replace(tree, quantities), sizes) or None
    except (NotDerivable, ArithmeticError, ValueError):  # a matrix
        return None


def _size(unit: str) -> float:
    """That of a unit as it is printed, "kg m^2/s"."""
    above, *below = unit.split("/")
    return _factors(above) / prod(map(_factors, below))


def _factors(units: str) -> float:
    parts = (part.partition("^") for part in units.split() if part != "1")
    return prod(_named(name) ** int(exponent or 1) for name, _, exponent in parts)


def _named(unit: str) -> float:
    known = UNITS.get(unit) or Unit(dimension_of(unit))
    turned = (pi / 180) ** known.degrees
    return float(known.size) * turned * prod(map(pow, BASE, known.dimension))


def _unit(said: Expr) -> str:
    """That which stands behind a value, with its degrees."""
    behind = said.unit if isinstance(said, Measured) else ""
    return ("deg" if any(isinstance(node, Degrees) for node in walk(said)) else "") + behind
