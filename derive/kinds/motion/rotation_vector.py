"""The rotation vector: along the axis, as long as the angle."""

from __future__ import annotations

from derive.algebra.normal import normal
from derive.derivation import Derivation, PageFacts, Phrase, Step
from derive.errors import NotDerivable
from derive.expression import ZERO, Call, Expr, Matrix, Product, Symbol, column, multiply, walk
from derive.kinds.checks import agreement
from derive.kinds.fields import NoOptions as Options
from derive.kinds.pose import axis_angle
from derive.kinds.problem import Problem
from derive.mechanics.motion import Motion, Move

RESULTS = {"r": "the rotation vector, angle times axis (rad)"}
EXAMPLE = """\
title: A rotation as a vector
problems:
- motion:
  - {rotate: x, by: 90 deg}
  - {rotate: z, by: 90 deg}
  find: rotation-vector
"""


class Facts(PageFacts):
    numeric: bool
    zero: bool


def derive(motion: Motion, options: Options, problem: Problem) -> Derivation:
    """r = theta k; its exponential is the rotation (Lynch and Park, section 3.2.3)."""
    turn = problem.ask("axis-angle")
    angle, axis = turn.results["angle"], turn.results["axis"]
    name, told = Symbol("r"), turn.told(axis_angle.Facts)
    if told.zero:  # whatever the axis is
        vector = column((ZERO, ZERO, ZERO))
        step = Step("r", (name, vector), "rotation-vector")
    elif not isinstance(axis, Matrix) or isinstance(angle, tuple | Phrase | float | str | Matrix):
        raise NotDerivable("this rotation has no single axis")
    else:
        vector = column(_entry(angle, entry, problem) for (entry,) in axis.rows)
        product = Product((told.angle, told.axis))
        step = Step("r", (name, product, vector), "rotation-vector")
    moves = motion.moves
    claim = agreement(
        "exponential",
        problem.symbols,
        lambda point: _exponential(vector, dict(point), problem),
        lambda point: _made(moves, dict(point), problem),
        tolerance=1e-8,
    )
    facts = Facts(numeric=told.numeric, zero=told.zero)
    return Derivation(
        "rotation-vector", (step,), {"r": vector}, (claim,), {name: vector}, uses=(turn,), facts=facts
    )


def _entry(angle: Expr, entry: Expr, problem: Problem) -> Expr:
    """A multiple of pi in its shortest form; any other angle stands before the entry."""
    if any(isinstance(node, Call) and node.function == "atan2" for node in walk(angle)):
        return multiply(angle, entry)
    return problem.readable(normal(multiply(angle, entry)))


def _exponential(vector: Matrix, point: dict[str, float], problem: Problem) -> object:
    """The sum of powers of the skew matrix, 30 of them."""
    import numpy as np

    from derive.algebra.numbers.floats import number
    from derive.kinds.values_at import completed

    x, y, z = (number(entry, completed(point, problem.where)) for (entry,) in vector.rows)
    S, term = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]]), np.eye(3)
    total = np.eye(3)
    for k in range(1, 30):
        term = term @ S / k
        total = total + term
    return total


def _made(moves: tuple[Move, ...], point: dict[str, float], problem: Problem) -> object:
    import numpy as np

    from derive.kinds.values_at import completed
    from derive.mechanics.oracle import elementary

    T, at = np.eye(4), completed(point, problem.where)
    for move in moves:
        made = elementary(move, at)
        T = made @ T if move.about == "world" else T @ made
    return T[:3, :3]
