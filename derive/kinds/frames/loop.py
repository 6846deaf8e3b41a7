"""Whether a frame that is given twice stands in one place: the loop of frames closes or it does not."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from derive.algebra.normal import normal_matrix
from derive.algebra.numbers.floats import numbers
from derive.derivation import Claim, Derivation, PageFacts, Record, Result, Step
from derive.errors import NotDerivable
from derive.expression import Call, Expr, Matrix, Product, Symbol
from derive.kinds.checks import agreement, links
from derive.kinds.fields import OptionsModel
from derive.kinds.frames._frames import (
    local_definitions,
    local_matrix,
    numeric_local,
    numeric_pose,
    pose_name,
)
from derive.kinds.problem import Problem
from derive.kinds.values_at import completed
from derive.mechanics.frame_tree import local, mismatch, relative, way
from derive.mechanics.frames import Frame, Frames
from derive.mechanics.poses import inverse_pose

RESULTS = {
    "closes": "yes or no, for each frame that is given twice",
    "E": "the second description seen from the first (4 by 4): the identity where they agree; E_1, E_2, ... "
    "where several frames are given twice",
}
EXAMPLE = """\
title: A loop of frames
problems:
- frames:
  - {x: y0, y: -x0, z: z0, origin: [a, 0, 0]}
  - {motion: [{translate: x, by: b}, {rotate: z, by: 90 deg}]}
  - {frame: 2, in: 0, x: -x0, y: -y0, z: z0, origin: [a, b, 0]}
  find: loop
"""


class Options(OptionsModel):
    """Nothing to choose."""


class LoopTold(Record):
    number: int  # of the frame that is given twice
    parent: int
    given: tuple[str, ...]  # the steps of the first description
    first: Symbol
    route: bool  # whether these are more than the pose of the frame itself
    second: Symbol
    E: Symbol
    closes: bool
    turned: bool
    shifted: bool


class Facts(PageFacts):
    loops: tuple[LoopTold, ...]


def derive(frames: Frames, options: Options, problem: Problem) -> Derivation:
    """Along a closed loop the transformations multiply to the identity (Craig, section 2.7).

    Raises NotDerivable where no frame is given twice.
    """
    if not frames.again:
        raise NotDerivable("no frame is given twice; give one again with frame: 1 and in: another frame")
    several = len(frames.again) > 1
    loops = [
        _Loop(frames, frame, problem, f"_{k}" if several else "") for k, frame in enumerate(frames.again, 1)
    ]
    steps = tuple(step for loop in loops for step in loop.steps())
    definitions = {name: tree for loop in loops for name, tree in loop.definitions().items()}
    results: dict[str, Result] = {"closes": ", ".join("yes" if loop.closes else "no" for loop in loops)}
    results |= {loop.E.name: problem.final(problem.readable_matrix(loop.error)) for loop in loops}
    claims = (
        *links(steps, {**problem.names, **definitions}),
        *(loop.second_route() for loop in loops),
    )
    facts = Facts(loops=tuple(loop.facts() for loop in loops))
    return Derivation("loop", steps, results, claims, definitions, facts=facts)


class _Loop:
    """One frame given twice."""

    def __init__(self, frames: Frames, frame: Frame, problem: Problem, index: str) -> None:
        self.frames, self.frame, self.problem = frames, frame, problem
        self.path = way(frames, frame.number, frame.parent)
        self.first = pose_name(frame.number, frame.parent)
        self.E, self.second = Symbol(f"E{index}"), Symbol(f"G{index}")
        self.error = normal_matrix(problem.readable_matrix(mismatch(frames, frame)), problem.names)

    @property
    def closes(self) -> bool:
        return self.error == inverse_pose(self.error) @ self.error

    def steps(self) -> tuple[Step, ...]:
        """The frame by the first route and as given again, and the product around the loop."""
        read, names = self.problem.readable_matrix, self.problem.names
        first = relative(self.frames, self.frame.number, self.frame.parent)
        product = Product(self._factors()) if len(self._factors()) > 1 else self._factors()[0]
        chain = () if product == self.first else (product,)
        error = mismatch(self.frames, self.frame)
        last = read(normal_matrix(read(error), names))
        route = Product((Call("inverse", (self.first,)), self.second))
        return (
            *(
                Step(str(name.name), (name, self._local(frame)), "given")
                for frame in (*self.path.down, *self.path.up)
                for name in (pose_name(frame.number, frame.parent),)
            ),
            *((Step(self.first.name, (self.first, *chain, read(first)), "route"),) if chain else ()),
            Step(self.second.name, (self.second, self._local(self.frame)), "again"),
            Step(
                self.E.name, (self.E, route, read(error), *((last,) if last != read(error) else ())), "loop"
            ),
        )

    def _local(self, frame: Frame) -> Matrix:
        return local_matrix(frame, self.problem)

    def _factors(self) -> tuple[Expr, ...]:
        """The transformations of the first route, those on the way back inverted."""
        back = tuple(
            Call("inverse", (pose_name(frame.number, frame.parent),)) for frame in reversed(self.path.down)
        )
        return (*back, *(pose_name(frame.number, frame.parent) for frame in self.path.up))

    def definitions(self) -> dict[Expr, Expr]:
        read = self.problem.readable_matrix
        found: dict[Expr, Expr] = {}
        for frame in (*self.path.down, *self.path.up):
            found |= local_definitions(frame, self.problem)
        found[self.first] = read(relative(self.frames, self.frame.number, self.frame.parent))
        found[self.second] = read(local(self.frame))
        return found

    def second_route(self) -> Claim:
        """The product around the loop in numbers."""

        def around(point: Mapping[str, float]) -> Any:
            import numpy as np

            at = completed(point, self.problem.where)
            T = np.linalg.solve(numeric_pose(self.path.down, at), numeric_pose(self.path.up, at))
            return np.linalg.inv(T) @ numeric_local(self.frame, at)

        exact = self.problem.readable_matrix(self.error)
        return agreement(
            "around-the-loop",
            self.problem.symbols,
            lambda point: numbers(exact, completed(point, self.problem.where)),
            around,
            E=self.E.name,
        )

    def facts(self) -> LoopTold:
        identity = self.error @ inverse_pose(self.error)
        wrong = [(i, j) for i in range(3) for j in range(4) if self.error[i, j] != identity[i, j]]
        given = (*self.path.down, *self.path.up)
        return LoopTold(
            number=self.frame.number,
            parent=self.frame.parent,
            given=tuple(pose_name(frame.number, frame.parent).name for frame in given),
            first=self.first,
            route=len(given) > 1 or bool(self.path.down),
            second=self.second,
            E=self.E,
            closes=self.closes,
            turned=any(j < 3 for _, j in wrong),
            shifted=any(j == 3 for _, j in wrong),
        )
