"""An arm, a path for its end-effector, and what is known in numbers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

from derive.errors import NotDerivable
from derive.expression import Expr
from derive.kinds.fields import Place
from derive.kinds.path._moving import Driven, Moving, moving
from derive.kinds.path._timing import T
from derive.kinds.problem import Problem
from derive.kinds.robot._carried.coordinates import Coordinates, coordinates_of
from derive.kinds.values_at import point_of
from derive.mechanics.paths import Carried, Path

TURNED = "joints that follow an orientation in space are not derived yet; leave orientation out"


@dataclass(frozen=True)
class Setting:
    """The `problem` is that of the arm, `both` that of arm and path. `start` are joint variables there."""

    problem: Problem
    both: Problem
    moving: Moving
    where: Coordinates
    start: Place
    evaluate: Place | None

    @cached_property
    def names(self) -> frozenset[str]:
        """What has no value by itself, the joint variables and the time apart."""
        return self.both.symbols - {*self.both.subject.variables} - {T.name}

    @cached_property
    def point(self) -> dict[str, float]:
        """What is known in numbers."""
        return dict(point_of(dict(self.evaluate or ()), self.problem.where))

    @property
    def time(self) -> float | None:
        """The moment that is asked for."""
        return self.point.get(T.name)

    @cached_property
    def driven(self) -> Driven | None:
        """The path in numbers; None where symbols are left, or nothing says when it begins and ends."""
        if self.names - self.point.keys() - {self.moving.way.s.name}:
            return None
        found = self.moving.numbers(self.point)
        return found if found.ends else None

    @cached_property
    def begun(self) -> Mapping[str, float] | None:
        """The joint variables near which it starts. Raises NotDerivable where one of them is left out."""
        if not self.start:
            return None
        found = point_of(dict(self.start), self.problem.where)
        variables = self.both.subject.variables
        if unknown := sorted({name for name, _ in self.start} - {*variables}):
            listed = ", ".join(variables)
            raise NotDerivable(f"'{unknown[0]}' under start is no joint variable; they are {listed}", "start")
        if missing := [name for name in variables if name not in found]:
            raise NotDerivable(f"start gives no value to {', '.join(missing)}", "start")
        return {name: found[name] for name in variables}

    @property
    def turned(self) -> bool:
        """Whether angles are said in degrees."""
        style = self.problem.style
        return style.degrees or style.turned


def setting_of(problem: Problem, path: Path, start: Place, evaluate: Place | None) -> Setting:
    """Raises NotDerivable where the path has no timing, or is not one for this arm."""
    if path.turned is not None:
        raise NotDerivable(TURNED, "path")
    both = Problem(
        problem.name, Carried(path, problem.subject), problem.where, problem.assumptions,
        angles=problem.angles, points=tuple(_trees(problem, start)),
    )  # fmt: skip
    where = coordinates_of(problem, both)
    return Setting(problem, both, moving(both), where, start, evaluate)


def _trees(problem: Problem, start: Place) -> tuple[Expr, ...]:
    return (*problem.points, *(value for _, value in start))
