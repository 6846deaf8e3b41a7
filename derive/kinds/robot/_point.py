"""The point whose motion is asked for."""

from __future__ import annotations

from dataclasses import dataclass

from pydantic import Field, model_validator

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.errors import NotDerivable, how_many
from derive.expression import ZERO, Expr, Symbol, column
from derive.kinds.fields import OptionsModel, Point
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.chain import Chain
from derive.mechanics.jacobian import MovingPoint, drift
from derive.mechanics.poses import position_part, rotation_part

ORIGIN = (ZERO, ZERO, ZERO)


class PointOn(OptionsModel):
    """`{link: 2, at: [-a2/2, 0, 0]}` in the link's own frame, or `{frame: 2}`: the origin of a frame."""

    link: int | None = Field(None, ge=1)
    """The link on which the point lies."""
    frame: int | None = Field(None, ge=0)
    """The frame whose origin the point is."""
    at: Point = ORIGIN
    """Where the point lies in the link's own frame; its origin if left out."""

    @model_validator(mode="after")
    def _on_one(self) -> PointOn:
        if self.link is not None and self.frame is not None:
            raise ValueError(
                "a point lies on a link, {link: 2, at: [..]}, or is the origin of a frame, {frame: 2}"
            )
        return self


@dataclass(frozen=True, slots=True)
class Tracked:
    """A point: its name, its position (3 by 1, base frame), the last row that moves it, the frame it
    is given in (rows + 1 for the tool's) and where there (3 trees); `drift` (3 by n) is how it moves in that
    frame."""

    name: Symbol
    position: ScalarMatrix
    last: int
    frame: int
    offset: tuple[Expr, Expr, Expr]
    drift: ScalarMatrix | None = None

    @property
    def carried(self) -> bool:
        """Whether it is no origin of a frame."""
        return self.offset != ORIGIN

    @property
    def moving(self) -> MovingPoint:
        """The same without its names."""
        return MovingPoint(self.position, self.last, self.drift)

    def jacobian(self, chain: Chain) -> ScalarMatrix:
        """J (6 by n)."""
        return self.moving.jacobian(chain)

    def line(self, work: Work, chain: Chain) -> Work:
        """How its position is found: the last column of a pose, or o_c = o_i + R_i^0 p for a point p of
        link i."""
        if not self.carried:
            return work.line(self.name, value=self.position, rule="extract")
        o, R, T = Symbol(f"o_{self.frame}"), Symbol(f"R_{self.frame}^0"), chain.T[self.frame]
        route = o + R * column(self.offset)
        known = {o: position_part(T), R: rotation_part(T)}
        work = work.knowing({name: work.problem.readable_matrix(value) for name, value in known.items()})
        return work.line(self.name, route, value=self.position, rule="carry")


def tracked(problem: Problem, chain: Chain, point: PointOn | None) -> Tracked:
    """The point an option names; the end-effector where it names none. Raises NotDerivable for a link that
    the arm does not have, and for the base."""
    rows = len(chain.T_local)
    at = ORIGIN if point is None else point.at
    frame = rows if point is None else next((n for n in (point.link, point.frame) if n is not None), rows)
    key = "point/link" if point is not None and point.link is not None else "point/frame"
    if frame > rows:
        raise NotDerivable(f"the point is on link {frame}, but the arm has {how_many(rows, 'row')}", key)
    if frame == 0:
        raise NotDerivable("frame 0 stands still: no joint moves this point", key)
    if point is None and problem.subject.ends_in_tool:
        return Tracked(Symbol("o_e"), position_part(chain.T_tool), rows + 1, rows + 1, at)
    o, R = position_part(chain.T[frame]), rotation_part(chain.T[frame])
    if at == ORIGIN:
        return Tracked(Symbol(f"o_{frame}"), o, frame, frame, at)
    p = ScalarMatrix.column(map(normal, at))
    return Tracked(Symbol("o_c"), o + R @ p, frame, frame, at, drift(chain, R, p))
