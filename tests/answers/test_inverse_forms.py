"""The angles of the two-link inverse in the forms of books: equal or different as mpmath finds them to be, at
points that the arm reaches. No form is hidden from the comparison, and no quadrant is lost."""

from __future__ import annotations

import random
from fractions import Fraction
from functools import cache
from itertools import product

import mpmath
import pytest
import sympy as sp

from derive.answers.branches import Sets
from derive.answers.latex.letters import Letters
from derive.answers.points import Sampling
from derive.answers.reading import read_text
from derive.answers.terms import Terms

NAMES = frozenset({"x", "y", "a1", "a2"})
LETTERS = Letters(NAMES, own=NAMES)
PAIRS = 45
R = "(x^2 + y^2)"
D = f"(({R} - a1^2 - a2^2)/(2*a1*a2))"
ELBOW = (
    f"acos({D})", f"atan2(sqrt(1 - {D}^2), {D})", f"2*atan(sqrt((1 - {D})/(1 + {D})))", f"pi/2 - asin({D})",
    f"2*atan2(sqrt((a1 + a2)^2 - {R}), sqrt({R} - (a1 - a2)^2))", f"2*asin(sqrt((1 - {D})/2))",
    f"2*acos(sqrt((1 + {D})/2))", f"pi - acos(-{D})", f"2*atan(sqrt(1 - {D}^2)/(1 + {D}))",
    f"atan2(sqrt(4*a1^2*a2^2 - ({R} - a1^2 - a2^2)^2), {R} - a1^2 - a2^2)",
    f"atan(sqrt(1 - {D}^2)/{D})", f"asin(sqrt(1 - {D}^2))", f"2*acos({D})", f"-acos({D})",
)  # fmt: skip
BEARING = (
    "atan2(y, x)", "2*atan(y/(x + sqrt(x^2 + y^2)))", "2*atan((sqrt(x^2 + y^2) - x)/y)", "pi/2 - atan2(x, y)",
    "atan2(y/sqrt(x^2 + y^2), x/sqrt(x^2 + y^2))", "atan2(-y, -x) + pi", "sign(y)*acos(x/sqrt(x^2 + y^2))",
    "atan2(y, x) + 2*pi", "atan(y/x)", "acos(x/sqrt(x^2 + y^2))", "asin(y/sqrt(x^2 + y^2))", "atan2(x, y)",
    "-atan2(-y, x)",
)  # fmt: skip


@cache
def reached() -> tuple[dict[str, float], ...]:
    draw, found = random.Random(3), []
    for _ in range(40):
        a1, a2 = draw.uniform(0.2, 2), draw.uniform(0.2, 2)
        one, two = draw.uniform(-3.1, 3.1), draw.uniform(-3.1, 3.1)
        x = a1 * mpmath.cos(one) + a2 * mpmath.cos(one + two)
        y = a1 * mpmath.sin(one) + a2 * mpmath.sin(one + two)
        found.append({"a1": a1, "a2": a2, "x": float(x), "y": float(y)})
    return tuple(found)


@cache
def angles(form: str) -> tuple[mpmath.mpf, ...]:
    names = sorted(NAMES)
    function = sp.lambdify(names, sp.sympify(form), "mpmath")
    with mpmath.workdps(40):
        return tuple(function(*(mpmath.mpf(point[name]) for name in names)) for point in reached())


def are_equal(one: str, other: str) -> bool:
    """Up to whole turns."""
    with mpmath.workdps(40):
        gaps = [abs(mpmath.sin((a - b) / 2)) for a, b in zip(angles(one), angles(other), strict=True)]
        return all(gap < mpmath.mpf(10) ** -25 for gap in gaps)


@pytest.mark.parametrize("forms", [ELBOW, BEARING])
def test_forms_of_an_angle(forms: tuple[str, ...]) -> None:
    given = tuple({name: Fraction(value) for name, value in point.items()} for point in reached()[:12])
    sampling = Sampling(frozenset({"x", "y"}), frozenset({"a1", "a2"}), given)
    for one, other in random.Random(7).sample(list(product(forms, forms)), PAIRS):
        published, derived = ({"t": read_text(form, LETTERS).tree} for form in (one, other))
        (found, *_) = Sets([published], [derived], Terms({}, {}, sampling), frozenset({"t"})).paired()
        assert found.finding.verdict == ("equal" if are_equal(one, other) else "differs"), (one, other)
