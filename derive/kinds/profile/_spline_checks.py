"""A spline held to one linear system for all its coefficients: lines, tables and results as written."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import islice, pairwise
from typing import Any, TypeAlias

from derive.algebra.numbers.floats import Point, completed
from derive.algebra.numbers.floats import number as value_of
from derive.derivation import Branch, Claim, Table
from derive.expression import ZERO, Expr, Product, Relation, Symbol
from derive.kinds.checks import flat, route
from derive.kinds.fields import TREES
from derive.kinds.meanings import Chain, Names, farthest, valued
from derive.kinds.problem import Problem
from derive.kinds.profile._pieces import t, times_of
from derive.kinds.profile._places import places
from derive.mechanics.profile import Journey
from derive.mechanics.splines import acceleration_jumps, solved_in_floats

Floats: TypeAlias = tuple[Sequence[float], Sequence[float], Sequence[float | None]]
Knots: TypeAlias = tuple[Sequence[Expr], Sequence[Expr], Sequence[Expr | None]]
EACH = 2  # points
CLOSE = 1e-7
WITHIN = (0.3, 0.8)  # of a piece
OTHERS = (1.5, 4.25)  # velocities, told from where they begin
C = tuple(Symbol(f"a_{k}") for k in range(4))
FROM, TO, Q = Symbol("from"), Symbol("to"), Symbol("q")


def asked(journey: Journey, time: Expr | None, natural: bool) -> Knots:
    """The times, the places and the velocities that the sheet gives; at natural ends it gives none."""
    first, last = (None, None) if natural else (journey.start_velocity, journey.end_velocity)
    between = [(via.time, via.place, via.velocity) for via in journey.via]
    rows = [(ZERO, journey.start, first), *between, (time or ZERO, journey.end, last)]
    times, places, velocities = zip(*rows, strict=True)
    return times, places, velocities


def claims(
    knots: Knots,
    chains: Sequence[Chain],
    pieces: Sequence[Branch],
    table: Table,
    problem: Problem,
) -> Iterator[Claim]:
    """`knots` are the times, the places and the velocities that are given; the rows of the table and the
    pieces are tried one by one. Times out of order are left out."""
    times = knots[0]

    def in_order(at: Point) -> bool:
        known = completed(at, problem.where)
        return all(before < after for before, after in pairwise(value_of(tree, known) for tree in times))

    met = islice((at for at in places(problem.symbols) if in_order(at)), EACH)
    yield route("all-conditions", (_holds(at, knots, chains, pieces, table, problem) for at in met))


def _holds(
    at: Point,
    knots: Knots,
    chains: Sequence[Chain],
    pieces: Sequence[Branch],
    table: Table,
    problem: Problem,
) -> bool:
    known = completed(at, problem.where)
    times, through = ([value_of(tree, known) for tree in trees] for trees in knots[:2])
    given = [None if v is None else value_of(v, known) for v in knots[2]]
    found = solved_in_floats(times, through, given)
    names: dict[Expr, Any] = {Symbol(name): value for name, value in known.items()}
    for k in range(len(pieces)):
        names[Symbol(f"v_{k}")] = found[4 * k + 1]
    h, last = times[-1] - times[-2], found[-4:]
    names[Symbol(f"v_{len(pieces)}")] = last[1] + 2 * last[2] * h + 3 * last[3] * h**2
    gaps = [farthest(chains, names), _missed(chains, names, (times, through, given))]
    for k, (piece, row) in enumerate(zip(pieces, table.rows, strict=True)):
        own: dict[Expr, Any] = {**names, FROM: times[k], TO: times[k + 1]}
        own |= dict(zip(C, found[4 * k : 4 * k + 4], strict=True))
        when = times_of(piece)
        told = [(FROM, row[1]), (TO, row[2]), *zip(C, row[3:], strict=True), (TO, when.right)]
        told += [(FROM, when.left.left)] if isinstance(when.left, Relation) else []
        gaps.append(farthest([(a, b) for a, b in told if isinstance(b, TREES)], own))
        for part in WITHIN:
            tau = part * (times[k + 1] - times[k])
            place = sum(c * tau**n for n, c in enumerate(found[4 * k : 4 * k + 4]))
            gaps.append(farthest([(Q, piece.values["q"])], {**own, t: times[k] + tau, Q: place}))
    return max(gaps) < CLOSE


def _missed(chains: Sequence[Chain], names: Names, knots: Floats) -> float:
    """How far the rows of the system are from what they are conditions for, whatever the velocities are: one
    that is given, or no jump of the acceleration. By two other choices of velocities, a row and its jump
    change alike."""
    times, through, given = knots
    ((left, right),) = (chain for chain in chains if isinstance(chain[0], Product))
    seen: list[list[float]] = []
    jumps: list[list[float]] = []
    for choice in OTHERS:
        other = [(choice + k) ** 2 % 7 - 3 for k in range(len(times))]
        at: dict[Expr, Any] = {**names}
        at |= {Symbol(f"v_{k}"): v for k, v in enumerate(other)}
        seen.append([a - b for a, b in zip(flat(valued(left, at)), flat(valued(right, at)), strict=True)])
        steps = acceleration_jumps(times, through, other)
        known = zip(other, given, steps, strict=True)
        jumps.append([jump if wanted is None else v - wanted for v, wanted, jump in known])
    rows = zip(*seen, *jumps, strict=True)
    return max(float(abs(a * q - b * p) / (1 + abs(a * q) + abs(b * p))) for a, b, p, q in rows)
