"""Rotations and poses in SymPy: Rodrigues' formula, moves one after the other, frames seen from the world.

(Siciliano et al., Robotics, sections 2.2 to 2.7.)
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import sympy

from derive.audit.asked import Asked
from derive.mechanics.frames import ByMatrix, Frame, Frames
from derive.mechanics.motion import Motion, Move

UNIT = {"x": (1, 0, 0), "y": (0, 1, 0), "z": (0, 0, 1)}


def cross_matrix(v: Sequence[sympy.Expr]) -> sympy.Matrix:
    """S(v) (3 by 3), with S(v) w = v x w."""
    x, y, z = v
    return sympy.Matrix([[0, -z, y], [z, 0, -x], [-y, x, 0]])


def vector_of(S: sympy.Matrix) -> list[sympy.Expr]:
    """v of S(v)."""
    return [S[2, 1], S[0, 2], S[1, 0]]


def turned(axis: Sequence[sympy.Expr], angle: sympy.Expr) -> sympy.Matrix:
    """R (3 by 3) about a unit vector: 1 + sin(angle) S + (1 - cos(angle)) S^2."""
    S = cross_matrix(axis)
    return sympy.eye(3) + sympy.sin(angle) * S + (1 - sympy.cos(angle)) * S * S


def homogeneous(R: sympy.Matrix, p: Iterable[sympy.Expr] = (0, 0, 0)) -> sympy.Matrix:
    """T (4 by 4)."""
    return R.row_join(sympy.Matrix(list(p))).col_join(sympy.Matrix([[0, 0, 0, 1]]))


def moved(move: Move, asked: Asked) -> sympy.Matrix:
    """T (4 by 4) of one move: about or along an axis, a letter or a vector of any length."""
    axis = UNIT[move.axis] if isinstance(move.axis, str) else tuple(map(asked.formula, move.axis))
    unit = sympy.Matrix(axis) / sympy.sqrt(sum(part**2 for part in axis))
    by = asked.formula(move.by)
    if move.kind == "rotate":
        return homogeneous(turned(list(unit), by))
    return homogeneous(sympy.eye(3), unit * by)


def after(moves: Sequence[Move], asked: Asked) -> sympy.Matrix:
    """T (4 by 4) of moves in the order in which they are made: those of the world from the left."""
    T = sympy.eye(4)
    for move in moves:
        T = moved(move, asked) * T if move.about == "world" else T * moved(move, asked)
    return T


def local(frame: Frame, asked: Asked) -> sympy.Matrix:
    """T (4 by 4) of a frame in its parent."""
    match frame.source:
        case Motion(moves):
            return after(moves, asked)
        case ByMatrix(matrix):
            T = sympy.Matrix([[asked.formula(entry) for entry in row] for row in matrix.rows])
            return T if T.shape == (4, 4) else homogeneous(T)
        case observed:
            axes = (observed.x, observed.y, observed.z)
            R = sympy.Matrix([[asked.formula(axis[i]) for axis in axes] for i in range(3)])
            return homogeneous(R, map(asked.formula, observed.origin))


def in_world(frames: Frames, number: int, asked: Asked) -> sympy.Matrix:
    """T (4 by 4) of a frame in frame 0, by way of its parents."""
    T = sympy.eye(4)
    while number:
        frame = frames.frames[number - 1]
        T, number = local(frame, asked) * T, frame.parent
    return T


def back(T: sympy.Matrix) -> sympy.Matrix:
    """T^-1 (4 by 4), by blocks."""
    R = T[:3, :3].T
    return homogeneous(R, -R * T[:3, 3])


def seen_from(frames: Frames, source: int, target: int, asked: Asked) -> sympy.Matrix:
    """T_source^target (4 by 4), by way of the world."""
    return back(in_world(frames, target, asked)) * in_world(frames, source, asked)
