"""An encoder is driven as fast as was found, and its edges are counted."""

from __future__ import annotations

from collections.abc import Iterator
from math import tau

from derive.algebra.numbers.floats import Point
from derive.algebra.numbers.floats import number as at
from derive.derivation import Claim, Derivation
from derive.expression import ONE, Call, Expr, Symbol, free_symbols
from derive.expression import replace as put_in
from derive.kinds.checks import close, random_points, route
from derive.kinds.problem import Problem
from derive.kinds.sensor._encoder import OMEGA
from derive.kinds.sensor._facts import SpeedFacts
from derive.kinds.sensor._oracle import turned
from derive.kinds.work import Work
from derive.mechanics.sensing import Encoder


def turning_claims(
    encoder: Encoder, counted: tuple[Expr, Expr], problem: Problem, results: dict[str, Expr], base: Derivation
) -> Iterator[Claim]:
    """The encoder driven as fast as that for so long; by the counts of a turn where it cannot be built."""
    counts, period, gear = (problem.final(e) for e in (*counted, encoder.gear or ONE))
    symbols = sorted(problem.symbols | free_symbols(counts) | free_symbols(period))
    turn = base.scalar("counts")
    built = [*turned(encoder, symbols, problem.final)]
    driven = built or [(at_, at(turn, at_), at(gear, at_)) for at_ in random_points(symbols, 3)]
    found = [
        each
        for point, edges, ratio in driven
        for each in _driven(results, point, at(counts, point), at(period, point), edges, ratio)
    ]
    yield route("edge-by-edge" if built else "turned-so-far", found)


def _driven(
    results: dict[str, Expr], point: Point, n: float, T: float, edges: float, gear: float
) -> Iterator[bool]:
    """What is counted within T at the speed found and at a quantum more; what the motor does meanwhile."""
    omega, quantum, relative = (at(results[name], point) for name in ("omega", "quantum", "relative"))
    per_turn = edges * gear
    yield close(omega * T * per_turn / tau, n)
    yield close((omega + quantum) * T * per_turn / tau, n + 1)
    yield close(relative * abs(n), 1.0)
    if "omega_motor" in results:
        yield close(at(results["omega_motor"], point) * T * edges / tau, n)


def as_given(work: Work, counted: tuple[Expr, Expr], told: SpeedFacts) -> Iterator[bool]:
    """The names of what was counted, and in which time, stand for what is given."""
    for name, typed in zip((told.n, told.T), counted, strict=True):
        yield work.value(put_in(name, work.definitions)) == work.value(typed)
    yield told.given == tuple(pair for pair in work.typed if pair[0] in (told.n, told.T))
    share, *others = work.steps[-1].chain
    yield share == Symbol("delta_omega") / OMEGA or share == Symbol("delta_omega") / Call("abs", (OMEGA,))
    yield not any("relative" in free_symbols(each) for each in others)
    if told.gear is not None:
        yield work.value(told.gear * OMEGA) == work.value(Symbol("omega_m"))
