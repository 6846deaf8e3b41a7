"""A kind without options."""

from __future__ import annotations

from derive.kinds.fields import OptionsModel


class Options(OptionsModel):
    """None."""
