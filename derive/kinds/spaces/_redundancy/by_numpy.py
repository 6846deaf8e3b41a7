"""The second route of the lines, by NumPy."""

from __future__ import annotations

from typing import Any


def np_one(size: int) -> Any:
    import numpy as np

    return np.eye(size)


def np_column(entries: Any) -> Any:
    import numpy as np

    return np.reshape(entries, (-1, 1))


def np_null(J: Any) -> Any:
    """An orthonormal basis of the null space, as columns."""
    import numpy as np

    J = np.atleast_2d(J)
    _, sizes, turned = np.linalg.svd(J)
    rank = int((sizes > 1e-8 * max(1.0, *sizes)).sum())
    return turned[rank:].T


def solved(A: Any, b: Any) -> Any:
    import numpy as np

    return np.linalg.solve(A, b)
