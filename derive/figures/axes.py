"""What stands at the axes of plots, and numbers in the words of who cannot see them."""

from __future__ import annotations

from derive.derivation import Label, Phrase
from derive.expression import Expr, Symbol


def axis(name: Expr | Phrase, unit: str) -> Label:
    """A quantity with its unit in brackets, where it has one."""
    return Phrase("with-unit", {"name": name, "unit": unit}) if unit else name


IN_TIME = axis(Symbol("t"), "s")


def short(value: float) -> str:
    """To three digits: what can be read off a picture."""
    return f"{value:.3g}".replace("-", "\u2212") if abs(value) > 1e-12 else "0"
