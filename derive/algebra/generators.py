"""What the generators of a ring are: letters, roots, and functions that the normal form keeps as they are.

FLINT names generators by texts. The text of a function, `exp(2 x)`, carries the function and its arguments
with it, so that values, derivatives and trees come from them and never from the text.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Generic, Protocol, TypeVar

PI = "pi"  # the atom of fixed angles in degrees
RADIAN = "1"  # the atom of fixed angles given as plain numbers
ITSELF = ""  # the function whose value is its argument: a part of an angle such as a*sin(t)


class Argument(Protocol):
    """What functions are applied to: scalars, which are built on these names."""

    def letters(self) -> frozenset[str]:
        """The names it rests on, `pi` apart."""
        ...


A = TypeVar("A", bound=Argument)


class Opaque(str, Generic[A]):
    """A name that is the same for the same function of equal arguments (see `roots_and_functions.canonical`).

    `rate` gives the derivative of the function from its value, its arguments and their derivatives; it is
    None where there is no rule for it.
    """

    __slots__ = ("arguments", "function", "rate")

    function: str
    arguments: tuple[A, ...]
    rate: Callable[..., A] | None

    def __new__(
        cls, text: str, function: str, arguments: tuple[A, ...], rate: Callable[..., A] | None = None
    ) -> Opaque[A]:
        """The name `text` of a function of these arguments."""
        self = super().__new__(cls, text)
        self.function, self.arguments, self.rate = function, arguments, rate
        return self


ONE_ALONE = (((), Fraction(1)),)


@dataclass(frozen=True, slots=True)
class Root:
    """A root, square unless its degree says otherwise; `radicand` is a polynomial as sorted text-keyed terms,
    so that it can be a key."""

    name: str
    radicand: tuple[tuple[tuple[tuple[str, int], ...], Fraction], ...]
    degree: int = 2

    @property
    def is_sign(self) -> bool:
        """Whether it is 1 or -1, left open, and bears a name of its own."""
        return self.radicand == ONE_ALONE


def letters_of(name: str) -> frozenset[str]:
    """The names in a letter, a product such as `w*t^2`, or a function and its arguments; `pi` apart."""
    if isinstance(name, Opaque):
        return frozenset().union(*(argument.letters() for argument in name.arguments))
    return frozenset(factor.partition("^")[0] for factor in name.split("*")) - {PI, RADIAN}
