"""frames: given by their observed axes, by a matrix, or by a motion."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, Any, TypeAlias

from pydantic import Discriminator, Field, Tag

from derive.expression import ZERO, Expr, Product, Quotient, Sum, Symbol, add, free_symbols, multiply
from derive.kinds.fields import Formula, OptionsModel, Point, Quantity
from derive.mechanics.frames import Frame, Frames, FrameSource, Observed
from derive.mechanics.motion import Motion
from derive.sheet.source import At, Faults
from derive.sheet.subjects.moves import MoveField, move
from derive.sheet.subjects.registry import Known
from derive.sheet.written_pose import by_matrix, orthonormal

HARMLESS = frozenset({"frame", "in", "origin"})


class _Parent(OptionsModel):
    frame: int | None = Field(default=None, ge=1)
    """The number of a frame that is given once more, as seen from another one."""
    parent: int | None = Field(default=None, alias="in", ge=0)
    """The frame in which this one is given; the one before it if left out."""


class ObservedFrame(_Parent):
    """A frame by its axes, in terms of those of the parent, as `x: 0.6*x2 - 0.8*y2`."""

    x: Formula
    """The x-axis of the frame, in the axes of its parent."""
    y: Formula
    """The y-axis of the frame, in the axes of its parent."""
    z: Formula
    """The z-axis of the frame, in the axes of its parent."""
    origin: Point = (ZERO, ZERO, ZERO)
    """The origin of the frame in its parent."""


class MatrixFrame(_Parent):
    """A frame by a homogeneous transform or a rotation matrix."""

    matrix: Annotated[list[list[Quantity]], Field(max_length=20)]
    """The rows of the matrix."""


class MotionFrame(_Parent):
    """A frame by the motion that brings the axes of its parent there."""

    motion: Annotated[list[MoveField], Field(min_length=1, max_length=50)]
    """The moves in the order in which they are made."""


def _form(value: Any) -> str:
    keys = value if isinstance(value, dict) else {}
    return "=matrix" if "matrix" in keys else "=motion" if "motion" in keys else "=observed"


FrameField: TypeAlias = Annotated[
    Annotated[ObservedFrame, Tag("=observed")]
    | Annotated[MatrixFrame, Tag("=matrix")]
    | Annotated[MotionFrame, Tag("=motion")],
    Discriminator(_form),
]
Given: TypeAlias = Annotated[list[FrameField], Field(min_length=1, max_length=50)]


def build(given: Given, at: At, known: Known) -> Frames:
    """The frames of a problem. Raises SheetErrors: axes that are no right-handed orthonormal frame."""
    faults = Faults()
    frames: list[Frame] = []
    again: list[Frame] = []
    count = 0
    for index, entry in enumerate(given):
        second = entry.frame is not None and entry.frame <= count
        count += not second
        with faults.gathered():
            if second:
                again.append(_second(entry, count, at / index, known))
            else:
                frames.append(_frame(entry, count, at / index, known))
    faults.settle()
    return Frames(tuple(frames), tuple(again))


def _second(given: FrameField, count: int, at: At, known: Known) -> Frame:
    """A frame given once more, in any other frame known so far."""
    number, parent = given.frame or 0, given.parent
    if parent is None or parent == number or parent > count:
        hint = f"say with in: which frame it is seen from, another one of 0 to {count}"
        raise at.error(f"frame {number} is given again", ("frame",), hint)
    return Frame(number, parent, _source(given, number, parent, at, known))


def _frame(given: FrameField, number: int, at: At, known: Known) -> Frame:
    parent = number - 1 if given.parent is None else given.parent
    if given.frame is not None and given.frame != number:
        hint = f"frames are numbered in their order; this one is frame {number}"
        raise at.error(f"frame {given.frame} is given before frame {number}", ("frame",), hint)
    if parent >= number:
        hint = f"frame {number} can be given in a frame from 0 to {number - 1}"
        raise at.error(f"frame {number} cannot be given in frame {parent}", ("in",), hint)
    return Frame(number, parent, _source(given, number, parent, at, known))


def _source(given: FrameField, number: int, parent: int, at: At, known: Known) -> FrameSource:
    if isinstance(given, MotionFrame):
        return Motion(tuple(move(entry) for entry in given.motion))
    if isinstance(given, MatrixFrame):
        return by_matrix(given.matrix, f"frame {number}", at / "matrix", known)
    return _observed(given, number, parent, at, known)


def _observed(given: ObservedFrame, number: int, parent: int, at: At, known: Known) -> Observed:
    axes = tuple(f"{letter}{parent}" for letter in "xyz")
    faults, read = Faults(), []
    for name, expr in (("x", given.x), ("y", given.y), ("z", given.z)):
        try:
            read.append(weights(expr, axes))
        except WeightsError as error:
            hint = f"frame {number} is given in frame {parent}: write it with {', '.join(axes)}"
            faults.append(at.fault(f"{name}: {error}", (name,), hint + ", or say which frame with 'in:'"))
    faults.settle()
    turned, places = orthonormal(read, "axes", f"frame {number}", at, known)
    return Observed(turned[0], turned[1], turned[2], given.origin, places)


class WeightsError(ValueError):
    """The expression is no combination of the axes."""


def weights(expr: Expr, axes: Sequence[str]) -> tuple[Expr, Expr, Expr]:
    """The factors of the three axes in a linear combination. Raises WeightsError."""
    x, y, z = (_factor(expr, axis, axes) for axis in axes)
    return x, y, z


def _factor(expr: Expr, axis: str, axes: Sequence[str]) -> Expr:
    match expr:
        case Symbol(name) if name in axes:
            return multiply() if name == axis else ZERO
        case Sum(terms):
            return add(*(_factor(term, axis, axes) for term in terms))
        case Product(factors):
            return _of_product(factors, axis, axes)
        case Quotient(top, bottom) if not free_symbols(bottom) & set(axes):
            above = _factor(top, axis, axes)
            return ZERO if above == ZERO else above / bottom
    if expr == ZERO:
        return ZERO
    raise WeightsError(f"this is no combination of {', '.join(axes)}")


def _of_product(factors: tuple[Expr, ...], axis: str, axes: Sequence[str]) -> Expr:
    with_axes = [factor for factor in factors if free_symbols(factor) & set(axes)]
    if len(with_axes) != 1:
        raise WeightsError(f"this is no combination of {', '.join(axes)}")
    inner = _factor(with_axes[0], axis, axes)
    return multiply(*(inner if factor is with_axes[0] else factor for factor in factors))
