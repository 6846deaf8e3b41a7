"""Whether a frame that is given twice stands in one place: the loop of frames closes or it does not."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from itertools import chain
from typing import Any

from derive.algebra.normal import normal_matrix
from derive.algebra.numbers.floats import Point
from derive.derivation import Derivation, PageFacts, Phrase, Record, Result
from derive.errors import NotDerivable
from derive.expression import Call, Expr, Product, Symbol
from derive.kinds.fields import NoOptions as Options
from derive.kinds.frames._frames import local_definitions, local_matrix, pose_name
from derive.kinds.frames._meanings import frames_told
from derive.kinds.meanings import Chain, Names
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.frame_places import in_its_parent, seen
from derive.mechanics.frame_tree import local, mismatch, relative, way
from derive.mechanics.frames import Frame, Frames
from derive.mechanics.poses import inverse_pose

VERDICTS = {  # by whether the axes are turned, and whether the origin is elsewhere
    (False, False): "closes", (True, False): "turned", (False, True): "shifted", (True, True): "both",
}  # fmt: skip
NEARLY = 1e-9
CLAIMS = ("verdict", "as-told")


class LoopTold(Record):
    number: int  # of the frame that is given twice
    parent: int
    given: tuple[str, ...]  # the steps of the first description
    first: Symbol
    second: Symbol
    E: Symbol
    verdict: Phrase


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
    work = Work(problem)
    for loop in loops:
        work = loop.on(work)
    results: dict[str, Result] = {"closes": ", ".join("yes" if loop.closes else "no" for loop in loops)}
    errors = {loop.E.name: problem.final(problem.readable_matrix(loop.error)) for loop in loops}
    results |= errors
    facts = Facts(loops=tuple(loop.facts() for loop in loops))
    told = facts.loops
    chains: list[Chain] = [(loop.E, errors[loop.E.name]) for loop in loops]
    work = frames_told(work, frames, chains, others=partial(_around, loops))
    closes = results["closes"] == ", ".join("yes" if one.verdict.key == "closes" else "no" for one in told)
    firsts = (each.first == pose_name(each.number, each.parent) for each in told)
    work = work.law("said", (closes, *firsts))
    for loop, each in zip(loops, told, strict=True):
        turned, shifted = next(wrong for wrong, key in VERDICTS.items() if key == each.verdict.key)
        said = [float(not (turned or shifted)), float(turned), float(shifted)]
        work = work.agrees("verdict", problem.symbols, partial(_said, said), loop.verdict, E=loop.E.name)
    return work.answer("loop", results, facts)


def _around(loops: Sequence[_Loop], at: Point) -> Names:
    return dict(chain.from_iterable(loop.around(at) for loop in loops))


def _said(verdict: list[float], at: Point) -> list[float]:
    """What is told, wherever it is tried."""
    return verdict


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

    @property
    def given(self) -> tuple[Frame, ...]:
        """Those of the first route."""
        return (*self.path.down, *self.path.up)

    def on(self, work: Work) -> Work:
        """The frame by the first route and as given again, and the product around the loop."""
        for frame in self.given:
            name = pose_name(frame.number, frame.parent)
            work = work.given(name, local_matrix(frame, self.problem))
            work = work.knowing(local_definitions(frame, self.problem))
        first = relative(self.frames, self.frame.number, self.frame.parent)
        factors = self._factors()
        product = Product(factors) if len(factors) > 1 else factors[0]
        if product == self.first:
            work = work.knowing({self.first: work.readable(first)})
        else:
            work = work.line(self.first, product, value=first, rule="route")
        work = work.given(self.second, local_matrix(self.frame, self.problem), "again")
        work = work.knowing({self.second: work.readable(local(self.frame))})
        route = Call("inverse", (self.first,)) * self.second
        error = work.readable(mismatch(self.frames, self.frame))
        return work.line(self.E, route, error, value=self.error, rule="loop")

    def _factors(self) -> tuple[Expr, ...]:
        """The transformations of the first route, those on the way back inverted."""
        back = (Call("inverse", (pose_name(f.number, f.parent),)) for f in reversed(self.path.down))
        return (*back, *(pose_name(frame.number, frame.parent) for frame in self.path.up))

    def around(self, at: Point) -> tuple[tuple[Symbol, Any], ...]:
        """The second pose and the product around the loop in numbers, by their names."""
        import numpy as np

        again = in_its_parent(self.frame, at)
        first = seen(self.frames, self.frame.number, self.frame.parent, at)
        return (self.second, again), (self.E, np.linalg.solve(first, again))

    def verdict(self, at: Point) -> list[float]:
        """1 or 0: whether it closes, whether the axes of the second are turned, whether its origin is
        elsewhere."""
        import numpy as np

        _, (_, E) = self.around(at)
        turned, shifted = (
            not np.allclose(E[:, columns], np.eye(4)[:, columns], atol=1e-9)
            for columns in (slice(3), slice(3, 4))
        )
        return [float(not (turned or shifted)), float(turned), float(shifted)]

    def facts(self) -> LoopTold:
        names = [pose_name(frame.number, frame.parent).name for frame in self.given]
        identity = self.error @ inverse_pose(self.error)
        wrong = [(i, j) for i in range(3) for j in range(4) if self.error[i, j] != identity[i, j]]
        return LoopTold(
            number=self.frame.number,
            parent=self.frame.parent,
            given=tuple(dict.fromkeys((*names, self.first.name))),
            first=self.first,
            second=self.second,
            E=self.E,
            verdict=Phrase(VERDICTS[any(j < 3 for _, j in wrong), any(j == 3 for _, j in wrong)]),
        )
