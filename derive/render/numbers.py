"""Numbers as LaTeX: fractions, decimals as typed, and rounded ones to the digits of the sheet."""

from __future__ import annotations

import re
from fractions import Fraction
from itertools import zip_longest
from math import isfinite

from derive.algebra.rationals import decimal_places

SMALLEST_PLAIN, LARGEST_PLAIN = -3, 5  # powers of ten printed without an exponent
OHM = r"\Omega"
MOST_ZEROS = 6  # at the end of a decimal number without an exponent, or behind its point
ZERO_BELOW = 1e-12  # what rounding leaves of a zero


def fraction_latex(value: Fraction, decimal: bool = False) -> str:
    """`\\frac{1}{2}`, `-3`, or as a decimal fraction where it ends: `0.35`."""
    if decimal and (written := _terminating(value)):
        return written
    sign = "-" if value < 0 else ""
    if value.denominator == 1:
        return str(value.numerator)
    return rf"{sign}\frac{{{abs(value.numerator)}}}{{{value.denominator}}}"


def unit_latex(unit: str) -> str:
    """A unit behind a number, `\\ \\mathrm{m/s}^2`; what degrees are divided by, `/\\mathrm{s}^2`."""
    if unit.startswith("/"):
        return "/" + _upright(unit[1:])
    return r"\ " + _upright(unit)


def _upright(unit: str) -> str:
    """Powers stand behind what is upright: not every reader of TeX knows a script inside it."""
    parts = re.split(r"\^(\d+)", unit)
    words = [r"\ ".join(OHM if word == "ohm" else word for word in part.split(" ")) for part in parts[::2]]
    written = [rf"\mathrm{{{word}}}" for word in words if word]
    return "".join(
        f"{word}^{power}" for word, power in zip_longest(written, parts[1::2], fillvalue="")
    ).rstrip("^")


def _terminating(value: Fraction) -> str:
    """The decimal fraction equal to a rational, with every digit it has; "" where it never ends."""
    places = decimal_places(value)
    if places is None:
        return ""
    digits = str(abs(value.numerator) * 10**places // value.denominator)
    sign, zeros = "-" if value < 0 else "", len(digits) - len(digits.rstrip("0"))
    if places - len(digits) >= MOST_ZEROS or (places == 0 and zeros > MOST_ZEROS):
        return sign + _scientific(digits.rstrip("0"), len(digits) - 1 - places)
    if not places:
        return sign + digits
    digits = digits.zfill(places + 1)
    return f"{sign}{digits[:-places]}.{digits[-places:]}"


def _scientific(digits: str, exponent: int) -> str:
    if digits == "1":
        return f"10^{{{exponent}}}"
    mantissa = f"{digits[0]}.{digits[1:]}" if len(digits) > 1 else digits
    return rf"{mantissa} \cdot 10^{{{exponent}}}"


def rounded_latex(value: float, digits: int) -> str:
    """A float to so many significant digits, without trailing zeros: `0.433`, `1.2 \\cdot 10^{-5}`."""
    if not isfinite(value):
        return r"\infty" if value > 0 else r"-\infty" if value < 0 else r"\text{undefined}"
    if abs(value) < ZERO_BELOW:
        return "0"
    mantissa, power = f"{value:.{digits - 1}e}".split("e")
    exponent = int(power)
    if SMALLEST_PLAIN <= exponent < max(LARGEST_PLAIN, digits):
        return _trimmed(f"{float(f'{mantissa}e{power}'):.{max(digits - 1 - exponent, 0)}f}")
    return rf"{_trimmed(mantissa)} \cdot 10^{{{exponent}}}"


def _trimmed(written: str) -> str:
    return written.rstrip("0").rstrip(".") if "." in written else written
