"""Units as they stand behind a number: `mm`, `kg m^2`, `m/s^2`, `N m`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from derive.algebra.formulas.tokens import Token
from derive.algebra.formulas.units import ANGLE_UNITS, LETTERS, UNITS

MAX_UNIT_POWER = 9


@dataclass(frozen=True, slots=True)
class Phrase:
    """Units with their powers, where they begin in the text, and the index of the token after them."""

    parts: tuple[tuple[str, int], ...]
    offset: int
    end: int

    @property
    def text(self) -> str:
        """The names of the units, with blanks between them."""
        return " ".join(name for name, _ in self.parts)

    @property
    def letters(self) -> bool:
        """Whether all of it could just as well be symbols."""
        return all(name in LETTERS for name, _ in self.parts)


def unit_phrase(tokens: Sequence[Token], at: int, every: bool) -> Phrase | None:
    """The longest unit that starts at this token, or None where it reads as symbols.

    `every` is False where only deg and rad are read. Letters followed by a name or a parenthesis are
    symbols (`2 m L`), and so is g beside another unit (`2 m g` is a weight, not a metre gram).
    """
    known = UNITS.keys() if every else ANGLE_UNITS
    parts: list[tuple[str, int]] = []
    end, sign = at, 1
    while tokens[end].text in known and tokens[end].kind == "name":
        exponent, after = _exponent(tokens, end + 1)
        if exponent is None:
            return None
        parts.append((tokens[end].text, sign * exponent))
        end = after
        sign, start = _joint(tokens, end)
        if tokens[start].text not in known or tokens[start].kind != "name":
            break
        end = start
    phrase = Phrase(tuple(parts), tokens[at].offset, end)
    return phrase if parts and not _reads_as_symbols(phrase, tokens[end]) else None


def _exponent(tokens: Sequence[Token], at: int) -> tuple[int | None, int]:
    """The power of a unit (1 if none; None if it is no small integer) and the token after it."""
    if tokens[at].text != "^":
        return 1, at
    negative = tokens[at + 1].text == "-"
    digits = tokens[at + 1 + negative]
    if not digits.text.isdigit() or int(digits.text) > MAX_UNIT_POWER:
        return None, at
    return (-1 if negative else 1) * int(digits.text), at + 2 + negative


def _joint(tokens: Sequence[Token], at: int) -> tuple[int, int]:
    """How the next unit would join on: the sign of its power, and the token where it would stand.

    A `*` joins units only where it touches both (`kg*m^2`): `5 kg * g` is a product with a symbol.
    """
    sign = tokens[at]
    if sign.text == "/":
        return -1, at + 1
    if sign.text == "*" and tokens[at - 1].end == sign.offset and tokens[at + 1].offset == sign.end:
        return 1, at + 1
    return 1, at


def _reads_as_symbols(phrase: Phrase, after: Token) -> bool:
    weight = any(name == "g" and power > 0 for name, power in phrase.parts) and len(phrase.parts) > 1
    followed = after.kind == "name" or after.text == "("
    return weight or (phrase.letters and followed)
