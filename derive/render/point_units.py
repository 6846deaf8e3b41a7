"""In which unit numbers at a point are said: by what a result means, or by the dimension of its formula."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, get_args

from derive.algebra.formulas.dimensions import comparable, dimension_of_formula
from derive.algebra.formulas.units import PLAIN, Dimension, dimension_of, unit_of
from derive.derivation import Derivation
from derive.errors import NotDerivable
from derive.expression import ZERO, Degrees, Expr, Matrix, Number, Symbol, free_symbols, walk

TREES = get_args(Expr)


@dataclass(frozen=True, slots=True)
class PointUnits:
    """`meant` has the units of results by their names, `names` those of names that results are written in.
    Where no unit was `typed` but of angles, angles alone have one. Angles are said in degrees where they were
    `turned`, their rates where `rates` were typed so."""

    results: Mapping[str, Any]
    meant: Mapping[str, str]
    names: Mapping[str, Dimension | None]
    typed: bool
    turned: bool
    rates: bool
    inlined: bool  # whether data typed with units stand in the formulas as numbers

    def of(self, name: str) -> str:
        """The unit of a result, "" where none is known; "deg/s" for one said in degrees."""
        unit = self.meant.get(name)
        unit = self._by_formula(self.results.get(name)) if unit is None else unit
        if not unit or not (self.typed or unit in ("rad", "deg")):
            return ""
        degrees = self.turned if unit in ("rad", "deg") else self.rates
        return "deg" + unit[3:] if degrees and unit.startswith(("rad", "deg")) else unit

    def agrees(self, name: str, unit: str) -> bool:
        """Whether a unit is that of the formula of a result, as far as this tells."""
        found = self._dimension(self.results.get(name)) if unit else None
        return found is None or comparable(found, dimension_of(unit))

    def are_mixed(self, name: str) -> bool:
        """Whether the entries of a result measure different things, so that no one unit stands behind it."""
        if not self.typed or self.inlined:
            return False
        return self.meant.get(name) == "" or len(self._dimensions(self.results.get(name))) > 1

    def _by_formula(self, result: Any) -> str:
        found = self._dimension(result)
        return unit_of(found) if found else ""

    def _dimension(self, result: Any) -> Dimension | None:
        """That of a formula, or of all entries of a vector; None where it is not known."""
        found = self._dimensions(result)
        return found.pop() if len(found) == 1 else None

    def _dimensions(self, result: Any) -> set[Dimension]:
        """Those of a formula, or of all entries of a vector; a number among these has none, where that is not
        an angle or zero. None at all where they are not known."""
        if not isinstance(result, TREES) or self.inlined:
            return set()
        entries = [entry for row in result.rows for entry in row] if isinstance(result, Matrix) else [result]
        try:
            found = {dimension_of_formula(entry, self.names) for entry in entries if free_symbols(entry)}
        except NotDerivable:
            return set()
        numbers = any(entry != ZERO and not free_symbols(entry) for entry in entries)
        return found | {PLAIN} if numbers and not any(comparable(each, PLAIN) for each in found) else found


def point_units(derivation: Derivation, at: Mapping[str, Expr], turned: bool) -> PointUnits:
    """Those of an answer at a point; `turned` says whether angles are said in degrees."""
    style = derivation.facts.style
    on_page = {name.name: unit for name, unit in derivation.units.items() if isinstance(name, Symbol)}
    letters = {name: unit for name, unit in derivation.meant.items() if name not in derivation.results}
    known = {**letters, **on_page, **dict(_typed(at))}
    nodes = [node for value in at.values() for node in walk(value)]
    return PointUnits(
        derivation.results,
        {**letters, **_of_results(derivation, on_page), **derivation.meant},
        {**dict.fromkeys(name for name, value in at.items() if value == ZERO)}
        | {name: dimension_of(unit) for name, unit in known.items()},
        typed=style.units or bool(on_page) or any(isinstance(node, Number) and node.unit for node in nodes),
        turned=turned,
        rates=any(isinstance(node, Degrees) and node.unit for node in nodes)
        or any(unit.startswith("deg/") for unit in on_page.values()),
        inlined=style.units or _holds_data(derivation),
    )


def _holds_data(derivation: Derivation) -> bool:
    """Whether a line has a quantity that its author typed into a question, as a force of 10 N."""
    trees = (tree for step in derivation.steps for tree in step.chain)
    return any(isinstance(node, Number) and node.unit for tree in trees for node in walk(tree))


def _of_results(derivation: Derivation, on_page: Mapping[str, str]) -> dict[str, str]:
    """The units of results by what they are called on the page."""
    called = derivation.facts.page_names
    names = {name: str(called.get(name, name)) for name in (*derivation.results, *derivation.evaluated)}
    return {name: on_page[written] for name, written in names.items() if written in on_page}


def _typed(at: Mapping[str, Expr]) -> Iterator[tuple[str, str]]:
    """The names with a value that has a unit, and this."""
    for name, value in at.items():
        if isinstance(value, Degrees):
            yield name, "rad" + value.unit
        elif isinstance(value, Number) and value.unit:
            yield name, value.unit


def unit_typed(value: Expr) -> str:
    """What stands behind a value as its author typed it."""
    return value.unit if isinstance(value, Number | Degrees) else ""
