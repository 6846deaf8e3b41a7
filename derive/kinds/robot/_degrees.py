"""Joint angles of special configurations, as the sheet says its angles."""

from __future__ import annotations

from derive.algebra.infix import text
from derive.algebra.normal import normal
from derive.algebra.scalar import Scalar
from derive.expression import Degrees, Expr, free_symbols
from derive.kinds.problem import Problem


def in_degrees(problem: Problem, name: Expr, value: Expr) -> tuple[Expr, Expr]:
    """A joint variable and its value, a fixed angle in degrees where the sheet has them."""
    slides = (link.variable for link in problem.subject.links if link.joint == "prismatic")
    degrees = problem.style.degrees or problem.style.turned
    if not degrees or str(text(name)) in slides or free_symbols(value):
        return name, value
    turns = (normal(value) / Scalar.symbol("pi")).constant
    return name, value if turns is None else Degrees(turns * 180)
