"""A value is said as it was found, and in what its name measures: rounded, a decimal or with a common factor
it is the same number; a speed is in metres per second, a rate said in degrees in degrees per second. Held
of every chain that is shown, entry by entry of a matrix."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from math import isclose

from derive.algebra.formulas.dimensions import Unlike, comparable, dimension_of_formula
from derive.algebra.formulas.units import Dimension, dimension_of
from derive.algebra.numbers.floats import number
from derive.derivation import Phrase
from derive.errors import NotAsWritten, NotDerivable
from derive.expression import (
    ZERO,
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

NEARLY = 1e-9  # of what is exact; what is rounded has all its digits still

Chain = Sequence[Expr]


def hold_as_said(found: Chain, said: Chain, units: Mapping[Expr | Phrase, str]) -> None:
    """Raises NotAsWritten where what a chain ends in is said as another number, or its value in what the name
    at its head does not measure."""
    hold_number(found[-1], said[-1])
    if len(said) > 1 and not _measures(said[0], said[-1], units):
        raise NotAsWritten(f"{said[0]!r} is not measured in what its value is said in")
    if not _are_alike([*filter(None, map(_dimension, said))]):
        raise NotAsWritten(f"what {said[0]!r} is equal to is not measured alike")


# -- the number ---------------------------------------------------------------------------------------


def hold_number(found: Expr, said: Expr) -> None:
    """Raises NotAsWritten where a value is said as another number."""
    if not _alike(found, said):
        raise NotAsWritten(f"{found!r} is said as another value")


def _alike(found: Expr, said: Expr) -> bool:
    """Numbers are the same; of what is in symbols the reading of the page says so."""
    if found is said or found == said:
        return True
    pairs = [*zip(_entries(found), _entries(said), strict=True)]
    return all(_is_near(one, other) for one, other in pairs if not free_symbols(one))


def _is_near(one: Expr, other: Expr) -> bool:
    try:
        return isclose(number(one, {}), number(other, {}), rel_tol=NEARLY, abs_tol=NEARLY)
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


def _are_alike(dimensions: Sequence[Dimension]) -> bool:
    return all(comparable(each, dimensions[0]) for each in dimensions)


def _dimension(tree: Expr) -> Dimension | None:
    """Of a formula of quantities, by the units that are printed in it. None where none are, or names are
    left. Raises NotAsWritten where unlike ones are added."""
    quantities: dict[Expr, Symbol] = {
        node: Symbol(_unit(node)) for node in walk(tree) if isinstance(node, Measured)
    }
    if not quantities or free_symbols(tree) or any(isinstance(node, Matrix) for node in walk(tree)):
        return None
    known = {unit.name: dimension_of(unit.name) for unit in quantities.values()}
    try:
        return dimension_of_formula(replace(tree, {**quantities}), known)
    except Unlike as error:
        raise NotAsWritten(str(error)) from error
    except NotDerivable:
        return None


def _unit(said: Expr) -> str:
    """That which stands behind a value, with its degrees."""
    behind = said.unit if isinstance(said, Measured) else ""
    return ("deg" if any(isinstance(node, Degrees) for node in walk(said)) else "") + behind
