"""The one axis and the one angle that make a rotation in a single turn."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.algebra.numbers.floats import Point
from derive.algebra.readable.operation_count import operations
from derive.algebra.scalar import Scalar
from derive.derivation import Claim, Derivation, PageFacts, Result
from derive.expression import (
    ONE,
    ZERO,
    Call,
    Expr,
    Matrix,
    Symbol,
    add,
    atan2,
    column,
    cos,
    free_symbols,
    number,
    sin,
    sqrt,
    squared,
    transpose,
)
from derive.kinds.meanings import Chain, Names, as_told, column_of, told
from derive.kinds.pose._every_turn import EveryTurn, Singular
from derive.kinds.pose._every_turn_checks import put_back, turns_at
from derive.kinds.pose._given import Given, diagonal, given_pose, lacking
from derive.kinds.pose._given import PoseOptions as Options
from derive.kinds.pose._meanings import entries_of, printed, turn_of
from derive.kinds.pose._numbers import along, fixed_angle, is_short, known_angle, over, size
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.motion import Move
from derive.mechanics.oracle import elementary
from derive.mechanics.oracle.poses import turn
from derive.names import free

SUBJECTS = ("motion", "frames", "robot", "rotation")
OF_EULER = frozenset({"euler-angles", "euler-rates"})
CLAIMS = ("as-told",)
CLAIMED = {"solutions": "turns-again"}
LONGEST_ANGLE = 8  # operations above which the angle of symbols is left in what it is made of


class Facts(PageFacts):
    rotation: Symbol
    angle: Symbol | None = None
    axis: Symbol | None = None
    turned: Symbol | None = None  # along the axis; it may vanish
    plus: Expr | None = None  # then: R and the identity, whose columns lie along the axis of half a turn
    twice: tuple[Expr, Expr] | None = None  # what that is
    law: tuple[Expr, Expr] | None = None  # of half a turn
    trace: tuple[Expr, Expr] | None = None  # of R, by the angle
    half: Expr | None = None  # a turn, the largest angle
    by: Expr | None = None  # of numbers: the angle, and a vector
    along: Matrix | None = None  # along the axis
    opposite: tuple[Expr, Expr] | None = None  # the angle and the axis of the turn that is as good
    singular: Singular | None = None  # of any rotation


@dataclass(frozen=True, slots=True)
class _Names:
    """What the angle, the axis and the vector 2 sin(angle) axis are called here."""

    angle: Symbol
    axis: Symbol
    turn: Symbol

    @staticmethod
    def of(problem: Problem) -> _Names:
        axis = free(problem.taken, "k", "u", "n", "k_r")
        turned = any(kind in OF_EULER for kind, _ in problem.questions)  # whose angles are phi, theta, psi
        angles = ("alpha", "beta") if turned else ("theta", "phi", "alpha")
        return _Names(
            Symbol(free(problem.taken, *angles, "theta_k")),
            Symbol(axis),
            Symbol(free({*problem.taken, axis}, "w", "v", "u", "w_r")),
        )

    @property
    def length(self) -> Expr:
        """Of that vector: twice the sine."""
        return Call("abs", (self.turn,))


def derive(subject: Any, options: Options, problem: Problem) -> Derivation:
    """The angle (rad, from 0 to pi) from the trace, the axis (3 by 1) from the antisymmetric part of R; from
    R + 1 for half a turn (Siciliano et al., eqs. 2.27 and 2.28)."""
    given, names = given_pose(options, problem), _Names.of(problem)
    work = Work(problem, given.entries, uses=given.uses)
    if ScalarMatrix.identity(3) == given.R:
        return _nothing(work, given, names)
    half = given.R == given.R.T
    work, angle, axis = (_half_turn if half else _general)(work, given, names)
    work = _in_general(work, names)
    if given.numeric:
        k = normal_matrix(axis)
        work = work.law("unit-axis", (k.T @ k)[0, 0] == 1).law("axis-stays", given.R @ k == k)
    (x,), (y,), (z,) = axis.rows
    move = Move("rotate", (x, y, z), angle)
    work = work.agrees(
        "orientation-again",
        problem.symbols,
        lambda at: elementary(move, given.place(at))[:3, :3],
        given.turns,
        1e-8,
    )
    facts = replace(
        _half_facts(given, names) if half else _facts(given, names),
        angle_results=("angle",),
        style=problem.style,
        page_names={"angle": names.angle, "axis": names.axis},
        by=angle if given.numeric and is_short(angle) else None,
        along=along(axis) if given.numeric and is_short(angle) else None,
    )
    work = as_told(
        work,
        partial(_meant, given, names, axis),
        (*_told(given, names, facts), (names.angle, angle), (names.axis, axis)),
    )
    if facts.plus is not None:
        work = work.claim(_of_half_turns(given, names, facts.plus))
    work = work.law("said", ((facts.law is None) != half, (facts.turned is None) == (half or given.numeric)))
    results: dict[str, Result] = {"angle": angle, "axis": axis}
    if not given.every:
        return work.answer("axis-angle", results, facts)
    turns = EveryTurn(given, names.angle, names.axis)
    branches = turns.branches(angle, axis, half)
    if given.named:
        work = replace(work, steps=(*work.steps, *turns.steps()))
        facts = replace(facts, singular=turns.facts())
    work = work.claim(*put_back(turns, branches, {step.name: step.chain for step in work.steps}))
    facts = replace(facts, met=True, numbers=("solutions",) if options.evaluate else None)
    if not half:
        facts = replace(facts, opposite=(-names.angle, -names.axis))
    evaluated = turns_at(turns, options.evaluate, branches)
    return work.answer("axis-angle", {**results, "solutions": branches}, facts, evaluated=evaluated)


def _meant(given: Given, names: _Names, axis: Matrix | None, at: Point) -> Names:
    """The rotation by its other route; its angle and axis by what it does."""
    import numpy as np

    R, there = given.turns(at), given.place(at)
    angle, k = turn_of(R, None if axis is None else printed(axis, there))
    letters: Names = {Symbol(name): value for name, value in there.items()}
    return {**letters, **_called(names, R, angle, k), given.rotation: R, Symbol("I"): np.eye(3)}


def _called(names: _Names, R: Any, angle: float, k: Any) -> dict[Expr, Any]:
    """What stands for the entries of a rotation, its angle, its axis and w."""
    return {
        **entries_of(R), names.angle: angle, names.axis: column_of(k),
        names.turn: column_of(2 * math.sin(angle) * k), cos(names.angle): math.cos(angle),
    }  # fmt: skip


def _in_general(work: Work, names: _Names) -> Work:
    """With the claim that the formulas in these names hold of a rotation that has no two entries alike."""
    import numpy as np

    angle, k = 1.1, np.array([2.0, 3.0, 6.0]) / 7
    means = _called(names, turn(k, angle), angle, k)
    chains = [step.chain[:2] for step in work.steps if _of_entries(step.chain[1], means)]
    return work.claim(told(chains, lambda _: means, (), {}, "in-general")) if chains else work


def _of_half_turns(given: Given, names: _Names, plus: Expr) -> Claim:
    """That by half a turn about any axis the columns of what is told are multiples of the axis."""
    import numpy as np

    k = np.array([[2.0], [3.0], [6.0]]) / 7
    means: Names = {given.rotation: 2 * k @ k.T - np.eye(3), Symbol("I"): np.eye(3), names.axis: k}
    return told([(plus, 2 * names.axis * transpose(names.axis))], lambda _: means, (), {}, "in-general")


def _of_entries(formula: Expr, means: Names) -> bool:
    """Whether a formula is one in the names of entries."""
    used = {Symbol(name) for name in free_symbols(formula)}
    return bool(used) and used <= means.keys()


def _told(given: Given, names: _Names, facts: Facts) -> Iterator[Chain]:
    """The law that is told, and what the words call the rotation, its angle, its axis and w."""
    called = (
        (given.rotation, facts.rotation),
        (names.angle, facts.angle),
        (names.angle, facts.by),
        (names.axis, facts.axis),
    )
    yield from ((name, told) for name, told in (*called, (names.turn, facts.turned)) if told is not None)
    if facts.along is not None:
        yield names.axis, facts.along / Call("abs", (facts.along,))
    yield from (law for law in (facts.law, facts.twice, facts.trace) if law is not None)


def _facts(given: Given, names: _Names) -> Facts:
    """Of a rotation that is none by half a turn."""
    return Facts(
        rotation=given.rotation,
        angle=names.angle,
        axis=names.axis,
        turned=None if given.numeric else names.turn,
        plus=None if given.numeric or given.named else given.rotation + Symbol("I"),
        twice=(names.turn, 2 * names.axis * sin(names.angle)),
        trace=(diagonal(), 1 + 2 * cos(names.angle)),
        half=fixed_angle(Fraction(1), given.problem),
    )


def _half_facts(given: Given, names: _Names) -> Facts:
    """R = 2 k k^T - 1."""
    twice = 2 * names.axis * transpose(names.axis)
    return Facts(rotation=given.rotation, law=(given.rotation, twice - Symbol("I")))


def _trace() -> Expr:
    """That, less one: twice the cosine of the angle."""
    return diagonal() - 1


def _nothing(work: Work, given: Given, names: _Names) -> Derivation:
    """The identity: the angle is zero, and every axis is as good as another."""
    work = work.line(cos(names.angle), _trace() / 2, value=ONE, label="cosine")
    work = _in_general(work.line(names.angle, value=ZERO, label="angle"), names)
    facts = Facts(rotation=given.rotation)
    work = as_told(work, partial(_meant, given, names, None), _told(given, names, facts))
    results: dict[str, Result] = {"angle": ZERO, "axis": "any"}
    if given.every:
        results["solutions"] = (EveryTurn(given, names.angle, names.axis).nothing(),)
    return work.answer("axis-angle", results, facts)


def _general(work: Work, given: Given, names: _Names) -> tuple[Work, Expr, Matrix]:
    """w = 2 sin(angle) k, the trace is 1 + 2 cos(angle); with the values where these can be read, else with
    those of w and the cosine. Angle and axis are checked by their second route alone."""
    angle_of, axis_of = atan2(names.length, _trace()), names.turn / names.length
    angle, axis = _value(given) if given.short and not given.named else _long(given)
    shown = given.short and given.shows(angle) and (given.numeric or operations(angle) <= LONGEST_ANGLE)
    exact = known_angle(angle, work.problem) if given.numeric and shown else angle
    if given.short and not given.named:
        work = work.line(names.turn, column(lacking()), label="w")
    else:
        work = work.line(names.turn, value=column(lacking()), label="w")
    if given.short and not given.numeric:
        value = _trace() / 2 if given.named else None
        work = work.line(cos(names.angle), _trace() / 2, value=value, rule="cosine", label="cosine")
    if shown:
        work = work.line(names.angle, angle_of, angle, value=exact, label="angle")
        work = work.line(names.axis, axis_of, value=axis, label="axis")
    else:
        work = work.line(names.angle, value=angle_of, label="angle")
        work = work.line(names.axis, value=axis_of, label="axis")
        work = work.knowing({names.angle: angle, names.axis: axis})
    unlinked = ("w", "cosine", "angle", "axis") if given.named else ("angle", "axis")
    return work.linked(but=unlinked if given.short else ("w", "angle", "axis")), exact, axis


def _value(given: Given) -> tuple[Expr, Matrix]:
    """The angle and the axis as trees, in the symbols of R."""
    square = sum((part * part for part in given.lacking), Scalar.of(0))
    angle = atan2(size(square, given.problem), given.problem.readable(_cosine(given)))
    return angle, column(over(part, square, given.problem) for part in given.lacking)


def _cosine(given: Given) -> Scalar:
    """Twice that of the angle."""
    return sum((given.R[i, i] for i in range(3)), Scalar.of(-1))


def _long(given: Given) -> tuple[Expr, Matrix]:
    """The angle and the axis of a rotation with long entries: w component by component, its length left
    as a root of squares."""
    w = tuple(map(given.problem.readable, given.lacking))
    length = sqrt(add(*map(squared, w)))
    return atan2(length, given.problem.readable(_cosine(given))), column(part / length for part in w)


def _half_turn(work: Work, given: Given, names: _Names) -> tuple[Work, Expr, Matrix]:
    """R = 2 k k^T - 1: each column of (R + 1)/2 is a multiple of k."""
    outer, entries = given.half_turn()
    angle, axis = known_angle(atan2(ZERO, number(-1)), work.problem), column(entries)
    work = work.line(names.axis * transpose(names.axis), value=outer, rule="given", label="outer")
    work = work.line(names.axis, value=axis, label="axis").line(names.angle, value=angle, label="angle")
    return work.linked(but=("outer", "angle", "axis")), angle, axis
