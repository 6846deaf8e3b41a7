"""The parts of a tree: walked, changed, replaced, with and without units."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

from derive.expression.nodes import (
    PI,
    ZERO,
    Approximate,
    Call,
    Degrees,
    Derivative,
    Expr,
    Indexed,
    Matrix,
    Measured,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
)

LEAVES = (Symbol, Number)


def children(expr: Expr) -> tuple[Expr, ...]:
    """The parts of a tree, in the order they are written."""
    # in the order of how often they occur; a `match` on dataclasses takes twice as long
    if isinstance(expr, LEAVES):
        return ()
    if isinstance(expr, Product):
        return expr.factors
    if isinstance(expr, Call):
        return expr.arguments
    if isinstance(expr, Sum):
        return expr.terms
    match expr:
        case Indexed(_, lower, upper):
            return lower + upper
        case Quotient(left, right) | Power(left, right):
            return left, right
        case Matrix(rows):
            return tuple(entry for row in rows for entry in row)
        case Derivative(of, by):
            return of, by
        case Measured(value):
            return (value,)
        case _:
            return ()


def walk(expr: Expr) -> Iterator[Expr]:
    """Every node of a tree, parents first."""
    pending = [expr]
    while pending:
        node = pending.pop()
        yield node
        if parts := children(node):
            pending.extend(parts[::-1])


def rebuild(expr: Expr, change: Callable[[Expr], Expr]) -> Expr:
    """The same node with `change` applied to each of its parts."""
    match expr:
        case Sum(terms):
            return Sum(tuple(map(change, terms)))
        case Product(factors):
            return Product(tuple(map(change, factors)))
        case Quotient(top, bottom):
            return Quotient(change(top), change(bottom))
        case Power(base, exponent):
            return Power(change(base), change(exponent))
        case Call(function, arguments):
            return Call(function, tuple(map(change, arguments)))
        case Matrix(rows):
            return Matrix(tuple(tuple(map(change, row)) for row in rows))
        case Derivative(of, by):
            return Derivative(change(of), by)
        case Measured(value, unit):
            return Measured(change(value), unit)
        case _:
            return expr


def measured(value: Expr, unit: str) -> Expr:
    """A number, pi/4 too, with its unit; of one in degrees they are a part."""
    if isinstance(value, Degrees):
        unit = unit.removeprefix("deg")
    whole = isinstance(value, Number | Degrees) or (not free_symbols(value) and _has_no_unit(value))
    return Measured(value, unit) if unit and whole and value != ZERO else value


def _has_no_unit(expr: Expr) -> bool:
    return not any(isinstance(node, Matrix | Measured | Degrees | Approximate) for node in walk(expr))


def unmeasured(expr: Expr) -> Expr:
    """Without the units in it."""
    return unmeasured(expr.value) if isinstance(expr, Measured) else rebuild(expr, unmeasured)


def replace(expr: Expr, values: Mapping[Expr, Expr]) -> Expr:
    """The tree with each node that is a key of `values` replaced, outermost first. Parts that were one object
    are one object again."""
    kinds = {*map(type, values)}  # nothing else is looked up: the hash of a sum is that of all in it
    done: dict[int, Expr] = {}

    def put(node: Expr) -> Expr:
        if id(node) not in done:
            is_key = type(node) in kinds and node in values
            done[id(node)] = values[node] if is_key else rebuild(node, put)
        return done[id(node)]

    return put(expr)


def replace_all(expr: Expr, values: Mapping[Expr, Expr]) -> Expr:
    """The tree without keys of `values`, which may stand for others but not, in the end, for themselves."""
    while (filled := replace(expr, values)) != expr:
        expr = filled
    return expr


def free_symbols(expr: Expr) -> frozenset[str]:
    """The names in a tree, `pi` apart."""
    return frozenset({node.name for node in walk(expr) if isinstance(node, Symbol)} - {PI.name})
