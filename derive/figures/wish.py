"""What an author says of a figure that we draw: values to draw with, and the body that frames stand on."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TypeAlias

from derive.expression import Expr

Point: TypeAlias = tuple[Expr, Expr, Expr]


@dataclass(frozen=True, slots=True)
class Polyhedron:
    """A body with flat faces, in frame 0: corners by their names (o0, o1, ... are the origins of the frames),
    faces by their corners in order, edges with the length that is written beside them, and angles (corner,
    vertex, corner) with their names."""

    corners: Mapping[str, Point]
    faces: tuple[tuple[str, ...], ...]
    lengths: tuple[tuple[str, str, Expr], ...] = ()
    angles: tuple[tuple[str, str, str, Expr], ...] = ()


@dataclass(frozen=True, slots=True)
class Wish:
    """`at` gives names the values with which they are drawn (rad, m)."""

    at: Mapping[str, Expr] = field(default_factory=dict)
    body: Polyhedron | None = None
