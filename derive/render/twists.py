"""Twists with the angular velocity first, as Lynch and Park write them (sections 3.3 and 5.1). In derivations
and in the JSON the linear half stands first."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from derive.derivation import Condition, Derivation, PageFacts, Phrase, Result, Said
from derive.expression import Expr, Indexed, Matrix, Product, Relation, Symbol, walk
from derive.render.names import stem_of

# The rules of lines whose rows are those of a twist: of a Jacobian, of its columns, of a screw.
OF_TWISTS = frozenset(
    {
        "adjoint", "analytic", "change-of-frame", "jacobian", "jacobian-column", "jacobian-columns",
        "motion-twists", "motions-jacobian", "other-frame", "rigid-jacobian", "twist", "twists", "unsolved",
        "velocity",
    }
)  # fmt: skip
OF_JACOBIANS = frozenset({"chain-rule", "product", "rows"})  # where these are told of J
ROWS = 6
OF_WRENCHES = "virtual-work"
WRENCH = Symbol("F")
HALVES = 2  # of names: the linear part over the angular


def line(rule: str, chain: tuple[Expr, ...], derivation: Derivation) -> tuple[Expr, ...]:
    """A line with the angular half first, where it has twists or wrenches with both their halves."""
    if _has_twists(rule, chain) or (chain and chain[0] == WRENCH and _is_whole(derivation)):
        return tuple(map(_turned, chain))
    if rule == OF_WRENCHES and _is_whole(derivation):
        return tuple(map(_wrench, chain))
    return chain


def _is_whole(derivation: Derivation) -> bool:
    """Whether torques are found from a wrench of six, whose rows no author has put in an order."""
    lines = [step.chain for step in derivation.all_steps() if step.rule == OF_WRENCHES]
    nodes = [node for chain in lines for link in chain for node in walk(link)]
    whole = any(isinstance(node, Matrix) and len(node.rows) == ROWS for node in nodes)
    return whole and not any(isinstance(node, Indexed) for node in nodes)


def _wrench(tree: Expr) -> Expr:
    """J^T F, where the columns of the first are of twists and the rows of the other."""
    match tree:
        case Product(factors):
            return Product(tuple(map(_wrench, factors)))
        case Matrix(found) if len(found[0]) == ROWS:
            return Matrix(tuple(map(swapped, found)))
        case Matrix(found) if len(found) == ROWS and len(found[0]) == 1:
            return rows(tree)
    return tree


def _has_twists(rule: str, chain: tuple[Expr, ...]) -> bool:
    if not chain or not any(isinstance(link, Matrix) and len(link.rows) == ROWS for link in chain):
        return rule == "velocity" and bool(chain) and isinstance(chain[0], Matrix)
    of_j = rule in OF_JACOBIANS and next(_stems(chain[0]), "") == "J"
    return isinstance(chain[0], Symbol | Product | Matrix) and (rule in OF_TWISTS or of_j)


def _stems(tree: Expr) -> Iterator[str]:
    return (stem_of(node.name) for node in walk(tree) if isinstance(node, Symbol))


def _turned(tree: Expr) -> Expr:
    match tree:
        case Matrix():
            return rows(tree)
        case Product(factors):
            return Product(tuple(map(_factor, factors)))
    return tree


def _factor(tree: Expr) -> Expr:
    """What stands before a twist takes halves to halves, and has columns of both."""
    if not isinstance(tree, Matrix) or len(tree.rows) != len(tree.rows[0]):
        return _turned(tree)
    return Matrix(tuple(map(swapped, rows(tree).rows)))


def rows(matrix: Matrix) -> Matrix:
    """The matrix, of six rows or of two of halves, with its halves in the other order."""
    return Matrix(swapped(matrix.rows)) if len(matrix.rows) in (ROWS, HALVES) else matrix


def swapped(parts: Any) -> Any:
    """The second half before the first."""
    half = len(parts) // 2
    return (*parts[half:], *parts[:half])


def answer(derivation: Derivation) -> Derivation:
    """A derivation whose results, and their numbers, have the angular half first where they are of twists."""
    if not any(_has_twists(step.rule, step.chain) for step in derivation.all_steps()):
        return derivation
    facts = derivation.facts
    results = {
        name: found if name in facts.by_joint else _result(found)
        for name, found in derivation.results.items()
    }
    numbers = {name: _told(found, name, facts) for name, found in derivation.evaluated.items()}
    return replace(derivation, results=results, evaluated=numbers)


def _told(found: Any, name: str, facts: PageFacts) -> Any:
    """The numbers of a result."""
    if name in facts.forms:
        return [_numbers(row) for row in _numbers(found)]
    return found if name in facts.by_joint else _numbers(found)


def _result(found: Result) -> Result:
    return rows(found) if isinstance(found, Matrix) and len(found.rows) == ROWS else found


def _numbers(found: Any) -> Any:
    return [*swapped(found)] if isinstance(found, list) and len(found) == ROWS else found


def said(condition: Condition, derivation: Derivation) -> Condition:
    """What is said of the twist S_i of a joint, (v, omega), in the other order."""
    if not isinstance(condition, Phrase):
        return condition
    stems = {next(_stems(step.chain[0]), "") for step in derivation.all_steps() if step.rule == "twist"}
    return Phrase(condition.key, {name: _relation(part, stems) for name, part in condition.about.items()})


def _relation(part: Said, stems: set[str]) -> Said:
    match part:
        case Relation(Symbol(name) as left, sign, Matrix() as right) if stem_of(name) in stems:
            return Relation(left, sign, rows(right))
    return part
