"""The smallest angle an encoder tells apart, at the motor and, through a gear, at the link."""

from __future__ import annotations

from collections.abc import Iterator
from math import tau

from derive.algebra.numbers.floats import number as at
from derive.derivation import Derivation, PageFacts
from derive.expression import ONE, Expr, Number, Symbol
from derive.kinds.checks import close, random_points, route
from derive.kinds.fields import NoOptions as Options
from derive.kinds.problem import Problem
from derive.kinds.sensor._encoder import counted
from derive.kinds.sensor._oracle import turned
from derive.kinds.work import Work
from derive.mechanics.sensing import Encoder, Incremental

NEEDS = ("encoder",)


def claims_of(encoder: Encoder, options: Options) -> tuple[str, ...]:
    """A disc whose size is a number is turned edge by edge."""
    disc = encoder.disc
    always = ("whole-turn", "as-given")
    sizes = (disc.lines, disc.edges) if isinstance(disc, Incremental) else (disc.bits,)
    return (*always, "edge-by-edge") if all(isinstance(x, Number) for x in sizes) else always


class Facts(PageFacts):
    edges: Expr | None  # that are counted; None of an absolute encoder
    gear: Symbol | None
    gear_value: Expr | None


def derive(encoder: Encoder, options: Options, problem: Problem) -> Derivation:
    """2 pi over the counts of a turn, divided by the gear (Siciliano et al., section 5.3.1)."""
    work, gear = counted(problem, encoder)
    results: dict[str, Expr] = {"counts": work.final("N")}
    if gear:
        results["resolution_motor"] = work.final("Delta_m")
    results["resolution"] = work.final("Delta")
    work = work.claim(route("whole-turn", _whole_turn(encoder, problem, results)))
    if seen := [*_edge_by_edge(encoder, problem, results)]:
        work = work.claim(route("edge-by-edge", seen))
    edges = encoder.disc.edges if isinstance(encoder.disc, Incremental) else None
    facts = Facts(edges=edges, gear=gear, gear_value=work[gear] if gear else None)
    work = work.claim(route("as-given", _as_given(encoder, work, facts)))
    return work.answer("resolution", results, facts)


def _as_given(encoder: Encoder, work: Work, told: Facts) -> Iterator[bool]:
    """The sentences tell the edges and the gear of the sheet."""
    disc = encoder.disc
    yield told.edges == (disc.edges if isinstance(disc, Incremental) else None)
    yield (told.gear is None) == (encoder.gear is None) == (told.gear_value is None)
    if told.gear_value is not None and encoder.gear is not None:
        yield work.value(told.gear_value) == work.value(encoder.gear)


def _whole_turn(encoder: Encoder, problem: Problem, results: dict[str, Expr]) -> Iterator[bool]:
    """In floats: counts of the disc, turns of the motor, and the angle of one make a full turn."""
    gear = problem.final(encoder.gear or ONE)
    for point in random_points(problem.symbols, 3):
        counts, angle = (at(results[name], point) for name in ("counts", "resolution"))
        yield close(counts * at(gear, point) * angle, tau)


def _edge_by_edge(encoder: Encoder, problem: Problem, results: dict[str, Expr]) -> Iterator[bool]:
    """The disc turned once; none where its sizes are no whole numbers whatever the symbols."""
    at_motor = results["resolution_motor"] if encoder.gear else results["resolution"]
    for point, counts, gear in turned(encoder, problem.symbols, problem.final):
        yield close(at(results["counts"], point), counts)
        yield close(at(at_motor, point) * counts, tau)
        yield close(at(results["resolution"], point) * gear * counts, tau)
