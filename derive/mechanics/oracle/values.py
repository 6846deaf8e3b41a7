"""What the rooms of the oracle say of numbers: arrays, and how a tree is valued."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeAlias

from derive.expression import Expr

if TYPE_CHECKING:
    from numpy.typing import NDArray

Array: TypeAlias = "NDArray[Any]"
Value: TypeAlias = Callable[[Expr, Any], Any]  # of a tree at a point: floats, or numbers of more digits
