"""What a proof may cost, counted before it is tried: a published answer must not keep the checker busy."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from functools import reduce
from itertools import islice
from math import gcd, lcm

from derive.algebra.formulas.quantities import rational
from derive.algebra.normal import Names
from derive.expression import Call, Expr, Product, Quotient, Sum, Symbol, children

MOST_ROOTS = 12  # different roots and inverse functions
MOST_NODES = 1500  # of a tree with all its definitions written out once
MOST_TURNS = 64  # 64 theta against theta: a polynomial of degree 64
ROOTS = ("sqrt", "abs", "atan2", "atan", "acos", "asin")


def affordable(trees: Sequence[Expr], names: Sequence[Names]) -> bool:
    """Whether trees, each under its own names, can be proved equal in a moment."""
    parts = bounded(trees, names, MOST_NODES)
    if parts is None or too_many_turns(parts):
        return False
    return len({part for part in parts if isinstance(part, Call) and part.function in ROOTS}) <= MOST_ROOTS


def bounded(trees: Sequence[Expr], names: Sequence[Names], most: int) -> list[Expr] | None:
    """Every node of trees and of what their names stand for; None where there are more than so many."""
    every = (part for tree, known in zip(trees, names, strict=True) for part in parts_of(tree, known))
    found = list(islice(every, most + 1))
    return found if len(found) <= most else None


def too_many_turns(parts: Iterable[Expr]) -> bool:
    """Whether one angle is a large multiple of another, as 10000 q is of q: the sine of the one is a
    polynomial of that degree in those of the other."""
    multiples: dict[str, set[Fraction]] = {}
    for part in parts:
        if isinstance(part, Call) and part.function in ("cos", "sin", "tan"):
            for name, times in _linear(part.arguments[0], Fraction(1)):
                multiples.setdefault(name, set()).add(abs(times))
    return any(_turns(found) > MOST_TURNS for found in multiples.values())


def _turns(found: set[Fraction]) -> Fraction:
    """The largest as a multiple of what divides them all."""
    kept = [times for times in found if times]
    if not kept:
        return Fraction(0)
    measure = Fraction(reduce(gcd, (n.numerator for n in kept)), reduce(lcm, (n.denominator for n in kept)))
    return max(kept) / measure


def _linear(angle: Expr, times: Fraction) -> Iterator[tuple[str, Fraction]]:
    """Each symbol or function of an angle with the number before it."""
    match angle:
        case Sum(terms):
            for term in terms:
                yield from _linear(term, times)
        case Product(factors):
            numbers = [value for value in map(rational, factors) if value is not None]
            rest = [factor for factor in factors if rational(factor) is None]
            scale = reduce(lambda a, b: a * b, numbers, times)
            if len(rest) == 1:
                yield from _linear(rest[0], scale)
            elif rest:
                yield "*".join(sorted(map(repr, rest))), scale
        case Quotient(top, bottom) if below := rational(bottom):
            yield from _linear(top, times / below)
        case Symbol(name):
            yield name, times
        case Call():
            yield repr(angle), times
            yield "", times  # a multiple of an inverse function is worked out turn by turn
            yield "", Fraction(1)


def parts_of(tree: Expr, names: Names) -> Iterator[Expr]:
    """Every node, those of definitions once."""
    pending, seen = [tree], set[Expr]()
    while pending:
        node = pending.pop()
        yield node
        if isinstance(node, Symbol) and node in names and node not in seen:
            seen.add(node)
            pending.append(names[node])
        pending.extend(children(node))
