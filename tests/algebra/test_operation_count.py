"""Our D_11 against those of textbooks: equal, and no longer."""

from __future__ import annotations

from derive.algebra.formulas.grammar import parse
from derive.algebra.infix import text
from derive.algebra.normal import normal
from derive.algebra.readable.form import readable, readable_matrix
from derive.algebra.readable.operation_count import operations
from derive.expression import ZERO, Expr, add, multiply, squared
from derive.kinds.problem import Problem
from derive.kinds.robot._dynamics.bodies import Weighted, weighted
from derive.mechanics.bodies import Body
from derive.mechanics.chain import chain
from derive.mechanics.dynamics import inertia_matrix
from derive.mechanics.robot import Robot
from tests.mechanics.robots import body, robot, row


def diagonal(i: int, com: str) -> Body:
    return body(f"m{i}", com, f"Ixx{i}, Iyy{i}, Izz{i}, 0, 0, 0")


ANTHROPOMORPHIC = robot(
    row("t1*", "0", "0", "90 deg", diagonal(1, "0, -lc1, 0")),
    row("t2*", "0", "a2", "0", diagonal(2, "lc2 - a2, 0, 0")),
    row("t3*", "0", "a3", "0", diagonal(3, "lc3 - a3, 0, 0")),
)
STANFORD = robot(
    row("t1*", "0", "0", "-90 deg", diagonal(1, "0, y1, z1")),
    row("t2*", "d2", "0", "90 deg", diagonal(2, "0, y2, 0")),
    row("0", "d3*", "0", "0", diagonal(3, "0, 0, z3")),
    row("t4*", "0", "0", "-90 deg", diagonal(4, "0, y4, z4")),
    row("t5*", "0", "0", "90 deg", diagonal(5, "0, 0, z5")),
    row("t6*", "d6", "0", "0", diagonal(6, "0, 0, z6")),
)
# Siciliano et al., section 7.3.2 carried over to three links: every term by hand, squares recognised.
D_11_OF_3R = """
    Iyy1 + Ixx2 sin(t2)^2 + Iyy2 cos(t2)^2 + m2 lc2^2 cos(t2)^2
    + Ixx3 sin(t2 + t3)^2 + Iyy3 cos(t2 + t3)^2 + m3 (a2 cos(t2) + lc3 cos(t2 + t3))^2
"""


def bodies(arm: Robot) -> tuple[Weighted, ...]:
    return weighted(Problem("robot", arm), chain(arm))


def ours(arm: Robot) -> Expr:
    """D_11 as it is printed."""
    return readable(inertia_matrix([found.motion for found in bodies(arm)])[0, 0])


def unexpanded(arm: Robot) -> Expr:
    """D_11 = sum of m J_v1^T J_v1 + J_w1^T R I R^T J_w1, entries put in and nothing multiplied out."""
    return add(*(part for found in bodies(arm) for part in (_linear(found), _angular(found))))


def _linear(found: Weighted) -> Expr:
    entries = [line[0] for line in readable_matrix(found.motion.J_v).rows]
    squares = [squared(entry) for entry in entries if entry != ZERO]
    return multiply(found.body.mass, add(*squares)) if squares else ZERO


def _angular(found: Weighted) -> Expr:
    """The first columns of J_w are (0, 0, 1): the third row of R, squared, with the moments."""
    R, moments = readable_matrix(found.motion.R), found.moments
    return add(
        *(
            multiply(moment, squared(entry))
            for moment, entry in zip(moments[:3], R.rows[2], strict=True)
            if entry != ZERO
        )
    )


def test_the_textbook_form_of_the_anthropomorphic_arm() -> None:
    published, found = parse(D_11_OF_3R), ours(ANTHROPOMORPHIC)
    assert normal(found) == normal(published)
    assert operations(found) <= operations(published) <= 33, text(found)
    assert operations(found) <= operations(unexpanded(ANTHROPOMORPHIC)), text(found)


def test_the_unexpanded_form_of_the_stanford_arm() -> None:
    """456 is what the textbook's product of matrices comes to where nothing is simplified."""
    found = ours(STANFORD)
    assert normal(found) == normal(unexpanded(STANFORD))
    assert operations(found) <= 456, text(found)
