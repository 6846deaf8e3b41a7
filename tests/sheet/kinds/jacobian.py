"""A kind with options."""

from __future__ import annotations

from pydantic import Field

from derive.kinds.fields import Name, OptionsModel, Point


class Options(OptionsModel):
    """Some of every sort."""

    rows: tuple[Name, ...] = ()
    at: Point | None = None
    frame: int = Field(default=0, alias="in")
