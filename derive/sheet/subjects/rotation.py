"""rotation: a rotation matrix that is given as such."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from derive.expression import Matrix
from derive.kinds.fields import OptionsModel, Quantity
from derive.mechanics.rotations import GivenRotation
from derive.sheet.source import At
from derive.sheet.subjects.registry import Known
from derive.sheet.written_pose import by_matrix

Row = Annotated[list[Quantity], Field(min_length=3, max_length=3)]


class Given(OptionsModel):
    """A rotation by its matrix."""

    matrix: Annotated[list[Row], Field(min_length=3, max_length=3)]
    """The rows of the matrix, in numbers or formulas (of the time t where it turns); nine names, as r11,
    stand for any rotation."""


def build(given: Given, at: At, known: Known) -> GivenRotation:
    """The rotation of a problem. Raises SheetErrors where the matrix is none."""
    named = GivenRotation(Matrix(tuple(map(tuple, given.matrix))))
    if named.names and not known.where.keys() & {*named.names}:
        return named
    found = by_matrix(given.matrix, "the rotation", at / "matrix", known)
    return GivenRotation(found.matrix, found.rounded)
