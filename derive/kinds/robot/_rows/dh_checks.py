"""What is told of the rows and frames of a convention, held against frames in numbers."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import reduce
from operator import matmul
from random import Random
from typing import Any, Literal

from derive.algebra.numbers.floats import Point, number, numbers
from derive.derivation import Claim, Phrase
from derive.expression import Symbol, symbols
from derive.expression import number as tree
from derive.kinds.checks import agreement, close, route
from derive.kinds.robot._rows.dh_rows import COLUMNS, INDICES, TYPED
from derive.kinds.robot._rows.dh_told import Found, FrameTold, Given, Restated
from derive.kinds.work import Work
from derive.mechanics.motion import Move
from derive.mechanics.oracle.poses import elementary, turn
from derive.mechanics.oracle.values import Array
from derive.mechanics.robot import Convention, DHRow

HERE, TRIED = 2, 3  # the row that is looked at; how many are
STEP, FAR = 0.3, 1e-6  # of a joint; apart are two things farther than that
KINDS: Mapping[str, Literal["rotate", "translate"]] = {"Rot": "rotate", "Trans": "translate"}
BY = Symbol("by")


def moves_of(told: Given, convention: Convention) -> Claim:
    """That the moves of a row lead from frame to frame, in frames of rows at random."""
    return _of_rows(convention, lambda row: [close(row.moved(told.moves), row.frames[HERE])])


def products_of(told: Restated, given: Convention, here: Convention) -> tuple[Claim, Claim]:
    """The same of the products of a row in both conventions."""
    return (
        _of_rows(given, lambda row: [close(row.product(told.given), row.pose)]),
        _of_rows(here, lambda row: [close(row.product(told.here), row.pose)]),
    )


def shifted(told: Restated, rows: Sequence[DHRow], given: Sequence[DHRow]) -> Claim:
    """That lengths and twists stand one row after, or before, the one in which they were given."""
    by = 1 if told.shift.key == "on" else -1
    pairs = ((row, given[i - by]) for i, row in enumerate(rows) if 0 <= i - by < len(given))
    moved = ((row.a, row.alpha) == (old.a, old.alpha) for row, old in pairs)
    return route("shifted", (len(rows) == len(given), *moved))


def measures_of(told: Found, convention: Convention) -> Claim:
    """That frames of rows at random stand as they are assigned, and have the parameters that are measured."""
    return _of_rows(convention, lambda row: [*row.assigned(told.assigned), *map(row.measured, told.measured)])


def _of_rows(convention: Convention, held: Callable[[_Row], Iterable[bool]]) -> Claim:
    dice = Random(HERE)
    rows = [_Row.drawn(convention, dice) for _ in range(TRIED)]
    return route("as-measured", (each for row in rows for each in held(row)))


@dataclass(frozen=True)
class _Row:
    """The frames (4 by 4, in some base) of the numbers HERE - 1, HERE and HERE + 1, the parameters by their
    names and indices, and the axes of the joints: a point and a direction."""

    frames: dict[int, Array]
    parameters: dict[tuple[str, int], float]
    joints: dict[int, tuple[Array, Array]]

    @classmethod
    def drawn(cls, convention: Convention, dice: Random) -> _Row:
        import numpy as np

        typed, indices = TYPED[convention], INDICES[convention]
        frames = {HERE - 1: elementary(Move("rotate", "y", tree("2/5")), {})}
        parameters: dict[tuple[str, int], float] = {}
        joints: dict[int, tuple[Array, Array]] = {}
        for i in (HERE, HERE + 1):
            row = [dice.uniform(0.2, 1.2) for _ in range(4)]
            before = frames[i - 1]
            frames[i] = before @ np.array(typed(*row))
            turned = before @ np.array(typed(row[0] + STEP, *row[1:]))
            joints[i] = _axis(turned @ np.linalg.inv(frames[i]))
            shifts = (int(index) - HERE for index in indices)
            names = COLUMNS
            parameters |= {
                (name, i + shift): value for name, shift, value in zip(names, shifts, row, strict=True)
            }
        return cls(frames, parameters, joints)

    @property
    def pose(self) -> Array:
        """Of the frame in that before it."""
        import numpy as np

        return np.array(np.linalg.inv(self.frames[HERE - 1]) @ self.frames[HERE])

    def _at(self, name: Any) -> int:
        return int(number(name.lower[0], {"i": float(HERE)}))

    def _value(self, name: Any) -> float:
        return self.parameters[name.base, self._at(name)]

    def _along(self, name: Any) -> Array:
        """The direction of x_i or z_i."""
        return self.frames[self._at(name)][:3, "xyz".index(name.base)]

    def _origin(self, name: Any) -> Array:
        """The origin of the frame that x_i, z_i or o_i belongs to."""
        return self.frames[self._at(name)][:3, 3]

    def measured(self, phrase: Phrase) -> bool:
        name, start, end, axis = (phrase.about[key] for key in ("name", "start", "end", "axis"))
        along, value = self._along(axis), self._value(name)
        if phrase.key == "measured-angle":
            return close(turn(along, value) @ self._along(start), self._along(end))
        return close((self._origin(end) - self._origin(start)) @ along, value)

    def moved(self, moves: tuple[Phrase, ...]) -> Array:
        """Where frame i - 1 is taken, one move after the other."""
        T = self.frames[HERE - 1].copy()
        for move in moves:
            along, by = self._along(move.about["axis"]), self._value(move.about["by"])
            if move.key == "turned":
                T[:3, :3] = turn(along, by) @ T[:3, :3]
            else:
                T[:3, 3] += by * along
        return T

    def product(self, product: Any) -> Array:
        factors = ((KINDS[each.base], *each.lower) for each in product.factors)
        made = [
            elementary(Move(kind, axis.name, BY), {BY.name: self._value(by)}) for kind, axis, by in factors
        ]
        return reduce(matmul, made)

    def assigned(self, phrase: Phrase) -> Iterator[bool]:
        import numpy as np

        axis, x, start, end, on = (phrase.about[key] for key in ("axis", "x", "start", "end", "on"))
        point, direction = self.joints[HERE]
        yield close(np.cross(self._along(axis), direction), np.zeros(3))
        yield close(np.cross(self._origin(axis) - point, direction), np.zeros(3))
        for line in (start, end):
            across = np.cross(self._along(x), self._along(line))
            yield close(self._along(x) @ self._along(line), 0.0)
            yield close((self._origin(line) - self._origin(x)) @ across, 0.0)
        yield bool((self._origin(end) - self._origin(start)) @ self._along(x) > 0)
        yield close(np.cross(self._origin(x) - self._origin(on), self._along(on)), np.zeros(3))


def _axis(displacement: Array) -> tuple[Array, Array]:
    """A point and the direction of the axis of a turn."""
    import numpy as np

    S = displacement[:3, :3] - displacement[:3, :3].T
    w = np.array([S[2, 1], S[0, 2], S[1, 0]])
    still = np.eye(3) - displacement[:3, :3]
    return np.linalg.lstsq(still, displacement[:3, 3], rcond=None)[0], w / np.linalg.norm(w)


# -- frames that were found -----------------------------------------------------------------------


@dataclass(frozen=True)
class _Seen:
    """The axes and origins of the frames in numbers, by their names."""

    named: Mapping[str, Array]
    about: Mapping[str, Any]

    def __getitem__(self, key: str) -> Array:
        """What fills a field of the phrase."""
        return self.named[self.about[key].name]

    def origin(self, key: str) -> Array:
        """Of the frame that this axis belongs to."""
        return self.named["o" + self.about[key].name[1:]]

    @property
    def before(self) -> tuple[Array, Array, Array]:
        """x, z and o of the frame before."""
        x, z, o = (self.named[f"{letter}_{self.about['before']}"] for letter in "xzo")
        return x, z, o

    def parallel(self) -> bool:
        return _vanish(_cross(self["a"], self["b"]))

    def apart(self) -> bool:
        """Whether the axes a and b have no point in common."""
        way, across = self.origin("b") - self.origin("a"), _cross(self["a"], self["b"])
        return not _vanish(_cross(way, self["a"]) if _vanish(across) else [way @ across])

    def upright(self) -> bool:
        """Whether x is at right angles to a and b, and o lies on both."""
        lines = ((self[key], self["o"] - self.origin(key)) for key in "ab")
        return all(_vanish([self["x"] @ z]) and _vanish(_cross(way, z)) for z, way in lines)

    def meet(self) -> bool:
        return not self.parallel() and not self.apart() and self.upright()


def _last(seen: _Seen) -> bool:
    x, z, _ = seen.before
    return close([seen["x"], seen["z"]], [x, z])


def _as_next(seen: _Seen) -> bool:
    return all(close(seen[key], seen.named[f"{key}_1"]) for key in "xzo")


MEANINGS: Mapping[str, Callable[[_Seen], bool]] = {
    "frame-world": lambda s: close([s["x"], s["z"], s["o"]], [[1, 0, 0], [0, 0, 1], [0, 0, 0]]),
    "frame-free-standard": lambda s: _vanish([s["x"] @ s["z"]]),
    "frame-free-modified": _as_next,
    "frame-skew": lambda s: not s.parallel() and s.apart(),
    "frame-intersecting": _Seen.meet,
    "frame-turned": lambda s: s.meet() and close(s["x"], s["kept"]),
    "frame-parallel": lambda s: s.parallel() and s.apart() and _vanish([(s["o"] - s.before[2]) @ s["a"]]),
    "frame-coincident": lambda s: (
        s.parallel() and not s.apart() and close([s["x"], s["o"]], [s.before[0], s.before[2]])
    ),
    "frame-coincident-near": lambda s: (
        s.parallel() and not s.apart() and _vanish([(s["o"] - s["near"]) @ s["a"], s["x"] @ s["a"]])
    ),
    "frame-end-effector-standard": lambda s: _vanish([s["x"] @ s["a"]]),
    "frame-end-effector-modified": lambda s: _vanish([s["x"] @ s["z"]]),
    "frame-last-standard": _last,
    "frame-last-modified": lambda s: close(s["x"], s["kept"]) and _vanish([(s["o"] - s.before[2]) @ s["z"]]),
}


def as_seen(work: Work, frames: tuple[FrameTold, ...]) -> Claim:
    """That the frames on the board, all joints at zero, stand as is told of each."""
    variables = dict.fromkeys(work.problem.subject.variables, 0.0)

    def held(at: Point) -> list[bool]:
        import numpy as np

        point = {**at, **variables}
        lines = {step.name: step.result for step in work.steps if step.rule in ("axis", "normal", "origin")}
        named = {name: np.ravel(numbers(line, point)) for name, line in lines.items()}
        return [_of_its_own(frame) and _stands(frame.why, named) for frame in frames]

    return agreement("frames-told", work.problem.symbols, held, lambda _: [True] * len(frames))


def _of_its_own(frame: FrameTold) -> bool:
    """Whether it is told of this frame by the one before it."""
    i, about = frame.number, frame.why.about
    letters = [about[name] for name in ("x", "z", "o", "d", "kept", "near")]
    own = [*symbols(f"x_{i} z_{i} o_{i} d_{i} x_{i - 1} o_{i - 1}")]
    return letters == own and about["before"] == i - 1


def _stands(why: Phrase, named: Mapping[str, Array]) -> bool:
    """Whether a frame stands as is told; not where it is told of axes that are none."""
    try:
        return MEANINGS[why.key](_Seen(named, why.about))
    except KeyError:
        return False


def _cross(a: Array, b: Array) -> Any:
    import numpy as np

    return np.cross(a, b)


def _vanish(values: Any) -> bool:
    return bool(max(map(abs, values)) < FAR)
