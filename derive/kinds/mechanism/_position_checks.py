"""What is said of a linkage that is closed, held to bars laid end to end in numbers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import islice
from math import tau

from derive.algebra.numbers.floats import Point
from derive.algebra.numbers.floats import number as at
from derive.derivation import Branch
from derive.errors import NotDerivable, NotReal
from derive.expression import Expr, Symbol, free_symbols
from derive.kinds.checks import close, random_points
from derive.kinds.mechanism._assemblies import Closed
from derive.kinds.mechanism._loop_oracle import rockers, sliders, tip
from derive.mechanics.linkages import FourBar, SliderCrank

DRAWS, POINTS = 400, 3
STRETCHED = 1e-4  # as a share of the crank: near a position in which two assemblies meet nothing is looked at
SIZES = {
    FourBar: ("crank", "coupler", "rocker", "ground", "angle"),
    SliderCrank: ("crank", "rod", "offset", "angle"),
}


@dataclass(frozen=True)
class There:
    """A linkage at a point: its sizes as they are given, and for each assembly the values of all names."""

    point: Point
    sizes: tuple[float, ...]
    assemblies: tuple[Mapping[str, float], ...]


def places(linkage: FourBar | SliderCrank, closed: Closed) -> list[There]:
    """Points at which it can be put together. Raises NotDerivable where none were found."""
    problem = closed.work.problem
    sizes = [problem.final(getattr(linkage, name)) for name in SIZES[type(linkage)]]
    names = frozenset().union(*map(free_symbols, sizes))
    found = []
    for point in random_points(names, DRAWS):
        try:
            there = _there(point, sizes, closed)
        except (NotReal, ValueError, ZeroDivisionError):
            continue
        if there.assemblies[0][closed.w.name] > STRETCHED * there.sizes[0]:
            found.append(there)
    if not found:
        raise NotDerivable("no position was found in which bars of these lengths can be joined")
    return [*islice(found, POINTS)]


def _there(point: Point, sizes: list[Expr], closed: Closed) -> There:
    problem = closed.work.problem
    given = {name: at(problem.final(value), point) for name, value in problem.names.items()}
    given |= {name: at(problem.final(value), point) for name, value in closed.work.typed}
    start = {**point, **{str(getattr(name, "name", name)): value for name, value in given.items()}}
    return There(
        point,
        tuple(at(size, point) for size in sizes),
        tuple(in_turn(start, assembly.formulas) for assembly in closed.assemblies),
    )


def in_turn(start: Mapping[str, float], formulas: Mapping[Symbol, Expr]) -> dict[str, float]:
    """The values of names, each by those before it."""
    found = dict(start)
    for name, formula in formulas.items():
        found[name.name] = at(formula, found)
    return found


def closes(
    linkage: FourBar | SliderCrank, closed: Closed, branches: tuple[Branch, ...], there: list[There]
) -> Iterator[bool]:
    """The bars laid end to end meet, on the side that is said; every line holds, and so do the results."""
    problem = closed.work.problem
    for place in there:
        for values, assembly, branch in zip(place.assemblies, closed.assemblies, branches, strict=True):
            yield _meets(linkage, place, values, closed.s.name)
            yield (
                branch.when == (assembly.side,)
                and _side(linkage, place, values, closed.s.name) == assembly.side.key
            )
            whole = {name: at(problem.final(tree), place.point) for name, tree in branch.values.items()}
            yield all(close(worth, values[name]) for name, worth in whole.items())
            short = in_turn(place.point, {Symbol(name): tree for name, tree in branch.short.items()})
            yield all(close(short[name], values[name]) for name in whole)
            for step in closed.work.steps:
                if step.rule == "in-numbers" and step.name in (
                    "apart",
                    "along",
                    "theta_3",
                    assembly.side.key,
                ):
                    left, right = (at(expr, values) for expr in step.chain)
                    yield close(left, right)


def every_way(linkage: FourBar | SliderCrank, closed: Closed, there: list[There]) -> Iterator[bool]:
    """All places around are looked at, and these are the ones in which the bars meet."""
    name = "theta_4" if isinstance(linkage, FourBar) else closed.s.name
    for place in there:
        seen = rockers(*place.sizes) if isinstance(linkage, FourBar) else sliders(*place.sizes)
        ours = [values[name] for values in place.assemblies]
        if isinstance(linkage, FourBar):
            ours = [value % tau for value in ours]
            seen = [value % tau for value in seen]
        yield close(sorted(ours), sorted(seen), 1e-7)


def _meets(linkage: FourBar | SliderCrank, place: There, values: Mapping[str, float], slider: str) -> bool:
    if isinstance(linkage, FourBar):
        crank, coupler, rocker, ground, angle = place.sizes
        gap = tip(crank, angle) + tip(coupler, values["theta_3"]) - ground - tip(rocker, values["theta_4"])
    else:
        crank, rod, offset, angle = place.sizes
        gap = tip(crank, angle) + tip(rod, values["theta_3"]) - values[slider] - 1j * offset
    return abs(gap) < 1e-9 * (1 + sum(map(abs, place.sizes)))


def _side(linkage: FourBar | SliderCrank, place: There, values: Mapping[str, float], slider: str) -> str:
    """On which side of the line from the pivot of the rocker to the end of the crank the coupler ends; or
    whether the slider lies beyond the end of the crank."""
    if isinstance(linkage, FourBar):
        crank, _, rocker, ground, angle = place.sizes
        seen = (tip(crank, angle) - ground).conjugate() * tip(rocker, values["theta_4"])
        return "left" if seen.imag > 0 else "right"
    return "outwards" if values[slider] > tip(place.sizes[0], place.sizes[-1]).real else "inwards"
