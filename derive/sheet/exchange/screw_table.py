"""Screw axes [omega, v] as Lynch and Park list them (Modern Robotics, 4.1): v = -omega x q + h omega."""

from __future__ import annotations

from fractions import Fraction
from math import fabs
from typing import TYPE_CHECKING

from derive.sheet.exchange.told import Data, Told
from derive.sheet.exchange.values import exact, written

if TYPE_CHECKING:
    from derive.sheet.exchange.table import Row

OMEGA, V = ("wx", "wy", "wz"), ("vx", "vy", "vz")
UNIT = 1e-3  # a rounded direction has a length this near to 1


def screw(told: Told, index: int, row: Row) -> None:
    """A screw axis of the base frame as the row of a robot. Raises SheetErrors."""
    omega, v = _numbers(row, OMEGA), row.some(V) or ["0", "0", "0"]
    element = row.element(OMEGA[0])
    if not any(omega):
        if all(_value(each) == 0 for each in v):
            raise element.error("omega and v are both zero: nothing moves")
        told.put({"slide": list(v)}, row.element(V[0]), "links", index, "screw")
        told.put(f"d{index + 1}*", element, "links", index, "variable")
        return
    square = sum(each * each for each in omega)
    if fabs(square - 1) > UNIT:
        raise element.error("omega is a unit vector, or zero where a joint slides")
    through = [
        _sum([(omega[j] / square, v[k]), (-omega[k] / square, v[j])]) for j, k in ((1, 2), (2, 0), (0, 1))
    ]
    axis: dict[str, Data] = {"axis": [written(each) for each in omega], "through": list(through)}
    pitch = _sum([(a / square, b) for a, b in zip(omega, v, strict=True)])
    if not _nothing(pitch, v):
        axis["pitch"] = pitch
    told.put(axis, element, "links", index, "screw")
    told.put(f"theta{index + 1}*", element, "links", index, "variable")


def _numbers(row: Row, columns: tuple[str, ...]) -> list[Fraction]:
    found = []
    for column, cell in zip(columns, row.some(columns), strict=False):
        if (value := _value(cell)) is None:
            message = f"'{cell}' is no number"
            raise row.element(column).error(message, "the direction of an axis is given by numbers")
        found.append(value)
    return found


def _value(text: str) -> Fraction | None:
    try:
        return exact(text.removesuffix("m").strip())
    except ValueError:
        return None


def _sum(terms: list[tuple[Fraction, str]]) -> str:
    """A sum of factors times what was typed, as a number where all are numbers."""
    kept = [(factor, text) for factor, text in terms if factor and _value(text) != 0]
    values = [(factor, value) for factor, text in kept if (value := _value(text)) is not None]
    if len(values) == len(kept):
        return written(sum((factor * value for factor, value in values), start=Fraction(0)), "m")
    if len(kept) == 1 and kept[0][0] == 1:
        return kept[0][1]
    return " + ".join(_product(factor, text) for factor, text in kept).replace("+ -", "- ")


def _product(factor: Fraction, text: str) -> str:
    simple = text.replace("_", "").isalnum()
    if factor == 1:
        return text if simple or len(text.split()) == 1 else f"({text})"
    if factor == -1:
        return f"-{text}" if simple else text[1:] if text[1:].replace("_", "").isalnum() else f"-({text})"
    return f"{written(factor)}*({text})"


def _nothing(pitch: str, v: list[str]) -> bool:
    """Whether a pitch is zero, or what rounding left of it."""
    value = _value(pitch)
    sizes = [fabs(each) for each in map(_value, v) if each is not None]
    return value is not None and fabs(value) <= UNIT * max(sizes, default=0.0)
