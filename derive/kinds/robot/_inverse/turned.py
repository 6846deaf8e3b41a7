"""The arm angle as a page tells it: the line between the centres of shoulder and wrist, a frame on it, and
what the shoulder has to make."""

from __future__ import annotations

from dataclasses import dataclass

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.scalar import Scalar
from derive.derivation import Step
from derive.expression import Expr, Matrix, Symbol, atan2, column, sqrt, transpose
from derive.kinds.robot._inverse.progress import Progress
from derive.kinds.robot._inverse.signs import square, total
from derive.kinds.robot._inverse.subproblem import Definition
from derive.mechanics.chain import Chain
from derive.mechanics.inverse.arm_angle import ArmAngle
from derive.mechanics.inverse.plan import Decoupling
from derive.mechanics.poses import rotation_part


@dataclass(frozen=True, slots=True)
class Turned:
    """`line` is that between the centres, `directions` are its angles in the base and `bent` is that after
    the shoulder; `before` and `after` the frame on it, seen from either; `wanted` what the shoulder has to
    make, by names for its elements, and `made` what it makes in its angles. `names` are those of the line, of
    the frame in the base and after the shoulder, and of what the shoulder makes."""

    angle: ArmAngle
    line: Step
    directions: tuple[Step, ...]
    bent: Step
    before: Step
    after: Step
    wanted: Step
    made: Step
    names: tuple[str, str, str, str]

    @property
    def steps(self) -> tuple[Step, ...]:
        """In the order of the page, all but what is made."""
        return (self.line, *self.directions, self.before, self.bent, self.after, self.wanted)


def turned(progress: Progress, chain: Chain, decoupling: Decoupling, angle: ArmAngle) -> Turned:
    """The steps before the sub-problems of the shoulder, their names defined."""
    readable, free = progress.problem.readable_matrix, progress.free_name
    names = tuple(decoupling.centre) or tuple("xyz")
    place = ScalarMatrix.column(map(Scalar.symbol, names))
    between = place - angle.shoulder.centre
    x, y, z = map(progress.tree, between.entries)
    v, U, V = Symbol(free("v")), Symbol(free("U")), Symbol(free("V"))
    start, end = angle.shoulder.centre, place_of(decoupling)
    line = Step("line", (v, end - readable(start) if start else end, column((x, y, z))), "line")
    directions = (
        _angle(progress, angle.alpha, atan2(y, x)),
        _angle(progress, angle.beta, atan2(sqrt(total((square(x), square(y)))), z)),
    )
    bent = _angle(progress, angle.gamma, atan2(*map(progress.tree, angle.across)))
    frame = angle.shoulder.frame
    R = Symbol(f"R_{frame}^0")
    entries = [progress.define(name, value) for name, value in angle.named().items()]
    rows = Matrix(tuple(tuple(entries[k : k + 3]) for k in (0, 3, 6)))
    before, after = (readable(each) for each in (angle.before, angle.after))
    return Turned(
        angle,
        line,
        directions,
        bent,
        Step("before", (U, before), "turn"),
        Step("after", (V, after), "turn"),
        Step("turned", (R, U * transpose(V), rows), "turn"),
        Step("shoulder_made", (R, readable(rotation_part(chain.T[frame]))), "turn"),
        (v.name, U.name, V.name, R.name),
    )


def place_of(decoupling: Decoupling) -> Expr:
    """The centre of the wrist, by its name where it has one."""
    return decoupling.name if decoupling.centre else column(map(Symbol, "xyz"))


def _angle(progress: Progress, name: str, value: Expr) -> Step:
    symbol = Symbol(name)
    progress.items.append(Definition(value, symbol))
    return Step(name, (symbol, value), "name")
