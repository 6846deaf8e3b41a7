"""Links: each chain of a derivation is equal from end to end, laws in the instance in which they are tried.
The normal form decides; floats, which know nothing of it, must not contradict it.

What says nothing is no claim: a name beside its own definition, or a chain of one.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace as fields_replaced
from itertools import pairwise
from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import Names, Walk, walk_over
from derive.algebra.numbers.floats import Point, completed, numbers
from derive.algebra.values import Value
from derive.derivation import Claim, Step
from derive.errors import NotDerivable
from derive.expression import Approximate, Expr, Indexed, Matrix, Symbol, free_symbols, replace, walk
from derive.kinds.checks import FLOATS, NORMAL_FORM, agreement
from derive.kinds.somewhere import Somewhere, contradicted, near, values_of

EQUATIONS = ("given", "elimination")  # rules of steps with the same name on both sides, maybe
UNLINKED = ("law", "in-numbers", "unsolved")  # rules of steps that names of the board say nothing about


def links(steps: Iterable[Step], names: Names, letters: frozenset[str] = frozenset()) -> tuple[Claim, ...]:
    """One claim for each chain, inner steps included, and one more for each number that is rounded. The
    `letters` are the symbols of the sheet that stand for nothing.

    A step by rule "law" states what holds in general: it is compared in the case that is its instance. One by
    rule "in-numbers" or "unsolved", such as an equation of motion, holds of what its names mean and not of
    what the board has under them: its kind compares it by `meanings.told`. What it comes to in names of the
    sheet and the board is compared here.
    """
    inner = [each for step in steps for each in step.all()]
    chains = [(step.name, _with_content(step, names)) for step in inner if step.rule not in UNLINKED]
    exact = [(name, [expr for expr in chain if not _rounded(expr)]) for name, chain in chains]
    walk_of = walk_over([expr for _, chain in exact for expr in chain], names)
    at = Somewhere(names)
    found = [_link(name, chain, walk_of, at) for name, chain in exact if len(chain) > 1]
    found += [_circular(step) for step in inner if _defines_itself(step)]
    found += [claim for name, chain in chains for claim in _in_floats(name, chain, walk_of)]
    known = letters | {name.name for name in names if isinstance(name, Symbol)}
    found += [claim for step in inner if step.rule in UNLINKED[1:] for claim in _in_letters(step, known, at)]
    return (*found, *(in_its_instance(step, names) for step in inner if step.rule == "law" and step.instance))


def _with_content(step: Step, names: Names) -> tuple[Expr, ...]:
    """The chain without a name at its head that it defines, or whose definition stands in it."""
    head, *rest = step.chain or (None,)
    if isinstance(head, Symbol | Indexed) and (head not in names or names[head] in rest):
        return tuple(dict.fromkeys(rest))
    return step.chain


def _defines_itself(step: Step) -> bool:
    """Whether a name stands in the formulas that say what it is; an equation between signals says nothing of
    the kind, nor what is put into one."""
    head, *formulas = step.chain or (None,)
    if step.rule in EQUATIONS:
        return False
    return isinstance(head, Symbol | Indexed) and any(head in walk(expr) for expr in formulas)


def _circular(step: Step) -> Claim:
    return Claim("links", NORMAL_FORM, False, {"step": step.name}, link=True)


def _link(name: str, chain: Sequence[Expr], walk_of: Walk, at: Somewhere) -> Claim:
    values = [_plain(walk_of.value(expr)) for expr in chain]
    holds = all(a == b for a, b in pairwise(values)) and not contradicted(chain, at)
    return Claim("links", NORMAL_FORM, holds, {"step": name}, link=True, tried=len(chain) - 1)


def _in_letters(step: Step, known: frozenset[str], at: Somewhere) -> Iterator[Claim]:
    """What stands behind a name or an equation that the board does not know, in floats."""
    chain = [expr for expr in step.chain[1:] if not _rounded(expr) and free_symbols(expr) <= known]
    if pairs := [*pairwise(values_of(chain, at))]:
        holds = all(near(one, other) for one, other in pairs)
        yield Claim("links", FLOATS, holds, {"step": step.name}, link=True, tried=len(pairs))


def _plain(value: Value) -> Value:
    """A product such as g^T o is a scalar, though a matrix of one entry."""
    return value[0, 0] if isinstance(value, ScalarMatrix) and value.shape == (1, 1) else value


# -- in numbers -----------------------------------------------------------------------------------


def _in_floats(name: str, chain: Sequence[Expr], walk_of: Walk) -> Iterator[Claim]:
    """Rounded numbers are what stands before them comes to; no claim where no numbers are had of that."""
    for before, rounded in pairwise(chain):
        if _rounded(rounded):
            with suppress(NotDerivable):
                value = before if _rounded(before) else _plain(walk_of.value(before))
                yield _same_numbers(name, (value,), (rounded,), (before, rounded), walk_of.names)


def in_its_instance(law: Step, names: Names) -> Claim:
    """A law that holds in general, compared in one case: by normal form, else in numbers where it can be."""
    chain = tuple(replace(expr, law.instance) for expr in law.chain)
    with suppress(NotDerivable):
        claim = _link(law.name, chain, walk_over(chain, names), Somewhere(names))
        if claim.holds or any(isinstance(node, Matrix) for expr in chain for node in walk(expr)):
            return claim
    return _same_numbers(law.name, chain[:-1], chain[1:], chain, names)


def _same_numbers(
    name: str, ours: Sequence[Expr | Value], other: Sequence[Expr], trees: Sequence[Expr], names: Names
) -> Claim:
    """At random points of all that the trees and the definitions of names rest on."""
    where = {each.name: value for each, value in names.items() if isinstance(each, Symbol)}
    letters = frozenset().union(*map(free_symbols, (*trees, *where.values()))) - where.keys()

    def at_points(values: Sequence[Expr | Value]) -> Callable[[Mapping[str, float]], list[Any]]:
        def found(at: Point) -> list[Any]:
            return [numbers(value, completed(at, where)) for value in values]

        return found

    claim = agreement("links", letters, at_points(ours), at_points(other), step=name)
    return fields_replaced(claim, by=FLOATS, link=True)


def _rounded(expr: Expr) -> bool:
    return any(isinstance(node, Approximate) for node in walk(expr))
