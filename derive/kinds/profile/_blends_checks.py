"""A linear segment with parabolic blends held to its velocity.

The area under it is the way, found by halving, and the place is what it adds up to.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice, pairwise
from math import inf, isclose
from typing import Any

from derive.algebra.numbers.floats import Point, completed
from derive.algebra.numbers.floats import number as value_of
from derive.derivation import Branch, Claim, Phrase
from derive.expression import Expr, Relation, Symbol
from derive.kinds.checks import law, route
from derive.kinds.fields import TREES
from derive.kinds.meanings import Chain, farthest
from derive.kinds.problem import Problem
from derive.kinds.profile._blends import POSSIBLE, T_B, A, Blended, V, t, with_values
from derive.kinds.profile._pieces import times_of
from derive.kinds.profile._places import places
from derive.mechanics import trapezoid
from derive.mechanics.profile import Journey, Profile

EACH = 2  # points
CLOSE, BESIDE = 1e-6, 1e-3
HOW = {"a": "blended-quadratic", "v": "blended", "t_b": "blended", "": "as-the-profile"}
PIECES = {1: "begins", 2: "goes-on", 3: "ends"}
WITHIN = (0.3, 0.8)  # of a piece: moments at which its law is tried


@dataclass(frozen=True, slots=True)
class Motion:
    """From a place to another in the time T: the velocity grows to v during t_b, and falls likewise."""

    start: float
    end: float
    T: float
    t_b: float
    v: float

    @property
    def a(self) -> float:
        return self.v / self.t_b

    def velocity(self, at: float) -> float:
        return self.v * min(at / self.t_b, 1.0, (self.T - at) / self.t_b)

    def place(self, at: float) -> float:
        """What the velocity, which is made of straight lines, adds up to."""
        corners = [0.0, *(corner for corner in (self.t_b, self.T - self.t_b) if corner < at), at]
        areas = (
            (self.velocity(left) + self.velocity(right)) * (right - left) / 2
            for left, right in pairwise(corners)
        )
        return self.start + sum(areas)

    @property
    def borders(self) -> tuple[float, float, float, float]:
        """Where the pieces begin and end."""
        return 0.0, self.t_b, self.T - self.t_b, self.T


@dataclass(frozen=True, slots=True)
class Blends:
    """What was asked, how it was made, and what is told of it."""

    journey: Journey
    profile: Profile
    problem: Problem
    found: Blended

    def claims(
        self, chains: Sequence[Chain], pieces: Sequence[Branch], told: Mapping[int, tuple[Chain, Phrase]]
    ) -> Iterator[Claim]:
        """Lines and results, each piece at moments of its own; `told` are the law and the words of those that
        the page has."""
        met = list(islice(self._possible(), EACH))
        yield route("as-told", (self._holds(at, chains, pieces, told) for at in met))

    def said(
        self,
        how: Phrase,
        back: Phrase | None,
        smaller: Phrase | None,
        possible: Phrase | None,
        told: Sequence[tuple[Expr, Expr, int | None]],
        met: Phrase | None = None,
    ) -> Iterator[Claim]:
        """What is said of all of it: how it is made, and for which values."""
        area, given = how.about.get("area"), self.given[0]
        equal = area is None or (isinstance(area, Relation) and area.sign == "=")
        root = Phrase("smaller-root") if given == "a" else None
        yield law(
            "said",
            (smaller == root, self._is_back(back), how.key == HOW[given], equal, self._is_given(told)),
        )
        if isinstance(area, Relation) and isinstance(area.left, TREES) and area.sign == "=":
            names = (self.names(motion, at) for at in self._possible() if (motion := self.possible(at)))
            chains = [(area.left, area.right), (how.about["v"], V), (how.about["t_b"], T_B)]
            joined = how.about.get("joined")
            if isinstance(joined, Relation) and isinstance(joined.left, TREES):
                chains += [(joined.left, joined.right), (how.about["a"], A)]
                yield law("said", joined.sign == "=")
            yield route("area", (farthest(chains, each) < CLOSE for each in islice(names, EACH)))
        if possible is not None:
            yield route("which", self._which(possible))
            if met is not None:
                yield route("in-bounds", self._met(met, possible))

    def _is_back(self, told: Phrase | None) -> bool:
        """Whether what was given is told to be negative where the motion in numbers goes backwards."""
        by, name = self.given[0], self.found.given
        first = next(filter(None, map(self.possible, self._possible())), None)
        if self.found.open or by == "t_b" or name is None or first is None or first.v >= 0:
            return told is None
        return told == Phrase("goes-back", {"given": name})

    def _is_given(self, told: Sequence[tuple[Expr, Expr, int | None]]) -> bool:
        """Whether all that the sheet gives is told, each with how often it is differentiated."""
        found, sorts = self.found, {"v": 1, "a": 2, "t_b": None, "": None}
        rates: dict[Expr, int | None] = {
            found.start: 0, found.end: 0, found.T: None, V: 1, A: 2, T_B: None,
            found.given or T_B: sorts[self.given[0]],
        }  # fmt: skip
        typed = [(name, value, rates[name]) for name, value in found.working.typed if name in rates]
        return list(told) == typed

    @property
    def given(self) -> tuple[str, Expr | None]:
        """What was given of the velocity, the acceleration and the duration of the blends."""
        way = self.journey
        chosen = (("v", way.cruise), ("a", way.acceleration), ("t_b", way.blend))
        return next(((key, value) for key, value in chosen if value is not None), ("", None))

    def _which(self, told: Phrase) -> Iterator[bool]:
        """Whether just the values are told that make a motion, where they have the sign of the way."""

        def worth(tree: Expr, at: Point) -> float:
            return value_of(self.problem.final(with_values(tree, self.found.working)), at)

        (by, value), (start, end) = self.given, (self.found.start, self.found.end)
        trees = {key: tree for key, tree in told.about.items() if isinstance(tree, TREES)}
        bounds: list[tuple[Expr, Expr]] = []
        for key, bound in told.about.items():
            if isinstance(bound, Relation) and not isinstance(bound.left, Relation):
                yield bound.sign == "="
                trees[key] = bound.left
                bounds.append((bound.left, bound.right))
        yield told.key == POSSIBLE[by] and trees["given"] == self.found.given and value is not None
        for at in places(self.problem.symbols):
            sizes = {key: worth(tree, at) for key, tree in trees.items()}
            yield all(isclose(worth(one, at), worth(other, at)) for one, other in bounds)
            way = worth(end, at) - worth(start, at)
            if worth(self.found.T, at) <= 0 or sizes["given"] * (1.0 if by == "t_b" else way) <= 0:
                continue
            sign = 1.0 if by == "t_b" or way > 0 else -1.0
            least, most = sign * sizes.get("least", 0.0), sign * sizes.get("most", sign * inf)
            size = abs(sizes["given"])
            above = size > least if not isclose(size, least) else by == "a"  # at which there are still blends
            within = above and (size < most or isclose(size, most))
            yield least >= 0 and within == (self.possible(at) is not None)
            ends = worth(start, at), worth(end, at), worth(self.found.T, at)
            for key, inward in (("least", BESIDE), ("most", -BESIDE)):
                edge = abs(sizes.get(key, 0.0))
                beside = [_made(by, *ends, edge * (1 + side)) is not None for side in (inward, -inward)]
                yield key not in sizes or beside == [True, False]

    def _met(self, told: Phrase, possible: Phrase) -> Iterator[bool]:
        """Whether a chain of numbers is the bounds with the given value between them, and in order."""
        (_, value), known = self.given, completed({}, self.problem.where)
        bounds = [possible.about.get(key) for key in ("least", "most")]
        least, most = (each.right if isinstance(each, Relation) else None for each in bounds)
        numbers: list[float] = []
        said = told.about["chain"]
        while isinstance(said, Relation):
            lowest = not isinstance(said.left, Relation) and least is not None
            yield said.sign == ("<" if lowest and self.given[0] == "v" else "<=")
            yield isinstance(said.right, TREES)
            numbers.insert(0, value_of(said.right, {}) if isinstance(said.right, TREES) else inf)
            said = said.left
        numbers.insert(0, value_of(said, {}) if isinstance(said, TREES) else inf)
        wanted = [value_of(each, known) for each in (least, value, most) if isinstance(each, TREES)]
        yield len(numbers) == len(wanted) and all(map(isclose, numbers, wanted))
        yield all(one <= other for one, other in pairwise(numbers))

    def possible(self, at: Point) -> Motion | None:
        """The motion at a point; None where there is none."""
        known = completed(at, self.problem.where)
        start, end = value_of(self.journey.start, known), value_of(self.journey.end, known)
        way, T = end - start, None if self.profile.time is None else value_of(self.profile.time, known)
        if self.found.by == "limits":
            return self._within_limits(start, end, known)
        chosen = {"v": self.journey.cruise, "a": self.journey.acceleration, "t_b": self.journey.blend}
        given = chosen[self.found.by]
        if T is None or given is None or way == 0 or T <= 0:
            return None
        value = value_of(given, known)
        if self.found.given is not None:  # its sign is that of the way, where numbers say which that is
            used = value_of(self.found.working[self.found.given], known)
            value = used if abs(used) == abs(value) else 0.0
        return _made(self.found.by, start, end, T, value if self.found.by == "t_b" or way > 0 else -value)

    def _within_limits(self, start: float, end: float, at: Point) -> Motion | None:
        (axis,) = self.profile.axes
        a_max = float("inf") if axis.a_max is None else value_of(axis.a_max, at)
        T = None if self.profile.time is None else value_of(self.profile.time, at)
        found = trapezoid.searched(abs(end - start), value_of(axis.v_max, at), a_max, T)
        if found.case == "infeasible":
            return None
        return Motion(start, end, found.t_3, found.t_1, found.v if end > start else -found.v)

    def _possible(self) -> Iterator[Point]:
        return (at for at in places(self.problem.symbols) if self.possible(at) is not None)

    def names(self, motion: Motion, at: Point) -> dict[Expr, Any]:
        """What the names on the page stand for at a point."""
        found = self.found
        names: dict[Expr, Any] = {
            found.start: motion.start, found.end: motion.end, T_B: motion.t_b, V: motion.v, A: motion.a,
            Symbol("t_f"): motion.T, **_letters(at, self.problem), found.T: motion.T,
        }  # fmt: skip
        if found.given is not None:
            names[found.given] = {"v": motion.v, "a": motion.a, "t_b": motion.t_b}[found.by]
        return names

    def _holds(
        self, at: Point, chains: Sequence[Chain], pieces: Sequence[Branch],
        told: Mapping[int, tuple[Chain, Phrase]],
    ) -> bool:  # fmt: skip
        motion = self.possible(at)
        if motion is None:
            return False
        names, letters = self.names(motion, at), _letters(at, self.problem)
        gaps = [farthest(chains, names)]
        flat = motion.borders[2] - motion.borders[1] <= CLOSE * motion.T
        whole = {1, 3} <= told.keys() and (2 in told or flat)
        whole &= all(what.key == PIECES[k] for k, (_, what) in told.items())
        for k, branch in enumerate(pieces, 1):
            low, high = motion.borders[k - 1 : k + 1]
            law, about = (told[k][0], told[k][1].about) if k in told else ((), {})
            ends = {"start": LOW, "end": HIGH}
            edges = [(ends[name], tree) for name, tree in about.items() if isinstance(tree, TREES)]
            when = times_of(branch)
            edges += [(LOW, when.left.left), (HIGH, when.right)] if isinstance(when.left, Relation) else []
            gaps.append(farthest(edges, {**names, LOW: low, HIGH: high}))
            for part in WITHIN:
                moment = low + part * (high - low)
                here: dict[Expr, Any] = {t: moment, Symbol("q"): motion.place(moment)}
                gaps.append(farthest([law], {**names, **here}) if law else 0.0)
                gaps.append(farthest([(Symbol("q"), branch.values["q"])], {**letters, **here}))
        return whole and max(gaps) < CLOSE


LOW, HIGH = Symbol("beginning of the piece"), Symbol("end of the piece")


def _letters(at: Point, problem: Problem) -> dict[Expr, Any]:
    return {Symbol(name): value for name, value in completed(at, problem.where).items()}


def _made(by: str, start: float, end: float, T: float, size: float) -> Motion | None:
    """By the size of its velocity or acceleration, or the duration of its blends. That is found by halving:
    the longer they are, the smaller is the way at a velocity, and the larger at an acceleration."""
    way = abs(end - start)
    sign = 1.0 if end > start else -1.0
    if size <= 0:
        return None

    def covered(t_b: float) -> float:
        return (size if by == "v" else size * t_b) * (T - t_b)

    if by == "t_b":
        return Motion(start, end, T, size, sign * way / (T - size)) if size <= T / 2 else None
    low, high = 0.0, T / 2
    without, longest = covered(low), covered(high)  # blends of no duration are none
    if isclose(way, without) or not (
        isclose(way, longest) or min(without, longest) < way < max(without, longest)
    ):
        return None
    for _ in range(100):
        middle = (low + high) / 2
        if (covered(middle) > way) == (by == "v"):
            low = middle
        else:
            high = middle
    t_b = (low + high) / 2
    return Motion(start, end, T, t_b, sign * (size if by == "v" else size * t_b))
