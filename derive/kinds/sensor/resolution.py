"""The smallest angle an encoder tells apart, at the motor and, through a gear, at the link."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

from derive.derivation import Derivation, Panels
from derive.expression import Expr, Number
from derive.figures.waves import tracks
from derive.kinds.checks import close, route
from derive.kinds.fields import NoOptions as Options
from derive.kinds.problem import Problem
from derive.kinds.sensor._encoder import UNITS, counted
from derive.kinds.sensor._facts import ResolutionFacts as Facts
from derive.kinds.sensor._resolution_checks import as_given, edge_by_edge, whole_turn
from derive.mechanics.sensing import Encoder, Incremental

NEEDS = ("encoder", "size")
USES = frozenset({"lines", "bits", "turn_bits"})
DRAWN = (1, 2, 4)  # edges of a line


def claims_of(encoder: Encoder, options: Options) -> tuple[str, ...]:
    """A disc whose size is a number is turned edge by edge."""
    disc = encoder.disc
    always = ("whole-turn", "as-given")
    sizes = (disc.lines, disc.edges) if isinstance(disc, Incremental) else (disc.bits,)
    return (*always, "edge-by-edge") if all(isinstance(x, Number) for x in sizes) else always


def derive(encoder: Encoder, options: Options, problem: Problem) -> Derivation:
    """2 pi over the counts of a turn, divided by the gear (Siciliano et al., section 5.3.1)."""
    work, gear = counted(problem, encoder)
    results: dict[str, Expr] = {"counts": work.final("N")}
    if gear:
        results["resolution_motor"] = work.final("Delta_m")
    results["resolution"] = work.final("Delta")
    work = work.claim(route("whole-turn", whole_turn(encoder, problem, results)))
    if seen := [*edge_by_edge(encoder, problem, results)]:
        work = work.claim(route("edge-by-edge", seen))
    edges = encoder.disc.edges if isinstance(encoder.disc, Incremental) else None
    drawn = isinstance(edges, Number) and edges.value in DRAWN
    facts = Facts(edges=edges, gear=work[gear] if gear else None, drawn=drawn)
    work = work.claim(route("as-given", as_given(encoder, work, facts)))
    if not isinstance(edges, Number) or not drawn:
        return work.answer("resolution", results, facts, units=UNITS)
    picture = tracks(int(edges.value))
    work = work.claim(route("drawn", _evenly(picture, int(edges.value))))
    return work.answer("resolution", results, facts, units=UNITS, plots=(picture,))


def _evenly(picture: Panels, edges: int) -> Iterator[bool]:
    """The edges that are marked are as many of each line, and evenly apart."""
    marked = sorted(x for plot in picture.plots for x, _ in plot.points)
    yield sum(x < marked[0] + 1 for x in marked) == edges
    yield from (close(b - a, 1 / edges) for a, b in pairwise(marked))
