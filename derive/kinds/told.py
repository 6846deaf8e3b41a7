"""Each result is told by the page: it is the value of one of its lines, or claims of the kind speak for it.

A kind whose claims are about results that no line tells says which of them speaks for each, as in
`CLAIMED = {"solutions": "as-printed"}` ("a|b" where it makes the one or the other). Where that claim is not
made the result is compared with the lines as all others are, so that nothing is read off them wrongly.
"""

from __future__ import annotations

import math
from collections import ChainMap
from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import chain
from types import ModuleType
from typing import Any, get_args

from derive.algebra.normal import Names
from derive.algebra.numbers.floats import Point, completed, number, numbers
from derive.derivation import Branch, Claim, Derivation, PageFacts, Step
from derive.errors import NotDerivable
from derive.expression import Expr, Matrix, Symbol, free_symbols
from derive.kinds.checks import FLOATS, close, random_points
from derive.kinds.units import UNKNOWN, Units
from derive.kinds.values_at import NOT_REAL

TREES = get_args(Expr)
POINTS = 4


def with_results_told(
    derivation: Derivation, module: ModuleType, where: Names, units: Units = UNKNOWN,
    facts: PageFacts | None = None,
) -> Derivation:  # fmt: skip
    """The same derivation with its units and facts, claiming that its results are told, with a claim that
    fails for each that is not; those that no line could be compared with are kept."""
    page, claimed = Page(derivation, where), frozenset(_claimed(derivation, getattr(module, "CLAIMED", {})))
    on_page = derivation.facts.page_names  # the pose T_1^0 with a tool is T_e^0 there
    found = [
        (name, page.tells(str(on_page.get(name, name)), tree))
        for name, result in derivation.results.items()
        if name not in claimed
        for tree in _trees(result)
    ]
    untold = dict.fromkeys(name for name, told in found if told is False)
    claims = [Claim("untold", FLOATS, False, {"name": name}, link=True) for name in untold]
    if tried := sum(told is True for _, told in found):
        claims.append(Claim("told", FLOATS, not untold, link=True, tried=tried))
    alone = tuple(dict.fromkeys(name for name, told in found if told is None))
    claims = [*derivation.claims, *units.claims, *claims]
    return replace(
        derivation, claims=tuple(claims), alone=alone, units=units.names, meant=units.meant,
        facts=facts or derivation.facts,
    )  # fmt: skip


def _claimed(derivation: Derivation, claimed: Mapping[str, str]) -> Iterator[str]:
    """The results that a claim speaks for which was made, and tried."""
    made = {claim.key for claim in derivation.claims if not claim.link and claim.tried}
    return (name for name, keys in claimed.items() if not made.isdisjoint(keys.split("|")))


def _trees(result: Any) -> Iterator[Expr]:
    """The formulas in a result."""
    match result:
        case Branch():
            yield from result.values.values()
        case tuple():
            for part in result:
                yield from _trees(part)
        case _ if isinstance(result, TREES):
            yield result


@dataclass(frozen=True)
class Page:
    """The lines of a derivation and of all that it rests on."""

    derivation: Derivation
    where: Names

    def tells(self, name: str, tree: Expr) -> bool | None:
        """Whether the line of this name has the value; where none bears it any line, or its entries. None
        where that has no numbers by which they could be compared."""
        named = self.named.get(name)
        if named is not None:
            return tree == named or self._among(tree, [named])
        entries = chain(*tree.rows) if isinstance(tree, Matrix) else (tree,)
        if tree in self.values or all(entry in self.entries for entry in entries):
            return True
        return self._among(tree, self.values)

    def _among(self, tree: Expr, values: Iterable[Expr]) -> bool | None:
        """Whether it is one of the values, in numbers at a point where it is real."""
        for at in self.points:
            ours = at.numbers(tree)
            if ours is not None:
                others = [at.numbers(value) for value in values]
                found = [close(ours, other) for other in others if other is not None]
                return True if any(found) else False if found else None
        return None

    @cached_property
    def named(self) -> dict[str, Expr]:
        """The values of lines by their names; what the answer defines before what it rests on."""
        defined = {name.name: value for name, value in self.definitions.items() if isinstance(name, Symbol)}
        lines = (step.chain for step in self.steps if step.chain)
        return {**{line[0].name: line[-1] for line in lines if isinstance(line[0], Symbol)}, **defined}

    @cached_property
    def values(self) -> frozenset[Expr]:
        """All that stands in a line, or is what a name stands for."""
        return frozenset(chain(*(step.chain for step in self.steps), self.definitions.values()))

    @cached_property
    def entries(self) -> frozenset[Expr]:
        """These, and the entries of those that are matrices."""
        rows = (row for value in self.values if isinstance(value, Matrix) for row in value.rows)
        return self.values.union(*rows)

    @cached_property
    def definitions(self) -> Names:
        """What names stand for."""
        return ChainMap(*(dict(each.definitions) for each in _all(self.derivation)))

    @cached_property
    def steps(self) -> list[Step]:
        """Every line but laws."""
        return [step for each in _all(self.derivation) for step in each.all_steps() if step.rule != "law"]

    @cached_property
    def points(self) -> list[There]:
        """A few places where the lines are looked at."""
        where = {name.name: value for name, value in self.where.items() if isinstance(name, Symbol)}
        results = chain(*map(_trees, self.derivation.results.values()))
        letters = (
            frozenset().union(*map(free_symbols, (*self.values, *where.values(), *results))) - where.keys()
        )
        letters -= {name.name for name in self.definitions if isinstance(name, Symbol)}
        found = []
        for at in random_points(letters, POINTS):
            with suppress(NotDerivable, *NOT_REAL):
                found.append(There(completed(at, where), self.definitions))
        return found


class There(dict[str, float]):
    """A point, where names have the values of what they stand for as soon as these are asked for."""

    def __init__(self, at: Point, definitions: Names) -> None:
        super().__init__(at)
        self.definitions = definitions
        self.found: dict[Expr, Any] = {}

    def __missing__(self, name: str) -> float:
        self[name] = math.nan  # where a name rests on itself
        self[name] = number(self.definitions[Symbol(name)], self)
        return self[name]

    def numbers(self, tree: Expr) -> Any:
        """A tree in numbers; None where it has none here."""
        if tree not in self.found:
            self.found[tree] = None
            with suppress(NotDerivable, KeyError, *NOT_REAL):
                self.found[tree] = numbers(tree, self)
        return self.found[tree]


def _all(derivation: Derivation) -> Iterator[Derivation]:
    yield derivation
    for used in derivation.uses:
        yield from _all(used)
