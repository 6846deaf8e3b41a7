"""Between unit quaternions on the shorter arc (Shoemake, Animating rotation with quaternion curves, 1985)."""

from __future__ import annotations

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.algebra.numbers.floats import matrix_numbers, numbers
from derive.algebra.scalar import Scalar
from derive.derivation import Phrase, Step
from derive.errors import NotDerivable
from derive.expression import (
    ONE,
    ZERO,
    Approximate,
    Call,
    Degrees,
    Expr,
    Matrix,
    Symbol,
    column,
    multiply,
    negate,
    number,
    sin,
    transpose,
)
from derive.kinds.path._turning.course import Course, Part, Way
from derive.kinds.path._turning.one_axis import half_turn, steadily, turn_between
from derive.kinds.pose._meanings import turn_of
from derive.kinds.pose._numbers import over, size
from derive.kinds.problem import Problem


def by_quaternions(course: Course) -> Way:
    """Raises NotDerivable where nothing turns."""
    R_s, R_f, q_s, q_f, half, u, q, k = (
        course.name(*each)
        for each in (
            ("R_0", "R_i"), ("R_f", "R_e"), ("q_0", "h_0"), ("q_f", "h_f"), ("Omega", "beta"),
            ("u", "lambda"), ("q", "h"), ("k", "n"),
        )
    )  # fmt: skip
    first, last = (course.rotation(end) for end in (course.turned.start, course.turned.end))
    angle, axis = turn_between(course, first.T @ last)
    begin, end = quaternion(course, first), quaternion(course, last)
    end = end if _is_nearer(begin, end, axis) else column(negate(entry) for (entry,) in end.rows)
    arc = _half(angle)
    shares = course.shares(u)
    left, right = multiply(sin(multiply(ONE - u, half)), q_s), multiply(sin(multiply(u, half)), q_f)
    steps = (
        Step("R_s", (R_s, course.readable(first)), "in-numbers"),
        Step("R_f", (R_f, course.readable(last)), "in-numbers"),
        Step("q_s", (q_s, begin), "in-numbers"),
        Step("q_f", (q_f, end), "in-numbers"),
        Step("Omega", (half, Call("acos", (multiply(transpose(q_s), q_f),)), arc), "in-numbers"),
        *shares,
        Step("q", (q, (left + right) / sin(half)), "in-numbers"),
        Step("k", (k, axis), "in-numbers"),
    )
    parts = (
        Part(said=Phrase("turns-from-to", {"R_s": R_s, "R_f": R_f}), lines=("R_s", "R_f")),
        Part(said=Phrase("unit-quaternions"), lines=("q_s", "q_f")),
        Part(said=Phrase("angle-between", {"q_s": q_s, "q_f": q_f}), lines=("Omega",)),
        Part(said=Phrase("on-the-arc", {"u": u}), lines=(shares[0].name,)),
        Part(said=Phrase("quaternion-is"), lines=("q",), answers=True),
        Part(said=Phrase("axis-between", {"twice": multiply(number(2), half)}), lines=("k",), answers=True),
    )
    known: dict[Expr, Expr] = {u: course.share, half: arc, q_s: begin, q_f: end, k: axis}
    whole = Way(
        parts,
        steps,
        known,
        {"q": _blended(begin, end, u, arc, course.problem), "axis": axis},
        {"q": q.name, "axis": k.name},
        {"R_s": R_s, "R_f": R_f, "q_s": q_s, "q_f": q_f, "arc": half, "share": u, "q": q, "axis": k},
    )
    return whole.followed_by(steadily(course, shares, (R_s, first), multiply(number(2), half), (k, axis)))


def _half(angle: Expr) -> Expr:
    match angle:
        case Degrees(value):
            return Degrees(value / 2)
        case Approximate(value):
            return Approximate(value / 2)
    return angle / 2


def quaternion(course: Course, R: ScalarMatrix) -> Matrix:
    """Of a rotation, scalar part first and not negative (Siciliano et al., eqs. 2.34 and 2.35)."""
    if course.rounded:
        import numpy as np

        angle, k = turn_of(np.array(matrix_numbers(R, {})))
        parts_of = [np.cos(angle / 2), *(np.sin(angle / 2) * k)]
        return column(Approximate(float(each)) for each in parts_of)
    problem = course.problem
    square = sum((R[i, i] for i in range(3)), Scalar.of(1)) / 4
    if square == 0:
        return column((ZERO, *half_turn(course, R)))
    parts = (R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1])
    return column((size(square, problem), *(over(part / 4, square, problem) for part in parts)))


def _is_nearer(begin: Matrix, end: Matrix, axis: Matrix) -> bool:
    """Whether the second goes the shorter way from the first, about this axis and not its opposite."""
    import numpy as np

    (a, *v), (b, *w), k = (list(map(float, _flat(each))) for each in (begin, end, axis))
    between = a * np.array(w) - b * np.array(v) - np.cross(v, w)
    return bool(between @ np.array(k) > 0)


def _flat(matrix: Matrix) -> list[float]:
    return [numbers(entry, {}) for (entry,) in matrix.rows]


def _blended(begin: Matrix, end: Matrix, u: Symbol, arc: Expr, problem: Problem) -> Matrix:
    """The quaternion at a share of the way, with what is known put in."""
    weights = (sin(multiply(ONE - u, arc)) / sin(arc), sin(multiply(u, arc)) / sin(arc))
    rows = zip(begin.rows, end.rows, strict=True)
    return column(_written(multiply(weights[0], a) + multiply(weights[1], b), problem) for (a,), (b,) in rows)


def _written(tree: Expr, problem: Problem) -> Expr:
    try:
        return problem.readable(normal(tree, problem.names))
    except NotDerivable:
        return tree
