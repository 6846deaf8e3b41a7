"""Define before use, of results: each name in one is on the sheet, or the answer says what it is.

An answer says what a name is where it stands alone: at the head of a chain, at the end of a law (tau_k of any
joint), as a definition, an unknown, an entry, with its unit, or as something that its words are told of. A
slip that leaves a name behind whose line was never derived, t_2 of a course that has no such time, is found
here.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any, get_args

from pydantic import BaseModel

from derive.derivation import Branch, Derivation, LinearSystem, Result
from derive.expression import Expr, Matrix, Relation, Symbol, every, free_symbols, held
from derive.kinds.problem import Problem, expressions
from derive.kinds.registry import load

TREES = get_args(Expr)
RATE = re.compile(r"(_d*dot)+$")
OF_A_JOINT, OF_EACH = re.compile(r"_\d+$"), "_k"  # an index, and that of a law
OF_ALL = {"pi", "t", "g"} | {kind + axis for kind in ("v", "w", "a", "omega_") for axis in "xyz"}
INTRODUCED = "INTRODUCED"  # a pattern in the module of a kind: names that stand for nothing else on its page


def strangers(answer: Derivation, options: Any, problem: Problem) -> frozenset[str]:
    """Names in results that are nowhere said to be anything."""
    used = frozenset[str]().union(*map(_used, answer.results.values()))
    used = frozenset(name.rstrip("*") for name in used) - OF_ALL - problem.taken
    known = {RATE.sub("", name) for name in _known(answer, options, problem)}
    pattern = getattr(load(problem.name, answer.kind), INTRODUCED, "")
    alone = {name: RATE.sub("", name) for name in used if not re.fullmatch(pattern, name)}
    return frozenset(
        name for name, still in alone.items() if not {still, OF_A_JOINT.sub(OF_EACH, still)} & known
    )


def _used(result: Result) -> frozenset[str]:
    trees = (result.left, result.right) if isinstance(result, LinearSystem) else expressions(result)
    return frozenset[str]().union(*map(free_symbols, trees))


def _known(answer: Derivation, options: Any, problem: Problem) -> Iterator[str]:
    yield from (*problem.moving, *answer.results)
    for part in every(answer.results):
        yield from (*part.values, *part.short) if isinstance(part, Branch) else ()
    yield from _typed(options)
    yield from _said(answer)


def _typed(value: Any) -> Iterator[str]:
    """Names of an option."""
    match value:
        case BaseModel():
            for _, each in value:
                yield from _typed(each)
        case tuple() | list():
            for each in value:
                yield from _typed(each)
        case Mapping():
            for key, each in value.items():
                yield from _typed((key, each))
        case _ if isinstance(value, TREES):
            yield from free_symbols(value)


def _said(answer: Derivation) -> Iterator[str]:
    """By the answer, and by those on which it rests."""
    alone = [answer.definitions, answer.units, answer.facts]
    for step in answer.all_steps():
        alone += [step.chain[:1], step.entries, step.facts]
        alone += step.chain[-1:] if step.rule == "law" else ()
    for result in answer.results.values():
        if isinstance(result, LinearSystem):
            alone += [result.unknowns, result.names]
    yield from _alone(tuple(alone))
    for used in answer.uses:
        yield from _said(used)


def _alone(value: Any) -> Iterator[str]:
    """Names that stand alone, not in a formula."""
    match value:
        case Symbol(name):
            yield name.rstrip("*")
        case Matrix(rows):
            yield from _alone(rows)
        case Relation():
            yield from _alone(value.left if value.sign == "=" else ())
        case _:
            for each in held(value):
                yield from _alone(each)
