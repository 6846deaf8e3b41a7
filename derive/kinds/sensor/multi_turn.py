"""The range of an absolute encoder that counts its turns too, and how many positions it tells apart."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import tau

from derive.algebra.numbers.floats import number as at
from derive.derivation import Derivation, PageFacts
from derive.expression import ONE, Expr, Power, Symbol, number
from derive.kinds.checks import close, random_points, route
from derive.kinds.fields import NoOptions as Options
from derive.kinds.problem import Problem
from derive.kinds.sensor._encoder import TURN, UNITS
from derive.kinds.sensor._oracle import readings
from derive.kinds.work import Work
from derive.mechanics.sensing import Absolute, Encoder

NEEDS = ("absolute", "size", "turn_bits")
USES = frozenset({"bits", "turn_bits"})
CLAIMS = ("whole-range", "as-given")
POINTS = 3


class Facts(PageFacts):
    turn_bits: tuple[Symbol, Expr]
    positions: Expr  # of each turn
    gear: Symbol | None


def derive(encoder: Encoder, options: Options, problem: Problem) -> Derivation:
    """2^b_t turns of 2^b positions each, so 2^(b + b_t) positions and the angle 2 pi 2^b_t of the motor."""
    base = problem.ask("resolution")
    work = Work(problem, angular=True, units=UNITS, taken=problem.symbols & {"N"}).resting_on(base)
    bits, turn_bits = _bits(encoder)
    work, (b, b_t) = work.naming(b=bits, b_t=turn_bits)
    N_t, N = work.symbol("N_t"), work.symbol("N")
    work = work.worked("N_t", number(2) ** b_t)
    open_ = isinstance(work[N_t], Power)
    power = open_ or isinstance(work[N], Power)
    work = work.worked("B", b + b_t)
    work = work.worked("N_a", N * N_t, number(2) ** work["B"] if power else None)
    work = work.worked("phi_m", TURN * N_t, TURN * work[N_t] if open_ else None)
    results = {"turns": "N_t", "bits": "B", "counts": "N_a", "range_motor": "phi_m"}
    gear = None
    if encoder.gear is not None:
        work, (gear,) = work.naming(G=encoder.gear)
        last = TURN * work[N_t] / encoder.gear if open_ else None
        work = work.worked("phi", Symbol("phi_m") / gear, last)
        results["range"] = "phi"
    found = {name: work.final(line) for name, line in results.items()}
    facts = Facts(turn_bits=(b_t, work.definitions.get(b_t, b_t)), positions=N, gear=gear, page_names=results)
    work = work.claim(route("whole-range", _whole(encoder, problem, found)))
    work = work.claim(route("as-given", facts.turn_bits[1] == turn_bits))
    return work.answer("multi-turn", found, facts, units=UNITS)


def _bits(encoder: Encoder) -> tuple[Expr, Expr]:
    disc = encoder.disc
    return (disc.bits, disc.turn_bits) if isinstance(disc, Absolute) else (ONE, ONE)


def _whole(encoder: Encoder, problem: Problem, results: Mapping[str, Expr]) -> Iterator[bool]:
    """The discs of the turns and of a turn are read all the way round, one geared down behind the other."""
    trees = [*map(problem.final, _bits(encoder)), problem.final(encoder.gear or ONE)]
    for point in random_points(problem.symbols, POINTS):
        whole = {name: float(round(2 + value)) for name, value in point.items()}
        b, b_t, gear = (at(tree, whole) for tree in trees)
        fine, turns = readings(round(b)), readings(round(b_t))
        yield close([b, b_t], [round(b), round(b_t)])
        yield close([at(results["turns"], whole), at(results["counts"], whole)], [turns, fine * turns])
        yield readings(max(0, round(at(results["bits"], whole)))) == fine * turns
        yield close(at(results["range_motor"], whole), turns * tau)
        if "range" in results:
            yield close(at(results["range"], whole) * gear, turns * tau)
