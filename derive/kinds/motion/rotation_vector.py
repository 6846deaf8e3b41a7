"""The rotation vector: along the axis, as long as the angle."""

from __future__ import annotations

from fractions import Fraction
from functools import partial
from typing import Any

from derive.algebra.normal import normal, normal_matrix
from derive.algebra.numbers.floats import Point, numbers
from derive.algebra.scalar import Scalar
from derive.derivation import Derivation, LinearSystem, PageFacts, Phrase
from derive.errors import NotDerivable
from derive.expression import (
    ONE,
    PI,
    ZERO,
    Approximate,
    Call,
    Expr,
    Matrix,
    Symbol,
    column,
    free_symbols,
    multiply,
    number,
    walk,
)
from derive.kinds.fields import NoOptions as Options
from derive.kinds.meanings import Names, as_told, column_of
from derive.kinds.pose._meanings import printed, turn_of
from derive.kinds.pose._numbers import along, size
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.motion import Motion
from derive.mechanics.oracle import exponential, made
from derive.names import free

CLAIMS = ("exponential", "as-told")


class Facts(PageFacts):
    way: Phrase  # in which it is found


def derive(motion: Motion, options: Options, problem: Problem) -> Derivation:
    """r = theta k (3 by 1, rad); its exponential is the rotation (Lynch and Park, section 3.2.3).

    Raises NotDerivable where the rotation has no single axis.
    """
    turn, r = problem.ask("axis-angle"), Symbol(free(problem.taken, "rho", "r"))
    angle, axis = turn.results["angle"], turn.results["axis"]
    names, work = _named(turn), Work(problem, uses=(turn,))
    nothing = axis == "any"
    if nothing:  # whatever the axis is
        work = work.line(r, value=column((ZERO, ZERO, ZERO)), label="r")
    elif not isinstance(axis, Matrix) or isinstance(
        angle, tuple | LinearSystem | Phrase | float | str | Matrix
    ):
        raise NotDerivable("this rotation has no single axis")
    else:
        vector = column(_entry(angle, entry, problem) for (entry,) in axis.rows)
        work = _line(work, r, names, (angle, axis, vector)).knowing({r: vector})
    work = work.linked(but=("r",)).agrees(
        "exponential",
        problem.symbols,
        lambda at: _exponential(work.matrix(r), at),
        lambda at: made(motion.moves, at)[:3, :3],
        1e-8,
    )
    facts = Facts(way=Phrase("nothing-turned" if nothing else "as-long-as-the-angle"), page_names={"r": r})
    work = as_told(work, partial(_meant, motion, names, r, work.matrix(r)))
    still = set(work.entries(r)) == {ZERO}
    work = work.law("said", facts.way == Phrase("nothing-turned" if still else "as-long-as-the-angle"))
    return work.answer("rotation-vector", {"r": work[r]}, facts)


def _named(turn: Derivation) -> tuple[Symbol, Symbol]:
    """What the angle and the axis are called there; of nothing, usual names."""
    given = turn.facts.page_names
    angle, axis = (given.get(name, Symbol(name)) for name in ("angle", "axis"))
    if isinstance(angle, Symbol) and isinstance(axis, Symbol):
        return angle, axis
    return Symbol("theta"), Symbol("k")


def _line(work: Work, r: Symbol, names: tuple[Symbol, Symbol], of: tuple[Expr, Matrix, Matrix]) -> Work:
    """The angle times the axis, with what they are (`of`), and the vector: of numbers in decimals."""
    angle, axis, vector = of
    if free_symbols(vector):
        return work.line(r, names[0] * names[1], value=vector, label="r")
    turns = (normal(angle) / Scalar.symbol("pi")).constant
    whole = along(axis)
    length = size(normal_matrix(whole.T * whole)[0, 0], work.problem)
    known = () if turns is None else (multiply(_radians(turns, length), whole),)
    decimals = column(map(Approximate, numbers(vector, {})))
    return work.line(r, names[0] * names[1], *known, value=decimals, label="r")


def _radians(turns: Fraction, length: Expr) -> Expr:
    """So many pi by a length, as one fraction."""
    above, below = multiply(number(turns.numerator), PI), multiply(number(turns.denominator), length)
    return above if below == ONE else above / below


def _meant(motion: Motion, names: tuple[Symbol, Symbol], r: Symbol, of: Matrix, at: Point) -> Names:
    """The vector, the angle and the axis of the motion made in numbers."""
    angle, axis = turn_of(made(motion.moves, at)[:3, :3], printed(of, at))
    return {names[0]: angle, names[1]: column_of(axis), r: column_of(angle * axis)}


def _entry(angle: Expr, entry: Expr, problem: Problem) -> Expr:
    """A multiple of pi in its shortest form; any other angle stands before the entry."""
    if any(isinstance(node, Call) and node.function == "atan2" for node in walk(angle)):
        return multiply(angle, entry)
    return problem.readable(normal(multiply(angle, entry)))


def _exponential(vector: Matrix, at: Point) -> Any:
    """The rotation (3 by 3) by the series of its skew-symmetric matrix."""
    import numpy as np

    x, y, z = numbers(vector, at)
    return exponential(np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]]))
