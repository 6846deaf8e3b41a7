"""The lines of a recursion with the frame of every link turned at random, all vectors in it with it.

A law in vectors holds in any frames; one that holds because the axes of this arm are parallel does not.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from derive.algebra.numbers.floats import completed, numbers
from derive.expression import Expr, Symbol, free_symbols
from derive.kinds.checks import close, random_points
from derive.kinds.meanings import valued
from derive.kinds.robot._dynamics.bodies import Weighted
from derive.kinds.robot._dynamics.recursion import Line
from derive.kinds.work import Work

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

VECTOR = re.compile(r"(?:omega_|o_c|o_|r_c|r_|e_|F_|N_|f_|mu_)(\d+)(?:_dot|_ddot)?")
BEFORE = re.compile(r"p_(\d+)")  # in the frame before
ROTATION = re.compile(r"R_(\d+)\^(\d+)")
POINTS = 2


def hold_in_any_frames(work: Work, lines: Sequence[Line], bodies: Sequence[Weighted]) -> Iterator[bool]:
    """Whether each line has the same vector at its head, in the frame of its link; names that no line has are
    those of the board."""
    problem = work.problem
    rates = {f"{name}_{dots}" for name in problem.subject.variables for dots in ("dot", "ddot")}
    own: dict[Expr, int] = {body.I: body.i for body in bodies}
    asked = frozenset().union(*(free_symbols(line.formula) for line in lines))
    given = {name: tree for name, tree in work.definitions.items() if free_symbols(name) <= asked}
    moments = {name.name: tree for name, tree in work.aside.items() if isinstance(name, Symbol)}
    turns = _turns(len(problem.subject.links) + 1)
    for at in random_points(problem.symbols | rates | {"g"}, POINTS):
        point = completed(at, {**problem.where, **moments})
        letters: dict[Expr, Any] = {Symbol(name): value for name, value in point.items()}
        names = letters | {name: _array(numbers(tree, point)) for name, tree in given.items()}
        turned = {name: _turned(name, value, turns, own) for name, value in names.items()}
        for line in lines:
            names[line.name], turned[line.name] = (_whole(line, each) for each in (names, turned))
            yield close(turned[line.name], _turned(line.name, names[line.name], turns, own))


def _whole(line: Line, names: Mapping[Expr, Any]) -> Any:
    """What a formula comes to; a vector of zeros where it is zero."""
    import numpy as np

    found = valued(line.formula, names)
    return np.zeros((3, 1)) if np.ndim(found) == 0 and VECTOR.fullmatch(line.name.name) else found


def _array(found: Any) -> Array:
    import numpy as np

    value = np.array(found, dtype=float)
    return value.reshape(-1, 1) if value.ndim == 1 else value


def _turns(count: int) -> list[Array]:
    """A rotation (3 by 3) for each frame."""
    import numpy as np

    drawn = np.random.default_rng(1)
    found = (np.linalg.qr(drawn.normal(size=(3, 3)))[0] for _ in range(count))
    return [turn * np.linalg.det(turn) for turn in found]


def _turned(name: Expr, value: Any, turns: Sequence[Array], own: Mapping[Expr, int]) -> Any:
    """What a name stands for with all frames turned."""
    if name in own:
        turn = turns[own[name]]
        return turn @ value @ turn.T
    said = name.name if isinstance(name, Symbol) else ""
    if found := ROTATION.fullmatch(said):
        inner, outer = (turns[int(i)] for i in found.groups())
        return outer @ value @ inner.T
    if found := BEFORE.fullmatch(said):
        return turns[int(found[1]) - 1] @ value
    if (found := VECTOR.fullmatch(said)) and getattr(value, "shape", ()) == (3, 1):
        return turns[int(found[1])] @ value
    return value
