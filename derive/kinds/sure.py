"""Numbers that are certain: what a formula comes to at a point, with as many bits as that takes.

`sure("sqrt(3)*q_1", {"q_1": tree})` is a ball so small that its digits are those of the number. The formula
is a tree or a text as it stands in the JSON, read by the grammar of sheets; nothing of it was ever a float.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from contextlib import suppress
from functools import lru_cache

from flint import arb, ctx

from derive.algebra.ball_arithmetic import Balls
from derive.algebra.fold import fold
from derive.algebra.formulas.grammar import parse
from derive.errors import DivisionByZero, NotDerivable, NotReal
from derive.expression import Expr, free_symbols

FLOAT = 53  # bits
ROUNDS = (128, 512, 2048)  # bits, more of them until the digits are sure
DIGITS = 64  # bits that are sure then
NOTHING = arb(2) ** (-ROUNDS[-1] // 2)  # in the last round what may be zero and is smaller is zero
ABS = re.compile(r"\bAbs\(")
MAX = "Max(0, "
LONGEST = 10**7
MARGIN = 1e-12  # relative: within it a float and the number are the same
NO_SLACK = 1e-6  # relative: what rounding may do where one round of floats decides nothing, as at acos(1)


def sure(formula: Expr | str, point: Mapping[str, Expr]) -> arb:
    """The number (dimensionless, SI units as in the formula). Names of the point may rest on one another.

    Raises KeyError for a name without a value; NotReal or DivisionByZero where there certainly is no number;
    NotDerivable where no number of bits decides.
    """
    tree = read(formula) if isinstance(formula, str) else formula
    for bits in ROUNDS:
        with ctx.workprec(bits):
            value = _value(tree, point, _Certain)
        if value.is_finite() and (not value or value.rel_accuracy_bits() >= DIGITS):
            return value
    with ctx.workprec(ROUNDS[-1]):
        value = _value(tree, point, _Settled)
    if not value.is_finite():
        raise NotDerivable(f"{ROUNDS[-1]} bits do not decide what this number is")
    return value


def place(names: Mapping[str, Expr]) -> dict[str, float]:
    """A point in floats, by balls: for checks of what is said there. Names without a value are left out."""
    found = {}
    for name, tree in names.items():
        with suppress(KeyError, NotReal, DivisionByZero, NotDerivable):
            found[name] = float(sure(tree, names))
    return found


def rounding(formula: Expr | str, point: Mapping[str, Expr]) -> float:
    """By how much a float of it, computed in floats from end to end, may be beside it."""
    tree = read(formula) if isinstance(formula, str) else formula
    with ctx.workprec(FLOAT):
        try:
            value = _value(tree, point, Balls)
        except ZeroDivisionError:
            return float("inf")
    size = abs(float(sure(tree, point)))
    return (4 * float(value.rad()) if value.is_finite() else NO_SLACK * max(1.0, size)) + MARGIN * size


@lru_cache(maxsize=4096)
def read(text: str) -> Expr:
    """A text of the JSON as a tree, by the grammar of sheets. Raises FormulaError."""
    return parse(ABS.sub("abs(", _without_max(text)), longest=LONGEST)


def _without_max(text: str) -> str:
    """With (x + |x|)/2 for Max(0, x), and (x + y + |x - y|)/2 for any other two; no author writes Max."""
    while (begin := text.rfind(MAX)) >= 0:
        parts, end = _arguments(text, begin + len(MAX))
        largest = "0"
        for part in parts:
            apart = f"({part})" if largest == "0" else f"({largest} - ({part}))"
            largest = f"(({largest} + ({part}) + abs{apart})/2)"
        text = f"{text[:begin]}{largest}{text[end:]}"
    return text


def _arguments(text: str, start: int) -> tuple[list[str], int]:
    """Those of a call, from the place where the first begins, and the place after its bracket."""
    parts, depth, end = [""], 1, start
    while depth:
        depth += {"(": 1, ")": -1}.get(text[end], 0)
        if text[end] == "," and depth == 1:
            parts.append("")
        elif depth:
            parts[-1] += text[end]
        end += 1
    return parts, end


def _value(tree: Expr, point: Mapping[str, Expr], domain: type[Balls]) -> arb:
    """At the working precision, the names of the point after those that they rest on."""
    known: dict[str, arb] = {}

    def find(name: str) -> None:
        if name not in known:
            known[name] = arb("nan")  # a name that rests on itself has no value
            for inner in free_symbols(point[name]):
                find(inner)
            known[name] = fold(point[name], domain(known))

    for name in free_symbols(tree):
        find(name)
    return fold(tree, domain(known))


class _Certain(Balls):
    """Balls that say where there certainly is no real number."""

    def quotient(self, top: arb, bottom: arb) -> arb:
        if bottom.is_zero():
            raise DivisionByZero("a division by zero")
        return top / bottom

    def power(self, base: arb, exponent: arb) -> arb:
        if base < 0 and not exponent.contains_integer():
            raise NotReal("a power of a negative number")
        if exponent.is_integer() and exponent < 0:
            return self.quotient(arb(1), base**-exponent)
        return base**exponent

    def root(self, value: arb, degree: int) -> arb:
        if value < 0 and degree % 2 == 0:
            raise NotReal("a root of a negative number")
        return super().root(value, degree)

    def call(self, function: str, arguments: list[arb]) -> arb:
        first = arguments[0]
        beyond = {"sqrt": first < 0, "log": first <= 0, "acos": abs(first) > 1, "asin": abs(first) > 1}
        if beyond.get(function, False):
            raise NotReal(f"{function} of a number that it has no value at")
        return super().call(function, arguments)


class _Settled(_Certain):
    """The last round: what is zero to three hundred digits is zero, what is 1 to as many is 1."""

    def sum(self, terms: list[arb]) -> arb:
        return self._settled(super().sum(terms))

    def call(self, function: str, arguments: list[arb]) -> arb:
        if function in ("acos", "asin"):
            arguments = [next((arb(n) for n in (1, -1) if abs(x - n) < NOTHING), x) for x in arguments]
        return self._settled(super().call(function, list(map(self._settled, arguments))))

    @staticmethod
    def _settled(value: arb) -> arb:
        return arb(0) if value.contains(0) and abs(value) < NOTHING else value
