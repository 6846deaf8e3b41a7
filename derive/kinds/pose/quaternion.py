"""A rotation as a unit quaternion, scalar part first."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import Any

from derive.algebra.numbers.floats import Point, numbers
from derive.algebra.scalar import Scalar
from derive.derivation import Derivation, PageFacts, Phrase, Said, Step
from derive.expression import ONE, ZERO, Matrix, Symbol, add, column, multiply, number, sqrt
from derive.kinds.meanings import Names, as_told, column_of, told
from derive.kinds.pose._given import Given, given_pose, lacking, of_any_rotation
from derive.kinds.pose._given import PoseOptions as Options
from derive.kinds.pose._meanings import entries_of, printed, turn_of
from derive.kinds.pose._numbers import over, size
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.names import free

SUBJECTS = ("motion", "frames", "robot")
CLAIMS = ("turns-the-axes", "as-told")


class Facts(PageFacts):
    before: Phrase  # the scalar part
    after: Phrase  # it, before the rest


def derive(subject: Any, options: Options, problem: Problem) -> Derivation:
    """q_0 from the trace, the rest from the antisymmetric part of R (Siciliano et al., eqs. 2.34 and 2.35);
    from the diagonal for half a turn."""
    given = given_pose(options, problem)
    square = sum((given.R[i, i] for i in range(3)), Scalar.of(1)) / 4
    name = Symbol(free(problem.taken, "q", "h", "q_r"))
    scalar, half = Symbol(f"{name.name}_0"), square == 0
    q = column((ZERO, *given.half_turn()[1])) if half else _value(given, square)
    steps = (Step("q_0", (scalar, ZERO)), Step("q", (name, q))) if half else _steps(given, name, scalar, q)
    work = Work(problem, {**given.entries, name: q}, uses=given.uses, steps=steps).linked(but=("q_0", "q"))
    work = work.agrees("turns-the-axes", problem.symbols, lambda at: _turned(q, at), given.turns, 1e-8)
    facts = Facts(before=_before(given, scalar, half), after=_after(given, half))
    work = as_told(work, partial(_meant, given, name, scalar, q), ((name, q),))
    if not half:
        anywhere = partial(_meant, of_any_rotation(given), name, scalar, None)
        formulas = [step.chain[:2] for step in steps]
        work = work.claim(told(formulas, anywhere, (), {}, "in-general"))
    work = work.law("said", _said(facts, given, scalar, q))
    return work.answer("quaternion", {"q": q}, facts)


def _before(given: Given, scalar: Symbol, half: bool) -> Phrase:
    about: dict[str, Said] = {"R": given.rotation}
    return Phrase("half-turn", about) if half else Phrase("diagonal", about | {"scalar": scalar})


def _after(given: Given, half: bool) -> Phrase:
    return Phrase("along-the-axis") if half else Phrase("lacking", {"R": given.rotation})


def _said(facts: Facts, given: Given, scalar: Symbol, q: Matrix) -> Iterator[bool]:
    """Which way is told, by the scalar part that was found."""
    half = q.rows[0][0] == ZERO
    yield (facts.before.key, facts.after.key) == (
        ("half-turn", "along-the-axis") if half else ("diagonal", "lacking")
    )
    yield all(each.about.get("R", given.rotation) == given.rotation for each in (facts.before, facts.after))
    yield facts.before.about.get("scalar", scalar) == scalar


def _meant(given: Given, name: Symbol, scalar: Symbol, q: Matrix | None, at: Point) -> Names:
    """cos(angle/2), and the axis times sin(angle/2), of the rotation by its other route."""
    import numpy as np

    R = given.turns(at)
    angle, axis = turn_of(R, None if q is None else printed(q, at)[1:])
    parts = np.array([np.cos(angle / 2), *(np.sin(angle / 2) * axis)])
    return {**entries_of(R), given.rotation: R, name: column_of(parts), scalar: parts[0]}


def _steps(given: Given, name: Symbol, scalar: Symbol, q: Matrix) -> tuple[Step, ...]:
    """By the names of the entries, and their values where these can be read."""
    trace = add(ONE, *(Symbol(f"r_{i}{i}") for i in (1, 2, 3)))
    root_of = multiply(number("1/2"), sqrt(trace))
    formula = column((scalar, *(each / (4 * scalar) for each in lacking())))
    shown = all(given.shows(entry) for (entry,) in q.rows)
    first, whole = ((q.rows[0][0],), (q,)) if shown else ((), ())
    return Step("q_0", (scalar, root_of, *first)), Step("q", (name, formula, *whole))


def _value(given: Given, square: Scalar) -> Matrix:
    """The quaternion in the symbols of R, `square` that of its scalar part."""
    problem = given.problem
    parts = (over(part / 4, square, problem) for part in given.lacking)
    return column((size(square, problem), *parts))


def _turned(q: Matrix, at: Point) -> Any:
    """The axes (3 by 3), turned by v -> q v q*."""
    import numpy as np

    w, *v = numbers(q, at)
    return np.array([e + 2 * np.cross(v, np.cross(v, e) + w * e) for e in np.eye(3)]).T
