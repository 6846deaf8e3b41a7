"""What the rooms of the oracle say of numbers: arrays, and how a tree is valued."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any, TypeAlias, get_args

from derive.expression import Expr, every

if TYPE_CHECKING:
    from numpy.typing import NDArray

Array: TypeAlias = "NDArray[Any]"
Value: TypeAlias = Callable[[Expr, Any], Any]  # of a tree at a point: floats, or numbers of more digits
TREES = get_args(Expr)


def trees_in(value: Any) -> Iterator[Expr]:
    """Those inside a record, or a tuple of records."""
    return (part for part in every(value) if isinstance(part, TREES))
