"""The pose a question is about, whatever the subject: of a motion, of one frame in another, of a robot."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import reduce
from typing import TYPE_CHECKING, Any

from pydantic import Field

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.algebra.numbers.floats import Point
from derive.derivation import Derivation
from derive.errors import NotDerivable
from derive.expression import Matrix, Symbol
from derive.kinds.evaluation import Evaluation
from derive.kinds.fields import OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.values_at import completed
from derive.mechanics.frames import Frames
from derive.mechanics.motion import Motion
from derive.mechanics.poses import pose, rotation_part
from derive.mechanics.robot import Robot
from derive.mechanics.sequences import in_product_order

if TYPE_CHECKING:
    from numpy.typing import NDArray


class PoseOptions(OptionsModel):
    """For frames: the frame wanted, `from` (the last one if left out), seen from frame `to`."""

    source: int | None = Field(default=None, alias="from", ge=0)
    target: int = Field(default=0, alias="to", ge=0)
    evaluate: Evaluation = None


@dataclass(frozen=True, slots=True)
class Given:
    """A pose: its name and that of its rotation, T (4 by 4) with the names of `where` kept, what it rests
    on, and the same in NumPy by another route."""

    name: Symbol
    rotation: Symbol
    T: ScalarMatrix
    uses: tuple[Derivation, ...]
    oracle: Callable[[Point], NDArray[Any]]
    where: dict[Any, Any]

    @property
    def R(self) -> ScalarMatrix:
        """The rotation (3 by 3), names of `where` kept."""
        return rotation_part(self.T)

    def exact(self, written: Matrix) -> ScalarMatrix:
        """A matrix with the names of `where` replaced."""
        return normal_matrix(written, self.where)


def given_pose(options: PoseOptions, problem: Problem, rotation_only: bool = True) -> Given:
    """The pose of the problem's subject. Raises NotDerivable where `from` and `to` make no sense."""
    subject = problem.subject
    if not isinstance(subject, Frames) and (options.source is not None or options.target):
        raise NotDerivable("'from' and 'to' choose among frames; this problem has none")
    if isinstance(subject, Frames):
        return _of_frames(subject, options, problem)
    if isinstance(subject, Motion):
        return _of_motion(subject, problem, rotation_only)
    if isinstance(subject, Robot):
        return _of_robot(subject, problem)
    raise NotDerivable("this subject has no pose")


def _of_motion(motion: Motion, problem: Problem, rotation_only: bool) -> Given:
    from derive.mechanics.oracle import compose

    moves = in_product_order(motion.moves)
    T = reduce(ScalarMatrix.__matmul__, map(pose, moves), ScalarMatrix.identity(4))
    uses = problem.ask("rotation-matrix" if rotation_only else "transform")
    return Given(
        Symbol("T"),
        Symbol("R"),
        T,
        (uses,),
        lambda point: compose(moves, completed(point, problem.where)),
        dict(problem.names),
    )


def _of_frames(frames: Frames, options: PoseOptions, problem: Problem) -> Given:
    import numpy as np

    from derive.kinds.frames._frames import is_given, numeric_pose, pose_name, rotation_name
    from derive.mechanics.frame_tree import relative, require_closed, way

    require_closed(frames, problem.names)
    source = len(frames.frames) if options.source is None else options.source
    path = way(frames, source, options.target)

    def oracle(point: Point) -> NDArray[Any]:
        at = completed(point, problem.where)
        return np.linalg.solve(numeric_pose(path.down, at), numeric_pose(path.up, at))

    plain = len(path.up) == 1 and not path.down and is_given(path.up[0])
    return Given(
        pose_name(source, options.target),
        rotation_name(source, options.target),
        relative(frames, source, options.target),
        () if plain else (problem.ask("transform", source=source, target=options.target),),
        oracle,
        dict(problem.names),
    )


def _of_robot(robot: Robot, problem: Problem) -> Given:
    from derive.kinds.robot._chain import end_frame
    from derive.mechanics.chain import chain
    from derive.mechanics.oracle import Oracle

    oracle, n = Oracle(robot, problem.where), end_frame(robot)
    return Given(
        Symbol(f"T_{n}^0"),
        Symbol(f"R_{n}^0"),
        chain(robot).T_tool,
        (problem.ask("forward-kinematics"),),
        lambda point: oracle.tool(oracle.at(point)),
        dict(problem.names),
    )
