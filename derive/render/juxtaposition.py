"""Factors side by side: where the sign goes, what may stand over a number, and where a dot is needed."""

from __future__ import annotations

import re

from derive.expression import Call, Expr, Indexed, Number, Power, Symbol
from derive.render.notation import Notation
from derive.render.trig import SHORT, is_written_out, short_index

WORDS = ("atan2", "adj", "sign")  # functions that are upright words, which TeX sets no room before
NUMERIC = re.compile(r"-?\\frac\{\d+\}\{\d+\}")


def sign_of(factors: tuple[Expr, ...]) -> tuple[str, tuple[Expr, ...]]:
    """The minus sign of a leading number, and the factors without it; a one is not written."""
    first, *rest = factors
    if not isinstance(first, Number):
        return "", factors
    size = Number(abs(first.value), first.decimal)
    kept = tuple(rest) if rest and size.value == 1 else (size, *rest)
    return ("-" if first.value < 0 else ""), kept


def is_letter(factor: Expr | None = None) -> bool:
    """Whether it may stand over a number; a rate is what its coefficient multiplies and stays outside."""
    match factor:
        case Symbol(name):
            return not name.endswith("dot")
        case Power(Symbol() as base, Number(value)):
            return is_letter(base) and value > 0 and value.denominator == 1
        case Call("sqrt", _):
            return True
        case _:
            return False


def need_room(before: Expr, after: Expr, notation: Notation) -> bool:
    """Whether two factors side by side look like something else: `cos theta` and what is no part of its
    angle, two upright words, L c_2 beside L_c, the word of a function behind what it is multiplied by."""
    match before, after:
        case (_, Call(function)) if function in WORDS:
            return True
        case (Symbol(letter), Call(function, (angle,))) if letter in notation.alike and function in SHORT:
            return bool(short_index(angle, notation))
        case (Indexed(base), Indexed(other)):
            return len(base) > 1 and len(other) > 1
    return is_written_out(before, notation) and not (is_written_out(after, notation) or is_letter(after))


def meet_as_numbers(before: str, after: str) -> bool:
    """Whether juxtaposition would read as one number: `2 3`, `2 \\frac{1}{2}`, `x 2`."""
    return after[0].isdigit() or (before[-1].isdigit() and _is_plain(before) and after[:6] == r"\frac{")


def fractions_meet(before: str, after: str) -> bool:
    """Whether a fraction of numbers stands before another fraction, where a dot keeps them apart."""
    return after[:6] == r"\frac{" and NUMERIC.fullmatch(before) is not None


def _is_plain(written: str) -> bool:
    return written.rsplit(" ", 1)[-1].replace(".", "").lstrip("-").isdigit()
