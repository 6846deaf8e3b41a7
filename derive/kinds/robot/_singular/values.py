"""The values of a singular set: each choice among the angles that its equations leave."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import islice

from derive.mechanics.vanishing import SIGN, Fixed, Locus, with_signs
from derive.mechanics.zeros import Write, Zero, zeros

MOST = 8  # choices that are worked out; more are told by their equations
Signs = dict[str, int]


def values_of(place: Locus, variables: tuple[str, ...], write: Write) -> tuple[tuple[Zero, ...], ...]:
    """The choices, the first few of them; none where an equation has no values that can be written."""
    steps = (*place.fixed, *place.left)
    if any(_values(each, {}, variables, write) is None for each in steps):
        return ()
    chosen = _chosen(steps, dict(place.signs), {}, variables, write)
    found = islice(chosen, MOST + 1)
    return tuple(tuple(sorted(each, key=lambda zero: variables.index(zero.variable))) for each in found)


def _chosen(
    steps: tuple[Fixed, ...], decided: Signs, signs: Signs, variables: tuple[str, ...], write: Write
) -> Iterator[tuple[Zero, ...]]:
    if not steps:
        yield ()
        return
    first, *rest = steps
    solved = _values(first, signs, variables, write) or ()
    for sign, zero in zip((1, -1), solved, strict=False):
        if decided.get(first.sign, sign) == sign:
            for others in _chosen(tuple(rest), decided, {**signs, first.sign: sign}, variables, write):
                yield (zero, *others)


def _values(each: Fixed, signs: Signs, variables: tuple[str, ...], write: Write) -> tuple[Zero, ...] | None:
    return zeros(with_signs(each.factor, signs), variables, write, by=each.variable)


def decided(place: Locus, variables: tuple[str, ...], write: Write) -> tuple[Zero, ...]:
    """Those values that are the same in every choice, where the signs of others would tell too much; what is
    left as an equation may have no values."""
    names = {each.variable for each in place.fixed if each.sign in dict(place.signs)}
    values = values_of(replace(place, left=()), variables, write) if names else ()
    return tuple(zero for zero in values[0] if zero.variable in names) if values else ()


def signed(place: Locus) -> bool:
    """Whether the equations of a set hold signs, and say something only with its values."""
    return any(name.startswith(SIGN) for each in place.equations for name in each.generators())
