"""What stands in ${...} of a xacro file: arithmetic, comparisons and strings, and nothing that Python could
be asked to do beside them. Decimals stay exact."""

from __future__ import annotations

import ast
import math
import operator
from collections.abc import Callable
from fractions import Fraction
from typing import TypeAlias

from derive.sheet.exchange.values import exact

Given: TypeAlias = Fraction | float | bool | str
Lookup: TypeAlias = Callable[[str], Given]

LONGEST = 2000  # characters of an expression
FUNCTIONS: dict[str, Callable[..., float]] = {
    name: getattr(math, name)
    for name in (
        "sin",
        "cos",
        "tan",
        "asin",
        "acos",
        "atan",
        "atan2",
        "sqrt",
        "exp",
        "radians",
        "degrees",
        "floor",
        "ceil",
    )
} | {"abs": abs, "min": min, "max": max, "float": float, "int": int}
CONSTANTS: dict[str, Given] = {"pi": math.pi, "True": True, "False": False, "true": True, "false": False}
ARITHMETIC: dict[type[ast.operator], Callable[..., Given]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Mod: operator.mod,
    ast.FloorDiv: operator.floordiv,
}
COMPARED: dict[type[ast.cmpop], Callable[..., bool]] = {
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
}


class NoValue(ValueError):
    """An expression that cannot be read, or has no value."""


def value(text: str, lookup: Lookup) -> Given:
    """The value of an expression, its names looked up. Raises NoValue."""
    if len(text) > LONGEST:
        raise NoValue("this expression is too long")
    try:
        return _Walk(text.strip(), lookup).value(ast.parse(text.strip(), mode="eval").body)
    except NoValue:
        raise
    except (SyntaxError, ValueError, TypeError, ArithmeticError, RecursionError, MemoryError) as error:
        raise NoValue(f"'{text.strip()[:60]}' has no value") from error


def said(typed: str) -> Given:
    """What a plain text stands for: a number, a truth, else itself."""
    try:
        return exact(typed.strip())
    except ValueError:
        return CONSTANTS.get(typed.strip(), typed) if typed.strip() != "pi" else typed


class _Walk:
    def __init__(self, text: str, lookup: Lookup) -> None:
        self.text, self.lookup = text, lookup

    def value(self, node: ast.expr) -> Given:
        match node:
            case ast.Constant(value=bool() | str() as held):
                return held
            case ast.Constant(value=int() | float()):
                return exact((ast.get_source_segment(self.text, node) or "").replace("_", ""))
            case ast.Name(id=name):
                return CONSTANTS[name] if name in CONSTANTS else self.lookup(name)
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                return -self.number(operand)
            case ast.UnaryOp(op=ast.UAdd(), operand=operand):
                return self.number(operand)
            case ast.UnaryOp(op=ast.Not(), operand=operand):
                return not self.value(operand)
            case ast.BinOp(left=left, op=ast.Pow(), right=right):
                return math.pow(self.number(left), self.number(right))
            case ast.BinOp(left=left, op=ast.Add(), right=right):
                return self.sum(self.value(left), self.value(right))
            case ast.BinOp(left=left, op=op, right=right) if type(op) in ARITHMETIC:
                return ARITHMETIC[type(op)](self.number(left), self.number(right))
            case ast.BoolOp(op=op, values=values):
                found = map(self.value, values)
                return all(found) if isinstance(op, ast.And) else any(found)
            case ast.Compare(left=left, ops=[op], comparators=[right]) if type(op) in COMPARED:
                return COMPARED[type(op)](self.value(left), self.value(right))
            case ast.IfExp(test=test, body=body, orelse=orelse):
                return self.value(body if self.value(test) else orelse)
            case ast.Call(func=ast.Name(id=name), args=arguments, keywords=[]) if name in FUNCTIONS:
                return FUNCTIONS[name](*map(self.number, arguments))
            case ast.Attribute(value=ast.Name(id="math"), attr="pi"):
                return math.pi
            case ast.Call(
                func=ast.Attribute(value=ast.Name(id="math"), attr=name), args=arguments, keywords=[]
            ) if name in FUNCTIONS:
                return FUNCTIONS[name](*map(self.number, arguments))
        raise NoValue(f"'{ast.get_source_segment(self.text, node)}' is not evaluated here")

    def number(self, node: ast.expr) -> Fraction | float:
        found = self.value(node)
        if isinstance(found, str):
            raise NoValue(f"'{found[:40]}' is no number")
        return found

    def sum(self, a: Given, b: Given) -> Given:
        if isinstance(a, str) or isinstance(b, str):
            if isinstance(a, str) and isinstance(b, str) and len(a) + len(b) < LONGEST:
                return a + b
            raise NoValue("a text and a number have no sum")
        return a + b
