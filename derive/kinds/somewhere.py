"""Chains at one point of all letters, in floats: whether what stands there in normal form is contradicted."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from typing import Any

from derive.algebra.numbers.arrays import arrays
from derive.algebra.numbers.floats import somewhere
from derive.errors import NotDerivable
from derive.expression import Expr, Symbol

NEAR, NOTHING = 1e-6, 1e-9  # relative, and what may be rounding of zero
NOWHERE = (KeyError, NotDerivable, ValueError, ArithmeticError, RecursionError)  # names chained without end


class Somewhere(Mapping[str, Any]):
    """What every name is worth at a point: what is known by what it stands for, any other letter by a number
    of its own, the same on every machine."""

    def __init__(self, names: Mapping[Expr, Expr]) -> None:
        self.names = names
        self.found: dict[str, Any] = {}
        self.asked: set[str] = set()

    def __getitem__(self, name: str) -> Any:
        """Raises KeyError for a name that rests on itself."""
        if name not in self.found:
            if name in self.asked:
                raise KeyError(name)
            self.asked.add(name)
            tree = self.names.get(Symbol(name), Symbol(name))
            letter = tree == Symbol(name)
            self.found[name] = somewhere(name) if letter else arrays(tree, self)
        return self.found[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.found)

    def __len__(self) -> int:
        return len(self.found)


def contradicted(chain: Sequence[Expr], at: Somewhere) -> bool:
    """Whether two neighbours of those of a chain that have a value there differ."""
    return any(not near(one, other) for one, other in pairwise(values_of(chain, at)))


def values_of(chain: Sequence[Expr], at: Somewhere) -> Iterator[Any]:
    """Of those members of a chain that have one there."""
    import numpy as np

    for expr in chain:
        try:
            value = np.squeeze(np.asarray(arrays(expr, at), dtype=float))
        except NOWHERE:
            continue
        if np.isfinite(value).all():
            yield value


def near(one: Any, other: Any) -> bool:
    """Whether two values are the same but for rounding."""
    import numpy as np

    if one.shape != other.shape:  # a zero of a column of blocks does not say how high it is
        return True
    size = max(float(np.abs(one).max(initial=0.0)), float(np.abs(other).max(initial=0.0)))
    return bool((np.abs(one - other) <= NEAR * size + NOTHING).all())
