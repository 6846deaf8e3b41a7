"""Displacements (4 by 4) as textbooks print them: both DH matrices, moves and screws, and fixed poses."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Protocol, TypeAlias

import numpy as np
import sympy

from derive.audit.subjects.robot.series import Array, Series
from derive.expression import Expr
from derive.mechanics.frames import ByMatrix
from derive.mechanics.motion import Axis, Motion, Move
from derive.mechanics.robot import Convention, DHRow, FreeRow, Row, ScrewRow

UNITS = {"x": (1, 0, 0), "y": (0, 1, 0), "z": (0, 0, 1)}
Entry: TypeAlias = Series | int
Turn: TypeAlias = tuple[Series, Series]


class Reader(Protocol):
    """How formulas become series."""

    def series(self, tree: Expr) -> Series:
        """A length."""

    def turn(self, tree: Expr) -> tuple[Series, Series]:
        """Cosine and sine of an angle."""

    def exact(self, expr: sympy.Expr) -> Series:
        """A SymPy expression."""

    def formula(self, tree: Expr) -> sympy.Expr:
        """A formula in SymPy."""


def row_matrix(row: Row, convention: Convention, read: Reader) -> Array:
    """Frame i-1 to frame i; of a screw e^{[S] q} in the base frame."""
    match row:
        case DHRow(theta, d, a, alpha):
            by = standard if convention == "standard" else modified
            return by(read.turn(theta), read.turn(alpha), read.series(a), read.series(d))
        case FreeRow(moves):
            return moved(moves, read)
        case ScrewRow():
            return screw(row, read)


def standard(theta: Turn, alpha: Turn, a: Series, d: Series) -> Array:
    """Spong, Hutchinson, Vidyasagar, eq. 3.10; angles by their cosines and sines."""
    (c, s), (ca, sa) = theta, alpha
    return matrix([c, -s * ca, s * sa, a * c], [s, c * ca, -c * sa, a * s], [0, sa, ca, d])


def modified(theta: Turn, alpha: Turn, a: Series, d: Series) -> Array:
    """Craig, eq. 3.6: alpha and a are those of the axis before."""
    (c, s), (ca, sa) = theta, alpha
    return matrix([c, -s, 0, a], [s * ca, c * ca, -sa, -sa * d], [s * sa, c * sa, ca, ca * d])


def screw(row: ScrewRow, read: Reader) -> Array:
    """Rotation about a line and a slide along it (Lynch and Park, eq. 3.88)."""
    w = unit(row.axis, read)
    if row.slide:
        return pose(rotation((1, 0), w), w * read.series(row.by))
    R = rotation(read.turn(row.by), w)
    q = np.array([read.series(part) for part in row.through], dtype=object)
    along = read.exact(read.formula(row.pitch) * read.formula(row.by))
    return pose(R, q - R @ q + w * along)


def moved(moves: Iterable[Move], read: Reader) -> Array:
    """Moves one after the other: about a current axis from the right, about the world's from the left."""
    T = matrix([1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0])
    for move in moves:
        axis = unit(move.axis, read)
        if move.kind == "rotate":
            made = pose(rotation(read.turn(move.by), axis), np.array([0, 0, 0], dtype=object))
        else:
            made = pose(rotation((1, 0), axis), axis * read.series(move.by))
        T = made @ T if move.about == "world" else T @ made
    return T


def fixed_pose(home: Motion | ByMatrix, read: Reader) -> Array:
    """A pose that is given, as moves or as a matrix (3 by 3 or 4 by 4)."""
    if isinstance(home, Motion):
        return moved(home.moves, read)
    entries = np.array([[read.series(entry) for entry in row] for row in home.matrix.rows], dtype=object)
    at = entries[:3, 3] if entries.shape[1] == 4 else np.array([0, 0, 0], dtype=object)
    return pose(entries[:3, :3], at)


def unit(axis: Axis, read: Reader) -> Array:
    """A direction of length one."""
    if isinstance(axis, str):
        return np.array(UNITS[axis], dtype=object)
    parts = [read.formula(part) for part in axis]
    length = sympy.sqrt(sum(part**2 for part in parts))
    return np.array([read.exact(part / length) for part in parts], dtype=object)


def rotation(turn: tuple[Entry, Entry], w: Array) -> Array:
    """Rodrigues: c 1 + s [w] + (1 - c) w w^T."""
    c, s = turn
    R: Array = np.array([*UNITS.values()], dtype=object) * c + cross_matrix(w) * s + np.outer(w, w) * (1 - c)
    return R


def cross_matrix(w: Array) -> Array:
    """[w], so that [w] p = w x p."""
    return np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]], dtype=object)


def pose(R: Array, p: Array) -> Array:
    """R and p as one matrix (4 by 4)."""
    return matrix(*([*row, at] for row, at in zip(R, p, strict=True)))


def matrix(*rows: Iterable[object]) -> Array:
    """Three rows, and (0, 0, 0, 1)."""
    return np.array([*map(list, rows), [0, 0, 0, 1]], dtype=object)
