"""orientation: how a body turns from one orientation to another while it goes along a path."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Any, Literal, TypeAlias

from pydantic import AfterValidator, Discriminator, Field, Tag

from derive.errors import SheetError
from derive.expression import Expr, free_symbols
from derive.kinds.fields import TREES, Angle, OptionsModel, Quantity
from derive.mechanics.euler import Convention
from derive.mechanics.motion import Move
from derive.mechanics.paths import Oriented, Turned
from derive.sheet.checked import values_in
from derive.sheet.faults import NO_FORM
from derive.sheet.source import At, Faults
from derive.sheet.subjects.moves import MoveAboutField, move
from derive.sheet.subjects.registry import Known
from derive.sheet.written_pose import by_matrix

FORMS = "write three angles of the convention, {matrix: [[..], ..]} or {motion: [{rotate: z, by: ..}, ..]}"
Row = Annotated[list[Quantity], Field(min_length=3, max_length=3)]
Angles: TypeAlias = tuple[Angle, Angle, Angle]


class OfMatrix(OptionsModel):
    """An orientation by its matrix."""

    matrix: Annotated[list[Row], Field(min_length=3, max_length=3)]
    """The rows of the matrix."""


class OfMotion(OptionsModel):
    """An orientation by turns."""

    motion: Annotated[list[MoveAboutField], Field(min_length=1, max_length=12)]
    """The turns, in the order in which they are made."""


def _form(value: Any) -> str | None:
    if isinstance(value, list | tuple):
        return "=angles"
    keys = value if isinstance(value, dict) else vars(value) if isinstance(value, OptionsModel) else ()
    return next((f"={form}" for form in ("matrix", "motion") if form in keys), None)


End: TypeAlias = Annotated[
    Annotated[OfMatrix, Tag("=matrix")]
    | Annotated[OfMotion, Tag("=motion")]
    | Annotated[Angles, Tag("=angles")],
    Discriminator(_form, custom_error_type=NO_FORM, custom_error_message=FORMS),
]


def _known(text: str) -> str:
    Convention.of(text)
    return text


class GivenOrientation(OptionsModel):
    """From one orientation to another, in proportion to the parameter of the path."""

    start: End = Field(alias="from")
    """The orientation at the start: three angles of the convention, a matrix, or a motion."""
    end: End = Field(alias="to")
    """The orientation at the end, likewise."""
    by: Literal["axis-angle", "euler-angles", "slerp"] = "axis-angle"
    """axis-angle: about one axis; euler-angles: each angle by itself; slerp: by unit quaternions."""
    convention: Annotated[str, AfterValidator(_known)] = "ZYX"
    """The order of the angles: ZYX about current axes, xyz about world axes, as in SciPy."""


def turned(given: GivenOrientation, at: At, known: Known) -> Turned:
    """How the body turns. Raises SheetErrors: a matrix that is no rotation, no angles, symbols."""
    Faults(_faults(given, at, known)).settle()
    first, last = (
        _oriented(each, key, given, at, known) for each, key in ((given.start, "from"), (given.end, "to"))
    )
    return Turned(first, last, given.by, given.convention)


def _faults(given: GivenOrientation, at: At, known: Known) -> Iterator[SheetError]:
    for key, end in (("from", given.start), ("to", given.end)):
        if given.by == "euler-angles" and not isinstance(end, tuple):
            hint = f"give three angles of the convention {given.convention}: {key}: [0, 90 deg, 0]"
            yield at.fault("its angles are not given", (key,), hint)
        trees = (
            end if isinstance(end, tuple) else (tree for _, tree in values_in(end) if isinstance(tree, TREES))
        )
        names = {name for tree in trees for name in free_symbols(tree)} - known.where.keys()
        if names:
            hint = "give it a value, here or under where:"
            yield at.fault(f"'{min(names)}' in an orientation has no value", (key,), hint)
        if isinstance(end, OfMotion) and any(move(each).kind == "translate" for each in end.motion):
            yield at.fault("a translation is no turn", (key,), "give turns alone: {rotate: z, by: ..}")


def _oriented(end: Any, key: str, given: GivenOrientation, at: At, known: Known) -> Oriented:
    if isinstance(end, OfMatrix):
        return Oriented(matrix=by_matrix(end.matrix, "the orientation", at / key / "matrix", known).matrix)
    if isinstance(end, OfMotion):
        return Oriented(tuple(map(move, end.motion)))
    return Oriented(_moves(end, Convention.of(given.convention)), angles=end)


def _moves(angles: tuple[Expr, Expr, Expr], convention: Convention) -> tuple[Move, ...]:
    pairs = zip(convention.axes, angles, strict=True)
    return tuple(Move("rotate", _letter(axis), angle, convention.about) for axis, angle in pairs)


def _letter(axis: str) -> Literal["x", "y", "z"]:
    return "x" if axis == "x" else "y" if axis == "y" else "z"
