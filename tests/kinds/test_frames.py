"""Frames of the exercise sheets of weeks 2 and 4 against their published answers."""

from __future__ import annotations

import pytest
from pydantic import ValidationError

from derive.errors import NotDerivable
from derive.expression import (
    MINUS_ONE,
    ONE,
    ZERO,
    add,
    atan2,
    column,
    cos,
    negate,
    number,
    sin,
    subtract,
    symbols,
)
from derive.kinds.problem import Problem
from derive.mechanics.frames import ByMatrix, Frame, Frames, Observed
from tests.kinds.published import matrix, same

a, b, c, d_, e, beta = symbols("a b c d e beta")
X, Y, Z = (ONE, ZERO, ZERO), (ZERO, ONE, ZERO), (ZERO, ZERO, ONE)


def minus(axis):
    return tuple(negate(part) if part != ZERO else ZERO for part in axis)


def decimal(text):
    return number(text, decimal=True)


STEPPED = Frames(
    (
        Frame(1, 0, Observed(minus(X), minus(Z), minus(Y), (ZERO, add(c, e), subtract(a, d_)))),
        Frame(2, 1, Observed(Z, minus(X), minus(Y), (b, subtract(a, d_), ZERO))),
        Frame(3, 2, Observed(minus(Z), Y, X, (e, ZERO, a))),
        Frame(4, 3, Observed(Y, minus(Z), minus(X), (d_, ZERO, c))),
        Frame(5, 4, Observed(Y, minus(Z), minus(X), (b, ZERO, d_))),
    )
)
PUBLISHED_STEPPED = {
    "T_1^0": "-1,0,0,0\n0,0,-1,c+e\n0,-1,0,a-d\n0,0,0,1",
    "T_2^1": "0,-1,0,b\n0,0,-1,a-d\n1,0,0,0\n0,0,0,1",
    "T_3^2": "0,0,1,e\n0,1,0,0\n-1,0,0,a\n0,0,0,1",
    "T_4^3": "0,0,-1,d\n1,0,0,0\n0,-1,0,c\n0,0,0,1",
    "T_5^4": "0,0,-1,b\n1,0,0,0\n0,-1,0,d\n0,0,0,1",
    "T_5^0": "0,0,-1,0\n1,0,0,0\n0,-1,0,a\n0,0,0,1",
}
PUBLISHED_WEDGE = {
    "T_1^0": "1,0,0,-0.35\n0,-1,0,0.3\n0,0,-1,0.1\n0,0,0,1",
    "T_2^1": "0,0,1,0\n-1,0,0,0.3\n0,-1,0,0.1\n0,0,0,1",
    "T_3^2": "0,0.6,0.8,0\n0,-0.8,0.6,0.5\n1,0,0,0\n0,0,0,1",
    "T_4^3": "-1,0,0,0.35\n0,1,0,0\n0,0,-1,0\n0,0,0,1",
    "T_4^0": "-1,0,0,0\n0,0.6,-0.8,0\n0,-0.8,-0.6,0.5\n0,0,0,1",
}


def wedge(sine, cosine):
    slanting = Observed(Z, (sine, negate(cosine), ZERO), (cosine, sine, ZERO), (ZERO, decimal("0.5"), ZERO))
    return Frames(
        (
            Frame(1, 0, Observed(X, minus(Y), minus(Z), (decimal("-0.35"), decimal("0.3"), decimal("0.1")))),
            Frame(2, 1, Observed(minus(Y), minus(Z), X, (ZERO, decimal("0.3"), decimal("0.1")))),
            Frame(3, 2, slanting),
            Frame(4, 3, Observed(minus(X), Y, minus(Z), (decimal("0.35"), ZERO, ZERO))),
        )
    )


TURNED = Frames(
    (
        Frame(
            1,
            0,
            ByMatrix(matrix("0,-1,0,1\n1,0,0,-1\n0,0,1,0\n0,0,0,1")),
        ),
    )
)


def holds(derivation):
    return all(claim.holds for claim in derivation.claims)


def check(derivation, published):
    assert set(derivation.results) == set(published)
    for name, text in published.items():
        assert same(derivation.results[name], matrix(text)), name
    assert holds(derivation)


def test_stepped_block_published():
    check(Problem("frames", STEPPED).ask("transforms"), PUBLISHED_STEPPED)


def test_wedge_published_in_decimals():
    derivation = Problem("frames", wedge(decimal("0.6"), decimal("0.8"))).ask("transforms")
    check(derivation, PUBLISHED_WEDGE)
    assert derivation.results["T_4^0"].rows[1][1] == decimal("0.6")


def test_wedge_by_its_angle():
    subject = wedge(sin(beta), cos(beta))
    derivation = Problem("frames", subject, where={"beta": atan2(number(3), number(4))}).ask("transforms")
    check(derivation, PUBLISHED_WEDGE)


def test_one_frame_in_another():
    derivation = Problem("frames", STEPPED).ask("transform", source=2, target=4)
    assert list(derivation.results) == ["T_2^4"] and holds(derivation)
    whole = Problem("frames", STEPPED).ask("transform", source=5)
    assert same(whole.results["T_5^0"], matrix(PUBLISHED_STEPPED["T_5^0"])) and holds(whole)


def test_free_vector_published():
    derivation = Problem("frames", TURNED).ask("change-of-frame", vector=(number(3), ONE, ZERO), source=1)
    assert derivation.results["v^0"] == column((MINUS_ONE, number(3), ZERO)) and holds(derivation)


def test_point_is_shifted_too():
    derivation = Problem("frames", TURNED).ask("change-of-frame", point=(number(3), ONE, ZERO), source=1)
    assert derivation.results["p^0"] == column((ZERO, number(2), ZERO)) and holds(derivation)
    back = Problem("frames", TURNED).ask("change-of-frame", point=(ZERO, number(2), ZERO), source=0, target=1)
    assert back.results["p^1"] == column((number(3), ONE, ZERO)) and holds(back)


def test_vector_or_point():
    with pytest.raises(ValidationError, match="either vector"):
        Problem("frames", TURNED).ask("change-of-frame")
    with pytest.raises(NotDerivable, match="no frame 7"):
        Problem("frames", TURNED).ask("transform", source=7)
