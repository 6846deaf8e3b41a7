"""What is found at the values asked for, held to the equations at these values."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from derive.control.oracle import poles
from derive.control.system import System
from derive.derivation import Claim
from derive.expression import Expr, Symbol
from derive.kinds.checks import route
from derive.kinds.system._oracle import Held, as_printed, number_claims, same_roots
from derive.kinds.system._plant import AtPoint

AT_POINT = ("in-numbers", "shown-in-numbers", "values-as-given")


def is_named(head: Expr, name: str, system: System, source: str = "") -> bool:
    """Whether this is what a result of the name is called where the equations may have that name too; that
    of a disturbance has its name, or the index of that, behind it."""
    free = isinstance(head, Symbol) and head.name not in system.names
    of = source if source != system.input.name else ""
    indices = (of.rpartition("_")[2], of) if of else ("", system.output.name)
    return free and head in [Symbol(f"{name}_{index}".rstrip("_")) for index in indices]


def point_claims(
    held: Held,
    evaluated: Mapping[str, Any],
    name: str,
    told: AtPoint | None,
    whole: Sequence[float] | None = None,
) -> Iterator[Claim]:
    """Transfer functions of the JSON, and what the page shows of the one called `name`: the function, its
    poles and zeros, and where they lie."""
    if told is None:
        return
    functions = {
        each: found for each, found in evaluated.items() if isinstance(found, Mapping) and "den" in found
    }
    yield from number_claims(held, functions)
    yield as_printed("shown-in-numbers", held, told.shown[0][-1])
    yield route("values-as-given", _given(held, told, name))
    if "poles" in functions[name]:
        yield route("roots-as-printed", _roots(evaluated, functions[name], told))
        if told.verdict is None:
            yield route("verdict", (not told.poles,))
        else:
            yield verdict_claim(whole or functions[name]["den"], told.verdict.key)


def _given(held: Held, told: AtPoint, name: str) -> Iterator[bool]:
    """The values in the sentence are those of the sheet, and the function is called by its name."""
    yield all(
        len(chain) == 2 and is_named(chain[0], name, held.system, held.source.name) for chain in told.shown
    )
    known = {**held.problem.where, **(held.given or {})}
    yield {chain[0]: chain[-1] for chain in told.point} == {
        Symbol(name): tree for name, tree in known.items()
    }


def _roots(evaluated: Mapping[str, Any], function: Mapping[str, Any], told: AtPoint) -> Iterator[bool]:
    """The page shows the roots of the JSON, which has them twice."""
    yield same_roots(told.poles, function["poles"])
    yield same_roots(told.zeros, function["zeros"])
    yield all(evaluated[each] == function[each] for each in ("poles", "zeros"))


def verdict_claim(polynomial: Sequence[float], told: str) -> Claim:
    """Where the roots of a polynomial in numbers, highest power first, are said to lie."""
    return route("verdict", (told in poles.possible(polynomial),))
