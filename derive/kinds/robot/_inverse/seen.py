"""The names of postures, and the signs in the table of solutions, against the arm as it stands in numbers.

Its axes are found by moving the joints of the oracle, its elbow is compared with the line to its end."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from derive.derivation import Cell, Claim, Phrase
from derive.expression import ZERO, Relation, Symbol
from derive.kinds.checks import close, route
from derive.kinds.robot._inverse.checks import Tried, side
from derive.kinds.robot._inverse.choices import Choices
from derive.kinds.robot._inverse.postures import End, Posture
from derive.kinds.robot._inverse.target import Target, Values, gap
from derive.kinds.robot._inverse.worked import Worked
from derive.kinds.robot._seen import axis_seen, meeting
from derive.mechanics.inverse.goal import AXES

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

TURN, NEAR = 0.3, 1e-6


def angle_told(said: Phrase, tried: Tried) -> Claim:
    """Whether an angle that is known is one between the two axes that are named: its cosine is their
    product."""
    names = {key: each.name for key, each in said.about.items() if isinstance(each, Symbol)}
    row, column = (AXES.index(names[key]) for key in ("base", "axis"))
    target = tried.target
    pairs = (
        (known[names["name"]], target.oracle.tool(target.completed(known))[row, column])
        for _, _, known in tried.once
    )
    return route("angle-told", (close(math.cos(phi), product, NEAR) for phi, product in pairs))


def meeting_told(said: Phrase, worked: Worked, tried: Tried) -> Claim:
    """Whether the axes of a wrist meet in the origin of the end-effector's frame, and those of a shoulder in
    that of the base, just where that is said."""
    there = (_meet_at_end(worked, tried.target, known) for _, _, known in tried.once)
    return route("meeting-told", (met == said.key.endswith("at-the-end") for met in there))


def _meet_at_end(worked: Worked, target: Target, known: Values) -> bool:
    end = 0.0 if worked.shoulder else target.oracle.tool(known)[:3, 3]
    return bool(abs(_centre(worked, target, known) - end).max() < NEAR)


def _centre(worked: Worked, target: Target, known: Values) -> Array:
    """Where the axes of a wrist or a shoulder meet (3): what its joints leave where it is."""
    import numpy as np

    tool = target.oracle.tool
    back = np.linalg.inv(tool(known))
    return meeting([tool({**known, name: known[name] + TURN}) @ back for name in worked.spherical])


@dataclass(frozen=True, slots=True)
class Seen:
    """What is said of the branches of an arm."""

    worked: Worked
    tried: Tried
    choices: Choices

    def claims(self) -> Iterator[Claim]:
        """Of every name, and of every sign in the table."""
        once = [*self.tried.once]
        if self.choices.postures:
            names = (has for k, _, known in once for has in self._named(k, known))
            yield route("postures-seen", [*names, *self._flipped()])
        if table := self.choices.table:
            signs = (holds for k, _, known in once for holds in self._signs(k, known))
            yield route("signs-told", [*signs, *self._numbered([row[0] for row in table.rows])])

    def _named(self, k: int, known: Values) -> Iterator[bool]:
        for posture in self.choices.postures:
            said = posture.sides[k]
            match posture.part:
                case "elbow":
                    yield said == self._elbow(posture, known)
                case "shoulder":
                    yield said == self._shoulder(posture, known)
                case "wrist":
                    yield said == self._wrist(posture, known)

    def _elbow(self, posture: Posture, known: Values) -> str:
        """Above the line from the first axis to the end, or to the left of it."""
        (_, start), (n, here) = (self._axis(row, known) for row in posture.rows)
        end = self._place(posture.end, known)
        if posture.view == "height":
            level = (-n[1], n[0])  # along the plane of the arm
            along = [float(level[0] * each[0] + level[1] * each[1]) for each in (start, here, end)]
            share = (along[1] - along[0]) / (along[2] - along[0])
            return "up" if here[2] > start[2] + share * (end[2] - start[2]) else "down"
        plane = (0, 1) if posture.view == "above" else self.worked.varying
        left = self._heading(here - start, plane) - self._heading(end - start, plane)
        names = ("left", "right") if posture.view == "above" else ("up", "down")
        return names[math.sin(left) < 0]

    def _shoulder(self, posture: Posture, known: Values) -> str:
        """Where the axis of the second joint points, on the way to the end."""
        (_, start), (n, _) = (self._axis(row, known) for row in posture.rows)
        way = self._place(posture.end, known) - start
        return "left" if math.sin(self._heading(n, (0, 1)) - self._heading(way, (0, 1))) > 0 else "right"

    def _wrist(self, posture: Posture, known: Values) -> str:
        """By its middle angle from -pi to pi, or from -90 to 90 degrees where its axes coincide at those."""
        middle = math.remainder(known[self._variables(posture)[1]], 2 * math.pi)
        even = self.worked.solved[posture.number].facts.method.name == "cosine"
        return "not-flipped" if (middle > 0 if even else abs(middle) < math.pi / 2) else "flipped"

    def _flipped(self) -> Iterator[bool]:
        """A wrist that flips turns its outer joints by half a turn, and leaves the others where they are."""
        for posture in self.choices.postures:
            if posture.part != "wrist":
                continue
            first, _, last = self._variables(posture)
            for met in self.tried.met:
                for k, other in self._pairs(posture.number):
                    if (one := met[k]) is not None and (two := met[other]) is not None:
                        turned = [abs(gap(one[name], two[name])) for name in (first, last)]
                        yield all(abs(each - math.pi) < NEAR for each in turned)

    def _pairs(self, number: int) -> Iterator[tuple[int, int]]:
        """Branches that differ in one choice."""
        signs = self.choices.signs
        for k, one in enumerate(signs):
            for n, other in enumerate(signs[:k]):
                if [key for key in one if one[key] != other[key]] == [number]:
                    yield n, k

    def _signs(self, k: int, known: Values) -> Iterator[bool]:
        """Of the conditions that the table has by their signs."""
        for condition, said in self.choices.told(k):
            value = side(Relation(condition, ">", ZERO), self.tried.target, known)
            yield value is not None and said == ("plus" if value > 0 else "minus")

    def _numbered(self, numbers: Sequence[Cell]) -> Iterator[bool]:
        """From 1 on, and a solution at a pose by those of its rows."""
        yield numbers == [str(k) for k, _ in enumerate(self.choices.chosen, 1)]
        for k, number in enumerate(numbers):
            yield self.choices.called([k]) == number
            yield self.choices.called([0, k]) == f"{numbers[0]}, {number}"

    # -- the arm in numbers -----------------------------------------------------------------------

    def _variables(self, posture: Posture) -> Sequence[str]:
        return [self.worked.chain.joint(row).variable for row in posture.rows]

    def _axis(self, row: int, known: Values) -> tuple[Array, Array]:
        return axis_seen(self.worked.problem, self.worked.chain, row, known)

    def _place(self, end: End, known: Values) -> Array:
        """Where a point is (3)."""
        import numpy as np

        oracle = self.tried.target.oracle
        if end.axis is not None:
            return self._axis(end.axis, known)[1]
        if end.wrist:
            return _centre(self.worked, self.tried.target, known)
        T = oracle.tool(known) if end.last is None else oracle.poses(known)[end.last]
        return np.array(T[:3, 3])

    @staticmethod
    def _heading(way: Array, plane: Sequence[int]) -> float:
        right, up = plane
        return math.atan2(way[up], way[right])
