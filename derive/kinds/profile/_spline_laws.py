"""What holds of every cubic spline, as steps; each law is tried in a spline of plain numbers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from derive.derivation import Step
from derive.expression import MINUS_ONE, ONE, Expr, Indexed, add, multiply, number, symbols

K, TAU, Q = symbols("k tau q")
C = symbols("a_0 a_1 a_2 a_3")
TWO, THREE = number(2), number(3)
BEFORE, HERE, AFTER = K - ONE, K, K + ONE


def _at(letter: str, place: Expr) -> Indexed:
    return Indexed(letter, (place,))


def _over(top: Expr, bottom: Expr) -> Expr:
    return top / bottom


def laws(natural: bool, spans: int) -> Iterator[Step]:
    """A piece by its coefficients, these by places and velocities; the condition between two of so many
    pieces, and those at natural ends."""
    for name, chain in _coefficients():
        yield Step(name, chain, "law", instance=_piece())
    yield Step("condition", _condition(), "law", instance=_two_pieces())
    if natural:
        first, last = (_natural(*ends) for ends in ((0, 1, 0), (spans, spans - 1, spans - 1)))
        yield Step("natural", first[0], "law", instance=_numbers(first[1], [2, 50, 1, 37, 2]))
        yield Step("natural_end", last[0], "law", instance=_numbers(last[1], [-2, -50, 1, 37, 2]))


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


def _natural(end: int, beside: int, piece: int) -> tuple[tuple[Expr, Expr], Sequence[Expr]]:
    """That the acceleration is zero at an end, with the names in it. It is tried with 1 + 2 tau + 4 tau^3 for
    a time of 2, which begins without acceleration, and with that run backwards."""
    names = v, v_beside, q, q_beside, h = symbols(f"v_{end} v_{beside} q_{end} q_{beside} h_{piece}")
    if end:
        return (v_beside + 2 * v, 3 * (q - q_beside) / h), names
    return (2 * v + v_beside, 3 * (q_beside - q) / h), names


# -- where they are tried --------------------------------------------------------------------------------


def _numbers(names: Sequence[Expr], values: Sequence[int | str]) -> Mapping[Expr, Expr]:
    return dict(zip(names, map(number, values), strict=True))


def _places(letter: str, *places: Expr) -> list[Expr]:
    return [_at(letter, place) for place in places]


def _piece() -> Mapping[Expr, Expr]:
    """q = 1 + 2 tau + 3 tau^2 + 4 tau^3 for a time of 2, at tau = 1/2."""
    names = [Q, TAU, *C, _at("h", HERE), *_places("q", HERE, AFTER), *_places("v", HERE, AFTER)]
    return _numbers(names, ["13/4", "1/2", 1, 2, 3, 4, 2, 1, 49, 2, 62])


def _two_pieces() -> Mapping[Expr, Expr]:
    """The same, and after it q = 49 + 62 tau + 27 tau^2 + 5 tau^3 for a time of 1: where they meet the
    acceleration is 54 on both sides."""
    places, velocities = (_places(letter, BEFORE, HERE, AFTER) for letter in "qv")
    return _numbers([*_places("h", BEFORE, HERE), *places, *velocities], [2, 1, 1, 49, 143, 2, 62, 131])
