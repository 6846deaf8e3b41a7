"""What in an equation is no ratio of polynomials in s: a delay, a root of s, a function of it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeAlias

from derive.control.rational import S
from derive.expression import Call, Expr, Number, Power, free_symbols, walk

Function: TypeAlias = Call | Power


def transcendental(expr: Expr) -> Iterator[Function]:
    """Functions of s, and its powers that are not whole, the outer ones first."""
    for node in walk(expr):
        if isinstance(node, Call | Power) and _is_transcendental(node):
            yield node


def _is_transcendental(node: Function) -> bool:
    if isinstance(node, Call):
        return any(S.name in free_symbols(argument) for argument in node.arguments)
    whole = isinstance(node.exponent, Number) and node.exponent.value.denominator == 1
    return S.name in free_symbols(node.exponent) or (not whole and S.name in free_symbols(node.base))
