"""Numbers as LaTeX: fractions, decimals as typed, and rounded ones to the digits of the sheet."""

from __future__ import annotations

from fractions import Fraction
from math import isfinite

SMALLEST_PLAIN, LARGEST_PLAIN = -3, 5  # powers of ten printed without an exponent
ZERO_BELOW = 1e-12  # what rounding leaves of a zero


def fraction_latex(value: Fraction, decimal: bool = False) -> str:
    """`\\frac{1}{2}`, `-3`, or as a decimal fraction where it ends: `0.35`."""
    if decimal and (written := _terminating(value)):
        return written
    sign = "-" if value < 0 else ""
    if value.denominator == 1:
        return str(value.numerator)
    return rf"{sign}\frac{{{abs(value.numerator)}}}{{{value.denominator}}}"


def _terminating(value: Fraction) -> str:
    """The decimal fraction equal to a rational, or "" where there is none of decent length."""
    for places in range(13):
        scaled = value * 10**places
        if scaled.denominator == 1:
            return f"{float(value):.{places}f}" if abs(value) < 10**12 else str(int(value))
    return ""


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
