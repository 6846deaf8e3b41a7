"""What an author typed and probably did not mean: 90 radians, nearly a right angle, a word that looks like a
unit. Each doubt is a message, where in the text it belongs, and what to write instead."""

from __future__ import annotations

from difflib import get_close_matches
from fractions import Fraction
from math import pi
from typing import NamedTuple

from derive.algebra.formulas.functions import ARGUMENTS
from derive.algebra.formulas.quantities import rational
from derive.algebra.formulas.tokens import GREEK, Token, tokens
from derive.algebra.formulas.units import INSTEAD, UNITS
from derive.algebra.rationals import decimal_places
from derive.expression import Expr

STEP = 15  # degrees: the angles that are told from decimals near them
NEARLY = 1e-6
FEWEST = 4  # decimal places with which an angle counts as a rounded multiple of these
LETTERS = frozenset({*GREEK.values(), *ARGUMENTS, "pi", "lambda"})


class Doubt(NamedTuple):
    """`word` is the name the doubt is about, where other places of the sheet may settle it."""

    message: str
    offset: int
    hint: str
    word: str = ""


def doubtful_angle(text: str, tree: Expr) -> Doubt | None:
    """What is doubtful about a bare number where an angle belongs: beyond a whole turn, or beside a simple
    multiple of pi; None where nothing is."""
    value = rational(tree)
    if value is None or any(token.text == "rad" for token in tokens(text)):
        return None
    shown, offset = text.strip(), len(text) - len(text.lstrip())
    if abs(value) > 2 * pi:
        hint = f"write {shown} deg for degrees, {shown} rad where radians are meant"
        return Doubt(f"{shown} is an angle in radians here, more than a whole turn", offset, hint)
    if degrees := _rounded_from(value):
        return Doubt(f"{shown} is not exactly {degrees} deg", offset, f"write {degrees} deg")
    return None


def _rounded_from(value: Fraction) -> int:
    """The multiple of 15 degrees that a decimal stands beside; 0 where there is none."""
    degrees = STEP * round(float(value) * 180 / pi / STEP)
    exact, places = degrees * pi / 180, decimal_places(value)
    rounded = places is not None and places >= FEWEST and value == round(Fraction(exact), places)
    return degrees if rounded or abs(float(value) - exact) < NEARLY else 0


def words_like_units(text: str) -> list[Doubt]:
    """A doubt for each lower-case word directly behind a number which is no unit: `3 furlong`, `30 cms`."""
    found = tokens(text)
    return [
        _unit_like(word)
        for before, word, after in zip(found, found[1:], found[2:], strict=False)
        if before.kind == "number" and _is_word(word) and after.text != "("
    ]


def _is_word(token: Token) -> bool:
    text = token.text
    plain = token.kind == "name" and text.isalpha() and text.isascii() and text.islower()
    return plain and len(text) > 1 and text not in UNITS and text not in LETTERS


def _unit_like(word: Token) -> Doubt:
    message = f"{word.text} is no unit; it is taken for a symbol"
    hint = meant_unit(word.text)
    hint += "" if hint.endswith("?") else "."
    return Doubt(message, word.offset, f"{hint} A symbol is declared under symbols:", word.text)


def meant_unit(word: str) -> str:
    """A hint: the unit that a word probably stands for, or all of them."""
    singular = word.removesuffix("s")
    close = get_close_matches(word, UNITS, n=1, cutoff=0.6)
    found = INSTEAD.get(word) or (singular if singular in UNITS else "".join(close))
    return f"did you mean {found}?" if found else f"the units are {', '.join(UNITS)}"
