"""About one axis: the turn between both orientations in proportion to the path (Siciliano et al., section
4.3.3; Spong et al., section 2.5.3)."""

from __future__ import annotations

from collections.abc import Iterator

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.algebra.numbers.floats import matrix_numbers
from derive.algebra.scalar import Scalar
from derive.derivation import Phrase, Step
from derive.errors import NotDerivable
from derive.expression import (
    ONE,
    ZERO,
    Approximate,
    Call,
    Expr,
    Matrix,
    Measured,
    Symbol,
    add,
    atan2,
    column,
    cos,
    multiply,
    number,
    sin,
    squared,
    transpose,
)
from derive.kinds.path._turning.course import Course, Part, Way
from derive.kinds.pose._given import diagonal, lacking
from derive.kinds.pose._meanings import turn_of
from derive.kinds.pose._numbers import known_angle, over, size
from derive.mechanics.poses import skew

NOTHING = "both orientations are the same: there is nothing to turn"
SMALL = 1e-9  # of a turn by rounded numbers
IDENTITY = Symbol("I")


def about_one_axis(course: Course) -> Way:
    """Raises NotDerivable where nothing turns."""
    R_s, R_f, between = (course.name(*each) for each in (("R_0", "R_i"), ("R_f", "R_e"), ("R", "R_d")))
    first, last = (course.rotation(end) for end in (course.turned.start, course.turned.end))
    D = first.T @ last
    half = is_half_turn(course, D)
    angle, axis = turn_between(course, D)
    theta_f, theta, k, u, S, R = (
        course.name(*each)
        for each in (
            ("theta_f", "phi_f", "vartheta_f"), ("theta", "phi", "vartheta"), ("k", "n", "e"),
            ("u", "lambda", "w"), ("S", "K"), ("R_b", "R_t"),
        )
    )  # fmt: skip
    K = skew(course.value(axis))
    now = _orientation(course, first, K, theta)
    formula = R_s * add(IDENTITY, multiply(sin(theta), S), multiply(ONE - cos(theta), squared(S)))
    shares = course.shares(u)
    steps = [
        Step("R_s", (R_s, course.readable(first)), "in-numbers"),
        Step("R_f", (R_f, course.readable(last)), "in-numbers"),
        Step("between", (between, transpose(R_s) * R_f, course.readable(D)), "in-numbers"),
        *_axis_steps(theta_f, k, between, angle, axis, half),
        *shares,
        Step("theta", (theta, multiply(u, theta_f)), "in-numbers"),
        Step("S", (S, course.readable(K)), "in-numbers"),
        Step("R", (R, formula, *(() if course.rounded else (now,))), "in-numbers"),
    ]
    parts = (
        Part(said=Phrase("turns-from-to", {"R_s": R_s, "R_f": R_f}), lines=("R_s", "R_f")),
        Part(said=Phrase("turn-between"), lines=("between",)),
        *_found(between, half),
        Part(said=Phrase("in-proportion", {"u": u}), lines=(shares[0].name, "theta")),
        Part(said=Phrase("rodrigues", {"k": k, "I": IDENTITY}), lines=("S",)),
        Part(said=Phrase("orientation-is"), lines=("R",), answers=True),
    )
    known: dict[Expr, Expr] = {u: course.share, theta: multiply(u, angle), theta_f: angle, k: axis}
    results: dict[str, Expr] = {"R": now, "angle": angle, "axis": axis}
    called = {"R_s": R_s, "R_f": R_f, "between": between, "angle": theta_f, "axis": k, "share": u}
    called |= {"turned": theta, "skew": S, "R": R}
    page = {"R": R.name, "angle": theta_f.name, "axis": k.name}
    whole = Way(parts, tuple(steps), known, results, page, called)
    return whole.followed_by(steadily(course, shares, (R_s, first), theta_f, (k, axis)))


def _found(between: Symbol, half: bool) -> Iterator[Part]:
    """How the angle and the axis are found."""
    if half:
        yield Part(said=Phrase("half-turn", {"I": IDENTITY}), lines=("law",))
        yield Part(said=Phrase("these-are"), lines=("theta_f", "k"), answers=True)
    else:
        yield Part(said=Phrase("angle-and-axis", {"R": between}), lines=("theta_f", "k"), answers=True)


def _orientation(course: Course, first: ScalarMatrix, K: ScalarMatrix, theta: Symbol) -> Matrix:
    """The formula of Rodrigues entry by entry."""
    eye, c, s = ScalarMatrix.identity(3), cos(theta), sin(theta)
    if not course.rounded:
        return course.readable(first @ (eye + K.scaled(normal(s)) + (K @ K).scaled(normal(ONE - c))))
    square = K @ K
    parts = (eye + square, K, square.scaled(Scalar.of(-1)))
    still, turned, back = (course.readable(first @ each).rows for each in parts)
    return Matrix(
        tuple(
            tuple(add(a, multiply(b, s), multiply(d, c)) for a, b, d in zip(*rows, strict=True))
            for rows in zip(still, turned, back, strict=True)
        )
    )


def turn_between(course: Course, D: ScalarMatrix) -> tuple[Expr, Matrix]:
    """The angle, from 0 to pi, and the axis. Raises NotDerivable where nothing turns."""
    if course.rounded:
        import numpy as np

        by, k = turn_of(np.array(matrix_numbers(D, {})))
        if by < SMALL:
            raise NotDerivable(NOTHING, "orientation")
        return Approximate(by), column(map(Approximate, map(float, k)))
    if ScalarMatrix.identity(3) == D:
        raise NotDerivable(NOTHING, "orientation")
    problem = course.problem
    if is_half_turn(course, D):
        return known_angle(atan2(ZERO, number(-1)), problem), column(half_turn(course, D))
    parts = (D[2, 1] - D[1, 2], D[0, 2] - D[2, 0], D[1, 0] - D[0, 1])
    square = sum((part * part for part in parts), Scalar.of(0))
    cosine = sum((D[i, i] for i in range(3)), Scalar.of(-1))
    angle = known_angle(atan2(size(square, problem), problem.readable(cosine)), problem)
    return angle, column(over(part, square, problem) for part in parts)


def is_half_turn(course: Course, D: ScalarMatrix) -> bool:
    """Whether it is its own inverse."""
    if not course.rounded:
        return D == D.T
    import numpy as np

    R = np.array(matrix_numbers(D, {}))
    return bool(abs(R - R.T).max() < SMALL)


def half_turn(course: Course, R: ScalarMatrix) -> tuple[Expr, ...]:
    """The axis of a rotation by half a turn: R = 2 k k^T - 1."""
    outer = (R + ScalarMatrix.identity(3)).scaled(Scalar.of(1) / 2)
    j = next(j for j in range(3) if outer[j, j] != 0)
    return tuple(over(outer[i, j], outer[j, j], course.problem) for i in range(3))


def _axis_steps(
    theta_f: Symbol, k: Symbol, between: Symbol, angle: Expr, axis: Matrix, half: bool
) -> Iterator[Step]:
    """By the trace and the antisymmetric part; of half a turn by the symmetric part."""
    if half:
        outer = multiply(k, transpose(k))
        yield Step("law", (outer, (between + IDENTITY) / 2), "in-numbers")
        yield Step("theta_f", (theta_f, angle), "in-numbers")
        yield Step("k", (k, axis), "in-numbers")
        return
    cosine = (diagonal() - 1) / 2
    told = Measured(angle, "rad") if isinstance(angle, Approximate) else angle
    yield Step("theta_f", (theta_f, Call("acos", (cosine,)), told), "in-numbers")
    yield Step("k", (k, multiply(ONE / (2 * sin(theta_f)), column(lacking())), axis), "in-numbers")


def steadily(
    course: Course,
    shares: tuple[Step, ...],
    start: tuple[Symbol, ScalarMatrix],
    angle: Expr,
    axis: tuple[Symbol, Matrix],
) -> Way | None:
    """The angular velocity and acceleration of a turn by this angle about an axis that stays; None without a
    law of time."""
    if course.time is None:
        return None
    names = {"omega": course.name("omega", "w"), "alpha": course.name("alpha", "epsilon")}
    direction = course.readable(start[1] @ course.value(axis[1]))
    rates = {name: share.chain[0] for name, share in zip(names, shares[1:], strict=True)}
    steps = tuple(
        Step(
            name,
            (
                symbol,
                *(multiply(rates[name], angle, *along) for along in ((start[0], axis[0]), (direction,))),
            ),
            "in-numbers",
        )
        for name, symbol in names.items()
    )
    return Way(
        parts=(
            Part(said=Phrase("axis-stays"), lines=tuple(step.name for step in shares[1:])),
            Part(said=Phrase("turns-so-fast"), lines=tuple(names), answers=True),
        ),
        steps=steps,
        known={share.chain[0]: share.chain[1] for share in shares[1:]},
        results={
            name: column(multiply(rates[name], angle, entry) for (entry,) in direction.rows) for name in names
        },
        page_names={name: symbol.name for name, symbol in names.items()},
        called=names,
    )
