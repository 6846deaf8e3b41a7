"""What a point reaches within limits, and how it is said and measured."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from derive.algebra.matrix import ScalarMatrix
from derive.derivation import Phrase
from derive.expression import ZERO, Expr
from derive.kinds.robot._reach.spans import Span


@dataclass(frozen=True, slots=True)
class Shape:
    """What is reached: its `kind` ("box", "ring", "rail", "ball"), between which angles the first joint
    turns it (None: all), how far it goes along the `rail` and the `lift` (None: there is none; a Span
    without ends goes on), the `rise` (see Crossed) as a function of the second joint with its least and
    its largest value. `formulas` lead to its distances and its size."""

    kind: str
    rows: tuple[int, ...]
    distance: Span
    formulas: Mapping[str, tuple[Expr, ...]]
    arm: Phrase
    description: Phrase
    turn: tuple[Expr, Expr] | None = None
    rail: Span | None = None
    lift: Span | None = None
    rise: tuple[Expr, Expr, Expr] | None = None
    center: ScalarMatrix | None = None
    side: Expr = ZERO
    called: str = ""  # the key of the region, without what it is said with
    measure: str = ""  # "area", "volume", "" where it has no end or none is found
    sides: tuple[Span, ...] = field(default=())  # of a box
    borders: Phrase | None = None  # what they are
    link: Expr = ZERO  # the last one
    far_start: Expr = ZERO  # how far away it turns round with its start in the ring that the others reach
    gap: Expr | None = None  # the hole of that ring
