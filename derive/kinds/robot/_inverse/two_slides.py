"""One of two displacements by a distance and a height, written out."""

from __future__ import annotations

from dataclasses import replace
from functools import reduce
from operator import add as add_values

from derive.algebra.infix import text
from derive.algebra.scalar import Scalar
from derive.derivation import Condition, Phrase
from derive.expression import ZERO, Expr, Relation, Symbol, multiply, number, sqrt
from derive.kinds.robot._inverse.facts import Method
from derive.kinds.robot._inverse.lengths import slid
from derive.kinds.robot._inverse.one_equation import LONG_CONDITION, SIGNS, of_sign
from derive.kinds.robot._inverse.signs import opposite, over, square, times, total
from derive.kinds.robot._inverse.solving import Solving
from derive.kinds.robot._inverse.subproblem import Choice
from derive.mechanics.inverse.subproblems import Quadratic, equations_of

FIRST = {2: Phrase("first-two"), 3: Phrase("first-three")}


def write(solving: Solving, found: Quadratic) -> None:
    """The coordinates, their squares, the height, and the equation with that put in."""
    progress, d, equations = solving.progress, Symbol(found.unknown), equations_of(found)
    solving.equation(*((progress.tree(each.left), progress.tree(each.right)) for each in equations))
    squares = total(square(progress.tree(each.left)) for each in found.coordinates)
    right = reduce(add_values, (each.right * each.right for each in found.coordinates))
    solving.add("squares", squares, progress.tree(right))
    solving.add("aside", Symbol(found.height.unknown), slid(solving, found.height)[0])
    P, Q, R = (solving.short(each) if each else ZERO for each in found.coefficients)
    solving.add("solved", total((times(P, d**2), times(Q, d), R)), ZERO)
    first = FIRST[len(found.coordinates)] if len(equations) > len(found.coordinates) else None
    method = Method(name="quadratic", squared=first)
    if found.coefficients[0]:
        _two_values(solving, found, (P, Q, R), method)
        return
    solving.equations = [(times(Q, d), opposite(R))]
    solving.solved(d, [Choice(over(opposite(R), Q))], replace(method, unless=progress.may_vanish(Q)))


def _two_values(solving: Solving, found: Quadratic, trees: tuple[Expr, Expr, Expr], method: Method) -> None:
    """(-b +- sqrt(b^2 - 4 a c)) / 2 a."""
    P, Q, R = trees
    d, (a, b, _) = Symbol(found.unknown), found.coefficients
    rest, slope = (
        total((square(Q), opposite(multiply(number(4), P, R)))),
        2 * a * Scalar.symbol(found.unknown) + b,
    )
    tops = (total((opposite(Q), sqrt(rest))), total((opposite(Q), -sqrt(rest))))
    solving.progress.sums.append((slope, len(solving.progress.solved)))
    choices = [
        Choice(over(top, multiply(number(2), P)), sign, _side(solving, d, slope, sign))
        for top, sign in zip(tops, SIGNS, strict=True)
    ]
    solving.solved(d, choices, replace(method, bound=Relation(rest, ">=", ZERO)))


def _side(solving: Solving, d: Symbol, middle: Scalar, sign: int) -> Condition:
    """The sign of 2 a d + b, where that is short."""
    names = {symbol.name: value for symbol, value in solving.progress.named}
    tree = solving.problem.readable(middle.substitute(names))
    if len(text(tree)) <= LONG_CONDITION:
        return of_sign(tree, sign)
    return Phrase("first-value" if sign > 0 else "second-value", {"angle": d})
