"""The recursive Newton-Euler algorithm in the same algebra: a second derivation of the dynamics.

Out from base to tip the motion of each link, back from tip to base the forces on it, every vector a
column of three in the link's own frame (Siciliano et al., section 7.5.3, eqs. 7.107 to 7.114; Craig,
section 6.5, eqs. 6.45 to 6.53). Nothing is shared with the Jacobians of the centres of mass, so that
D, c_ijk and g of both can be held against each other.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from itertools import combinations

from derive.algebra.matrix import ScalarMatrix, dot
from derive.algebra.ring import Ring
from derive.algebra.scalar import Like, Scalar, common_ring
from derive.mechanics.chain import Chain, Joint
from derive.mechanics.poses import position_part, rotation_part

Vector = tuple[Scalar, Scalar, Scalar]
HALF = Fraction(1, 2)


@dataclass(frozen=True, slots=True)
class LinkBody:
    """mass, com (3 by 1) and inertia about it (3 by 3), both in the link's own frame."""

    mass: Scalar
    com: ScalarMatrix
    inertia: ScalarMatrix


@dataclass(frozen=True, slots=True)
class _Row:
    """Row i in numbers of one ring: R and p take frame i to frame i-1; the joint's axis z, in frames
    i-1 and i; `out` from frame i-1 to a point of the axis (frame i-1), `arm` on to frame i (frame i)."""

    R: ScalarMatrix
    joint: Joint | None
    z_before: Vector
    z: Vector
    out: Vector
    arm: Vector
    body: LinkBody | None

    @property
    def turns(self) -> bool:
        return self.joint is not None and self.joint.type == "revolute"


@dataclass(frozen=True, slots=True)
class _Motion:
    """Angular velocity, angular acceleration, and acceleration of the frame's origin."""

    w: Vector
    alpha: Vector
    a: Vector


@dataclass(frozen=True, slots=True)
class Swept:
    """Link i, all in its own frame: angular velocity and acceleration, accelerations of the origin and the
    com, force and moment about the com that move the body, force and moment (about the point of the
    joint's axis) that the link before exerts, and what the joint has of it, None of a fixed row."""

    w: Vector
    alpha: Vector
    a: Vector
    a_c: Vector
    F: Vector
    N: Vector
    f: Vector
    mu: Vector
    tau: Scalar | None


@dataclass(frozen=True, slots=True)
class NewtonEuler:
    """An arm ready for sweeps; `base` turns the base frame into frame 0."""

    rows: tuple[_Row, ...]
    base: ScalarMatrix
    home: Ring

    @staticmethod
    def of(chain: Chain, links: Sequence[LinkBody | None], others: Sequence[Scalar] = ()) -> NewtonEuler:
        """The ring holds the chain, the bodies of its rows, and `others`, such as rates."""
        home = _home(chain, links, others)
        rows = zip(chain.T_local, chain.joints, links, strict=True)
        base = rotation_part(chain.T[0]).into(home)
        return NewtonEuler(
            tuple(_row(T.into(home), joint, body, home) for T, joint, body in rows), base, home
        )

    def torques(
        self, rates: Sequence[Like], accelerations: Sequence[Like], gravity: Sequence[Like]
    ) -> tuple[Scalar, ...]:
        """tau_k (N m of a revolute joint, N of a prismatic one), in the order of the joints; `gravity` is the
        acceleration in the base frame (3)."""
        links = self.sweep(rates, accelerations, gravity)
        return tuple(link.tau for link in links if link.tau is not None)

    def sweep(
        self, rates: Sequence[Like], accelerations: Sequence[Like], gravity: Sequence[Like]
    ) -> tuple[Swept, ...]:
        """Everything on the way, link by link from base to tip: out the motions, and back the forces that the
        links hand down (Siciliano et al., eqs. 7.112 to 7.114; Craig, 6.51 to 6.53)."""
        moving = iter(zip(self._scalars(rates), self._scalars(accelerations), strict=True))
        still, nothing = (self._zero, self._zero), (self._zero,) * 3
        motions = [_Motion(nothing, nothing, self.at_base(gravity))]
        for row in self.rows:
            motions.append(_outward(row, motions[-1], *(next(moving) if row.joint else still)))
        force = moment = nothing
        found = []
        for row, motion in reversed(list(zip(self.rows, motions[1:], strict=True))):
            a_c, F, N = motion.a, nothing, nothing
            if row.body:
                c = _vector(row.body.com)
                a_c, F, N = _load(row.body, c, motion)
                force, moment = _plus(force, F), _plus(moment, N, _cross(c, F))
            moment = _plus(moment, _cross(row.arm, force))  # about the point of the axis
            tau = dot(row.z, moment if row.turns else force) if row.joint else None
            found.append(Swept(motion.w, motion.alpha, motion.a, a_c, F, N, force, moment, tau))
            force, moment = _turned(row.R, force), _turned(row.R, moment)
            moment = _plus(moment, _cross(row.out, force))  # about the origin of the frame before
        return tuple(reversed(found))

    def at_base(self, gravity: Sequence[Like]) -> Vector:
        """The acceleration of a base that accelerates upwards, which stands for gravity, in frame 0."""
        return _turned(self.base.T, [-part for part in self._scalars(gravity)])

    @property
    def _zero(self) -> Scalar:
        return Scalar(self.home, self.home.zero)

    def _scalars(self, values: Sequence[Like]) -> list[Scalar]:
        return [Scalar.of(value).into(self.home) for value in values]

    @property
    def _joints(self) -> int:
        return sum(row.joint is not None for row in self.rows)

    def inertia_matrix(self) -> ScalarMatrix:
        """D (n by n), a column for each unit acceleration from rest without gravity."""
        n = self._joints
        columns = [self.torques([0] * n, _unit(n, j), [0] * 3) for j in range(n)]
        return ScalarMatrix(tuple(columns)).T

    def christoffel(self) -> dict[tuple[int, int, int], Scalar]:
        """c_ijk, indices from 1, by unit rates: tau_k at e_i is c_iik, and at e_i + e_j it is
        c_iik + c_jjk + 2 c_ijk, as c_ijk = c_jik."""
        n = self._joints
        alone = [self._by_rates(n, i) for i in range(n)]
        found = {(i + 1, i + 1, k + 1): alone[i][k] for i in range(n) for k in range(n)}
        for i, j in combinations(range(n), 2):
            both = self._by_rates(n, i, j)
            for k in range(n):
                symbol = (both[k] - alone[i][k] - alone[j][k]) * HALF
                found[i + 1, j + 1, k + 1] = found[j + 1, i + 1, k + 1] = symbol
        return found

    def _by_rates(self, n: int, *moving: int) -> tuple[Scalar, ...]:
        return self.torques([int(i in moving) for i in range(n)], [0] * n, [0] * 3)

    def gravity_torques(self, gravity: Sequence[Like]) -> tuple[Scalar, ...]:
        """g_k, the torques at rest."""
        return self.torques([0] * self._joints, [0] * self._joints, gravity)


def _home(chain: Chain, links: Sequence[LinkBody | None], others: Sequence[Scalar]) -> Ring:
    matrices = [part for link in links if link for part in (link.com, link.inertia)]
    matrices += [part for joint in chain.joints if joint for part in (joint.before, joint.axis)]
    home = reduce(Ring.union, (matrix.ring for matrix in matrices), chain.T[-1].ring)
    return home.union(common_ring([*(link.mass for link in links if link), *others]))


def _row(T: ScalarMatrix, joint: Joint | None, body: LinkBody | None, home: Ring) -> _Row:
    R, p = rotation_part(T), position_part(T)
    nothing = _vector(ScalarMatrix.zeros(3, 1).into(home))
    z_before = z = out = nothing
    if joint:
        before = joint.before.into(home)
        z_before = _vector(rotation_part(before) @ joint.axis.into(home))
        z = _turned(R.T, z_before)
        # a prismatic joint moves the frame as a whole: its length counts to the way out
        out = _vector(position_part(before) if joint.type == "revolute" else p)
    arm = _turned(R.T, _minus(_vector(p), out))
    if body:
        body = LinkBody(body.mass.into(home), body.com.into(home), body.inertia.into(home))
    return _Row(R, joint, z_before, z, out, arm, body)


def _outward(row: _Row, before: _Motion, rate: Scalar, rise: Scalar) -> _Motion:
    """The motion of frame i from that of frame i-1 (Siciliano, eqs. 7.107 to 7.109; Craig, 6.45 to 6.48
    and, prismatic, 6.35): in frame i-1 as far as the joint, beyond it in frame i."""
    a = _plus(before.a, _of_point(before, row.out))
    spin = _times(rate, row.z_before)
    if row.joint and not row.turns:
        a = _plus(a, _times(rise, row.z_before), _times(Scalar.of(2), _cross(before.w, spin)))
        return _Motion(*(_turned(row.R.T, v) for v in (before.w, before.alpha, a)))
    w = _plus(before.w, spin)
    alpha = _plus(before.alpha, _times(rise, row.z_before), _cross(before.w, spin))
    reached = _Motion(*(_turned(row.R.T, v) for v in (w, alpha, a)))
    return _Motion(reached.w, reached.alpha, _plus(reached.a, _of_point(reached, row.arm)))


def _load(body: LinkBody, c: Vector, motion: _Motion) -> tuple[Vector, Vector, Vector]:
    """a_c, m a_c, and I alpha + w x I w about the com at c (Craig, eqs. 6.48 to 6.50)."""
    a_c = _plus(motion.a, _of_point(motion, c))
    N = _plus(_turned(body.inertia, motion.alpha), _cross(motion.w, _turned(body.inertia, motion.w)))
    return a_c, _times(body.mass, a_c), N


def _of_point(motion: _Motion, r: Vector) -> Vector:
    """What a point at r accelerates more than the origin: alpha x r + w x (w x r)."""
    return _plus(_cross(motion.alpha, r), _cross(motion.w, _cross(motion.w, r)))


def _vector(column: ScalarMatrix) -> Vector:
    x, y, z = column.entries
    return x, y, z


def _unit(n: int, j: int) -> list[Like]:
    return [int(i == j) for i in range(n)]


def _plus(*vectors: Vector) -> Vector:
    x, y, z = (reduce(Scalar.__add__, parts) for parts in zip(*vectors, strict=True))
    return x, y, z


def _minus(u: Vector, v: Vector) -> Vector:
    return u[0] - v[0], u[1] - v[1], u[2] - v[2]


def _times(k: Scalar, v: Vector) -> Vector:
    return k * v[0], k * v[1], k * v[2]


def _cross(u: Vector, v: Vector) -> Vector:
    (a, b, c), (d, e, f) = u, v
    return dot((b, -c), (f, e)), dot((c, -a), (d, f)), dot((a, -b), (e, d))


def _turned(R: ScalarMatrix, v: Sequence[Scalar]) -> Vector:
    x, y, z = (dot(row, v) for row in R.rows)
    return x, y, z
