"""The words of a formula: numbers, names and signs, each with its place in the text."""

from __future__ import annotations

import keyword
import re
from fractions import Fraction
from typing import Literal, NamedTuple, TypeAlias, cast

from derive.errors import FormulaError

MAX_TEXT = 2000
MAX_DIGITS = 40  # before the point
MAX_PLACES = 1000  # behind it
MAX_EXPONENT = 99

_GREEK_NAMES = (
    "alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi omicron pi rho sigma tau"
    " upsilon phi chi psi omega Gamma Delta Theta Lambda Xi Pi Sigma Upsilon Phi Psi Omega phi theta epsilon"
    " sigma"
)
GREEK = dict(zip("αβγδεζηθικλμνξοπρστυφχψωΓΔΘΛΞΠΣΥΦΨΩϕϑϵς", _GREEK_NAMES.split(), strict=True))
SUBSCRIPTS = dict(zip("₀₁₂₃₄₅₆₇₈₉", "0123456789", strict=True))
SUPERSCRIPTS = dict(zip("⁰¹²³⁴⁵⁶⁷⁸⁹", "0123456789", strict=True))
SIGNS = {sign: sign for sign in "+-*/^(),="} | {
    "\N{MULTIPLICATION SIGN}": "*",
    "\N{MIDDLE DOT}": "*",
    "\N{DOT OPERATOR}": "*",
    "\N{MINUS SIGN}": "-",
    "\N{EN DASH}": "-",
    "\N{DIVISION SIGN}": "/",
}
# Words of programming languages: two of them side by side would read as a product of names.
# `lambda` stays a name, as it is a Greek letter.
CODE_WORDS = frozenset(keyword.kwlist) - {"lambda"} | {"eval", "exec", "open", "print", "getattr"}
# What most formulas are made of, wherever nothing beside it could belong to it too.
PLAIN = re.compile(
    r" *(?:(?P<name>[A-Za-z][A-Za-z0-9]*(?:_[A-Za-z0-9]+)*)(?![A-Za-z0-9_."
    + "".join((*GREEK, *SUBSCRIPTS))
    + r"])|(?P<number>[0-9]{1,40})(?![0-9.eE])|(?P<sign>[-+/^(),=]|\*(?!\*)))"
)
NUMERAL = re.compile(r"(?P<whole>[0-9]*)(?P<places>\.[0-9]*)?(?:[eE](?P<power>[+-]?[0-9]+))?")
NOT_A_FORMULA = "this is not a formula"
PRIMES = "'′’"
NAMED = re.compile(r"[^\W\d]\w*$")
ALLOWED = "numbers, names, + - * / ^, parentheses and functions such as cos and sqrt"


# The last three are of LaTeX only: a command, the end of a row, and a wide space between statements.
Kind: TypeAlias = Literal["number", "name", "sign", "end", "command", "row", "gap"]


class Token(NamedTuple):
    """`text` is normalised (Greek letters spelled out, `**` as `^`, a command without its backslash);
    `offset` counts from 0."""

    kind: Kind
    text: str
    offset: int
    end: int


def tokens(text: str, longest: int = MAX_TEXT) -> tuple[Token, ...]:
    """The tokens of a formula with an end token last. Raises FormulaError."""
    if len(text) > longest:
        raise FormulaError(f"a formula of {len(text)} characters is too long (at most {longest})", 0)
    found: list[Token] = []
    at = 0
    while at < len(text):
        if (plain := PLAIN.match(text, at)) and (word := plain[plain.lastindex or 0]) not in CODE_WORDS:
            at = plain.end()
            found.append(Token(cast(Kind, plain.lastgroup), word, at - len(word), at))
            continue
        if text[at].isspace():
            at += 1
            continue
        found.extend(read := _read(text, at))
        at = read[-1].end
    return (*found, Token("end", "", len(text), len(text)))


def value_of(number: str) -> tuple[Fraction, bool]:
    """The exact value of the text of a number, and whether it was typed as a decimal."""
    return Fraction(number), not number.isdigit()


def places_of(number: str) -> int:
    """The digits after the point of a number: 4 in 0.0130, 5 in 1.30e-3."""
    mantissa, _, power = number.lower().partition("e")
    return max(len(mantissa.partition(".")[2]) - int(power or 0), 0)


def _read(text: str, at: int) -> list[Token]:
    """The token at this place (a superscript is two: the sign `^` and its digits)."""
    char = text[at]
    if _digit(char) or (char == "." and _digit(text[at + 1 : at + 2])):
        return [_number(text, at)]
    if _letter(char):
        return [_name(text, at)]
    if char == "°":
        return [Token("name", "deg", at, at + 1)]
    if char in SUPERSCRIPTS:
        return _superscript(text, at)
    if text[at : at + 2] == "**":
        return [Token("sign", "^", at, at + 2)]
    if char in SIGNS:
        return [Token("sign", SIGNS[char], at, at + 1)]
    if char in PRIMES:
        raise FormulaError(f"{NOT_A_FORMULA}: a prime cannot stand in one", at, _unprimed(text, at))
    raise FormulaError(f"{NOT_A_FORMULA}: '{char}' cannot stand in one", at, f"use {ALLOWED}")


def _unprimed(text: str, at: int) -> str:
    """A hint: how the derivative is written that somebody meant by a prime here."""
    name = NAMED.search(text[:at])
    count = len(text[at:]) - len(text[at:].lstrip(PRIMES))
    ending = "_dot" if count == 1 else "_ddot"
    return f"use {ALLOWED}" if name is None else f"a derivative in time is written {name[0]}{ending}"


def _number(text: str, at: int) -> Token:
    found = NUMERAL.match(text, at)
    assert found is not None  # it begins like one
    whole, places, power = (found[part] or "" for part in ("whole", "places", "power"))
    if len(whole) > MAX_DIGITS or len(places) > MAX_PLACES:
        raise FormulaError(f"a number of more than {MAX_DIGITS} digits", at, "shorten it")
    if len(power) > 4 or abs(int(power or 0)) > MAX_EXPONENT:
        place = at + len(whole) + len(places)
        raise FormulaError(f"a power of ten beyond {MAX_EXPONENT}", place, "use a smaller exponent")
    if text[found.end() : found.end() + 1] == ".":
        raise FormulaError("a number has one decimal point", found.end())
    return Token("number", found[0], at, found.end())


def _name(text: str, at: int) -> Token:
    end = at
    while end < len(text) and (_letter(text[end]) or _digit(text[end]) or text[end] in SUBSCRIPTS):
        end += 1
    name = "".join(GREEK.get(char) or SUBSCRIPTS.get(char) or char for char in text[at:end])
    if name.startswith("_") or "__" in name or name in CODE_WORDS:
        raise FormulaError(f"{NOT_A_FORMULA}: '{name}' is no name", at, f"use {ALLOWED}")
    if name.endswith("_"):
        raise FormulaError(f"the name '{name}' ends in an underscore", at, f"write {name.rstrip('_')}")
    if text[end : end + 1] == ".":
        raise FormulaError(f"{NOT_A_FORMULA}: nothing can follow a name after a point", end, f"use {ALLOWED}")
    return Token("name", name, at, end)


def _superscript(text: str, at: int) -> list[Token]:
    end = at
    while end < len(text) and text[end] in SUPERSCRIPTS:
        end += 1
    digits = "".join(SUPERSCRIPTS[char] for char in text[at:end])
    return [Token("sign", "^", at, at), Token("number", digits, at, end)]


def _digit(char: str) -> bool:
    return char.isascii() and char.isdigit()


def _letter(char: str) -> bool:
    return (char.isascii() and char.isalpha()) or char == "_" or char in GREEK
