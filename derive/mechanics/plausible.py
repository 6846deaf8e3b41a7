"""Which masses and moments of inertia a body can have."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from fractions import Fraction
from itertools import combinations

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import Names, normal
from derive.algebra.scalar import Scalar
from derive.algebra.signs import sign_of
from derive.mechanics.bodies import Body
from derive.mechanics.moments import moments

AXES = ("xx", "yy", "zz")


def impossible_inertia(body: Body, names: Names, positive: Collection[str] = ()) -> str | None:
    """Why no body has this inertia about its com; None where one may, or where it is not decided.

    The integrals of x^2, xy, ... over a body make a positive semidefinite matrix, tr(I)/2 1 - I
    (Traversaro et al., Identification of fully physical consistent inertial parameters, 2016). On principal
    axes that is the triangle inequality, and the moments are then positive too.
    """
    if body.com == "center" and body.about == "origin":
        return None
    inertia = _matrix(body, names)
    if _shorthand(inertia):
        return None
    for k, moment in enumerate(inertia[i, i] for i in range(3)):
        if sign_of(moment, positive) == -1:
            return f"I_{AXES[k]} is negative"
    if (broken := _broken_triangle(inertia, positive)) is not None:
        return broken
    numbers = all(entry.constant is not None for entry in inertia.entries)
    if numbers and any(sign_of(minor) == -1 for minor in principal_minors(_second_moments(inertia))):
        return f"its principal moments{_principal(inertia)} are not the sides of a triangle"
    if inertia and not normal(body.mass, names):
        return "it has moments of inertia but no mass"
    return None


def _shorthand(inertia: ScalarMatrix) -> bool:
    """[0, 0, I]: of an arm in a plane, whose other moments do not matter and were left out."""
    named = [entry for entry in inertia.entries if entry]
    return len(named) == 1 and (named[0].constant is None or named[0].constant > 0)


def _matrix(body: Body, names: Names) -> ScalarMatrix:
    xx, yy, zz, xy, yz, xz = (normal(element, names) for element in moments(body))
    return ScalarMatrix.of([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def _second_moments(inertia: ScalarMatrix) -> ScalarMatrix:
    half_trace = (inertia[0, 0] + inertia[1, 1] + inertia[2, 2]) * Fraction(1, 2)
    return ScalarMatrix.identity(3).scaled(half_trace) - inertia


def _broken_triangle(inertia: ScalarMatrix, positive: Collection[str]) -> str | None:
    """I_yy > I_xx + I_zz, in any frame."""
    for k in range(3):
        i, j = (other for other in range(3) if other != k)
        others = inertia[i, i] + inertia[j, j]
        if sign_of(others - inertia[k, k], positive) == -1:
            left, right = f"I_{AXES[k]}{_shown(inertia[k, k])}", f"I_{AXES[i]} + I_{AXES[j]}{_shown(others)}"
            return f"{left} is greater than {right}"
    return None


def principal_minors(matrix: ScalarMatrix) -> Iterator[Scalar]:
    """The principal minors of a 3 by 3 matrix, none of them negative where it is positive semidefinite."""
    for size in (1, 2, 3):
        for kept in combinations(range(3), size):
            yield ScalarMatrix(tuple(tuple(matrix[i, j] for j in kept) for i in kept)).det()


def _shown(value: Scalar) -> str:
    constant = value.constant
    return "" if constant is None else f" = {float(constant):g}"


def _principal(inertia: ScalarMatrix) -> str:
    """The principal moments in numbers."""
    import numpy as np

    found = np.linalg.eigvalsh([[float(entry.constant or 0) for entry in row] for row in inertia.rows])
    return " " + ", ".join(f"{moment:.3g}" for moment in found)
