"""Euler-Lagrange dynamics of an open chain (Spong et al., chapter 6; Siciliano et al., section 7.1)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from typing import TypeAlias

from derive.algebra.matrix import ScalarMatrix, dot
from derive.algebra.scalar import Scalar
from derive.expression import ZERO, Expr, Symbol
from derive.mechanics.robot import Robot

HALF = Fraction(1, 2)
Christoffel: TypeAlias = Mapping[tuple[int, int, int], Scalar]  # c_ijk, indices from 1


@dataclass(frozen=True, slots=True)
class LinkMotion:
    """What a link brings to the energy: mass, com (3 by 1, base frame), the Jacobians J_v, J_w
    (3 by n) of its com, its rotation R (3 by 3), and I about its com in its own frame (3 by 3)."""

    mass: Scalar
    com: ScalarMatrix
    J_v: ScalarMatrix
    J_w: ScalarMatrix
    R: ScalarMatrix
    inertia: ScalarMatrix


def inertia_matrix(links: Sequence[LinkMotion]) -> ScalarMatrix:
    """D (n by n) = sum of m J_v^T J_v + J_w^T R I R^T J_w (Spong et al., eq. 6.30)."""
    return reduce(ScalarMatrix.__add__, map(link_inertia, links))


def link_inertia(link: LinkMotion) -> ScalarMatrix:
    """The part of D that one link brings (n by n)."""
    linear = _gram(link.J_v, link.J_v.scaled(link.mass))
    if not link.inertia:
        return linear
    local = link.R.T @ link.J_w  # angular velocity in the link's own frame
    return linear + _gram(local, link.inertia @ local)


def _gram(A: ScalarMatrix, B: ScalarMatrix) -> ScalarMatrix:
    """A^T B where that is symmetric: only one half is multiplied out."""
    home = A.ring.union(B.ring)
    left, right = A.into(home).T.rows, B.into(home).T.rows
    lower = [[dot(left[i], right[j]) for j in range(i + 1)] for i in range(len(left))]
    n = range(len(left))
    return ScalarMatrix(tuple(tuple(lower[max(i, j)][min(i, j)] for j in n) for i in n))


def christoffel(D: ScalarMatrix, variables: Sequence[str]) -> Christoffel:
    """c_ijk, indices from 1: (d_kj,i + d_ki,j - d_ij,k) / 2 (Spong et al., eq. 6.38)."""
    n = len(variables)
    d = [_derivative(D, name) for name in variables]
    found = {}
    for i in range(n):
        for j in range(i, n):
            for k in range(n):
                symbol = (d[i][k][j] + d[j][k][i] - d[k][i][j]) * HALF
                found[i + 1, j + 1, k + 1] = found[j + 1, i + 1, k + 1] = symbol
    return found


def coriolis_matrix(symbols: Christoffel, rate: ScalarMatrix) -> ScalarMatrix:
    """C (n by n), c_kj = sum of c_ijk qdot_i, for rates qdot (n by 1) (Spong et al., eq. 6.42)."""
    n = range(1, len(rate.entries) + 1)
    return ScalarMatrix.of(
        [sum((symbols[i, j, k] * rate[i - 1, 0] for i in n), Scalar.of(0)) for j in n] for k in n
    )


def velocity_terms(symbols: Christoffel, rate: ScalarMatrix) -> ScalarMatrix:
    """The sums c_ijk qdot_i qdot_j of each equation of motion (n by 1) (Spong et al., eq. 6.39)."""
    q = rate.entries
    totals = [Scalar.of(0) for _ in q]
    for (i, j, k), symbol in symbols.items():
        if symbol:
            totals[k - 1] = totals[k - 1] + symbol * q[i - 1] * q[j - 1]
    return ScalarMatrix.column(totals)


def _derivative(D: ScalarMatrix, name: str) -> list[list[Scalar]]:
    """Of every entry of a symmetric matrix, once for each pair."""
    n = D.shape[0]
    lower = [[D[i, j].diff(name) for j in range(i + 1)] for i in range(n)]
    return [[lower[max(i, j)][min(i, j)] for j in range(n)] for i in range(n)]


def gravity_of(robot: Robot) -> tuple[Expr, Expr, Expr]:
    """The acceleration of gravity in the base frame; g downwards along z where the sheet is silent."""
    return robot.gravity or (ZERO, ZERO, -Symbol("g"))


def potential_energy(links: Sequence[LinkMotion], gravity: ScalarMatrix) -> Scalar:
    """P = - sum of m g^T p_c (Spong et al., eq. 6.33); `gravity` is the acceleration (3 by 1) in the base
    frame, so that P is in joules where all else is in SI units."""
    return sum((-(link.mass * (gravity.T @ link.com)[0, 0]) for link in links), Scalar.of(0))


def rate_column(variables: Sequence[str], dots: str = "dot") -> ScalarMatrix:
    """qdot (n by 1), the rates of joint variables by name; with the `dots` "ddot" the accelerations."""
    return ScalarMatrix.column([Scalar.symbol(f"{name}_{dots}") for name in variables])


def kinetic_energy(D: ScalarMatrix, rate: ScalarMatrix) -> Scalar:
    """The kinetic energy K = qdot^T D qdot / 2 (Spong et al., eq. 6.30)."""
    return (rate.T @ D @ rate)[0, 0] * HALF


def time_derivative(M: ScalarMatrix, variables: Sequence[str]) -> ScalarMatrix:
    """dM/dt of a matrix that holds joint variables and their rates, by the chain rule (the same shape)."""
    pairs = [pair for q in variables for pair in ((q, f"{q}_dot"), (f"{q}_dot", f"{q}_ddot"))]
    M = M.into(M.ring.with_symbols(rate for _, rate in pairs))
    slopes = (M.diff(held).scaled(Scalar.symbol(rate)) for held, rate in pairs)
    return reduce(ScalarMatrix.__add__, slopes)
