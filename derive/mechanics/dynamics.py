"""Euler-Lagrange dynamics of an open chain (Spong et al., chapter 6; Siciliano et al., section 7.1)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.scalar import Scalar

HALF = Fraction(1, 2)


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
    parts = [link_inertia(link) for link in links]
    total = parts[0]
    for part in parts[1:]:
        total = total + part
    return total


def link_inertia(link: LinkMotion) -> ScalarMatrix:
    """The part of D that one link brings (n by n)."""
    linear = (link.J_v.T @ link.J_v).scaled(link.mass)
    if not link.inertia:
        return linear
    local = link.R.T @ link.J_w  # angular velocity in the link's own frame
    return linear + local.T @ link.inertia @ local


def christoffel(D: ScalarMatrix, variables: Sequence[str]) -> dict[tuple[int, int, int], Scalar]:
    """c_ijk, indices from 1: (d_kj,i + d_ki,j - d_ij,k) / 2 (Spong et al., eq. 6.38)."""
    n = len(variables)
    d = [D.diff(name) for name in variables]
    found = {}
    for i in range(n):
        for j in range(i, n):
            for k in range(n):
                symbol = (d[i][k, j] + d[j][k, i] - d[k][i, j]) * HALF
                found[i + 1, j + 1, k + 1] = found[j + 1, i + 1, k + 1] = symbol
    return found


def potential_energy(links: Sequence[LinkMotion], gravity: ScalarMatrix) -> Scalar:
    """P = - sum of m g^T p_c; `gravity` is the acceleration (3 by 1) in the base frame."""
    total = Scalar.of(0)
    for link in links:
        total = total - link.mass * (gravity.T @ link.com)[0, 0]
    return total


def equations(
    D: ScalarMatrix,
    symbols: dict[tuple[int, int, int], Scalar],
    g: Sequence[Scalar],
    variables: Sequence[str],
) -> tuple[Scalar, ...]:
    """tau_k = sum d_kj qddot_j + sum c_ijk qdot_i qdot_j + g_k (Spong et al., eq. 6.39)."""
    rates = [Scalar.symbol(f"{name}_dot") for name in variables]
    accelerations = [Scalar.symbol(f"{name}_ddot") for name in variables]
    torques = []
    for k in range(len(variables)):
        torque = g[k]
        for j, acceleration in enumerate(accelerations):
            torque = torque + D[k, j] * acceleration
        for (i, j, l), symbol in symbols.items():
            if l == k + 1 and symbol:
                torque = torque + symbol * rates[i - 1] * rates[j - 1]
        torques.append(torque)
    return tuple(torques)
