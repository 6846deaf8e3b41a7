"""Functions of a parameter that is called as a unit is: 90 deg*s is read as degrees times seconds."""

from __future__ import annotations

from derive.expression import Degrees, Expr, Number, walk


def taken_for_unit(tree: Expr, parameter: str) -> bool:
    """Whether the parameter was read as the unit of a number."""
    numbers = (node for node in walk(tree) if isinstance(node, Number | Degrees))
    return any(parameter in node.unit.split() for node in numbers)


def instead(parameter: str) -> str:
    """What is to be written."""
    return f"write {parameter} first: {parameter}*90 deg, {parameter}*0.5 m; or call the parameter u"
