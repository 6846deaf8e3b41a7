"""Names of generators that know what they stand for: functions that the normal form keeps as they are.

`exp(2 x)` is one generator of a ring, and generators are named by texts. This text carries the function and
its arguments with it, so that values, derivatives and trees come from them and never from the text.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from derive.algebra.scalar import Scalar

ITSELF = ""  # the function whose value is its argument: a part of an angle such as a*sin(t)


class Opaque(str):
    """A name that is the same for the same function of equal arguments; see `kernels.canonical`."""

    __slots__ = ("arguments", "function")

    function: str
    arguments: tuple[Scalar, ...]

    def __new__(cls, text: str, function: str, arguments: tuple[Scalar, ...]) -> Opaque:
        self = super().__new__(cls, text)
        self.function = function
        self.arguments = arguments
        return self
