"""Values at random points, to so many digits that what differs there does differ."""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from itertools import repeat

from flint import arb, ctx, fmpq

from derive.algebra.ball_arithmetic import precise
from derive.algebra.infix import text
from derive.errors import NotDerivable
from derive.expression import Call, Expr, Symbol, children, free_symbols, walk

BITS = 200
SHARP = 1e-20  # a value less certain is none: atan2 of what is not real is anything up to pi
NEAR = 1e-6  # relative to their size: what two formulas may differ by where the point itself is rounded
NO_VALUE = (ValueError, ZeroDivisionError, OverflowError, NotDerivable, KeyError, RecursionError)
RATES = ("_dot", "_ddot")

Names = Mapping[Expr, Expr]
Point = Mapping[str, Fraction]


class _Values(dict[str, arb]):
    """The numbers of a point; names that stand for expressions are worked out when they are met."""

    def __init__(self, point: Point, names: Names) -> None:
        super().__init__({name: _exact(value) for name, value in point.items()})
        self.names = names

    def __missing__(self, name: str) -> arb:
        tree = self.names.get(Symbol(name))
        if tree is None:
            raise KeyError(name)
        value = self[name] = precise(tree, self)
        return value


def value_at(tree: Expr, names: Names, point: Point) -> arb | None:
    """The value of a scalar with its bounds; None where it has no real one."""
    with ctx.workprec(BITS):
        try:
            value = precise(tree, _Values(point, names))
        except NO_VALUE:
            return None
        sharp = value.is_finite() and float(value.rad()) <= SHARP * max(1.0, abs(float(value.mid())))
        return value if sharp else None


def shown(tree: Expr, names: Names, evaluated: bool) -> str:
    """A scalar as text; as a number where numbers are wanted and it is one."""
    number = value_at(tree, names, {}) if evaluated and not unknowns(tree, names) else None
    return text(tree) if number is None else f"{float(number.mid()):.9g}"


def has_none_at(tree: Expr, names: Names, point: Point) -> bool:
    """Whether a root or an inverse function in the tree surely has no real value at a point."""
    with ctx.workprec(BITS):
        for node in walk(tree):
            if isinstance(node, Call) and node.function in ("sqrt", "acos", "asin", "log"):
                inside = value_at(node.arguments[0], names, point)
                if inside is not None and _outside(node.function, inside):
                    return True
    return False


def _outside(function: str, inside: arb) -> bool:
    return bool(inside < 0) if function in ("sqrt", "log") else bool(abs(inside) > 1)


def apart(left: arb, right: arb, angle: bool = False, rounded: bool = False) -> bool:
    """Whether two values surely differ; as angles, by more than whole turns. At a `rounded` point they
    differ only where rounding cannot explain it."""
    with ctx.workprec(BITS):
        gap = left - right
        if angle:
            gap = abs((gap / 2).sin())
        if rounded:
            size = 1 if angle else max(1.0, abs(float(left.mid())), abs(float(right.mid())))
            return bool(abs(gap) > NEAR * size)
        return not gap.contains(0)


def distance(left: arb, right: arb, angle: bool = False) -> float:
    """How far two values are apart; as angles, the shorter way round."""
    gap = float((left - right).mid())
    return abs(math.remainder(gap, 2 * math.pi)) if angle else abs(gap)


@dataclass(frozen=True)
class Sampling:
    """Where to look: `signed` names take either sign from the start, `positive` ones only one; `given` are
    points that lie where the symbols belong together, as the elements of a rotation do."""

    signed: frozenset[str] = frozenset()
    positive: frozenset[str] = frozenset()
    given: tuple[Point, ...] = ()

    @property
    def rounded(self) -> bool:
        """Whether the points themselves are rounded, so that equal formulas may differ a little there."""
        return bool(self.given)

    def usual(self, names: Iterable[str], count: int) -> Iterator[Point]:
        """Points as one meets them: lengths are positive, angles and coordinates of either sign."""
        if self.given:
            wanted = sorted(names)
            for point in self.given:
                yield {**self._fill(wanted), **{name: point[name] for name in wanted if name in point}}
            return
        for k, draw in enumerate(_draws(names, count)):
            yield {name: draw(k > 2 and name in self.signed) for name in sorted(names)}

    def odd(self, names: Iterable[str], count: int) -> Iterator[Point]:
        """Points where whatever is not said to be positive may be negative."""
        if self.given:
            return
        for draw in _draws([*names, "odd"], count):
            yield {name: draw(name not in self.positive) for name in sorted(names)}

    def _fill(self, names: Iterable[str]) -> Point:
        draw = next(_draws(names, 1))
        return {name: draw(False) for name in sorted(names)}


def _draws(names: Iterable[str], count: int) -> Iterator[Callable[[bool], Fraction]]:
    """As many times what draws a number of either sign, or a positive one; the same for the same names."""
    source = random.Random(" ".join(sorted(names)))

    def drawn(signed: bool) -> Fraction:
        size = Fraction(source.randint(200, 1900), 1000)
        return -size if signed and source.random() < 0.5 else size

    return repeat(drawn, count)


def unknowns(tree: Expr, names: Names) -> frozenset[str]:
    """The symbols a tree depends on in the end."""
    found: set[str] = set()
    seen: set[Expr] = set()
    pending = [tree]
    while pending:
        for name in free_symbols(pending.pop()):
            symbol = Symbol(name)
            if symbol not in seen:
                seen.add(symbol)
                if symbol in names:
                    pending.append(names[symbol])
                else:
                    found.add(name)
    return frozenset(found)


def turning(trees: Iterable[Expr], names: Names) -> frozenset[str]:
    """The symbols that stand inside a sine, a cosine or a tangent, and rates: of either sign by nature."""
    found: set[str] = set()
    for tree in trees:
        for node in walk(tree):
            if isinstance(node, Call) and node.function in ("cos", "sin", "tan"):
                found |= unknowns(children(node)[0], names)
            elif isinstance(node, Symbol) and node.name.endswith(RATES):
                found.add(node.name)
    return frozenset(found)


def _exact(value: Fraction) -> arb:
    with ctx.workprec(BITS):
        return arb(fmpq(value.numerator, value.denominator))
