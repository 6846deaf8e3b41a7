"""What the rooms of the oracle say of numbers: arrays, and how a tree is valued."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import fields, is_dataclass
from typing import TYPE_CHECKING, Any, TypeAlias, get_args

from derive.expression import Expr

if TYPE_CHECKING:
    from numpy.typing import NDArray

Array: TypeAlias = "NDArray[Any]"
Value: TypeAlias = Callable[[Expr, Any], Any]  # of a tree at a point: floats, or numbers of more digits
TREES = get_args(Expr)


def trees_in(value: Any) -> Iterator[Expr]:
    """Those inside a record, or a tuple of records."""
    if isinstance(value, TREES):
        yield value
    elif isinstance(value, tuple):
        for part in value:
            yield from trees_in(part)
    elif is_dataclass(value):
        for each in fields(value):
            yield from trees_in(getattr(value, each.name))
