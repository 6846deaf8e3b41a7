"""Inverse kinematics by iteration: Newton's method and the method of the gradient, in numbers.

f(q) is where the end-effector is, r where it should be, H(q) = |r - f(q)|^2 / 2 and its gradient
-J^T (r - f(q)) (Siciliano et al., section 3.7).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

Pose: TypeAlias = Callable[[Any], tuple[list[float], Any]]  # q -> (f(q), J(q))
Verdict: TypeAlias = Literal["converged", "singular", "stuck", "diverging", "unfinished"]

CLOSE = 1e-10  # an error that is none
SINGULAR = 1e-9  # the smallest singular value against the largest
FLAT = 1e-10  # a gradient that is none, against the error


@dataclass(frozen=True, slots=True)
class Row:
    """One iteration: the joint variables, |r - f(q)|, and H."""

    q: tuple[float, ...]
    error: float
    H: float


@dataclass(frozen=True, slots=True)
class Iteration:
    """All of them, and how it ended: "singular" where Newton meets a singular J, "stuck" where the gradient
    vanishes short of the target, "diverging" where the error has grown."""

    rows: tuple[Row, ...]
    verdict: Verdict

    @property
    def share(self) -> float:
        """What a step leaves of the error on average, geometrically; 1 of none."""
        steps = len(self.rows) - 1
        return float((self.rows[-1].error / self.rows[0].error) ** (1 / steps)) if steps else 1.0


def iterate(
    pose: Pose, target: Sequence[float], start: Sequence[float], method: str, most: int, fixed: float | None
) -> Iteration:
    """At most so many steps; `fixed` is the step of the gradient method, else the best for each."""
    import numpy as np

    q, r = np.array(start, dtype=float), np.array(target, dtype=float)
    rows: list[Row] = []
    for _ in range(most + 1):
        reached, J = pose(q)
        error, J = r - np.array(reached), np.array(J)
        rows.append(_row(q, error))
        if rows[-1].error < CLOSE:
            return Iteration(tuple(rows), "converged")
        if len(rows) > most:
            break
        change, verdict = _newton(J, error) if method == "newton" else _descent(J, error, fixed)
        if change is None:
            return Iteration(tuple(rows), verdict)
        q = q + change
    return Iteration(tuple(rows), _verdict(rows))


def _row(q: Any, error: Any) -> Row:
    import numpy as np

    size = float(np.linalg.norm(error))
    return Row(tuple(map(float, q)), size, size * size / 2)


def _newton(J: Any, error: Any) -> tuple[Any, Verdict]:
    """J^-1 e; with the pseudo-inverse where J is not square."""
    import numpy as np

    values = np.linalg.svd(J, compute_uv=False)
    if values[-1] < SINGULAR * max(values[0], 1e-300):
        return None, "singular"
    return np.linalg.pinv(J) @ error, "unfinished"


def _descent(J: Any, error: Any, fixed: float | None) -> tuple[Any, Verdict]:
    """alpha J^T e, down the slope of H; the best alpha for a linear f is |J^T e|^2 / |J J^T e|^2."""
    import numpy as np

    slope = J.T @ error
    if np.linalg.norm(slope) < FLAT * np.linalg.norm(error):
        return None, "stuck"
    alpha = float(slope @ slope) / float((J @ slope) @ (J @ slope)) if fixed is None else fixed
    return alpha * slope, "unfinished"


def _verdict(rows: list[Row]) -> Verdict:
    return "diverging" if rows[-1].error > rows[0].error else "unfinished"
