"""What holds of every cubic spline, as steps; each law is tried in the spline at hand."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise

from derive.derivation import Step
from derive.expression import MINUS_ONE, ONE, Expr, Indexed, Symbol, add, multiply, number, symbols
from derive.kinds.profile._pieces import Span

K, TAU, Q = symbols("k tau q")
C = symbols("c_0 c_1 c_2 c_3")
TWO, THREE = number(2), number(3)
BEFORE, HERE, AFTER = K - ONE, K, K + ONE


def _at(letter: str, place: Expr) -> Indexed:
    return Indexed(letter, (place,))


def _over(top: Expr, bottom: Expr) -> Expr:
    return top / bottom


def laws(
    times: Sequence[Expr], places: Sequence[Expr], velocities: Sequence[Expr], spans: Sequence[Span],
    free: Sequence[int], natural: bool,
) -> Iterator[Step]:  # fmt: skip
    """A piece by its coefficients, these by places and velocities; the condition at the points that are
    `free`, and at a natural end."""
    h = [after - before for before, after in pairwise(times)]
    piece = _piece(h, places, velocities, spans[0])
    for name, chain in _coefficients():
        yield Step(name, chain, "law", instance=piece)
    yield Step("condition", _condition(), "law", instance=_around(h, places, velocities, free))
    if natural:
        at_the_start: dict[Expr, Expr] = {
            Symbol("v_0"): velocities[0], Symbol("v_1"): velocities[1],
            Symbol("q_0"): places[0], Symbol("q_1"): places[1], Symbol("h_0"): h[0],
        }  # fmt: skip
        yield Step("natural", _natural(), "law", instance=at_the_start)


def _coefficients() -> Iterator[tuple[str, tuple[Expr, ...]]]:
    h, v, further = _at("h", HERE), _at("v", HERE), _at("v", AFTER)
    gap = _at("q", AFTER) - _at("q", HERE)
    yield "law_q", (Q, add(C[0], C[1] * TAU, C[2] * TAU**2, C[3] * TAU**3))
    yield "law_0", (C[0], _at("q", HERE))
    yield "law_1", (C[1], v)
    yield "law_2", (C[2], THREE / h**2 * gap + MINUS_ONE * ((2 * v + further) / h))
    yield "law_3", (C[3], MINUS_ONE * (TWO / h**3) * gap + (v + further) / h**2)


def _condition() -> tuple[Expr, Expr]:
    """That the acceleration is the same on both sides of a point."""
    before, here = _at("h", BEFORE), _at("h", HERE)
    v_0, v_1, v_2 = (_at("v", place) for place in (BEFORE, HERE, AFTER))
    q_0, q_1, q_2 = (_at("q", place) for place in (BEFORE, HERE, AFTER))
    slopes = here * ((q_1 - q_0) / before) + before * ((q_2 - q_1) / here)
    return add(here * v_0, multiply(TWO, before + here, v_1), before * v_2), THREE * slopes


def _natural() -> tuple[Expr, Expr]:
    v_0, v_1, q_0, q_1, h_0 = symbols("v_0 v_1 q_0 q_1 h_0")
    return 2 * v_0 + v_1, 3 * (q_1 - q_0) / h_0


# -- where they are tried --------------------------------------------------------------------------------


def _piece(h: Sequence[Expr], q: Sequence[Expr], v: Sequence[Expr], span: Span) -> Mapping[Expr, Expr]:
    """The first piece of the spline; q at a time in it."""
    within = h[0] / THREE
    place = add(*(multiply(c, within ** number(k)) if k else c for k, c in enumerate(span.coefficients)))
    found: dict[Expr, Expr] = {Q: place, TAU: within, _at("h", HERE): h[0]}
    found |= {_at("q", HERE): q[0], _at("q", AFTER): q[1], _at("v", HERE): v[0], _at("v", AFTER): v[1]}
    return found | dict(zip(C, span.coefficients, strict=True))


def _around(
    h: Sequence[Expr], q: Sequence[Expr], v: Sequence[Expr], free: Sequence[int]
) -> Mapping[Expr, Expr]:
    """A point at which no velocity is given; where there is none, that of the spline through 0, 1 and 3 at
    the times 0, 1 and 3, at rest at both ends: its velocity in the middle is 3/2."""
    k = free[0] if free else 1
    if not free:
        h, q, v = (ONE, TWO), (number(0), ONE, THREE), (number(0), number("3/2"), number(0))
    found: dict[Expr, Expr] = {_at("h", BEFORE): h[k - 1], _at("h", HERE): h[k]}
    for place, shift in ((BEFORE, -1), (HERE, 0), (AFTER, 1)):
        found |= {_at("q", place): q[k + shift], _at("v", place): v[k + shift]}
    return found
