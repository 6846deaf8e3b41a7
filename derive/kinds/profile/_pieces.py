"""A trajectory in pieces: as results, as claims about where they meet, and as a course in floats."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

from derive.algebra.numbers.floats import number as value_of
from derive.algebra.scalar import Scalar
from derive.derivation import Branch, Claim, Phrase
from derive.errors import NotDerivable
from derive.expression import ONE, ZERO, Degrees, Expr, Relation, Symbol, add, multiply, number
from derive.kinds.checks import law
from derive.kinds.fields import Place
from derive.kinds.problem import Problem
from derive.kinds.values_at import point_of
from derive.kinds.work import Work
from derive.mechanics.course import Course, Piece

t = Symbol("t")
CONTINUOUS = ("q-is-continuous", "velocity-is-continuous", "acceleration-is-continuous")


@dataclass(frozen=True, slots=True)
class Span:
    """q = a_0 + a_1 (t - start) + ... from `start` to `end`."""

    start: Expr
    end: Expr
    coefficients: tuple[Expr, ...]

    @property
    def law(self) -> Expr:
        """q as a function of t."""
        tau = t if self.start == ZERO else t - self.start
        return add(*(term(c, tau, k) for k, c in enumerate(self.coefficients))) or ZERO

    def derivative(self, working: Work, tau: Scalar, order: int) -> Scalar:
        """Exactly, at the time tau after the start."""
        coefficients = [working.scalar(c) for c in self.coefficients]
        for _ in range(order):
            coefficients = [c * k for k, c in enumerate(coefficients)][1:]
        total = Scalar.of(0)
        for coefficient in reversed(coefficients):
            total = total * tau + coefficient
        return total


def term(coefficient: Expr, tau: Expr, k: int) -> Expr:
    """c tau^k, a minus sign in front of all."""
    power = ONE if k == 0 else tau if k == 1 else tau ** number(k)
    if isinstance(coefficient, Degrees) and coefficient.value < 0:
        return multiply(number(-1), Degrees(-coefficient.value), power)
    return multiply(coefficient, power)


def branch(q: Expr, start: Expr, end: Expr, problem: Problem) -> Branch:
    """A piece of the trajectory, and when."""
    between = Relation(Relation(problem.final(start), "<=", t), "<=", problem.final(end))
    return Branch({"q": problem.final(q)}, (Phrase("between", {"times": between}),))


def times_of(piece: Branch) -> Relation:
    """When a piece of a trajectory holds, as it is told."""
    (said,) = piece.when
    times = said.about["times"] if isinstance(said, Phrase) else said
    if not isinstance(times, Relation):
        raise TypeError("a piece of a trajectory without its times")
    return times


def joined(spans: Sequence[Span], working: Work, orders: int) -> Iterator[Claim]:
    """Where two pieces meet, the derivatives below `orders` agree."""
    for order in range(orders):
        lengths = (working.scalar(before.end - before.start) for before, _ in pairwise(spans))
        met = (
            before.derivative(working, length, order) == after.derivative(working, Scalar.of(0), order)
            for length, (before, after) in zip(lengths, pairwise(spans), strict=True)
        )
        yield law(CONTINUOUS[order], met)


def in_floats(spans: Sequence[Span], evaluate: Place | None, problem: Problem) -> Course | None:
    """The course, where every value is known. Raises NotDerivable where it is none."""
    try:
        point = point_of({n: v for n, v in evaluate or () if n != "t"}, problem.where)
        found = tuple(
            Piece(
                value_of(problem.final(span.start), point),
                value_of(problem.final(span.end), point),
                tuple(value_of(problem.final(c), point) for c in span.coefficients),
            )
            for span in spans
        )
    except KeyError:
        return None
    except (ValueError, ZeroDivisionError) as error:
        raise NotDerivable("there is no such trajectory at the point asked for", "evaluate") from error
    if any(piece.end < piece.start for piece in found):
        raise NotDerivable("the time is too short at the point asked for: its pieces overlap", "evaluate")
    return found
