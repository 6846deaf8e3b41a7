"""The Christoffel symbols of an inertia matrix as lines, each from its partial derivatives."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from fractions import Fraction
from typing import TypeAlias

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.scalar import Scalar
from derive.derivation import PageFacts, Phrase, Result
from derive.expression import ZERO, Derivative, Expr, Number, Sum, Symbol, add, multiply, number
from derive.kinds.work import Work
from derive.mechanics.dynamics import Christoffel
from derive.names import entry_symbol

Index: TypeAlias = tuple[int, int, int]
HALF = number("1/2")


def lines(
    work: Work, symbols: Christoffel, variables: Sequence[str], final: Callable[[Scalar], Expr]
) -> Work:
    """With a line for each that is shown; `final` writes a value as it stands at the end."""
    for ijk in shown(symbols):
        work = _line(work, ijk, symbols[ijk], variables, final)
    return work


def shown(symbols: Christoffel) -> tuple[Index, ...]:
    """Those with i <= j that do not vanish, grouped by equation of motion."""
    ordered = sorted((ijk for ijk in symbols if ijk[0] <= ijk[1]), key=lambda ijk: (ijk[2], ijk))
    return tuple(ijk for ijk in ordered if symbols[ijk])


def skew(D: ScalarMatrix, symbols: Christoffel, variables: Sequence[str]) -> Iterator[bool]:
    """Whether dD/dt - 2C is skew-symmetric for each rate."""
    n = range(1, len(variables) + 1)
    by_rate = [ScalarMatrix.of([[symbols[i, j, k] for j in n] for k in n]) for i in n]
    found = [D.diff(name) - C.scaled(2) for name, C in zip(variables, by_rate, strict=True)]
    return (N == -N.T for N in found)


def named(ijk: Index) -> Symbol:
    """c_121"""
    return entry_symbol("c", *ijk)


def ordered(ijk: Index) -> Index:
    """The indices of the symbol that has the same value, the first two in order."""
    i, j, k = ijk
    return (min(i, j), max(i, j), k)


def listed(results: Mapping[str, Result], symbols: Christoffel) -> tuple[str, ...]:
    """The results that are worth a number at a point: of two that are equal one, and none that vanish."""
    left = {named(ijk).name for ijk in symbols if ijk != ordered(ijk) or results[named(ijk).name] == ZERO}
    return tuple(name for name in results if name not in left)


LEFT = {  # whether there are equal ones, and such as vanish
    (True, True): "equal-or-zero",
    (True, False): "equal-ones",
    (False, True): "zero-ones",
    (False, False): "",
}


def left_out(results: Mapping[str, Result], symbols: Christoffel) -> Phrase | None:
    """What is said of those that are not listed, where some are."""
    there = [ijk for ijk in symbols if results[named(ijk).name] != ZERO]
    key = LEFT[any(i != j for i, j, _ in there), len(there) < len(symbols)]
    return Phrase(key) if there and key else None


def left_out_rightly(facts: PageFacts, symbols: Christoffel) -> Iterator[bool]:
    """Whether each of the exact symbols equals one that is listed, or is zero; and whether there are such as
    it is said."""
    names, key = facts.numbers or (), facts.remark.key if facts.remark else ""
    for (i, j, k), value in symbols.items():
        yield not value or any(
            named((a, b, k)).name in names and symbols[a, b, k] == value for a, b in ((i, j), (j, i))
        )
    twins = any(value and i < j for (i, j, _), value in symbols.items())
    yield key == (LEFT[twins, not all(symbols.values())] if any(symbols.values()) else "")


def _line(
    work: Work, ijk: Index, value: Scalar, variables: Sequence[str], final: Callable[[Scalar], Expr]
) -> Work:
    """c_121 = c_211 = (three partial derivatives) / 2 = (those that are left) / 2 = value."""
    i, j, k = ijk
    raw = [
        (_partial(variables, k, j, i), 1),
        (_partial(variables, k, i, j), 1),
        (_partial(variables, i, j, k), -1),
    ]
    whole = multiply(HALF, Sum(tuple((-d if n < 0 else d for d, n in raw))))
    formulas = (*([named((j, i, k))] if i != j else []), whole, *_collected(raw), work.readable(value))
    return work.line(named(ijk), *formulas, value=final(value), rule="christoffel")


def _partial(variables: Sequence[str], a: int, b: int, by: int) -> Expr:
    return Derivative(entry_symbol("d", min(a, b), max(a, b)), Symbol(variables[by - 1]))


def _collected(raw: list[tuple[Expr, int]]) -> tuple[Expr, ...]:
    """Half the sum with equal derivatives collected; none where none are equal."""
    counts: Counter[Expr] = Counter()
    for derivative, sign in raw:
        counts[derivative] += sign
    kept = [(derivative, n) for derivative, n in counts.items() if n]
    if len(kept) == len(raw):
        return ()
    return (add(*(multiply(Number(Fraction(n, 2)), derivative) for derivative, n in kept)),)
