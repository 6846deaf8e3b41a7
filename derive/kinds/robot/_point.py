"""The point whose motion is asked for."""

from __future__ import annotations

from dataclasses import dataclass

from pydantic import Field

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.derivation import Step
from derive.errors import NotDerivable
from derive.expression import ZERO, Expr, Product, Sum, Symbol, column
from derive.kinds.fields import OptionsModel, Point
from derive.kinds.problem import Problem
from derive.mechanics.chain import Chain
from derive.mechanics.jacobian import MovingPoint, drift
from derive.mechanics.poses import position_part, rotation_part


class PointOn(OptionsModel):
    """`{link: 2, at: [-a2/2, 0, 0]}` in the link's own frame, or `{frame: 2}`: the origin of a frame."""

    link: int | None = Field(None, ge=1)
    frame: int | None = Field(None, ge=0)
    at: Point = (ZERO, ZERO, ZERO)


@dataclass(frozen=True, slots=True)
class Tracked:
    """A point: its name, its position (3 by 1, base frame), the last row that moves it, the frame it
    is given in (rows + 1 for the tool's) and where there (3 trees), and how its position is found; `drift`
    (3 by n) is how it moves in that frame."""

    name: Symbol
    position: ScalarMatrix
    last: int
    frame: int
    offset: tuple[Expr, Expr, Expr]
    step: Step
    definitions: dict[Expr, Expr]
    drift: ScalarMatrix | None = None

    @property
    def moving(self) -> MovingPoint:
        return MovingPoint(self.position, self.last, self.drift)

    def jacobian(self, chain: Chain) -> ScalarMatrix:
        """J (6 by n)."""
        return self.moving.jacobian(chain)


def tracked(problem: Problem, chain: Chain, point: PointOn | None) -> Tracked:
    """The point an option names; the end-effector where it names none."""
    rows = len(chain.T_local)
    at = (ZERO, ZERO, ZERO) if point is None else point.at
    frame = rows if point is None else next((n for n in (point.link, point.frame) if n is not None), rows)
    if frame > rows:
        raise NotDerivable(
            f"the point is on link {frame}, but the arm has {rows} row{'s' * (rows != 1)}", "point"
        )
    if any(part != ZERO for part in at):
        return _offset(problem, chain, frame, at)
    whole = point is None and problem.subject.ends_in_tool
    name = Symbol("o_e" if whole else f"o_{frame}")
    position = position_part(chain.T_tool if whole else chain.T[frame])
    step = Step(name.name, (name, problem.readable_matrix(position)), "extract")
    last = rows + 1 if whole else frame
    return Tracked(name, position, last, last, at, step, {name: step.result})


def _offset(problem: Problem, chain: Chain, frame: int, at: tuple[Expr, Expr, Expr]) -> Tracked:
    """o_c = o_i + R_i^0 p for a point p of link i."""
    T, name = chain.T[frame], Symbol("o_c")
    p = ScalarMatrix.column([normal(part) for part in at])
    position = position_part(T) + rotation_part(T) @ p
    o, R = Symbol(f"o_{frame}"), Symbol(f"R_{frame}^0")
    route = Sum((o, Product((R, column(at)))))
    step = Step(name.name, (name, route, problem.readable_matrix(position)), "carry")
    definitions: dict[Expr, Expr] = {
        name: step.result,
        o: problem.readable_matrix(position_part(T)),
        R: problem.readable_matrix(rotation_part(T)),
    }
    moving = drift(chain, rotation_part(T), p)
    return Tracked(name, position, frame, frame, at, step, definitions, moving)
