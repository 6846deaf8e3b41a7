"""Trajectories in pieces: put back where they begin, are joined and end."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import mpmath
import sympy

from derive.audit.asked import EVALUATED, Asked, Holds, Same, Test
from derive.audit.conditions import SIGN
from derive.audit.points import NEAR, Point, floating
from derive.audit.putting_back import is_real, put_back
from derive.audit.subjects.profile.polynomial import TIME, ends
from derive.audit.subjects.profile.trapezoid import found_at
from derive.mechanics.profile import Profile

ZERO = sympy.Integer(0)


@dataclass(frozen=True, slots=True)
class Piece:
    """q as a function of t from one time to another; `between` says whether that is how it is told."""

    q: sympy.Expr
    start: sympy.Expr
    end: sympy.Expr
    between: bool

    def at_start(self, rate: int) -> sympy.Expr:
        return self.q.diff(TIME, rate).subs(TIME, self.start)

    def at_end(self, rate: int) -> sympy.Expr:
        return self.q.diff(TIME, rate).subs(TIME, self.end)


def _pieces(asked: Asked) -> list[Piece]:
    """As they are told; names of results in the times stand for these."""
    known = {sympy.Symbol(n): asked.result(n) for n in asked.results if n in ("t_b", "t_f")}
    found = []
    for each in asked.objects("q"):
        first, since, t, until, last = SIGN.split(each["when"].replace("^", "**"))
        between = (since, t, until) == ("<=", "t", "<=")
        start, end = asked.read(first), asked.read(last)
        found.append(Piece(asked.read(each["q"]), start.subs(known), end.subs(known), between))
    return found


def _joined(pieces: Sequence[Piece], point: Point, smooth: Sequence[int]) -> Iterator[Test]:
    """Each begins where and as the one before it ends: in so many derivatives."""
    yield Holds("q", all(piece.between for piece in pieces), "a piece is for times from .. to ..")
    for (before, after), rates in zip(pairwise(pieces), smooth, strict=True):
        yield put_back("q", point, before.end, after.start, "a piece does not begin when the last ends")
        for rate in range(rates):
            yield put_back("q", point, before.at_end(rate), after.at_start(rate), f"derivative {rate} jumps")


def _in_numbers(pieces: Sequence[Piece], asked: Asked) -> Iterator[Test]:
    """q at a time that the author gave."""
    if "q" not in asked.evaluated:
        return
    here = asked.here
    now = floating(here["t"])
    stretches = [(piece, *(floating(here.at(t)) for t in (piece.start, piece.end))) for piece in pieces]
    piece = next((each for each, start, end in stretches if start <= now <= end), None)
    if piece is not None:
        yield Same(EVALUATED + "q", here.at(piece.q))
    else:
        yield Holds(EVALUATED + "q", False, "the motion has no such time")


# -- a straight middle --------------------------------------------------------------------------------


def lspb_trajectory(asked: Asked, point: Point) -> Iterator[Test]:
    """From rest to rest with constant accelerations a, 0, -a; the way is the area v (t_f - t_b)."""
    t_b, v, a, t_f = (asked.result(name) for name in ("t_b", "v", "a", "t_f"))
    (start, *_), (end, *_), _ = ends(asked)
    yield put_back("v", point, v * (t_f - t_b), end - start, "the area under the velocity is not the way")
    yield put_back("a", point, a * t_b, v, "the acceleration does not lead to the velocity")
    yield from _chosen(asked, point)
    pieces = _pieces(asked)
    yield from _joined(pieces, point, (2, 2))
    first, middle, last = pieces
    times = [first.start, first.end, middle.end, last.end]
    yield put_back("t_b", point, times, [ZERO, t_b, t_f - t_b, t_f], "the pieces begin and end otherwise")
    rest = [first.at_start(0), first.at_start(1), last.at_end(0), last.at_end(1)]
    yield put_back("q", point, rest, [start, ZERO, end, ZERO], "it does not go from rest to rest")
    bends = [piece.q.diff(TIME, 2) for piece in pieces]
    yield put_back("q", point, bends, [a, ZERO, -a], "the accelerations are others")
    yield from _in_numbers(pieces, asked)


def _chosen(asked: Asked, point: Point) -> Iterator[Test]:
    """What was given: the velocity, the acceleration, the duration of the blends, or limits; and the time."""
    profile: Profile = asked.subject
    journey: Any = profile.journey
    t_b, v, a, t_f = (asked.result(name) for name in ("t_b", "v", "a", "t_f"))
    if profile.time is not None:
        yield put_back("t_f", point, t_f, asked.formula(profile.time), "another time was given")
    chosen = (("v", v, journey.cruise), ("a", a, journey.acceleration), ("t_b", t_b, journey.blend))
    for name, ours, given in chosen:
        if given is not None:
            yield put_back(name, point, ours**2, asked.formula(given) ** 2, "another was given")
    halves = [point.at(t_b), point.at(t_f)]
    if all(map(is_real, halves)) and not (t_b.free_symbols | t_f.free_symbols):
        fits = 0 < floating(halves[0]) <= floating(halves[1]) / 2 + NEAR
        yield Holds("t_b", bool(fits), "the blends end before the middle")
    if journey.acceleration is not None:  # of the two roots the one with the shorter blends
        inside = point.at((t_f - 2 * t_b) ** 2)
        if is_real(inside) and all(map(is_real, halves)):
            shorter = mpmath.re(floating(halves[1]) - 2 * floating(halves[0])) >= -NEAR
            yield Holds("t_b", bool(shorter), "the blends overlap")
    if journey.cruise is journey.acceleration is journey.blend is None:
        (found,) = found_at(asked, point)
        sizes = [found.t_1, found.v**2, found.a**2, found.t_3]
        yield put_back("t_f", point, [t_b, v**2, a**2, t_f], sizes, "not the best within the limits")


# -- splines ------------------------------------------------------------------------------------------


def spline_trajectory(asked: Asked, point: Point) -> Iterator[Test]:
    """Through every place, with velocities that are the same on both sides, and accelerations where no
    velocity is given; clamped or natural at the ends."""
    profile: Profile = asked.subject
    journey: Any = profile.journey
    (start, v_start, _), (end, v_end, _), t_end = ends(asked)
    vias = journey.via
    times = [ZERO, *(asked.formula(via.time) for via in vias), t_end]
    places = [start, *(asked.formula(via.place) for via in vias), end]
    given = [None if via.velocity is None else asked.formula(via.velocity) for via in vias]
    pieces = _pieces(asked)
    yield Holds("q", len(pieces) == len(times) - 1, "a piece between every two places")
    yield from _joined(pieces, point, [3 if v is None else 2 for v in given])
    for k, piece in enumerate(pieces):
        here = [piece.start, piece.end, piece.at_start(0), piece.at_end(0), piece.q.diff(TIME, 4)]
        wanted = [*times[k : k + 2], *places[k : k + 2], ZERO]
        yield put_back("q", point, here, wanted, f"piece {k + 1} does not pass through its places")
    clamped = asked.options.ends == "clamped"
    rate, bounds = (1, [v_start, v_end]) if clamped else (2, [ZERO, ZERO])
    yield put_back(
        "q", point, [pieces[0].at_start(rate), pieces[-1].at_end(rate)], bounds, "its ends are others"
    )
    for k, velocity in enumerate(given, 1):
        if velocity is not None:
            yield put_back(f"v_{k}", point, asked.result(f"v_{k}"), velocity, "another velocity is given")
    velocities = [piece.at_start(1) for piece in pieces] + [pieces[-1].at_end(1)]
    for k, velocity in enumerate(velocities):
        yield Same(f"v_{k}", point.at(velocity))
    yield from _in_numbers(pieces, asked)
