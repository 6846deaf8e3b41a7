"""Where masses of a mechanical system are, taken apart: how far something slides, and rods that turn from
there, each by an angle of its own."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from derive.algebra.normal import normal
from derive.algebra.readable.form import readable
from derive.errors import NotDerivable
from derive.expression import (
    ONE,
    Call,
    Expr,
    Symbol,
    add,
    free_symbols,
    is_negative,
    negate,
    replace,
    terms_of,
    walk,
)
from derive.mechanics.lagrangian import TIME, LagrangianSystem, MovingBody

TURNS = frozenset({"sin", "cos"})
UNKNOWN = "it is not known what joins its masses"


@dataclass(frozen=True, slots=True)
class Rod:
    """A vector in a plane, as long as is said, that turns by `angle`."""

    vector: tuple[Expr, Expr]
    long: Expr
    angle: Expr


@dataclass(frozen=True, slots=True)
class Hung:
    """A mass at the end of rods, the first of which is fixed to what slides."""

    mass: Expr
    at: tuple[Expr, Expr]
    slide: tuple[Expr, Expr]
    rods: tuple[Rod, ...]


def hung(body: MovingBody, system: LagrangianSystem) -> Hung:
    """Raises NotDerivable where the position of a mass in a plane is something else."""
    if len(body.position) != 2 or body.inertia is not None:
        raise NotDerivable(UNKNOWN)
    angles = moving_angles(body.position, system)
    rods = [_rod(body.position, angle) for angle in angles]
    rest = [add(*(term for term in terms_of(part) if not _turning(term, angles))) for part in body.position]
    slid = set(system.coordinates) & (free_symbols(rest[0]) | free_symbols(rest[1]))
    if len(slid) > 1 or any(slid & free_symbols(rod.long) for rod in rods):
        raise NotDerivable(UNKNOWN)
    x, y = body.position
    return Hung(body.mass, (x, y), (rest[0], rest[1]), tuple(rods))


def moving_angles(position: Iterable[Expr], system: LagrangianSystem) -> list[Expr]:
    """The angles that change in time, those of few coordinates first."""
    moving = (*system.coordinates, TIME)
    found = dict.fromkeys(
        node.arguments[0]
        for part in position
        for node in walk(part)
        if isinstance(node, Call) and node.function in TURNS and free_symbols(node.arguments[0]) & {*moving}
    )

    def order(angle: Expr) -> tuple[int, int]:
        places = [k for k, name in enumerate(moving) if name in free_symbols(angle)]
        return len(places), places[0]

    return sorted(found, key=order)


def between_angles(angle: Expr, before: Expr) -> Symbol | None:
    """What an angle is more than another, where that is one name."""
    more = readable(normal(add(angle, negate(before))))
    return more if isinstance(more, Symbol) else None


def _turning(term: Expr, angles: Sequence[Expr]) -> list[Call]:
    """The sines and cosines in a term."""
    return [
        node
        for node in walk(term)
        if isinstance(node, Call) and node.function in TURNS and node.arguments[0] in angles
    ]


def _rod(position: Sequence[Expr], angle: Expr) -> Rod:
    """The terms with one angle: a length times its sine and its cosine."""
    parts, lengths, functions = [], [], set()
    for part in position:
        terms = [term for term in terms_of(part) if _turning(term, [angle])]
        if len(terms) != 1 or len(calls := [*dict.fromkeys(_turning(terms[0], [angle]))]) != 1:
            raise NotDerivable(UNKNOWN)
        factor = readable(normal(replace(terms[0], {calls[0]: ONE})))
        if any(isinstance(node, Call) for node in walk(factor)):
            raise NotDerivable(UNKNOWN)
        parts.append(terms[0])
        lengths.append(negate(factor) if is_negative(factor) else factor)
        functions.add(calls[0].function)
    if functions != TURNS or lengths[0] != lengths[1]:
        raise NotDerivable(UNKNOWN)
    return Rod((parts[0], parts[1]), lengths[0], angle)
