"""What is said of names: the values of `where`, and what `symbols` takes for granted."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from pydantic import BaseModel

from derive.derivation import Phrase
from derive.expression import free_symbols
from derive.given.datum import Datum, names, valued
from derive.kinds.problem import Problem, expressions

SAID = {
    "positive": "positive",
    "nonnegative": "positive|negative",
    "nonzero": "zero|vanish",
    "integer": "whole|integer",
}


def data(problem: Problem) -> Iterator[Datum]:
    """Of the names that the subject and the questions hold, and those that their values hold."""
    used = _used(problem)
    if values := tuple(valued(name, value) for name, value in problem.where.items() if name in used):
        yield Datum(Phrase("where", {"values": values}))
    free = used - problem.where.keys()
    for assumed, words in SAID.items():
        of = [name for name, said in problem.assumptions.items() if said == assumed and name in free]
        if of:
            yield Datum(Phrase(assumed, {"names": names(of)}), words=(words,))


def _used(problem: Problem) -> set[str]:
    options = tuple(value for _, asked in problem.questions for value in _values(asked))
    trees = [*expressions(problem.subject), *expressions(options)]
    found = {name for tree in trees for name in free_symbols(tree)}
    found |= {*getattr(problem.subject, "variables", ()), *getattr(problem.subject, "coordinates", ())}
    ahead = [*found]
    while ahead:
        inside = free_symbols(problem.where[name]) - found if (name := ahead.pop()) in problem.where else ()
        found |= {*inside}
        ahead += inside
    return found


def _values(value: Any) -> Iterator[Any]:
    """What stands in options, and in those that have options of their own."""
    if not isinstance(value, BaseModel):
        yield value
        return
    for key in type(value).model_fields:
        yield from _values(getattr(value, key))
