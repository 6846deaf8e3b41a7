"""A path through points that are passed at given times: a cubic spline of each coordinate.

Between two pieces nothing jumps but the third derivative, so that p(t) is one formula: the first piece, and
for each point that is passed a cube which begins there (Siciliano et al., section 4.2.2; de Boor, A Practical
Guide to Splines, chapter 9).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.numbers.floats import number as value_of
from derive.algebra.scalar import Scalar
from derive.derivation import Figure, Phrase, Record, Result, Step, Table
from derive.expression import (
    ZERO,
    Approximate,
    Call,
    Expr,
    Matrix,
    Symbol,
    add,
    column,
    free_symbols,
    multiply,
    number,
    symbols,
)
from derive.kinds.path._drawn import curve_in_the_plane, over_time, unit_of_places
from derive.kinds.path._frenet import E_B, E_N, E_T, KAPPA
from derive.kinds.path._length import integral
from derive.kinds.path._naming import place_name
from derive.kinds.path._spline_bend import BENDS, FRAME, bend, in_line, sized, unit_vectors
from derive.kinds.path._spline_checks import Told, held
from derive.kinds.path._timing import T
from derive.kinds.problem import Problem
from derive.kinds.profile._knots import Knots, plain, read, span_of, system
from derive.kinds.profile._pieces import Span
from derive.kinds.profile._spline_laws import laws
from derive.kinds.work import Work
from derive.mechanics.paths import Via
from derive.names import free

AXES = symbols("x y z")
C = symbols("a_0 a_1 a_2 a_3")
ORDERS = 3  # the place and two derivatives


class SplineTold(Record):
    """The points, the system for the velocities there, the pieces; steps."""

    natural: bool
    points: Table
    pieces: Table
    count: int
    bends: Phrase | None  # None where only the motion is asked for
    frame: tuple[str, ...]  # steps of the normal and the binormal
    length: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Splined:
    """The board with the velocities at the points; `spans` has of each coordinate its pieces."""

    work: Work
    shape: Via
    names: tuple[Symbol, Symbol, Symbol]
    V: Symbol
    L: Symbol
    knots: tuple[Knots, ...]
    spans: tuple[tuple[Span, ...], ...]
    told: SplineTold

    @property
    def on_page(self) -> dict[str, str | Expr]:
        """What the results are called there."""
        p, v, a = self.names
        return {
            "p": p.name, "v": v.name, "a": a.name,
            "length": self.L.name, "curvature": KAPPA.name,
            "t": E_T.name, "n": E_N.name, "b": E_B.name,
        }  # fmt: skip

    def by_time(self, order: int) -> Matrix:
        """The place, or a derivative, as one formula of the time."""
        return column(self._coordinate(spans, order) for spans in self.spans)

    def _coordinate(self, spans: tuple[Span, ...], order: int) -> Expr:
        """The derivative of the first piece, and what begins at each point after it."""
        work = self.work
        first, *others = spans
        start = self.work.scalar(first.start)
        coefficients = [work.scalar(each) for each in first.coefficients]
        terms = _differentiated(coefficients, order)
        tau: Expr = T if not start else T - self._time(first)
        found = [multiply(work.readable(each), _power(tau, k)) for k, each in enumerate(terms) if each]
        before = first
        for span in others:
            jump = work.scalar(span.coefficients[3]) - work.scalar(before.coefficients[3])
            for _ in range(order):
                jump = jump * (3 - _)
            if jump:
                later = Call("max", (ZERO, T - self._time(span)))
                found.append(multiply(work.readable(jump), _power(later, 3 - order)))
            before = span
        return add(*found) if found else ZERO

    def _time(self, span: Span) -> Expr:
        return self.work.problem.final(span.start)

    def results(self) -> dict[str, Result]:
        """p, v and a; the unit tangent, and where there are such normal and binormal; curvature, length."""
        p, v, a = (self.by_time(order) for order in range(ORDERS))
        squared = add(*(entry**2 for (entry,) in v.rows))
        speed = Call("sqrt", (squared,))
        found: dict[str, Result] = {"p": p, "v": v, "a": a, "t": column(e / speed for (e,) in v.rows)}
        found["curvature"] = sized(v, a) / multiply(squared, speed)
        found |= unit_vectors(v, a, speed) if self.told.frame else {}
        if self.L in self.work.known:
            found["length"] = self.work.final(self.L)
        return found

    def proved(self, results: Mapping[str, Result]) -> Work:
        """With what it is held to."""
        facts = self.told
        told = Told(self.V, self.knots, self.spans, facts.points, facts.pieces, facts.bends, results)
        return held(self.work, self.shape, told)

    def drawn(self, results: Mapping[str, Result]) -> Iterator[Figure]:
        """The path in the plane, and the motion over time, where numbers say them."""
        p, v, a = (results[key] for key in "pva")
        if any(isinstance(each, Matrix) and _letters(each) for each in (p, v, a)):
            return
        ends = tuple(value_of(self.work.problem.final(each), {}) for each in self.shape.times)
        unit = unit_of_places(self.work.problem)
        if isinstance(p, Matrix) and len(p.rows) == 2:
            yield curve_in_the_plane(p, T.name, ends[0], ends[-1], unit, ends[1:-1])
        yield over_time((p, v, a), ends[0], ends[-1], self.work.problem)


def splined(problem: Problem, bent: bool) -> Splined:
    """Of a problem whose subject is a path through points; how it bends is told where that is asked for."""
    shape: Via = problem.subject.shape
    work = Work(problem)
    p = place_name(problem)
    names = p, Symbol(f"{p.name}_dot"), Symbol(f"{p.name}_ddot")
    knots = tuple(_knots(shape, work, k) for k in range(len(shape.places[0])))
    solved = [_solved(each) for each in knots]
    A = solved[0][0]
    B = ScalarMatrix.beside([b for _, b, _ in solved])
    found = ScalarMatrix.beside([v for *_, v in solved])
    V = Symbol(free(problem.taken, "V", "V_p"))
    decimals = problem.style.decimals
    shown = Matrix(tuple(tuple(read(work.readable(v), decimals) for v in row) for row in found.rows))
    right = Matrix(tuple(tuple(read(work.readable(v), decimals) for v in row) for row in B.rows))
    spans = tuple(
        tuple(span_of(each, v.entries, k) for k in range(each.spans))
        for each, (*_, v) in zip(knots, solved, strict=True)
    )
    work = work.showing(
        *laws(shape.ends == "natural", knots[0].spans),
        Step("system", (multiply(plain(A, knots[0]), V), right), "unsolved"),
        Step("velocities", (V, shown), "unsolved"),
    )
    length, L = _length(work, shape, spans), Symbol(free(problem.taken, "L", "L_p", "ell"))
    frame = () if in_line(shape, work) else FRAME[: len(shape.places[0]) - 1]
    work = work.showing(*bend(names, frame, len(shape.places[0]))) if bent else work
    work = work if length is None else work.line(L, value=length, rule="in-numbers")
    told = SplineTold(
        natural=shape.ends == "natural",
        points=_points(shape),
        pieces=_pieces(spans, decimals),
        count=len(shape.places[0]),
        bends=Phrase(BENDS[len(frame)]) if bent else None,
        frame=frame[::-1] if bent else (),
        length=() if length is None else (L.name,),
    )
    return Splined(work, shape, names, V, L, knots, spans, told)


def _knots(shape: Via, work: Work, coordinate: int) -> Knots:
    """One coordinate: no velocity at the ends, or none that is given."""
    ends = ZERO if shape.ends == "clamped" else None
    inside = (None,) * (len(shape.times) - 2)
    places = tuple(place[coordinate] for place in shape.places)
    return Knots(shape.times, places, (ends, *inside, ends), shape.ends, work)


def _solved(knots: Knots) -> tuple[ScalarMatrix, ScalarMatrix, ScalarMatrix]:
    """The system and the velocities that solve it."""
    A, b = system(knots)
    return A, b, A.inverse() @ b


def _length(work: Work, shape: Via, spans: tuple[tuple[Span, ...], ...]) -> Approximate | None:
    """By quadrature, piece by piece; None where symbols are left."""
    total = 0.0
    for pieces in zip(*spans, strict=True):
        coefficients = [[work.problem.final(c) for c in piece.coefficients] for piece in pieces]
        if any(free_symbols(c) for row in coefficients for c in row):
            return None
        rates = [[k * value_of(c, {}) for k, c in enumerate(row)][1:] for row in coefficients]
        h = value_of(work.problem.final(pieces[0].end - pieces[0].start), {})

        def speed(tau: float, of: list[list[float]] = rates) -> float:
            return math.hypot(*(sum(c * tau**k for k, c in enumerate(row)) for row in of))

        total += integral(speed, 0.0, h)
    return Approximate(total)


def _points(shape: Via) -> Table:
    rows = tuple(
        (number(k), time, *place)
        for k, (time, place) in enumerate(zip(shape.times, shape.places, strict=True))
    )
    return Table((Phrase("point"), T, *AXES[: len(shape.places[0])]), rows)


def _pieces(spans: tuple[tuple[Span, ...], ...], decimals: bool) -> Table:
    """A row for each piece and coordinate."""
    rows = []
    for k, pieces in enumerate(zip(*spans, strict=True), 1):
        for axis, piece in zip(AXES, pieces, strict=False):
            coefficients = (read(c, decimals) for c in piece.coefficients)
            rows.append((number(k), piece.start, piece.end, axis, *coefficients))
    return Table((Phrase("piece"), Phrase("from"), Phrase("to"), Phrase("coordinate"), *C), tuple(rows))


def _differentiated(coefficients: list[Scalar], order: int) -> list[Scalar]:
    for _ in range(order):
        coefficients = [each * k for k, each in enumerate(coefficients)][1:]
    return coefficients


def _power(base: Expr, k: int) -> Expr:
    return number(1) if k == 0 else base if k == 1 else base ** number(k)


def _letters(matrix: Matrix) -> bool:
    return any(free_symbols(entry) - {T.name} for (entry,) in matrix.rows)
