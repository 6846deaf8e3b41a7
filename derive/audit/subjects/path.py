"""Paths: turned by Rodrigues' formula, differentiated by SymPy, their length by quadrature in many digits."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import fields
from typing import TypeAlias, get_args

import mpmath
import sympy

from derive.audit.asked import Asked, Holds, Same, Test
from derive.audit.laws import law
from derive.audit.points import ROUNDED, Number, Point, Value, agree, shown
from derive.audit.poses import UNIT, turned
from derive.audit.splines import spline
from derive.audit.turned_along import turning
from derive.expression import Expr, free_symbols
from derive.mechanics.paths import Arc, Curve, Line, Shape, Via

SHARES = (mpmath.mpf(13) / 100, mpmath.mpf(45) / 100, mpmath.mpf(9) / 10)  # of the whole time
LETTERS = ("s", "lambda", "sigma", "u")  # of the parameter where the sheet has none
TREES = get_args(Expr)
Between: TypeAlias = tuple[sympy.Expr, sympy.Expr] | None


def path(asked: Asked, point: Point) -> Iterator[Test]:
    """Derivatives, the frame by that of the unit tangent, curvature and length; in time at two moments."""
    if isinstance(asked.subject.shape, Via):
        yield from spline(asked, point.in_digits())
        return
    s = parameter(asked)
    p, between = place(asked, s, point)
    v = p.diff(s)
    speed = sympy.sqrt(sum(each**2 for each in v))
    if asked.subject.timing is None:
        v_now, a_now = point.vector(list(v)), point.vector(list(v.diff(s)))
        for name, theirs in _frenet(asked, p, v, s, point):
            yield Same(name, theirs)
        yield Same("v", v_now)
        yield Same("a", a_now)
    else:
        yield from _in_time(asked, point.in_digits(), p, s, between, speed)
    if asked.subject.turned is not None:
        yield from _turned(asked, point.in_digits(), s, between, speed)
    if "n" not in asked.results:
        bent = sum(point.at((each / speed).diff(s)) ** 2 for each in v)
        yield Holds("curvature", agree(bent, 0), "it is bent, and has a normal")
    if "length" in asked.results:
        yield _length(asked, point.in_digits(), speed, s, between)


def _frenet(
    asked: Asked, p: sympy.Matrix, v: sympy.Matrix, s: sympy.Symbol, point: Point
) -> Iterator[tuple[str, Value]]:
    """What a path has at a value of its parameter."""
    speed = sympy.sqrt(sum(each**2 for each in v))
    yield "p", point.vector(list(p))
    t = point.vector([each / speed for each in v])
    yield "t", t
    turning = point.vector([(each / speed).diff(s) for each in v])
    size = point.at(sympy.sqrt(sum((each / speed).diff(s) ** 2 for each in v)))
    yield "curvature", size / point.at(speed)
    if "n" in asked.results:
        n = [each / size for each in turning]
        yield "n", n
        if len(n) == len(UNIT):
            yield "b", _cross(t, n)


def _in_time(
    asked: Asked, point: Point, p: sympy.Matrix, s: sympy.Symbol, between: Between, speed: sympy.Expr
) -> Iterator[Test]:
    """Everything at moments of the motion, by its law in numbers."""
    if between is None:
        raise NotImplementedError("it has no range")
    low, high = (point.at(each) for each in between)
    moved = law(asked, point, low, high, point.at(speed) if asked.subject.along else mpmath.mpf(1))
    yield Holds("time", _near(point.at(asked.result("time")), moved.whole), "it takes another time")
    v = p.diff(s)
    for share in SHARES:
        time = moved.whole * share
        place, rate, change = moved.at(time)
        there = point.where(**{s.name: place})
        v_s, a_s = there.vector(list(v)), there.vector(list(v.diff(s)))
        theirs: dict[str, Value] = dict(_frenet(asked, p, v, s, there))
        theirs["v"] = [each * rate for each in v_s]
        theirs["a"] = [each * change + other * rate**2 for each, other in zip(v_s, a_s, strict=True)]
        theirs[s.name] = place
        now = point.where(t=time)
        for name, value in theirs.items():
            yield Holds(name, _near(now.each(asked.result(name)), value), f"it is {shown(value)}")


def _turned(
    asked: Asked, point: Point, s: sympy.Symbol, between: Between, speed: sympy.Expr
) -> Iterator[Test]:
    """The orientation at moments, or at values of the parameter where no law of time is given."""
    low, high = (point.at(each) for each in between or (sympy.Integer(0), sympy.Integer(1)))
    if asked.subject.timing is None:
        for share in SHARES:
            when = low + share * (high - low)
            now = point.where(**{s.name: when})
            yield from turning(asked, point, when, now, lambda at: (at - low) / (high - low), False)
        return
    moved = law(asked, point, low, high, point.at(speed) if asked.subject.along else mpmath.mpf(1))
    for share in SHARES:
        when = moved.whole * share
        now = point.where(t=when)
        yield from turning(asked, point, when, now, lambda at: (moved.at(at)[0] - low) / (high - low), True)


def _near(ours: Value, theirs: Value) -> bool:
    if isinstance(ours, Sequence) and isinstance(theirs, Sequence):
        size = max(abs(each) for each in theirs)  # of numbers
        return all(agree(a, b, size + 1, ROUNDED) for a, b in zip(ours, theirs, strict=True))
    return agree(ours, theirs, 1, ROUNDED)


def _cross(a: Sequence[Number], b: Sequence[Number]) -> list[Number]:
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def parameter(asked: Asked) -> sympy.Symbol:
    """The author's own, or a letter that is free."""
    shape: Shape = asked.subject.shape
    if isinstance(shape, Curve):
        return sympy.Symbol(shape.parameter)
    values = [getattr(shape, each.name) for each in fields(shape)]
    trees = [each for value in values for each in (value if isinstance(value, tuple) else (value,))]
    taken = frozenset(asked.where).union(*(free_symbols(each) for each in trees if isinstance(each, TREES)))
    return sympy.Symbol(next(letter for letter in LETTERS if letter not in taken))


def place(asked: Asked, s: sympy.Symbol, point: Point) -> tuple[sympy.Matrix, Between]:
    """p(s) as a column, and the range of s."""
    shape: Shape = asked.subject.shape
    match shape:
        case Line(start, end):
            begin, final = (sympy.Matrix([asked.formula(each) for each in place]) for place in (start, end))
            size = _size(final - begin)
            return begin + (final - begin) * s / size, (sympy.Integer(0), size)
        case Curve(value=value, between=between):
            ends = None if between is None else (asked.formula(between[0]), asked.formula(between[1]))
            return sympy.Matrix([asked.formula(each) for (each,) in value.rows]), ends
        case Arc() as arc:
            return _round(arc, asked, s, point)
    raise TypeError(f"no path: {shape!r}")


def _size(vector: sympy.Matrix) -> sympy.Expr:
    return sympy.sqrt(sum(each**2 for each in vector))


def _round(arc: Arc, asked: Asked, s: sympy.Symbol, point: Point) -> tuple[sympy.Matrix, Between]:
    """Turned about its axis, in the plane about z. Raises ZeroDivisionError where a radius is negative, which
    sends the audit to another point."""
    flat = arc.axis is None
    center, away = (
        sympy.Matrix([*map(asked.formula, place), *([0] if flat else [])])
        for place in (arc.center, arc.start)
    )
    away = away - center if arc.placed else away
    r = _size(away) if arc.radius is None else asked.formula(arc.radius)
    angle = asked.formula(arc.angle)
    if point.in_digits().at(r) <= 0 or (angle.free_symbols and point.in_digits().at(angle) <= 0):
        raise ZeroDivisionError
    axis = UNIT[arc.axis or "z"] if arc.axis is None or isinstance(arc.axis, str) else arc.axis
    k = sympy.Matrix([each if isinstance(each, int) else asked.formula(each) for each in axis])
    k = k / _size(k)
    back = -1 if point.in_digits().at(angle) < 0 else 1
    by = s if arc.pitch is not None else s / r
    p = center + turned(list(back * k), by) * (away / _size(away) * r)
    if arc.pitch is not None:
        p += back * k * asked.formula(arc.pitch) * s / (2 * sympy.pi)
    end = back * angle * (1 if arc.pitch is not None else r)
    return sympy.Matrix(p[:2]) if flat else p, (sympy.Integer(0), end)


def _length(asked: Asked, point: Point, speed: sympy.Expr, s: sympy.Symbol, between: Between) -> Holds:
    """The integral of the speed, to the digits of a float."""
    if between is None:
        return Holds("length", False, "there is no range")
    low, high = (point.at(each) for each in between)
    with mpmath.workdps(20):
        theirs = mpmath.quad(
            lambda at: point.where(**{s.name: sympy.Float(at, 20)}).at(speed), mpmath.linspace(low, high, 5)
        )
    ours = point.at(asked.result("length"))
    return Holds("length", agree(ours, theirs, near=ROUNDED), f"the length is {mpmath.nstr(theirs, 10)}")


KINDS = {"path": path}
