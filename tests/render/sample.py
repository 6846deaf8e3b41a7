"""A hand-made sheet that exercises everything a page can hold."""

from __future__ import annotations

from fractions import Fraction

from derive.derivation import Branch, Claim, Derivation, PageFacts, Phrase, Plot, Step, Table
from derive.expression import (
    MINUS_ONE,
    ONE,
    ZERO,
    Approximate,
    Degrees,
    Derivative,
    Expr,
    Indexed,
    Matrix,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
    add,
    atan2,
    column,
    cos,
    cross,
    multiply,
    negate,
    number,
    sin,
    sqrt,
    squared,
    subtract,
    symbols,
    transpose,
)
from derive.render.document import Document, ProblemPage, QuestionPage, Worked

theta1, theta2, phi, psi, theta = symbols("theta1 theta2 phi psi theta")
a1, a2, m, L, g = symbols("a1 a2 m L g")
c12, s12 = cos(Sum((theta1, theta2))), sin(Sum((theta1, theta2)))


class ArmFacts(PageFacts):
    factors: tuple[str, ...]
    table: Table


WORDS = {
    "words/sample/arm.j2": """\
{% block phrases %}
elbow-up: elbow up
pose: the pose, composed in numbers
{% endblock %}
The transformations between neighbouring frames of the {{ em("arm") }} are
{{ show(*facts.factors) }}

Their product is the pose of the {{ strong("end-effector") }} in the base frame, with {{ "a1" | m }} the
length of the first link:
{{ show("T_2^0", "r_14") }}

The Jacobian takes its columns from {{ ["z_0", "o_1", "o_2"] | listed }}.
{{ show("J") }}

{{ table(facts.table) }}

In the singular case, {{ inline("theta") }} holds, and the entries are
{{ show("r_11", "r_12", "r_13", "r_21") }}

{{ items(["first " ~ ("phi" | m), "second"]) }}
{{ show("long") }}

{{ show("wide") }}
{{ tell("zero") }}

{{ plot("step", "The step response.") }}
""",
    "words/sample/rotation.j2": """\
The rotation about the world axis is pre-multiplied:
{{ show("R") }}
In numbers,
{{ show("number") }}
""",
}


def planar(angle: Expr, length: Expr) -> Matrix:
    c, s = cos(angle), sin(angle)
    return Matrix(
        (
            (c, negate(s), ZERO, multiply(length, c)),
            (s, c, ZERO, multiply(length, s)),
            (ZERO, ZERO, ONE, ZERO),
            (ZERO, ZERO, ZERO, ONE),
        )
    )


def _pose() -> Matrix:
    x = add(multiply(a1, cos(theta1)), multiply(a2, c12))
    y = add(multiply(a1, sin(theta1)), multiply(a2, s12))
    last = ((ZERO, ZERO, ONE, ZERO), (ZERO, ZERO, ZERO, ONE))
    return Matrix(((c12, negate(s12), ZERO, x), (s12, c12, ZERO, y), *last))


def _jacobian() -> Matrix:
    x = add(multiply(a1, cos(theta1)), multiply(a2, c12))
    y = subtract(multiply(MINUS_ONE, a1, sin(theta1)), multiply(a2, s12))
    rows = ((y, negate(multiply(a2, s12))), (x, multiply(a2, c12)), *((ZERO, ZERO),) * 3, (ONE, ONE))
    return Matrix(rows)


def _entry(index: int) -> Expr:
    names = symbols("theta1 theta2 theta4 theta5 theta6")
    c = [cos(name) for name in names]
    s = [sin(name) for name in names]
    inner = subtract(multiply(c[2], c[3], c[4]), multiply(s[2], s[4]))
    term = multiply(c[0], subtract(multiply(c[1], inner), multiply(c[4], s[1], s[3])))
    return subtract(term, multiply(s[0], add(multiply(c[2], s[4]), multiply(c[3], c[4], s[2]))))


def _long_sum() -> Expr:
    terms = [
        multiply(
            number(f"{sign}{i}"),
            m,
            squared(L),
            cos(Symbol(f"theta{i}")),
            sin(theta2),
            Symbol(f"theta{i}_dot"),
        )
        for i, sign in zip(range(2, 10), "+-+--+-+", strict=True)
    ]
    return Sum(tuple(terms))


def _wide_matrix() -> Matrix:
    entry = Sum((multiply(cos(phi), cos(psi), sin(theta)), negate(multiply(sin(phi), sin(psi)))))
    return Matrix(((entry,) * 3, (entry, ZERO, Quotient(m, number(2))), (ONE, entry, entry)))


def arm() -> Derivation:
    """A two-link arm, with every kind of step."""
    T_10, T_21, T_20 = symbols("T_1^0 T_2^1 T_2^0")
    z0, o2, o0 = symbols("z_0 o_2 o_0")
    block = Matrix(((cross(z0, subtract(o2, o0)),), (z0,)))
    step = Plot("step", "time [s]", "angle [rad]", {"P": ((0.0, 1.0, 2.0), (0.0, 1.2, 1.0))}, {"final": 1.0})
    return Derivation(
        kind="arm",
        steps=(
            Step("T_1^0", (T_10, planar(theta1, a1))),
            Step("T_2^1", (T_21, planar(theta2, a2))),
            Step("T_2^0", (T_20, Product((T_10, T_21)), _pose())),
            Step("r_14", (Symbol("r_14"), add(multiply(a1, cos(theta1)), multiply(a2, c12)))),
            Step("J", (Symbol("J"), block, _jacobian())),
            Step("theta", (theta, atan2(sqrt(subtract(ONE, squared(cos(theta2)))), cos(theta2)))),
            *(Step(name, (Symbol(name), _entry(1))) for name in ("r_11", "r_12", "r_13", "r_21")),
            Step("long", (Symbol("tau1"), _long_sum())),
            Step("wide", (Symbol("R"), _wide_matrix())),
            Step("zero", (Symbol("v_1"), Symbol("0_3x1"))),
        ),
        results={
            "T_2^0": _pose(),
            "o": column((a1, number("7/20", True), Degrees(Fraction(30)))),
            "solutions": (Branch({"theta2": negate(theta)}, (Phrase("elbow-up"),)),),
            "DH": ((theta1, ZERO), (theta2, ONE)),
            "dof": "3",
        },
        claims=(
            Claim("orthogonal", "normal-form", True, {"R": "R"}),
            Claim("pose", "independent-route", True),
        ),
        evaluated={"T_2^0": [[0.5, -0.8660254037844386], [0.0, 1.0]], "poles": [{"re": -1.0, "im": 2.5}]},
        plots=(step,),
        facts=ArmFacts(
            factors=("T_1^0", "T_2^1"),
            table=Table(
                ("Joint", theta1, Symbol("d_i"), Symbol("alpha_i")),
                (("1", Symbol("theta1*"), number("0.1", True), Degrees(Fraction(-90))),) * 2,
            ),
        ),
    )


def rotation() -> Derivation:
    """A rotation by Greek angles, written out, and one in numbers."""
    z = Symbol("z")
    R = Indexed("R", (z, phi))
    c, s = cos(phi), sin(phi)
    matrix = Matrix(((c, negate(s), ZERO), (s, multiply(c, cos(psi)), ZERO), (ZERO, ZERO, ONE)))
    rounded = Matrix(((Approximate(0.4330127), Approximate(0.75)), (Approximate(1e-17), Approximate(-0.5))))
    inertia = multiply(number("-1/2"), m, squared(L), sin(theta2))
    return Derivation(
        kind="rotation",
        steps=(
            Step("R", (Symbol("R"), R, matrix)),
            Step("number", (Symbol("R_1"), rounded)),
            Step("rate", (Derivative(Symbol("d_11"), theta2), inertia, Power(transpose(R), number(2)))),
        ),
        results={"R": matrix},
    )


def sheet() -> Document:
    """The whole sample as a document."""
    worked = arm()
    first = QuestionPage(
        1, "arm", "Find the pose for $d_2 = 0.1$ m.", 10, "Use _both_ angles.", worked,
        (Worked(worked, "sample"),), {"theta1": Degrees(Fraction(30)), "a1": number("0.5", True)},
        folder="sample",
    )  # fmt: skip
    second = QuestionPage(2, "arm", "Say *why* 100% of `it_works` & costs $5 at θ = 30°.")
    problem = ProblemPage(1, (first, second), "Two links", "The arm of the figure:\n\n- one\n- two $x_1$\n")
    return Document(
        "Solutions & more", (problem,), "Robotics", "A. Teacher", "September 2023", figures="sample"
    )
