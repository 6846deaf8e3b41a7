"""What a name says by its indices: T_2^1, o_3, z_0, J_v2, c_121 are those of the arm in numbers.

The indices are read off the name as it is printed, and the thing that bears it, in an answer or on its way,
is compared with what the oracle finds for these indices. A link from a name to its value cannot notice
that both belong to another frame.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cached_property, partial
from typing import Any, TypeAlias

from derive.algebra.numbers.floats import Point, completed, number, numbers
from derive.derivation import Result, as_matrix
from derive.errors import NotReal
from derive.expression import ZERO, Expr, Indexed, Matrix, Symbol, free_symbols
from derive.kinds.checks import TRIES, close, flat, random_points, route
from derive.kinds.problem import TREES
from derive.kinds.robot._chain import oracle_of
from derive.kinds.work import Work
from derive.mechanics.oracle.heavy import Heavy

NEAR = 1e-7  # what differences of poses in floats leave, and more
POINTS = 2
Meaning: TypeAlias = Callable[..., Any]  # of the arm at a point, the indices, and what is said to be it
F = r"(c?\d+|e)"  # a frame


def _entry(letter: str, count: int) -> str:
    """d_12, and d_1,11 where an index has two digits."""
    single, any_number = r"(\d)" * count, ",".join([r"(\d+)"] * count)
    return rf"{letter}_(?:{any_number}|{single})"


FRAMES: Mapping[str, Meaning] = {
    rf"T_{F}\^{F}": lambda arm, a, b, _: arm.pose(a, b),
    rf"R_{F}\^{F}": lambda arm, a, b, _: arm.pose(a, b)[:3, :3],
    r"T_(c\d+)": lambda arm, a, _: arm.pose(a),
    r"T_base": lambda arm, _: arm.frames["base"],
    r"A_(\d+)": lambda arm, i, _: arm.local(int(i)),
    rf"o_{F}": lambda arm, a, _: arm.pose(a)[:3, 3],
    rf"x_{F}": lambda arm, a, _: arm.pose(a)[:3, 0],
    rf"z_{F}": lambda arm, a, _: arm.pose(a)[:3, 2],
    r"k_(\d+)": lambda arm, i, _: arm.axis(int(i)),
    r"p_(\d+)": lambda arm, i, said: arm.on_axis(int(i), said),
}
BODIES: Mapping[str, Meaning] = {
    r"J_v(\d+)": lambda arm, i, _: arm.jacobian(f"c{i}")[:3],
    r"J_w(\d+)": lambda arm, i, _: arm.jacobian(f"c{i}")[3:],
    r"J_c(\d+)": lambda arm, i, _: arm.jacobian(f"c{i}"),
    r"J_v(\d+)\^(\d+)": lambda arm, i, b, _: arm.pose(b)[:3, :3].T @ arm.jacobian(f"c{i}")[:3],
    r"J_w(\d+)\^(\d+)": lambda arm, i, b, _: arm.pose(b)[:3, :3].T @ arm.jacobian(f"c{i}")[3:],
    r"I_[cC]?([1-9]\d*)": lambda arm, i, _: arm.bodies[int(i) - 1].inertia,
    r"I_(xx|yy|zz|xy|yz|xz)([1-9]\d*)": lambda arm, at, i, _: arm.bodies[int(i) - 1].inertia[_place(at)],
    r"D_([1-9]\d*)": lambda arm, i, _: arm.D_of(int(i)),
    r"D": lambda arm, _: arm.D,
    r"D_dot": lambda arm, _: arm.D_dot,
    r"C": lambda arm, _: arm.C,
    r"N": lambda arm, _: arm.D_dot - 2 * arm.C,
    r"g": lambda arm, _: arm.g,
    r"P": lambda arm, _: arm.potential_energy,
    r"K": lambda arm, _: arm.kinetic_energy,
    r"tau": lambda arm, _: arm.tau,
    r"h": lambda arm, _: arm.tau_without_acceleration,
    r"h_([1-9]\d*)": lambda arm, k, _: arm.tau_without_acceleration[int(k) - 1],
    r"g_0": lambda arm, _: arm.oracle.gravity(arm.at),
    r"g_([1-9]\d*)": lambda arm, k, _: arm.g[int(k) - 1],
    r"P_([1-9]\d*)": lambda arm, i, _: arm.potential(int(i)),
    r"K_([1-9]\d*)": lambda arm, i, _: arm.kinetic(int(i)),
    r"v_(c\d+)": lambda arm, a, _: arm.courses[a].v,
    r"tau_([1-9]\d*)": lambda arm, k, _: arm.tau[int(k) - 1],
    _entry("[dm]", 2): lambda arm, i, j, _: arm.D[int(i) - 1, int(j) - 1],
    _entry("c", 3): lambda arm, i, j, k, _: arm.christoffel[int(i) - 1, int(j) - 1, int(k) - 1],
    _entry("b", 3): lambda arm, i, j, k, _: arm.christoffel[int(j) - 1, int(k) - 1, int(i) - 1],
}
EVERY = {**FRAMES, **BODIES}


def by_index(work: Work, results: Mapping[str, Result], meanings: Mapping[str, Meaning] = EVERY) -> Work:
    """With the claim that each name with indices, of the board and of the results, is the thing of these
    indices; names that the derivations it rests on have already are left to them."""
    told = _Told(work, meanings)
    things = [*told.things(results)]
    return work.claim(route("names", told.held(things), count=len(things))) if things else work


@dataclass(frozen=True, slots=True)
class Values:
    """The values of trees at one point, each worked out once: c_121 and c_211 are the same tree."""

    at: Point
    known: dict[int, Any] = field(default_factory=dict)  # by where the trees are kept

    def of(self, tree: Expr) -> Any:
        """In numbers, as `numbers` has them."""
        if id(tree) not in self.known:
            self.known[id(tree)] = numbers(tree, self.at)
        return self.known[id(tree)]


@dataclass(frozen=True, slots=True)
class Thing:
    """What bears a name with indices."""

    tree: Expr
    meaning: Meaning
    indices: tuple[str, ...]

    def is_meant(self, arm: Heavy, values: Values) -> bool:
        """Whether it is what its indices say."""
        said = values.of(self.tree)
        try:
            meant = self.meaning(arm, *self.indices, said)
            return close([0.0 for _ in flat(meant)] if self.tree == ZERO else said, meant, NEAR)
        except LookupError:  # there is no frame, link or joint of this number
            return False


@dataclass(frozen=True)
class _Told:
    """The names of an answer that mean something by their indices."""

    work: Work
    meanings: Mapping[str, Meaning]
    free: dict[int, frozenset[str]] = field(default_factory=dict)  # names in trees, by where these are kept

    def _names_in(self, tree: Expr) -> frozenset[str]:
        """Those of a tree of the board or of the results, which are long and asked for again and again."""
        if id(tree) not in self.free:
            self.free[id(tree)] = free_symbols(tree)
        return self.free[id(tree)]

    def things(self, results: Mapping[str, Result]) -> Iterator[Thing]:
        """Those whose value is written in symbols of the sheet and names of numbers."""
        board = ((name.name, tree) for name, tree in self._own() if isinstance(name, Symbol))
        for name, tree in _different((*board, *self._shown(), *results.items())):
            if isinstance(tree, TREES) and self._names_in(tree) <= self._valued:
                yield from self._things(name, tree)
        for named, tree in self._own():
            if isinstance(named, Indexed) and named.base == "Trans":
                yield Thing(tree, partial(_shift, named), ())
        for step in self.work.steps:
            for (i, j), symbol in step.entries.items():
                for whole in self._things(step.name, step.result):
                    entry = partial(_entry_of, whole.meaning, _numbers(symbol.name))
                    yield Thing(as_matrix(step.result, step.name).rows[i][j], entry, whole.indices)

    def _shown(self) -> Iterator[tuple[str, Expr]]:
        """The heads of lines that are shown beside the board, with what they end in."""
        for step in self.work.steps:
            head = step.chain[0] if len(step.chain) > 1 and step.rule != "law" else None
            if isinstance(head, Symbol) and head not in self.work.definitions:
                yield head.name, step.result

    def _things(self, name: str, tree: Expr) -> Iterator[Thing]:
        for pattern, meaning in self.meanings.items():
            if found := re.fullmatch(pattern, name):
                yield Thing(tree, meaning, tuple(i for i in found.groups() if i is not None))

    def held(self, things: list[Thing]) -> Iterator[bool]:
        """Of each at each point whether it is what its name says."""
        met, needed = 0, self._needed(things)
        for at in random_points(self._points, TRIES):
            with suppress(NotReal):
                arm = self._arm(at)
                values = Values(completed(arm.at, needed))
                yield from [thing.is_meant(arm, values) for thing in things]
                met += 1
            if met == POINTS:
                return

    def _needed(self, things: list[Thing]) -> dict[str, Expr]:
        """The names of numbers that these things are written in, and those in which these are."""
        found: dict[str, Expr] = {}
        pending = {name for thing in things for name in self._names_in(thing.tree)}
        while pending := {name for name in pending if name in self._scalars and name not in found}:
            found |= {name: self._scalars[name] for name in pending}
            pending = {other for name in pending for other in self._names_in(self._scalars[name])}
        return found

    def _arm(self, at: Point) -> Heavy:
        """The arm there, the same for all questions about it."""
        problem, key = self.work.problem, ("arm", *at.items())
        if key not in problem.memo.seen:
            problem.memo.seen[key] = Heavy(oracle_of(problem), completed(at, problem.where))
        found: Heavy = problem.memo.seen[key]
        return found

    def _own(self) -> Iterator[tuple[Expr, Expr]]:
        """The names that this answer brings."""
        uses = self.work.uses
        return (
            (name, tree)
            for name, tree in self.work.definitions.items()
            if not any(used.definitions.get(name) == tree for used in uses)
        )

    @cached_property
    def _points(self) -> frozenset[str]:
        rates = {f"{name}_{dots}" for name in self.work.problem.subject.variables for dots in ("dot", "ddot")}
        return self.work.problem.symbols | {"g"} | rates

    @cached_property
    def _scalars(self) -> dict[str, Expr]:
        """The names of the board that are numbers, such as moments."""
        names = {**self.work.aside, **self.work.definitions}
        return {
            name.name: tree
            for name, tree in names.items()
            if isinstance(name, Symbol) and not isinstance(tree, Matrix)
        }

    @cached_property
    def _valued(self) -> frozenset[str]:
        """Every name that has a value at a point."""
        found = {*self._points, *self.work.problem.where, "pi"}
        pending = {name: self._names_in(tree) for name, tree in self._scalars.items()}
        while ready := [name for name, needed in pending.items() if needed <= found]:
            found.update(ready)
            pending = {name: needed for name, needed in pending.items() if name not in found}
        return frozenset(found)


def _different(named: Iterable[tuple[str, Result]]) -> Iterator[tuple[str, Result]]:
    """Each name with each of its values once: long trees of one name are compared, none is hashed."""
    met: dict[str, list[Result]] = {}
    for name, value in named:
        if value not in (others := met.setdefault(name, [])):
            others.append(value)
            yield name, value


def _shift(name: Indexed, arm: Heavy, said: Any) -> Any:
    """Trans_{x, b}, or by all three coordinates."""
    import numpy as np

    T, (first, *others) = np.eye(4), name.lower
    if len(others) == 1 and isinstance(first, Symbol):
        T["xyz".index(first.name), 3] = number(others[0], arm.at)
    else:
        T[:3, 3] = [number(part, arm.at) for part in name.lower]
    return T


def _numbers(name: str) -> tuple[int, int]:
    """Row and column, from 0, of an entry r_12, d_1,11, or p_x of a pose."""
    index = name.partition("_")[2]
    if index in ("x", "y", "z"):
        return "xyz".index(index), 3
    i, j = index.split(",") if "," in index else tuple(index)
    return int(i) - 1, int(j) - 1


def _entry_of(whole: Meaning, place: tuple[int, int], arm: Heavy, *indices: Any) -> Any:
    return whole(arm, *indices)[place]


def _place(at: str) -> tuple[int, int]:
    i, j = ("xyz".index(axis) for axis in at)
    return i, j
