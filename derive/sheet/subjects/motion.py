"""motion: rotations and translations made one after the other."""

from __future__ import annotations

from typing import Annotated, TypeAlias

from pydantic import Field

from derive.mechanics.motion import Motion
from derive.sheet.source import At
from derive.sheet.subjects.moves import MoveAboutField, move
from derive.sheet.subjects.registry import Known

HARMLESS = frozenset({"about"})
Given: TypeAlias = Annotated[list[MoveAboutField], Field(min_length=1, max_length=50)]


def build(given: Given, at: At, known: Known) -> Motion:
    """The motion of a problem."""
    return Motion(tuple(move(entry) for entry in given))
