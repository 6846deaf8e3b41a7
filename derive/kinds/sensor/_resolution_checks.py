"""An encoder is turned once, and its edges are counted."""

from __future__ import annotations

from collections.abc import Iterator
from math import tau

from derive.algebra.numbers.floats import number as at
from derive.expression import ONE, Expr
from derive.kinds.checks import close, random_points
from derive.kinds.problem import Problem
from derive.kinds.sensor._facts import ResolutionFacts
from derive.kinds.sensor._oracle import turned
from derive.kinds.work import Work
from derive.mechanics.sensing import Encoder, Incremental


def as_given(encoder: Encoder, work: Work, told: ResolutionFacts) -> Iterator[bool]:
    """The sentences tell the edges and the gear of the sheet."""
    disc = encoder.disc
    yield told.edges == (disc.edges if isinstance(disc, Incremental) else None)
    yield (told.gear is None) == (encoder.gear is None)
    if told.gear is not None and encoder.gear is not None:
        yield work.value(told.gear) == work.value(encoder.gear)


def whole_turn(encoder: Encoder, problem: Problem, results: dict[str, Expr]) -> Iterator[bool]:
    """In floats: counts of the disc, turns of the motor, and the angle of one make a full turn."""
    gear = problem.final(encoder.gear or ONE)
    for point in random_points(problem.symbols, 3):
        counts, angle = (at(results[name], point) for name in ("counts", "resolution"))
        yield close(counts * at(gear, point) * angle, tau)


def edge_by_edge(encoder: Encoder, problem: Problem, results: dict[str, Expr]) -> Iterator[bool]:
    """The disc turned once; none where its sizes are no whole numbers whatever the symbols."""
    at_motor = results["resolution_motor"] if encoder.gear else results["resolution"]
    for point, counts, gear in turned(encoder, problem.symbols, problem.final):
        yield close(at(results["counts"], point), counts)
        yield close(at(at_motor, point) * counts, tau)
        yield close(at(results["resolution"], point) * gear * counts, tau)
