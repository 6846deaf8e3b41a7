"""Numbers as LaTeX: fractions, decimals as typed, and rounded ones to the digits of the sheet."""

from __future__ import annotations

import re
from fractions import Fraction
from math import isclose, isfinite

from derive.algebra.rationals import decimal_places
from derive.errors import NotAsWritten

SMALLEST_PLAIN, LARGEST_PLAIN = -3, 5  # powers of ten printed without an exponent
OHM = r"\Omega"
DECIMAL = re.compile(r"-?(?:0|[1-9]\d*)\.\d+")
UNIT_NAME = re.compile(r"[A-Za-z]+|^1(?=/)")
MOST_ZEROS = 6  # at the end of a decimal number without an exponent, or behind its point
NEARLY = 1e-6  # of a whole number: what is so near is one
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
    """A unit behind a number, `\\ \\mathrm{m}/\\mathrm{s}^2`; behind degrees `/\\mathrm{s}^2`."""
    return ("" if unit.startswith("/") else r"\ ") + UNIT_NAME.sub(_upright, unit).replace(" ", r"\ ")


def _upright(name: re.Match[str]) -> str:
    """One name alone, so that a power is that of its letter and as high."""
    return rf"\mathrm{{{OHM if name[0] == 'ohm' else name[0]}}}"


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
    written = f"{sign}{digits[:-places]}.{digits[-places:]}"
    if not DECIMAL.fullmatch(written) or Fraction(written) != value:
        raise NotAsWritten(f"{value} is written as {written}")
    return written


def _scientific(digits: str, exponent: int) -> str:
    if digits == "1":
        return f"10^{{{exponent}}}"
    mantissa = f"{digits[0]}.{digits[1:]}" if len(digits) > 1 else digits
    return rf"{mantissa} \cdot 10^{{{exponent}}}"


def rounded_latex(value: float, digits: int) -> str:
    """A float to so many significant digits, without trailing zeros: `0.433`, `1.2 \\cdot 10^{-5}`. One that
    only rounds to a whole number keeps them, `4.00`, so that it does not look like one."""
    if not isfinite(value):
        return r"\infty" if value > 0 else r"-\infty" if value < 0 else r"\text{undefined}"
    if abs(value) < ZERO_BELOW:
        return "0"
    mantissa, power = f"{value:.{digits - 1}e}".split("e")
    exponent = int(power)
    if SMALLEST_PLAIN <= exponent < max(LARGEST_PLAIN, digits):
        written = f"{float(f'{mantissa}e{power}'):.{max(digits - 1 - exponent, 0)}f}"
        return written if _looks_whole(written, value) else _trimmed(written)
    return rf"{_trimmed(mantissa)} \cdot 10^{{{exponent}}}"


def _looks_whole(written: str, value: float) -> bool:
    """Whether a number is written as a whole one that it is not."""
    return not written.partition(".")[2].strip("0") and not isclose(float(written), value, rel_tol=NEARLY)


def _trimmed(written: str) -> str:
    return written.rstrip("0").rstrip(".") if "." in written else written
