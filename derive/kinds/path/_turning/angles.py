"""Each of three angles by itself, in proportion to the path; the angular velocity by their rates (Siciliano
et al., section 3.6)."""

from __future__ import annotations

from fractions import Fraction

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal, normal_matrix
from derive.algebra.scalar import Scalar
from derive.derivation import Phrase, Step
from derive.errors import NotDerivable
from derive.expression import ZERO, Degrees, Expr, Matrix, Symbol, add, column, multiply, negate
from derive.kinds.path._turning.course import Course, Part, Way
from derive.kinds.pose._euler_steps import factors_of
from derive.kinds.problem import Problem
from derive.mechanics.euler import Convention, Euler

CANDIDATES = (("phi", "alpha"), ("theta", "beta"), ("psi", "gamma"))
Column = tuple[Expr, ...]


def by_angles(course: Course) -> Way:
    """Raises NotDerivable where no angle changes."""
    turned = course.turned
    begin, end = turned.start.angles, turned.end.angles
    if begin is None or end is None:
        raise NotDerivable("the angles at both ends are needed", "orientation")
    ways = [_way(a, b, course.problem) for a, b in zip(begin, end, strict=True)]
    if not any(normal(way) for way in ways):
        raise NotDerivable("all angles stay as they are: there is nothing to turn", "orientation")
    names = tuple(course.name(*each) for each in CANDIDATES)
    euler = Euler(Convention.of(turned.convention), (names[0].name, names[1].name, names[2].name))
    a_s, a_f, u, R = (
        course.name(*each) for each in (("a_0", "b_0"), ("a_f", "b_f"), ("u", "lambda"), ("R_b", "R_t"))
    )
    shares, factors = course.shares(u), factors_of(euler)
    angles = column(names)
    now = column(add(a, _times(u, way)) for a, way in zip(begin, ways, strict=True))
    steps = (
        Step("a_s", (a_s, column(begin)), "in-numbers"),
        Step("a_f", (a_f, column(end)), "in-numbers"),
        *shares,
        Step("angles", (angles, add(a_s, multiply(u, a_f - a_s)), now), "in-numbers"),
        Step("R", (R, multiply(*factors), course.readable(euler.matrix)), "in-numbers"),
    )
    parts = (
        Part(
            said=Phrase("angles-from-to", {"order": turned.convention, "a_s": a_s, "a_f": a_f}),
            lines=("a_s", "a_f"),
        ),
        Part(said=Phrase("angles-in-proportion", {"u": u}), lines=(shares[0].name,)),
        Part(said=Phrase("angles-are"), lines=("angles",), answers=True),
        Part(said=Phrase("they-turn"), lines=("R",), answers=True),
    )
    known: dict[Expr, Expr] = {u: course.share, **dict(zip(names, (e for (e,) in now.rows), strict=True))}
    called: dict[str, Expr] = {"a_s": a_s, "a_f": a_f, "share": u, "R": R}
    called |= {f"angle_{k}": name for k, name in enumerate(names)}
    called |= {f"factor_{k}": name for k, name in enumerate(factors)}
    whole = Way(
        parts,
        steps,
        known,
        {"angles": now, "R": course.readable(euler.matrix)},
        {"R": R.name, "angles": angles},
        called,
    )
    return whole.followed_by(_moving(course, euler, shares, (a_s, a_f), ways))


def _moving(
    course: Course, euler: Euler, shares: tuple[Step, ...], ends: tuple[Symbol, Symbol], ways: list[Expr]
) -> Way | None:
    """The angular velocity T a_dot and its rate; None without a law of time."""
    if course.time is None:
        return None
    T, omega, alpha = (course.name(*each) for each in (("T", "E"), ("omega", "w"), ("alpha", "epsilon")))
    T_dot = Symbol(f"{T.name}_dot")
    rates, rises = ([Symbol(f"{name}_{dots}") for name in euler.names] for dots in ("dot", "ddot"))
    R = euler.matrix
    turning = [R.diff(name) @ R.T for name in euler.names]
    axes = ScalarMatrix.beside([ScalarMatrix.column((S[2, 1], S[0, 2], S[1, 0])) for S in turning])
    change = sum(
        (
            axes.diff(name).scaled(Scalar.symbol(rate.name))
            for name, rate in zip(euler.names, rates, strict=True)
        ),
        axes.scaled(Scalar.of(0)),
    )
    velocity = axes @ normal_matrix(column(rates))
    rising = axes @ normal_matrix(column(rises)) + change @ normal_matrix(column(rates))
    way = ends[1] - ends[0]
    u_dot, u_ddot = (share.chain[0] for share in shares[1:])
    steps = (
        Step("rates", (column(rates), multiply(u_dot, way), _by(u_dot, ways)), "in-numbers"),
        Step("rises", (column(rises), multiply(u_ddot, way), _by(u_ddot, ways)), "in-numbers"),
        Step("T", (T, course.readable(axes)), "in-numbers"),
        Step("T_dot", (T_dot, course.readable(change)), "in-numbers"),
        Step("omega", (omega, multiply(T, column(rates)), course.readable(velocity)), "in-numbers"),
        Step("alpha", (alpha, add(multiply(T, column(rises)), multiply(T_dot, column(rates)))), "in-numbers"),
    )
    parts = (
        Part(said=Phrase("rates-of-angles"), lines=(*(share.name for share in shares[1:]), "rates", "rises")),
        Part(said=Phrase("axes-of-angles", {"T": T}), lines=("T",)),
        Part(said=Phrase("velocity-is"), lines=("omega",), answers=True),
        Part(said=Phrase("changes-of-axes"), lines=("T_dot",)),
        Part(said=Phrase("acceleration-is"), lines=("alpha",), answers=True),
    )
    known: dict[Expr, Expr] = {share.chain[0]: share.chain[1] for share in shares[1:]}
    for names, rate in ((rates, u_dot), (rises, u_ddot)):
        known |= {name: multiply(rate, each) for name, each in zip(names, ways, strict=True)}
    called = {"T": T, "T_dot": T_dot, "omega": omega, "alpha": alpha}
    called |= {f"rate_{k}": name for k, name in enumerate(rates)}
    called |= {f"rise_{k}": name for k, name in enumerate(rises)}
    results: dict[str, Expr] = {"omega": course.readable(velocity), "alpha": course.readable(rising)}
    return Way(parts, steps, known, results, {"omega": omega.name, "alpha": alpha.name}, called)


def _way(a: Expr, b: Expr, problem: Problem) -> Expr:
    """From one angle to another, in degrees where both are."""
    sizes = [each.value if isinstance(each, Degrees) else 0 if each == ZERO else None for each in (a, b)]
    if sizes[0] is not None and sizes[1] is not None and sizes != [0, 0]:
        return Degrees(Fraction(sizes[1] - sizes[0])) if sizes[0] != sizes[1] else ZERO
    return problem.readable(normal(b - a, problem.names))


def _by(rate: Expr, ways: list[Expr]) -> Matrix:
    return column(_times(rate, each) for each in ways)


def _times(rate: Expr, way: Expr) -> Expr:
    """With the sign in front."""
    if isinstance(way, Degrees) and way.value < 0:
        return negate(multiply(rate, negate(way)))
    return multiply(rate, way)
