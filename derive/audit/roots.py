"""Real roots of a system of equations, looked for by Newton's method from anywhere."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
import sympy

from derive.audit.budget import spend
from derive.audit.points import Point, floating

STARTS, STEPS = 40, 60
SMALL = 1e-10
A_FLOAT = 50  # operations on floats cost what one of the audit does


def found_from_anywhere(
    equations: Sequence[sympy.Expr], unknowns: Sequence[sympy.Symbol], point: Point
) -> Iterator[np.ndarray[Any, Any]]:
    """The places (floats) that Newton's method ends at, each once for every start; the other names have their
    values at the point. It may find none."""
    others = sympy.Matrix(equations).free_symbols - set(unknowns)
    values = {name: sympy.Float(floating(point.at(name)), 30) for name in others}
    system = sympy.Matrix(equations).subs(values)
    slopes = system.jacobian(unknowns)
    spend(STARTS * STEPS * int(sympy.count_ops([system, slopes])) // A_FLOAT)
    F, slope = (sympy.lambdify([unknowns], each, "numpy") for each in (system, slopes))
    draw = np.random.default_rng(point.seed)
    for _ in range(STARTS):
        place = _settled(F, slope, draw.normal(scale=2.0, size=len(unknowns)))
        if place is not None:
            yield place


def _settled(F: Any, slope: Any, place: np.ndarray[Any, Any]) -> np.ndarray[Any, Any] | None:
    """Where Newton's method comes to rest with steps that go on shrinking; None where it does not."""
    with np.errstate(all="ignore"):
        for _ in range(STEPS):
            value, J = np.array(F(place), float).ravel(), np.array(slope(place), float)
            if not (np.isfinite(value).all() and np.isfinite(J).all()):
                return None
            step = np.linalg.lstsq(J, value, rcond=None)[0]
            place = place - step
            if abs(step).max() <= SMALL * (1 + abs(place).max()):
                sharp = np.linalg.cond(J) < 1 / SMALL
                return place if sharp and abs(value).max() < SMALL * (1 + abs(J).max()) else None
    return None
