"""Linkages whose bars are laid end to end: each assembly closes, and its rates are those of the loop."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import mpmath
import sympy

from derive.audit.algebra import solution
from derive.audit.asked import Asked, Beyond, Holds, Same, Test
from derive.audit.points import Number, Point
from derive.expression import free_symbols
from derive.mechanics.linkages import FourBar

TRIES = 300
CLOSE, ROUGH = mpmath.mpf(10) ** -25, mpmath.mpf(10) ** -9  # of sure numbers, and of floats
THIRD, FOURTH = sympy.symbols("theta_3 theta_4")


def position(asked: Asked, point: Point) -> Iterator[Test]:
    """The loop closes in both assemblies, which differ."""
    yield from _assemblies(asked, point, ())


def velocity(asked: Asked, point: Point) -> Iterator[Test]:
    """The rates by SymPy's derivatives of the gap, and those of each assembly."""
    gap, names, crank = _gap(asked), _unknown(asked), _angle(asked)
    rates = [sympy.Symbol(f"_{name}_rate") for name in names]
    driving = sympy.Symbol(f"{crank}_dot")
    flow = [
        sympy.diff(side, crank) * driving
        + sum(sympy.diff(side, name) * rate for name, rate in zip(names, rates, strict=True))
        for side in gap
    ]
    angle = asked.formula(asked.subject.angle)
    found = [each.subs(crank, angle) for each in solution(flow, rates)]
    for name, each in zip(names, found, strict=True):
        yield Same(f"{name}_dot", point.at(each))
    yield from _assemblies(asked, point, tuple(zip(names, found, strict=True)))


def singularities(asked: Asked, point: Point) -> Iterator[Test]:
    """At each angle of the crank two bars lie in line, or the rod is upright."""
    if not asked.objects("solutions"):
        yield Beyond("solutions", "there are none")
    there = point if not point.exact else point.in_digits()
    for each in asked.objects("solutions"):
        angle, *moved = (asked.read(told) for name, told in each.items() if name != "when")
        yield Holds("solutions", _lie_in_line(asked, there, angle, CLOSE), "no bars lie in line there")
        if not moved:
            continue
        built = next((each for each in _positive(asked, point) if _is_built(asked, each, angle)), None)
        if built is None:
            yield Beyond("solutions", "no bars were found that have such a position")
        else:
            joined = _joined(asked, built, angle, moved[0], CLOSE)
            yield Holds("solutions", joined, "the bars are not joined there")
    for k, each in enumerate(asked.objects("evaluated solutions") if asked.evaluated else ()):
        if not each.get("real", True):
            angle = next(told for name, told in asked.objects("solutions")[k].items() if name != "when")
            unreal = mpmath.im(_value(asked.here, asked.read(angle)))
            yield Holds("evaluated solutions", unreal != 0, "there is such an angle")
            continue
        told = [told for name, told in each.items() if name not in ("when", "real")]
        if any(isinstance(value, str) for value in told):
            yield Beyond("evaluated solutions", "symbols are left")
            continue
        angle, *moved = (sympy.Float(value, 17) for value in told)
        yield Holds("evaluated solutions", _lie_in_line(asked, asked.here, angle, ROUGH), "no bars do")
        if moved and _is_built(asked, asked.here, angle):
            joined = _joined(asked, asked.here, angle, moved[0], ROUGH)
            yield Holds("evaluated solutions", joined, "the bars are not joined there")


def _is_built(asked: Asked, there: Point, angle: sympy.Expr) -> bool:
    """Whether the bars have lengths and the crank a real angle."""
    names = (
        ("crank", "coupler", "rocker", "ground") if isinstance(asked.subject, FourBar) else ("crank", "rod")
    )
    bars = [there.at(asked.formula(getattr(asked.subject, name))) for name in names]
    return all(bar > 0 for bar in bars) and not mpmath.im(there.at(angle))


def _joined(asked: Asked, there: Point, angle: sympy.Expr, moved: sympy.Expr, near: mpmath.mpf) -> bool:
    """Whether the bar behind the crank is as long as it is with the rocker, or the slider, so."""
    linkage = asked.subject
    crank = asked.formula(linkage.crank)
    if isinstance(linkage, FourBar):
        rocker, rod = asked.formula(linkage.rocker), asked.formula(linkage.coupler)
        x, y = asked.formula(linkage.ground) + rocker * sympy.cos(moved), rocker * sympy.sin(moved)
    else:
        rod, x, y = asked.formula(linkage.rod), moved, asked.formula(linkage.offset)
    gap = (x - crank * sympy.cos(angle)) ** 2 + (y - crank * sympy.sin(angle)) ** 2 - rod**2
    return bool(abs(there.at(gap)) < near * (1 + abs(there.at(rod)) ** 2))


def _lie_in_line(asked: Asked, there: Point, angle: sympy.Expr, near: mpmath.mpf) -> bool:
    """Whether one of the distances between joints is what it is where bars lie in line."""
    linkage = asked.subject
    c, s = sympy.cos(angle), sympy.sin(angle)
    crank = asked.formula(linkage.crank)
    if isinstance(linkage, FourBar):
        coupler, rocker, ground = (
            asked.formula(getattr(linkage, name)) for name in ("coupler", "rocker", "ground")
        )
        apart = (crank * c - ground) ** 2 + (crank * s) ** 2
        gaps = [apart - (coupler + rocker) ** 2, apart - (coupler - rocker) ** 2]
        for end in (crank + coupler, crank - coupler):
            gaps.append((end * c - ground) ** 2 + (end * s) ** 2 - rocker**2)
    else:
        rod, height = asked.formula(linkage.rod), asked.formula(linkage.offset)
        gaps = [crank * s - height - rod, crank * s - height + rod]
        gaps += [(crank + rod) * s - height, (crank - rod) * s - height]
    size = 1 + abs(there.at(crank)) ** 2
    return bool(min(abs(there.at(gap)) for gap in gaps) < near * size)


def _assemblies(
    asked: Asked, point: Point, rates: tuple[tuple[sympy.Symbol, sympy.Expr], ...]
) -> Iterator[Test]:
    there = _place(asked, point)
    found = [in_turn(asked, each, there) for each in asked.objects("solutions")]
    yield Holds("solutions", all(_closes(asked, each, CLOSE) for each in found), "the loop is open")
    last = _unknown(asked)[-1].name
    apart = abs(mpmath.expj(found[0][last]) - mpmath.expj(found[1][last])) > ROUGH
    yield Holds("solutions", len(found) == 2 and bool(apart), "the assemblies are one")
    for each in found:
        for name, rate in rates:
            gap = abs(each.at(rate) - each[f"{name}_dot"])
            same = bool(gap < CLOSE * (1 + abs(each.at(rate))))
            yield Holds("solutions", same, f"the rate of {name} differs")
    if asked.evaluated:
        for told in asked.objects("evaluated solutions"):
            if any(isinstance(value, str) for name, value in told.items() if name != "when"):
                yield Beyond("evaluated solutions", "symbols are left")
            elif told.get("real", True):
                told = {name: _float(value) for name, value in told.items() if name != "when"}
                here = asked.here.where(**told)
                yield Holds("evaluated solutions", _closes(asked, here, ROUGH), "the loop is open")


def _place(asked: Asked, point: Point) -> Point:
    """Where bars can be joined."""
    for there in _positive(asked, point):
        values = [in_turn(asked, each, there) for each in asked.objects("solutions")]
        if all(mpmath.im(each[name.name]) == 0 for each in values for name in _unknown(asked)):
            return there
    raise NotImplementedError("no position was found in which the bars can be joined")


def _positive(asked: Asked, point: Point) -> Iterator[Point]:
    """Points at which what has a letter in a linkage is positive."""
    sizes = [getattr(asked.subject, name) for name in type(asked.subject).__dataclass_fields__]
    positive = dict.fromkeys(frozenset().union(*map(free_symbols, sizes)), "positive")
    for k in range(TRIES):
        yield Point(point.seed * TRIES + k, False, (), {**positive, **asked.assumptions})


def in_turn(asked: Asked, branch: Mapping[str, Any], there: Point) -> Point:
    """The point with the names of a branch, each by those before it; a root of less than nothing is complex,
    and what is made of it is no place."""
    for name, told in branch.items():
        if name != "when":
            value = _value(there, asked.read(told))
            there = there.where(**{name: value})
    return there


def _value(there: Point, expr: sympy.Expr) -> Number:
    try:
        return there.at(expr)
    except (TypeError, ValueError, ZeroDivisionError):
        return mpmath.mpc(0, 1)


def _float(value: Any) -> mpmath.mpf:
    return mpmath.mpf(float(value))


def _closes(asked: Asked, there: Point, near: mpmath.mpf) -> bool:
    size = 1 + sum(abs(there.at(asked.formula(getattr(asked.subject, name)))) for name in ("crank",))
    angle = asked.formula(asked.subject.angle)
    gap = [side.subs(_angle(asked), angle) for side in _gap(asked)]
    return all(abs(there.at(side)) < near * size for side in gap)


def _gap(asked: Asked) -> list[sympy.Expr]:
    """Along x and y, between the ends of the bars laid out from both sides."""
    linkage, crank = asked.subject, _angle(asked)
    end = _bar(asked.formula(linkage.crank), crank)
    if isinstance(linkage, FourBar):
        there = _sum(end, _bar(asked.formula(linkage.coupler), THIRD))
        ground = [asked.formula(linkage.ground), sympy.Integer(0)]
        back = _sum(ground, _bar(asked.formula(linkage.rocker), FOURTH))
    else:
        there = _sum(end, _bar(asked.formula(linkage.rod), THIRD))
        back = [_unknown(asked)[-1], asked.formula(linkage.offset)]
    return [one - other for one, other in zip(there, back, strict=True)]


def _angle(asked: Asked) -> sympy.Symbol:
    angle = asked.formula(asked.subject.angle)
    return angle if angle.is_Symbol else sympy.Symbol("theta_2")


def _unknown(asked: Asked) -> list[sympy.Symbol]:
    if isinstance(asked.subject, FourBar):
        return [THIRD, FOURTH]
    names = asked.objects("solutions")[0]
    return [THIRD, sympy.Symbol("s" if "s" in names else "s_p")]


def _bar(length: sympy.Expr, angle: sympy.Expr) -> list[sympy.Expr]:
    return [length * sympy.cos(angle), length * sympy.sin(angle)]


def _sum(one: list[sympy.Expr], other: list[sympy.Expr]) -> list[sympy.Expr]:
    return [a + b for a, b in zip(one, other, strict=True)]
