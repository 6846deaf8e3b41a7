"""The lines of the Newton-Euler recursion: each quantity in the names of others, and written out."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.algebra.scalar import Scalar
from derive.expression import ZERO, Expr, Symbol, add, cross, multiply, transpose
from derive.kinds.robot._dynamics.bodies import Weighted
from derive.mechanics.joint_loads import reflected, resistance
from derive.mechanics.newton_euler import NewtonEuler, Swept
from derive.mechanics.robot import Link

Vector = Sequence[Scalar]


@dataclass(frozen=True, slots=True)
class Line:
    """One quantity: its name, its formula in other names, and its value (3 by 1, or a scalar)."""

    name: Symbol
    formula: Expr
    value: Scalar | ScalarMatrix
    rule: str
    i: int = 0  # the link


@dataclass(frozen=True, slots=True)
class Recursion:
    """A sweep of an arm, and the bodies of its links by row."""

    arm: NewtonEuler
    swept: tuple[Swept, ...]
    bodies: Mapping[int, Weighted]
    links: tuple[Link, ...]

    def constants(self) -> Iterator[Line]:
        """e_i, r_i, p_i and r_ci: what a link is in its own frame; those that vanish are left out."""
        for i, row in enumerate(self.arm.rows, 1):
            if row.joint:
                yield _constant(f"e_{i}", row.z)
            if any(row.out):
                yield _constant(f"p_{i}", row.out)
            if any(row.arm):
                yield _constant(f"r_{i}", row.arm)
            if row.body and row.body.com and self._heavy(i):
                yield _constant(f"r_c{i}", row.body.com.entries)

    def outward(self) -> Iterator[Line]:
        """Velocities and accelerations of each link, and what moves its body, from base to tip."""
        for i, (row, found) in enumerate(zip(self.arm.rows, self.swept, strict=True), 1):
            yield _line(i, f"omega_{i}", self._omega(i), found.w, "outward")
            yield _line(i, f"omega_{i}_dot", self._alpha(i), found.alpha, "outward")
            yield _line(i, f"o_{i}_ddot", self._origin(i), found.a, "outward")
            if row.body:
                yield from self._body(i, found)

    def inward(self) -> Iterator[Line]:
        """Forces and moments that the links hand down, and the joint forces, from tip to base."""
        for i in range(len(self.swept), 0, -1):
            found, link = self.swept[i - 1], self.links[i - 1]
            yield _line(i, f"f_{i}", self._force(i), found.f, "inward")
            yield _line(i, f"mu_{i}", self._moment(i), found.mu, "inward")
            if found.tau is not None:
                hand = Symbol(f"mu_{i}" if link.joint == "revolute" else f"f_{i}")
                formula = add(transpose(Symbol(f"e_{i}")) * hand, *_drive(link))
                whole = sum((normal(term) for term in _drive(link)), found.tau)
                yield Line(Symbol(f"tau_{self._number(i)}"), formula, whole, "torque", i)

    def handed_on(self, line: Line) -> tuple[int, Symbol] | None:
        """Which component of a moment is a joint force, and its name: where the axis is one of the frame, and
        neither rotor nor friction acts beside it."""
        link, axis = self.links[line.i - 1], self.arm.rows[line.i - 1].z
        if line.name != Symbol(f"mu_{line.i}") or link.joint != "revolute" or _drive(link):
            return None
        along = [k for k, entry in enumerate(axis) if entry == Scalar.of(1)]
        return (along[0], Symbol(f"tau_{self._number(line.i)}")) if along else None

    def _heavy(self, i: int) -> bool:
        """Whether link i has a mass."""
        return i in self.bodies and self.bodies[i].body.mass != ZERO

    def _number(self, i: int) -> int:
        """Which joint row i has."""
        return sum(link.variable is not None for link in self.links[:i])

    def _carried(self, i: int, name: str) -> Expr:
        """A vector of the link before, in frame i; zero of the base."""
        if i == 1 and name != "o_{}_ddot":
            return ZERO
        return transpose(rotation(i)) * Symbol(name.format(i - 1))

    def _omega(self, i: int) -> Expr:
        link = self.links[i - 1]
        own = multiply(_rate(link), Symbol(f"e_{i}")) if link.joint == "revolute" else ZERO
        return self._carried(i, "omega_{}") + own

    def _alpha(self, i: int) -> Expr:
        link, before = self.links[i - 1], self._carried(i, "omega_{}")
        terms = [self._carried(i, "omega_{}_dot")]
        if link.joint == "revolute":
            terms.append(multiply(_rise(link), Symbol(f"e_{i}")))
            if before != ZERO:
                terms.append(cross(before, multiply(_rate(link), Symbol(f"e_{i}"))))
        return add(*terms)

    def _origin(self, i: int) -> Expr:
        link, row = self.links[i - 1], self.arm.rows[i - 1]
        turns_before = any(row.out) and i > 1
        turning = _of_point(f"omega_{i - 1}", f"p_{i}") if turns_before else ()
        before = add(Symbol(f"o_{i - 1}_ddot"), *turning)
        terms: list[Expr] = [transpose(rotation(i)) * before]
        if link.joint == "prismatic":
            terms.append(multiply(_rise(link), Symbol(f"e_{i}")))
            if i > 1:
                spin = cross(self._carried(i, "omega_{}"), multiply(_rate(link), Symbol(f"e_{i}")))
                terms.append(2 * spin)
        if any(row.arm):
            terms += _of_point(f"omega_{i}", f"r_{i}")
        return add(*terms)

    def _body(self, i: int, found: Swept) -> Iterator[Line]:
        body, omega = self.bodies[i], Symbol(f"omega_{i}")
        at_com = _of_point(f"omega_{i}", f"r_c{i}") if body.com else ()
        if self._heavy(i):
            yield _line(i, f"o_c{i}_ddot", add(Symbol(f"o_{i}_ddot"), *at_com), found.a_c, "outward")
            yield _line(i, f"F_{i}", multiply(body.body.mass, Symbol(f"o_c{i}_ddot")), found.F, "outward")
        if body.turns:
            moment = body.I * Symbol(f"omega_{i}_dot") + cross(omega, body.I * omega)
            yield _line(i, f"N_{i}", moment, found.N, "outward")

    def _force(self, i: int) -> Expr:
        own = Symbol(f"F_{i}") if self._heavy(i) else ZERO
        return self._handed(i, "f_{}") + own

    def _handed(self, i: int, name: str) -> Expr:
        """What the next link hands down, in frame i."""
        if i == len(self.swept):
            return ZERO
        return rotation(i + 1) * Symbol(name.format(i + 1))

    def _moment(self, i: int) -> Expr:
        """About the point of the axis of joint i."""
        terms = [self._handed(i, "mu_{}")]
        body = self.bodies.get(i)
        if body and body.turns:
            terms.append(Symbol(f"N_{i}"))
        lever = add(*self._lever(i), *([Symbol(f"r_c{i}")] if body and body.com else []))
        if self._heavy(i) and lever != ZERO:
            terms.append(cross(lever, Symbol(f"F_{i}")))
        if i < len(self.swept):
            onward = [Symbol(f"p_{i + 1}")] if any(self.arm.rows[i].out) else []
            if (reach := add(*self._lever(i), *onward)) != ZERO:
                terms.append(cross(reach, self._handed(i, "f_{}")))
        return add(*terms)

    def _lever(self, i: int) -> list[Expr]:
        return [Symbol(f"r_{i}")] if any(self.arm.rows[i - 1].arm) else []


def _drive(link: Link) -> tuple[Expr, ...]:
    """What rotor and friction add to a joint force."""
    rotor = multiply(reflected(link.motor), _rise(link))
    return (*([rotor] if rotor != ZERO else []), *resistance(link.friction, link.variable or ""))


def _of_point(omega: str, r: str) -> tuple[Expr, Expr]:
    """What a point at r accelerates more than the origin: alpha x r + w x (w x r)."""
    arm, w = Symbol(r), Symbol(omega)
    return cross(Symbol(f"{omega}_dot"), arm), cross(w, cross(w, arm))


def rotation(i: int) -> Symbol:
    """R_2^1, which takes frame 2 to frame 1."""
    return Symbol(f"R_{i}^{i - 1}")


def _rate(link: Link) -> Symbol:
    return Symbol(f"{link.variable}_dot")


def _rise(link: Link) -> Symbol:
    return Symbol(f"{link.variable}_ddot")


def _constant(name: str, value: Vector) -> Line:
    return Line(Symbol(name), Symbol(name), ScalarMatrix.column(value), "constant")


def _line(i: int, name: str, formula: Expr, value: Vector, rule: str) -> Line:
    return Line(Symbol(name), formula, ScalarMatrix.column(value), rule, i)
