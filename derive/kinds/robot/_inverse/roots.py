"""The real roots of Pieper's quartic at a pose, and the solutions that they give there.

On the page a root is one more name that is given. In numbers the polynomial is solved, its roots isolated by
ball arithmetic (`fmpz_poly.complex_roots` of FLINT), and each put in.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from dataclasses import replace as replaced
from fractions import Fraction
from functools import cached_property, reduce
from itertools import pairwise
from math import lcm
from typing import get_args

from derive.algebra.numbers.arrays import arrays
from derive.algebra.numbers.compiled import compiled
from derive.algebra.numbers.floats import Point, scalar_number
from derive.derivation import Claim, Phrase
from derive.errors import NotDerivable
from derive.expression import ONE, Approximate, Expr, Symbol, add, multiply, replace
from derive.kinds.checks import close, route
from derive.kinds.robot._inverse.branches import Solutions
from derive.kinds.robot._inverse.evaluated import Evaluated, Numbers, with_rotation
from derive.kinds.robot._inverse.facts import AtPlace, Polynomial
from derive.kinds.robot._inverse.subproblem import Definition, Solved
from derive.kinds.robot._inverse.target import SAME, Target, Values
from derive.kinds.robot._inverse.worked import Worked
from derive.mechanics.inverse.plan import Plan
from derive.mechanics.inverse.subproblems import Quartic

SMALL = 1e-12  # of a coefficient against the largest: zero, but for rounding
TREES = get_args(Expr)
MEETING = 1e-6  # how near to each other, or to the real line, two roots count as one
TURNS = 720  # angles at which the equation is looked at
COUNTED = {0: "quartic-without-roots", 1: "quartic-with-one-root"}
TRIED = (-1.3, 0.4, 2.5)  # roots at which the polynomial is looked at


@dataclass(frozen=True)
class Roots:
    """A quartic, and the sub-problem as it was worked."""

    found: Quartic
    solved: Solved
    solutions: Solutions
    target: Target
    square: bool  # whether a wrist makes every orientation: its axes are perpendicular, or there is none

    @staticmethod
    def of(plan: Plan, worked: Worked, solutions: Solutions, target: Target) -> Roots | None:
        """Those of a plan that has a quartic."""
        if plan.quartic is None:
            return None
        number, found = plan.quartic
        return Roots(found, worked.solved[number], solutions, target, _is_square(worked))

    @property
    def names(self) -> frozenset[str]:
        """What is found in numbers."""
        return frozenset({self.found.root})

    @property
    def joint(self) -> str:
        """The angle that a root gives."""
        ((joint, _),) = self.found.unknown.parts
        return joint

    def named(self, points: Sequence[Point]) -> tuple[Values, ...]:
        """Poses with the joint values they come from, and with the roots that belong to these."""
        return tuple({**each, self.found.root: math.tan(each[self.joint] / 2)} for each in points)

    @cached_property
    def polynomial(self) -> Expr:
        """What is zero, in the root and what is given."""
        left, *_, right = self._told.quartic[0].chain
        names: dict[Expr, Expr] = {}
        for item in self.solutions.items:
            if isinstance(item, Definition):
                names[item.name] = replace(item.value, names)
        return replace(left - right, names)

    def at(self, point: Point) -> list[float]:
        """The real roots, infinity for half a turn. Raises ZeroDivisionError where every angle is one."""
        return _apart(sorted(root for row in self._coefficients(point) for root in _real_roots(row)))

    def each(self, point: Values, in_numbers: Callable[[Values], Evaluated]) -> Evaluated:
        """The solutions for every real root at a point. Raises NotDerivable where every angle is one."""
        at = with_rotation(point)[0]
        try:
            roots = self.at(at)
        except ZeroDivisionError as error:
            raise NotDerivable(
                f"every coefficient of the quartic is zero at this place, so that {self.joint} can be chosen "
                "freely"
            ) from error
        parts = tuple(in_numbers({**point, self.found.root: root}) for root in roots)
        found = _together(parts, self.found.root, self.solutions)
        there = found.numbers or Numbers(point, at, 1.0, 0.0)
        return replaced(found, numbers=there, said=(self._said(at, roots),))

    def _said(self, point: Point, roots: Sequence[float]) -> Phrase:
        """The quartic in numbers, and how many real roots it has."""
        u = Symbol(self.found.root)
        bare = reduce(_product, self._coefficients(point))
        there = max(TRIED, key=lambda root: abs(_value(bare, root)))
        scale = compiled(self.polynomial)({**point, u.name: there}) / _value(bare, there)
        coefficients = [scale * each for each in bare]
        powers = [u**n for n in range(len(coefficients) - 1, 1, -1)] + [u, ONE]
        least = SMALL * max(map(abs, coefficients))
        terms = [
            multiply(Approximate(each), power)
            for each, power in zip(coefficients, powers, strict=True)
            if abs(each) > least
        ]
        return Phrase(COUNTED.get(len(roots), "quartic-there"), {"quartic": add(*terms), "count": len(roots)})

    def _coefficients(self, point: Point) -> list[list[float]]:
        """Of each factor, the highest power first."""
        known = self.solutions.at_home(point)
        return [[scalar_number(each, known) for each in factor] for factor in self.found.factors]

    @property
    def _told(self) -> Polynomial:
        told = self.solved.facts.method.quartic
        assert told is not None
        return told

    def claims(self, points: Sequence[Point], values: Evaluated) -> Iterator[Claim]:
        """At poses the arm reaches: every root is a solution, and every change of sign of the equation in the
        angle, before the half angle, belongs to a root; where none is real at a place, there is none."""
        key = "each-root" if self.square else "roots-that-reach"
        yield route(key, (each for point in points for each in self._reach(point)))
        tried = (*points, values.numbers.point) if values.numbers else points
        yield route("every-root", (each for point in tried for each in self._are_met(point)))
        printed = [each for point in points for each in self._is_printed(point)]
        printed += [each for point in points for each in self._is_squared(point)]
        if values.numbers:
            printed += self._is_said(values.numbers.point, *values.said)
        yield route("quartic", printed)
        if values.parts is not None and values.numbers:
            yield route("placed", self._all_kept(values, values.numbers.point))

    def _all_kept(self, values: Evaluated, point: Point) -> Iterator[bool]:
        """Whether the solutions for each root are among those of all, and none is where there is no root."""
        entries = values.values["solutions"]
        count = len(self.at(point))
        yield len(values.parts or ()) == count
        yield len(entries) == (sum(len(p.values["solutions"]) for p in values.parts or ()) or len(entries))
        yield count > 0 or values.place.out_of_reach
        yield count > 0 or not any(each.get("real", True) for each in entries)

    def _is_printed(self, point: Point) -> Iterator[bool]:
        """Whether the polynomial as printed is the equation in the angle times (1 + u^2)^2."""
        printed, known = compiled(self.polynomial), self.solutions.at_home(point)
        sides = [compiled(self._told.joined[0].chain[k]) for k in (0, -1)]
        for root in TRIED:
            left, right = (side({**known, self.joint: 2 * math.atan(root)}) for side in sides)
            there = printed({**point, self.found.root: root})
            yield close(there, (left - right) * (1 + root**2) ** 2, SAME)

    def _is_squared(self, point: Point) -> Iterator[bool]:
        """Whether the square of every root is one of those told."""
        squares = [
            float(arrays(step.chain[-1], self.solutions.at_home(point))) for step in self._told.squared
        ]
        for root in self.at(point):
            yield not squares or any(close(root**2, each, SAME) for each in squares)

    def _is_said(self, point: Point, said: Phrase) -> Iterator[bool]:
        """Whether the polynomial in numbers is the one as printed, and how many roots it is said to have."""
        polynomial, tree = compiled(self.polynomial), said.about["quartic"]
        for root in TRIED:
            at = {**point, self.found.root: root}
            yield isinstance(tree, TREES) and close(arrays(tree, at), polynomial(at), SAME)
        count = {key: number for number, key in COUNTED.items()}.get(said.key, said.about["count"])
        yield count == len(self.at(point))

    def _reach(self, point: Point) -> Iterator[bool]:
        for root in self.at(point):
            there = [v for v in self.solutions.at({**point, self.found.root: root}) if v is not None]
            yield bool(there) or not self.square
            yield from (self.target.reached(point, values) for values in there)

    def _are_met(self, point: Point) -> Iterator[bool]:
        import numpy as np

        angles = [2 * math.atan(root) for root in self.at(point)]
        (step,) = self._told.joined
        q = np.linspace(-math.pi, math.pi, TURNS + 1)
        known, sides = self.solutions.at_home(point), [compiled(step.chain[k]) for k in (0, -1)]
        there = [[side({**known, self.joint: float(each)}) for side in sides] for each in q]
        off = np.array([left - right for left, right in there])
        crossed = np.flatnonzero(np.sign(off[1:]) != np.sign(off[:-1]))
        width = 2 * math.pi / TURNS
        yield bool(angles) or not len(crossed)
        for k in crossed:
            middle = float(q[k] + q[k + 1]) / 2
            yield any(abs(math.remainder(each - middle, 2 * math.pi)) <= width for each in angles)


def _together(parts: tuple[Evaluated, ...], root: str, solutions: Solutions) -> Evaluated:
    """What is said of all roots; where there is none, that no branch is real."""
    if not parts:
        entries = [{"when": when, "real": False} for when in solutions.conditions]
        return Evaluated({"solutions": entries}, AtPlace(out_of_reach=True), parts=())
    values = [part.numbers.point[root] for part in parts if part.numbers]
    finite = all(map(math.isfinite, values))  # no number stands for half a turn
    entries = [
        {**({root: value} if finite else {}), **each}
        for part, value in zip(parts, values, strict=True)
        for each in part.values["solutions"]
    ]
    place = AtPlace(
        out_of_reach=all(part.place.out_of_reach for part in parts),
        missed=not any(each.get("real", True) for each in entries),
        free=any(part.place.free for part in parts),
        rounded=any(part.place.rounded for part in parts),
    )
    return Evaluated(
        {"solutions": entries},
        place,
        parts[0].numbers,
        tuple(each for part in parts for each in part.branches),
        max((part.off for part in parts if part.off is not None), default=None),
        parts,
    )


def _is_square(worked: Worked) -> bool:
    chain, names = worked.chain, worked.spherical
    axes = [chain.axis(i) for i, joint in chain.moving if joint.variable in names]
    return all(not (one.T @ other)[0, 0] for one, other in pairwise(axes))


def _product(one: Sequence[float], other: Sequence[float]) -> list[float]:
    """Of two polynomials."""
    import numpy as np

    return [float(each) for each in np.polymul(one, other)]


def _value(coefficients: Sequence[float], root: float) -> float:
    return reduce(lambda total, each: total * root + each, coefficients)


def _real_roots(coefficients: Sequence[float]) -> Iterator[float]:
    """Of a polynomial, the highest power first; infinity where that has no coefficient."""
    from flint import fmpz_poly

    largest = max(map(abs, coefficients))
    if not largest:
        raise ZeroDivisionError("the quartic vanishes")
    exact = [Fraction(each) if abs(each) > SMALL * largest else Fraction(0) for each in coefficients]
    if not exact[0]:
        yield math.inf
    scale = lcm(*(each.denominator for each in exact))
    whole = fmpz_poly([int(each * scale) for each in reversed(exact)])
    if whole.degree() < 1:
        return
    for root, _ in whole.complex_roots():
        real, imaginary = float(root.real.mid()), float(root.imag.mid())
        if abs(imaginary) <= MEETING * max(1.0, abs(real)):
            yield real


def _apart(roots: Sequence[float]) -> list[float]:
    """Those that meet once."""
    found: list[float] = []
    for root in roots:
        if not found or math.isinf(root) or root - found[-1] > MEETING * max(1.0, abs(root)):
            found.append(root)
    return found
