"""Trees that hold matrices in numbers, as NumPy arrays: what stands on a page beside scalars."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from fractions import Fraction
from typing import TYPE_CHECKING, Any, TypeAlias

from derive.algebra.fold import Domain, fold
from derive.algebra.numbers.floats import FUNCTIONS
from derive.expression import Expr

if TYPE_CHECKING:
    from numpy.typing import NDArray

Meaning: TypeAlias = "Mapping[str, float | NDArray[Any]]"  # of each name


class _Arrays(Domain[Any]):
    """Floats, and arrays of two dimensions; vectors are columns."""

    __slots__ = ("meaning",)

    def __init__(self, meaning: Meaning) -> None:
        self.meaning = meaning

    def number(self, value: Fraction) -> Any:
        return float(value)

    def approximate(self, value: float) -> Any:
        return value

    def degrees(self, value: Fraction) -> Any:
        return math.radians(float(value))

    def symbol(self, name: str) -> Any:
        return math.pi if name == "pi" else self.meaning[name]

    def product(self, factors: list[Any]) -> Any:
        import numpy as np

        made, *rest = factors
        for factor in rest:
            made = made @ factor if np.ndim(made) and np.ndim(factor) else made * factor
        return made

    def power(self, base: Any, exponent: Any) -> Any:
        import numpy as np

        if np.ndim(base):
            return np.linalg.matrix_power(base, round(exponent))
        return FUNCTIONS["pow"](base, exponent)

    def matrix(self, rows: list[list[Any]]) -> Any:
        """A matrix of entries, or of blocks."""
        import numpy as np

        return np.block([[np.atleast_2d(entry) for entry in row] for row in rows])

    def call(self, function: str, arguments: list[Any]) -> Any:
        import numpy as np

        of_matrix = any(map(np.ndim, arguments)) or function not in FUNCTIONS
        known = (_of_matrices() if of_matrix else FUNCTIONS).get(function)
        return known(*arguments) if known else self.refuse(function)


def arrays(expr: Expr, meaning: Meaning) -> Any:
    """The value of a tree, a float or an array (m by n), where each name is one. Raises KeyError for a name
    without a value, ValueError or ZeroDivisionError where it is not real."""
    return fold(expr, _Arrays(meaning))


def _of_matrices() -> dict[str, Callable[..., Any]]:
    import numpy as np

    return {
        "transpose": np.transpose,
        "inverse": np.linalg.inv,
        "det": lambda a: float(np.linalg.det(a)),
        "adj": lambda a: np.linalg.det(a) * np.linalg.inv(a),
        "abs": lambda a: float(np.linalg.norm(a)),
        "cross": lambda a, b: np.cross(a, b, axis=0),
    }
