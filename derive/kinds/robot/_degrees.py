"""Joint angles of special configurations, as the sheet says its angles."""

from __future__ import annotations

from derive.algebra.infix import text
from derive.algebra.normal import normal
from derive.algebra.scalar import Scalar
from derive.expression import Degrees, Expr, free_symbols
from derive.kinds.problem import Problem
from derive.mechanics.matrices import GivenMatrix
from derive.mechanics.robot import Robot


def in_degrees(problem: Problem, name: Expr, value: Expr) -> tuple[Expr, Expr]:
    """A joint variable and its value, a fixed angle in degrees where the sheet has them."""
    degrees = problem.style.degrees or problem.style.turned
    if not degrees or str(text(name)) in _sliding(problem.subject) or free_symbols(value):
        return name, value
    turns = (normal(value) / Scalar.symbol("pi")).constant
    return name, value if turns is None else Degrees(turns * 180)


def _sliding(subject: Robot | GivenMatrix) -> tuple[str | None, ...]:
    """The joint variables that are lengths."""
    if isinstance(subject, GivenMatrix):
        return subject.sliding
    return tuple(link.variable for link in subject.links if link.joint == "prismatic")
