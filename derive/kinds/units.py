"""What the names of an answer measure: as its kind says it, and by the dimensions of its formulas.

A line is held to it: the formula of a velocity has the dimension of a velocity, or the answer is refused.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import ModuleType
from typing import Any

from derive.algebra.formulas.dimensions import Unlike, comparable, dimension_of_formula
from derive.algebra.formulas.units import Dimension, dimension_of, unit_of
from derive.derivation import Claim, Derivation, Phrase, Step
from derive.errors import NotDerivable
from derive.expression import Approximate, Degrees, Expr, Matrix, Number, Symbol, free_symbols, walk
from derive.kinds.checks import law

LARGEST_COUNT = 100  # of numbers that belong to a law, and are no data that were put in


@dataclass(frozen=True, slots=True)
class Units:
    """Those of the names on the page; those that results mean where units were typed; and what was held."""

    names: Mapping[Expr | Phrase, str] = field(default_factory=dict)
    meant: Mapping[str, str] = field(default_factory=dict)
    claims: tuple[Claim, ...] = ()


UNKNOWN = Units()


def units_of(derivation: Derivation, module: ModuleType, subject: Any, typed: bool) -> Units:
    """The units of an answer, as far as its lines tell them, and the claim that every line agrees with them.
    A kind may say what its results mean, `measures(subject)`; where units were `typed` among the data, its
    lines have them too."""
    measures = getattr(module, "measures", None)
    meant = measures(subject) if measures else {}
    known = {name: unit for used in derivation.uses for name, unit in used.units.items()}
    known |= {Symbol(name): unit for name, unit in meant.items() if typed and unit} | {**derivation.units}
    if not known:
        return Units({}, meant)
    found = _Lines({_text(name): dimension_of(unit) for name, unit in known.items()}, _names(derivation))
    for step in derivation.all_steps():
        found.line(step)
    turned = any(unit.startswith("deg") for unit in known.values())
    learned: dict[Expr | Phrase, str] = {
        Symbol(name): in_degrees(unit_of(dimension), turned) for name, dimension in found.dimensions.items()
    }
    return Units(learned | known, meant, (law("units", found.held),) if found.held else ())


@dataclass(slots=True)
class _Lines:
    """Dimensions of names, of which those in `own` may be learned; `held` has a truth for each line."""

    dimensions: dict[str, Dimension]
    own: frozenset[str]
    held: list[bool] = field(default_factory=list)

    def line(self, step: Step) -> None:
        """Learns what the name of a line measures, or compares; a law is about other names."""
        if len(step.chain) < 2 or step.rule == "law" or not isinstance(step.chain[0], Symbol):
            return
        head = step.chain[0].name
        for formula in filter(self._is_formula, step.chain[1:]):
            try:
                dimension = dimension_of_formula(formula, self.dimensions)
            except Unlike:
                self.held.append(False)
                continue
            except NotDerivable:
                continue
            if head in self.dimensions:
                self.held.append(comparable(self.dimensions[head], dimension))
            elif head in self.own:
                self.dimensions[head] = dimension

    def _is_formula(self, tree: Expr) -> bool:
        """Whether it is written in names of the page alone, with no data put in."""
        names = free_symbols(tree)
        if isinstance(tree, Matrix) or not names & self.own or not names <= self.dimensions.keys():
            return False
        return not any(map(_is_data, walk(tree)))


def in_degrees(unit: str, turned: bool = True) -> str:
    """The unit in which an angle, or its rate, is said where the author typed degrees."""
    return "deg" + unit.removeprefix("rad") if turned and unit.startswith("rad") else unit


def _is_data(node: Expr) -> bool:
    match node:
        case Degrees() | Approximate():
            return True
        case Number(value, decimal):
            return decimal or abs(value) > LARGEST_COUNT
    return False


def _names(derivation: Derivation) -> frozenset[str]:
    """Those that the page defines."""
    return frozenset(name.name for name in derivation.definitions if isinstance(name, Symbol))


def _text(name: Expr | Phrase) -> str:
    return name.name if isinstance(name, Symbol) else repr(name)
