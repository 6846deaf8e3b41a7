"""A mechanism built at random and asked how it moves: what the count of Grübler is held to.

Every joint is a set of twists about random axes, (omega, v) of the second body against the first. What no
twist of a joint moves are its constraints, a row each of one matrix for all the bodies; its rank says how the
bodies move. The numbers of a joint are counted off its twists, and no table of freedoms is asked.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Literal, TypeAlias

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array: TypeAlias = NDArray[np.float64]

Space: TypeAlias = Literal["planar", "spatial", "spherical"]
COORDINATES: dict[Space, tuple[int, ...]] = {  # of a twist (omega_x, ..., v_z) that a body has there
    "planar": (2, 3, 4),
    "spatial": (0, 1, 2, 3, 4, 5),
    "spherical": (0, 1, 2),
}
SMALL = 1e-9  # singular values that count as zero, as a share of the largest
DRAWS = 6  # instances tried: some graphs of the same joints hold a rigid part beside a loose one
LARGEST = 240  # coordinates of all bodies of an instance whose rank is taken


@dataclass(frozen=True, slots=True)
class Sort:
    """`count` joints that join `joining` bodies in each place; one without a `name` has so many
    `constraints`."""

    name: str
    count: int
    joining: int = 2
    constraints: int = 0


@dataclass(frozen=True, slots=True)
class Pair:
    """Two bodies at a joint, what the joint keeps from moving, a row each, and where it is."""

    bodies: tuple[int, int]
    sort: str
    rows: Array
    place: Array


@dataclass(frozen=True)
class Instance:
    """Bodies, the first of them the frame, and pairs of them."""

    size: int
    bodies: int
    pairs: tuple[Pair, ...]

    @cached_property
    def matrix(self) -> Array:
        """The constraints of all pairs on the twists of all bodies but the frame."""
        found = np.zeros((sum(len(pair.rows) for pair in self.pairs), self.size * self.bodies))
        at = 0
        for pair in self.pairs:
            for body, sign in zip(pair.bodies, (-1.0, 1.0), strict=True):
                place = slice(self.size * body, self.size * (body + 1))
                found[at : at + len(pair.rows), place] += sign * pair.rows
            at += len(pair.rows)
        return found[:, self.size :]

    @cached_property
    def rank(self) -> int:
        """Of the constraints."""
        return rank(self.matrix)

    @property
    def motions(self) -> int:
        """How many ways to move it has."""
        return int(self.matrix.shape[1]) - self.rank

    @property
    def repeated(self) -> int:
        """How many constraints follow from others."""
        return int(self.matrix.shape[0]) - self.rank

    @property
    def loops(self) -> int:
        """Pairs beyond those that hang the bodies together, a tree of them."""
        hung = {0}
        waiting = list(self.pairs)
        while reached := [pair for pair in waiting if len(hung & {*pair.bodies}) == 1]:
            hung |= {*reached[0].bodies}
            waiting.remove(reached[0])
        return len(waiting) if len(hung) == self.bodies else -1

    def spins(self, leg: Sequence[Pair]) -> int:
        """How often a leg holds two spherical joints between which bodies can turn about the line from one to
        the other while nothing else moves."""
        ends = [k for k, pair in enumerate(leg) if pair.sort == "spherical"]
        return sum(self._turns(leg[i], leg[j], leg[i:j]) for i, j in itertools.pairwise(ends))

    def _turns(self, start: Pair, end: Pair, between: Sequence[Pair]) -> bool:
        line = end.place - start.place
        twist = np.concatenate((line, np.cross(start.place, line))) / np.linalg.norm(line)
        moved = np.zeros(self.size * self.bodies)
        for body in {pair.bodies[1] for pair in between}:
            moved[self.size * body : self.size * (body + 1)] = twist
        return bool(np.abs(self.matrix @ moved[self.size :]).max() < SMALL)


def constraints_of(space: Space, sort: Sort) -> int:
    """How many constraints one joint of the sort has."""
    draw = np.random.default_rng(1)
    return len(kept(space, sort.name, draw.normal(size=3), draw, constraints=sort.constraints))


def index(space: Space, bodies: int, sorts: Sequence[Sort]) -> int:
    """Motions less repeated constraints of any instance: coordinates of the bodies less all constraints."""
    taken = sum(each.count * (each.joining - 1) * constraints_of(space, each) for each in sorts)
    return len(COORDINATES[space]) * (bodies - 1) - taken


def rank(matrix: Array) -> int:
    """How many rows say something new."""
    if not matrix.size:
        return 0
    sizes = np.linalg.svd(matrix, compute_uv=False)
    return int((sizes > SMALL * max(1.0, float(sizes[0]))).sum())


def assembled(space: Space, bodies: int, sorts: Sequence[Sort]) -> Instance:
    """The instance, of a few in which the same joints join other bodies, that moves least."""
    return min(
        (_assembled(space, bodies, sorts, seed) for seed in range(DRAWS)), key=lambda each: each.motions
    )


def of_legs(space: Space, legs: Sequence[tuple[str, int]]) -> tuple[Instance, tuple[tuple[Pair, ...], ...]]:
    """A base, a platform and legs between them, joint by joint from the base; and the pairs of each leg."""
    draw = np.random.default_rng(7)
    names = [[LETTERS[letter] for letter in chain] for chain, count in legs for _ in range(count)]
    found: list[tuple[Pair, ...]] = []
    bodies = 2
    for joints in names:
        chain = (0, *range(bodies, bodies + len(joints) - 1), 1)
        bodies += len(joints) - 1
        found.append(tuple(_leg(space, joints, chain, draw)))
    pairs = tuple(pair for leg in found for pair in leg)
    return Instance(len(COORDINATES[space]), bodies, pairs), tuple(found)


def _leg(
    space: Space, joints: Sequence[str], chain: Sequence[int], draw: np.random.Generator
) -> Iterator[Pair]:
    """Its pairs; a slider between two spherical joints lies on the line from one to the other."""
    places = draw.normal(size=(len(joints), 3))
    for k, (sort, bodies) in enumerate(zip(joints, itertools.pairwise(chain), strict=True)):
        held = sort == "prismatic" and joints[k - 1 : k + 2] == ["spherical", sort, "spherical"]
        along = places[k + 1] - places[k - 1] if held else None
        yield Pair(bodies, sort, kept(space, sort, places[k], draw, along), places[k])


def _assembled(space: Space, bodies: int, sorts: Sequence[Sort], seed: int) -> Instance:
    """Joints shared out at random: each hangs on what hangs together already as many bodies as are left, and
    the others close loops."""
    draw = np.random.default_rng(seed)
    joints = [sort for sort in sorts for _ in range(sort.count)]
    joints = [joints[k] for k in draw.permutation(len(joints))]
    degree = [0] * bodies
    hung, pairs, neighbours = 1, [], set[frozenset[int]]()
    for sort in joints:
        base = min(range(hung), key=lambda k: (degree[k], -k))
        new = list(range(hung, min(bodies, hung + sort.joining - 1)))
        hung += len(new)
        others = sorted(
            (k for k in range(hung) if k not in (base, *new)),
            key=lambda k: (frozenset((base, k)) in neighbours, degree[k], -k),
        )
        met = (base, *new, *others[: sort.joining - 1 - len(new)])
        place = draw.normal(size=3)
        rows = kept(space, sort.name, place, draw, constraints=sort.constraints)
        for body in met[1:]:
            pairs.append(Pair((base, body), sort.name, rows, place))
            neighbours.add(frozenset((base, body)))
            degree[base], degree[body] = degree[base] + 1, degree[body] + 1
    return Instance(len(COORDINATES[space]), bodies, tuple(pairs))


def freedoms_of_sarrus() -> int:
    """Ways to move of a loop of six revolute joints, three axes of which are parallel to one line and three
    to another."""
    draw = np.random.default_rng(3)
    axes = draw.normal(size=(2, 3))
    turns = [
        twist for k in range(6) for twist in _twists("revolute", draw.normal(size=3), axes[k // 3], draw)
    ]
    return len(turns) - rank(np.array(turns))


# -- joints -------------------------------------------------------------------------------------------

LETTERS = {
    "R": "revolute", "P": "prismatic", "H": "helical", "C": "cylindrical", "U": "universal", "S": "spherical",
    "E": "planar",
}  # fmt: skip


def kept(
    space: Space,
    sort: str,
    place: Array,
    draw: np.random.Generator,
    along: Array | None = None,
    constraints: int = 0,
) -> Array:
    """What a joint at a place keeps from moving, a row for each constraint; axes are drawn unless it slides
    `along`."""
    coordinates = COORDINATES[space]
    if not sort:
        return draw.normal(size=(constraints, len(coordinates)))
    axis = along if along is not None else draw.normal(size=3)
    if space == "planar":  # axes of rotation stand on the plane, sliders lie in it
        lies = np.array([1.0, 1.0, 0.0])
        place, axis = place * lies, axis * lies if sort == "prismatic" else np.array([0.0, 0.0, 1.0])
    elif space == "spherical":
        place = np.zeros(3)
    twists = np.array([*_twists(sort, place, axis, draw)])[:, coordinates]
    _, sizes, rows = np.linalg.svd(twists)
    return np.array(rows[int((sizes > SMALL).sum()) :])


def _twists(sort: str, p: Array, axis: Array, draw: np.random.Generator) -> Iterator[Array]:
    """How the second body can move against the first."""
    a = axis / np.linalg.norm(axis)
    b = np.cross(a, draw.normal(size=3))
    b = b / np.linalg.norm(b)
    c = np.cross(a, b)

    def turning(w: Array) -> Array:
        return np.concatenate((w, np.cross(p, w)))

    def sliding(v: Array) -> Array:
        return np.concatenate((np.zeros(3), v))

    moves: dict[str, Callable[[], tuple[Array, ...]]] = {
        "revolute": lambda: (turning(a),),
        "prismatic": lambda: (sliding(a),),
        "helical": lambda: (turning(a) + 0.3 * sliding(a),),
        "cylindrical": lambda: (turning(a), sliding(a)),
        "universal": lambda: (turning(a), turning(b)),
        "spherical": lambda: (turning(a), turning(b), turning(c)),
        "planar": lambda: (turning(a), sliding(b), sliding(c)),
    }
    yield from moves[sort]()
