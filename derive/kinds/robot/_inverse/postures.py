"""What the solutions of an arm are called: shoulder left or right, elbow up or down, wrist flipped or not.
(Lee and Ziegler 1984; Siciliano et al., section 2.12.4.)

A name belongs to an arm where one choice decides it at every pose tried, the other choices being what they
are. Up is along z of the base; the arm that moves in a plane is seen as its coordinates are drawn.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

from derive.algebra.numbers.floats import numbers
from derive.derivation import Phrase
from derive.expression import Symbol
from derive.kinds.robot._inverse.checks import Tried
from derive.kinds.robot._inverse.subproblem import Solved
from derive.kinds.robot._inverse.worked import Worked
from derive.mechanics.chain import Chain
from derive.mechanics.inverse.subproblems import Elbow, equations_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

Part: TypeAlias = Literal["shoulder", "elbow", "wrist"]
View: TypeAlias = Literal["height", "above", "drawn", "middle"]
SIDES: Mapping[View, tuple[str, str]] = {
    "height": ("up", "down"),
    "above": ("left", "right"),
    "drawn": ("up", "down"),
    "middle": ("not-flipped", "flipped"),
}
MEANING: Mapping[tuple[Part, View], str] = {
    ("shoulder", "above"): "shoulder-means",
    ("elbow", "height"): "elbow-up-means",
    ("elbow", "above"): "elbow-left-means",
    ("elbow", "drawn"): "elbow-drawn-means",
}
PARALLEL = 1e-9


@dataclass(frozen=True, slots=True)
class End:
    """A point of the arm: the origin of frame `last`, of the end-effector where that is None, the centre of a
    `wrist`, or any on the axis of the joint in row `axis`."""

    last: int | None = None
    wrist: bool = False
    axis: int | None = None


@dataclass(frozen=True, slots=True)
class Posture:
    """The `part` of an arm that has two sides, decided by the choice at sub-problem `number`: which each
    branch has. An elbow is that of the joints in `rows` on the way to `end`, seen by its `view`; a shoulder
    is where the axis of the second row points. A wrist turns about the middle one of its joints."""

    part: Part
    number: int
    sides: tuple[str, ...]
    view: View
    rows: tuple[int, ...] = ()
    end: End = End()

    def said(self, branch: int) -> Phrase:
        """`elbow up`."""
        return Phrase("posture", {"part": Phrase(self.part), "side": Phrase(self.sides[branch])})


@dataclass(frozen=True, slots=True)
class Postures:
    """The branches of an arm, as they stand at the poses tried; `chosen` has the sign of each at every
    sub-problem with two values, by number."""

    worked: Worked
    tried: Tried
    chosen: Sequence[Mapping[int, int]]

    def found(self) -> tuple[Posture, ...]:
        """In the order of the sub-problems."""
        other = self.worked.chain.coupling or self.worked.shoulder or self.worked.by_angle
        if other or next(self.tried.solved, None) is None:
            return ()
        each = (self._of(solved) for solved in self.worked.solved if solved.two_valued)
        return tuple({posture.part: posture for posture in each if posture}.values())

    def _of(self, solved: Solved) -> Posture | None:
        found = self.worked.plan.steps[solved.number].subproblem
        equations = equations_of(found)
        if not equations or solved.facts.method.half:
            return None
        end = End(equations[0].between.last, solved.stage == "arm")
        if solved.stage == "hand":
            return self._wrist(solved)
        if isinstance(found, Elbow) and (bent := self._bent(solved)):
            view, after = self._view(bent[1]), self._parallel_after(bent[1])
            end = end if after is None else End(axis=after)
            return self._named("elbow", solved.number, view, bent, end) if view else None
        rows = tuple(i for i, _ in self.worked.chain.moving)[:2]
        if self._turns_upright(rows):
            return self._named("shoulder", solved.number, "above", rows, end)
        return None

    def _wrist(self, solved: Solved) -> Posture | None:
        """By the sign of its middle angle, or of the cosine of that. Only one whose axes are square turns by
        half turns where it flips."""
        if not self.worked.singular or solved.head != Symbol(self.worked.chain.variables[-2]):
            return None
        rows = tuple(i for i, _ in self.worked.chain.moving)[-3:]
        if any(abs(self._axis(one) @ self._axis(other)) > PARALLEL for one, other in pairwise(rows)):
            return None
        good, bad = SIDES["middle"]
        sides = tuple(good if signs[solved.number] > 0 else bad for signs in self.chosen)
        return Posture("wrist", solved.number, sides, "middle", rows)

    def _bent(self, solved: Solved) -> tuple[int, int] | None:
        """The two joints with parallel axes that make an elbow of the unknown."""
        turning = [(i, joint.variable) for i, joint in self.worked.chain.moving if joint.type == "revolute"]
        for (first, _), (second, name) in pairwise(turning):
            if solved.head == Symbol(name):
                return (first, second) if _is_along(self._axis(first), self._axis(second)) else None
        return None

    def _parallel_after(self, row: int) -> int | None:
        """The next joint that turns, where its axis is parallel: the second link ends there."""
        later = (i for i, joint in self.worked.chain.moving if i > row and joint.type == "revolute")
        after = next(later, None)
        return after if after and _is_along(self._axis(row), self._axis(after)) else None

    def _view(self, row: int) -> View | None:
        """From where a person looks at the plane in which the elbow bends."""
        n = self._axis(row)
        if len(self.worked.varying) == 2:
            return "drawn"
        if _is_along(n, (0, 0, 1)):
            return "above"
        return "height" if abs(n[2]) < PARALLEL else None

    def _turns_upright(self, rows: Sequence[int]) -> bool:
        """Whether the first of two joints turns about z of the base, and the second about a level axis."""
        chain = self.worked.chain
        if len(rows) < 2 or any(chain.joint(i).type != "revolute" for i in rows):
            return False
        return _is_along(self._axis(rows[0]), (0, 0, 1)) and abs(self._axis(rows[1])[2]) < PARALLEL

    def _axis(self, row: int) -> Array:
        """At the first pose tried."""
        _, _, known = next(self.tried.solved)
        return _vector(self.worked.chain.axis(row), known)

    # -- sides ------------------------------------------------------------------------------------

    def _named(self, part: Part, number: int, view: View, rows: tuple[int, ...], end: End) -> Posture | None:
        """With the side of every branch; None where a branch has both, or both values have one."""
        seen: dict[int, set[bool]] = {}
        for k, _, known in self.tried.solved:
            seen.setdefault(k, set()).add(self._side(part, view, rows, end, known) > 0)
        if len(seen) < len(self.chosen) or any(len(sides) > 1 for sides in seen.values()):
            return None
        first, second = SIDES[view]
        sides = tuple(first if seen[k] == {True} else second for k in range(len(self.chosen)))
        return Posture(part, number, sides, view, rows, end) if self._decides(number, sides) else None

    def _decides(self, number: int, sides: Sequence[str]) -> bool:
        """Whether two branches that differ in this choice alone differ in their side."""
        pairs = (
            (sides[k], sides[n])
            for k, one in enumerate(self.chosen)
            for n, other in enumerate(self.chosen)
            if [key for key in one if one[key] != other[key]] == [number]
        )
        return all(one != other for one, other in pairs)

    def _side(
        self, part: Part, view: View, rows: Sequence[int], end: End, known: Mapping[str, float]
    ) -> float:
        """Positive on the first of the two sides."""
        import numpy as np

        first, second = rows
        chain = self.worked.chain
        start, here = (_vector(chain.point(row), known) for row in (first, second))
        way, n = place(self.worked, end, known) - start, _vector(chain.axis(second), known)
        if part == "shoulder":
            return float(np.cross(way, n)[2])
        across = np.cross(way, here - start)
        match view:
            case "height":  # to the left of a line that goes backwards is below it
                return float((across @ n) * (way @ np.cross((0, 0, 1), n)))
            case "drawn":
                right, up = self.worked.varying
                return float(across @ np.cross(np.eye(3)[right], np.eye(3)[up]))
        return float(across[2])


def place(worked: Worked, end: End, known: Mapping[str, float]) -> Array:
    """Where a point of the arm is (3)."""
    import numpy as np

    chain, decoupling = worked.chain, worked.plan.decoupling
    if end.axis is not None:
        return _vector(chain.point(end.axis), known)
    if end.wrist and decoupling:
        T = np.array(numbers(chain.T[decoupling.joint.frame], known))
        return np.array(T[:3, :3] @ _vector(decoupling.joint.inside, known) + T[:3, 3])
    T = np.array(numbers(chain.T_tool if end.last is None else chain.T[end.last], known))
    return np.array(T[:3, 3])


def explained(postures: Sequence[Posture], chain: Chain) -> Iterator[Phrase]:
    """What the names mean."""
    for each in postures:
        names = [Symbol(chain.joint(i).variable) for i in each.rows]
        match each.part, each.view:
            case "wrist", _:
                yield Phrase("flip-means", dict(zip(("first", "middle", "last"), names, strict=True)))
            case part, view:
                about = dict(zip(("first", "second"), names, strict=True))
                yield Phrase(MEANING[part, view], {**about, "end": _called(each.end, chain)})


def _called(end: End, chain: Chain) -> Phrase:
    if end.axis is not None:
        return Phrase("end-axis", {"joint": Symbol(chain.joint(end.axis).variable)})
    if end.last is not None:
        return Phrase("end-frame", {"frame": end.last})
    return Phrase("end-wrist" if end.wrist else "end-arm")


def _vector(value: Any, known: Mapping[str, float]) -> Array:
    """A column (3 by 1) in numbers (3)."""
    import numpy as np

    return np.array(numbers(value, known), dtype=float).ravel()


def _is_along(one: Any, other: Any) -> bool:
    import numpy as np

    return bool(np.linalg.norm(np.cross(one, other)) < PARALLEL)
