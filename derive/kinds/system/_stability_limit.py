"""What can be read off an array of Routh besides its conditions: where a system is only just stable."""

from __future__ import annotations

from derive.algebra.readable.form import readable
from derive.algebra.scalar import Scalar
from derive.algebra.solving.polynomials import known_sign, numerator
from derive.control.hurwitz import is_impossible, is_never
from derive.expression import Expr
from derive.kinds.system._stability_answer import Answer

MOST_TERMS = 10  # of a frequency squared


def limiting(answer: Answer) -> Scalar | None:
    """The condition that the row of s brings in; None where it follows from the others."""
    entry = numerator(answer.array.rows[-2].entries[0])
    if known_sign(entry, answer.positive) is not None or is_impossible(answer.conditions, answer.positive):
        return None
    for each in answer.conditions:
        if not is_never(each) and known_sign(entry / each, answer.positive) is not None:
            return each
    return None


def frequency_squared(answer: Answer) -> Scalar | None:
    """r_2 / r_1 of the row of s^2; None where the row of s cannot be made to vanish, or r_2 / r_1 is long."""
    if len(answer.array.rows) < 3 or answer.array.mended or not limiting(answer):
        return None
    first, second = answer.array.rows[-3].entries[:2]
    square = second / first
    long = max(len(square.numerator), len(square.denominator or square.ring.one)) > MOST_TERMS
    return square if second and not long else None


def is_marginal(answer: Answer) -> bool:
    """Whether only a row of zeros stands against stability."""
    never = [each for each in answer.conditions if is_never(each)]
    return answer.array.mended == ("derivative",) and not any(never)


def possible(answer: Answer) -> tuple[Scalar, ...]:
    """The conditions that can hold."""
    return tuple(each for each in answer.conditions if not is_never(each))


def of_one_sign(answer: Answer) -> tuple[Expr, ...]:
    """The coefficients, where the conditions say no more than that they have one sign, whichever."""
    lead, *rest = answer.array.polynomial
    if (
        len(rest) > 2
        or any(k.constant is not None for k in rest)
        or known_sign(lead, answer.positive) is not None
    ):
        return ()
    return tuple(readable(k, answer.plant.style) for k in answer.array.polynomial)


def necessary(answer: Answer) -> str:
    """Whether all coefficients are there and of one sign, and whether that is enough: "met", "violated" or
    "open", of low degree "met-enough" or "open-enough"."""
    low = len(answer.array.rows) < 4
    lead, *rest = (known_sign(k, answer.positive) if k else 0 for k in answer.array.polynomial)
    if 0 in rest or (lead is not None and -lead in rest):
        return "violated"
    if lead is None or None in rest:
        return "open-enough" if low else "open"
    return "met-enough" if low else "met"
