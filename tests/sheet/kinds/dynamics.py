"""A kind that needs masses and gravity."""

from __future__ import annotations

from derive.kinds.fields import OptionsModel


class Options(OptionsModel):
    """None."""


NEEDS = ("bodies", "gravity")
