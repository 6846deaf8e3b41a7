"""The moves of an inverse: each finds a joint variable, or a sum of them, by those found before."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any, TypeAlias

from derive.algebra.angles import Form, combination
from derive.derivation import Step
from derive.expression import ZERO, Expr, Symbol, add, multiply, number
from derive.kinds.robot._inverse.trees import minus

Signs: TypeAlias = Mapping[int, int]  # move -> the sign chosen there


@dataclass(frozen=True, slots=True)
class Option:
    """One value of the unknown: chosen freely by `sign`, or where the signs chosen at earlier moves have this
    product. `when` says which it is; 0 is no choice."""

    value: Expr
    sign: int = 0
    when: str = ""
    earlier: tuple[int, ...] = ()
    product: int = 1

    def fits(self, signs: Signs) -> bool:
        result = 1
        for move in self.earlier:
            result *= signs[move]
        return not self.earlier or result == self.product


@dataclass(frozen=True, slots=True)
class Move:
    """`number` counts the moves from 0; `of` is a sum of angles or the name of a displacement, `head` how it
    is written; `trig` are the sine and cosine of that sum where they are known without it, by sign."""

    number: int
    of: Form | str
    head: Expr
    options: tuple[Option, ...]
    steps: tuple[Step, ...]
    facts: Mapping[str, Any]
    trig: Mapping[int, Mapping[Expr, Expr]] = field(default_factory=dict)

    @property
    def chosen(self) -> bool:
        """Whether there is a choice to make, rather than one made already."""
        return len(self.options) > 1 and any(option.sign for option in self.options)


@dataclass(frozen=True, slots=True)
class Definition:
    """A name for a quantity that is known by then."""

    name: Symbol
    value: Expr


Item: TypeAlias = Definition | Move


def choices(items: Sequence[Item]) -> Iterator[dict[int, Option]]:
    """Every branch: the option taken at each move, by its number."""
    yield from _choose([item for item in items if isinstance(item, Move)], {}, {})


def _choose(
    moves: Sequence[Move], signs: dict[int, int], taken: dict[int, Option]
) -> Iterator[dict[int, Option]]:
    if not moves:
        yield taken
        return
    first, *rest = moves
    for option in first.options:
        if option.fits(signs):
            here = {**signs, first.number: option.sign} if option.sign else signs
            yield from _choose(rest, here, {**taken, first.number: option})


@lru_cache(maxsize=1024)
def shares(joint: str, forms: tuple[Form, ...], joints: tuple[str, ...]) -> tuple[int, ...] | None:
    """How a joint angle is made up of known sums, the angles nobody knows yet taken as zero."""
    basis = list(forms)
    for name in joints:
        single = Form.of({name: 1})
        if combination(single, basis) is None:
            basis.append(single)
    found = combination(Form.of({joint: 1}), basis)
    return tuple(int(n) for n in found[: len(forms)]) if found else None


def weighted(values: Sequence[Expr], weights: Sequence[int]) -> Expr:
    """A sum of values with whole weights."""
    terms = [_scaled(value, n) for value, n in zip(values, weights, strict=True) if n]
    return add(*terms) if terms else ZERO


def _scaled(value: Expr, n: int) -> Expr:
    if abs(n) == 1:
        return value if n > 0 else minus(value)
    return multiply(number(n), value)
