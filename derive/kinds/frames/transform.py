"""One frame in another."""

from __future__ import annotations

from pydantic import Field

from derive.algebra.normal import normal_matrix
from derive.algebra.numbers.floats import numbers
from derive.derivation import Claim, Derivation, PageFacts, Step
from derive.expression import Call, Expr, Matrix, Product, Symbol
from derive.kinds.checks import agreement, is_rotation, links
from derive.kinds.fields import OptionsModel
from derive.kinds.frames._frames import is_given, local_definitions, local_matrix, numeric_pose, pose_name
from derive.kinds.problem import Problem
from derive.kinds.values_at import completed
from derive.mechanics.frame_tree import Way, along, relative, require_closed, way
from derive.mechanics.frames import Frame, Frames
from derive.mechanics.poses import inverse_pose, rotation_part

RESULTS = {"T_2^0": "frame `from` in frame `to` (4 by 4); named by their numbers"}
EXAMPLE = """\
title: One frame in another
problems:
- frames:
  - {x: y0, y: -x0, z: z0, origin: [a, 0, 0]}
  - {x: x1, y: z1, z: -y1, origin: [0, b, 0]}
  find: transform
  from: 2
  to: 0
"""


class Options(OptionsModel):
    """The frame wanted, `from` (the last one if left out), and the frame it is seen from, `to`."""

    source: int | None = Field(default=None, alias="from", ge=0)
    target: int = Field(default=0, alias="to", ge=0)


class Facts(PageFacts):
    name: str
    source: int
    target: int
    meeting: int
    inverse: tuple[str, ...]  # steps
    products: tuple[str, ...]  # steps
    direct: bool


def derive(frames: Frames, options: Options, problem: Problem) -> Derivation:
    """T of frame `from` in frame `to`, over the frame both stand in (Spong et al., section 2.6)."""
    require_closed(frames, problem.names)
    source = len(frames.frames) if options.source is None else options.source
    path = way(frames, source, options.target)
    name = pose_name(source, options.target)
    written = problem.readable_matrix(relative(frames, source, options.target))
    steps = _steps(path, name, written, problem)
    definitions = _definitions(path, problem)
    exact = problem.final(written)
    R = rotation_part(normal_matrix(written, problem.names))
    claims = (
        *links(steps, {**problem.names, **definitions, name: written}),
        *is_rotation(R, f"R_{source}^{options.target}"),
        _second_route(path, exact, name, problem),
    )
    found = any(not is_given(frame) for frame in (*path.up, *path.down))
    uses = (problem.ask("transforms"),) if found else ()
    facts = Facts(
        name=name.name,
        source=source,
        target=options.target,
        meeting=path.meeting,
        inverse=tuple(step.name for step in steps[:-1] if step.rule == "inverse"),
        products=tuple(step.name for step in steps[:-1] if step.rule == "product"),
        direct=len(path.up) == 1 and not path.down,
    )
    definitions |= {name: written}
    return Derivation("transform", steps, {name.name: exact}, claims, definitions, uses=uses, facts=facts)


def _steps(path: Way, name: Symbol, written: Matrix, problem: Problem) -> tuple[Step, ...]:
    steps: list[Step] = []
    parts: list[Expr] = []
    if path.down:
        there = pose_name(path.down[-1].number, path.meeting)
        back = pose_name(path.meeting, path.down[-1].number)
        if len(path.down) > 1:
            steps.append(_product(there, path.down, problem.readable_matrix(along(path.down))))
        inverse = problem.readable_matrix(inverse_pose(along(path.down)))
        steps.append(Step(back.name, (back, Call("inverse", (there,)), inverse), "inverse"))
        parts.append(back)
    if path.down and not path.up:
        return tuple(steps)
    if path.down and len(path.up) > 1:
        whole = pose_name(path.up[-1].number, path.meeting)
        steps.append(_product(whole, path.up, problem.readable_matrix(along(path.up))))
        parts.append(whole)
    else:
        parts += [pose_name(frame.number, frame.parent) for frame in path.up]
    shown = () if parts in ([name], []) else (Product(tuple(parts)),)
    given = () if path.down or len(path.up) < 2 else _given(path.up, problem)
    exact = problem.final(written)
    last = () if exact == written else (exact,)
    return (*steps, Step(name.name, (name, *shown, *given, written, *last), "product"))


def _product(name: Symbol, frames: tuple[Frame, ...], written: Matrix) -> Step:
    factors = Product(tuple(pose_name(frame.number, frame.parent) for frame in frames))
    return Step(name.name, (name, factors, written), "product")


def _given(frames: tuple[Frame, ...], problem: Problem) -> tuple[Expr, ...]:
    """The matrices of the problem put into the product, where all of them are given."""
    if not all(map(is_given, frames)):
        return ()
    return (Product(tuple(local_matrix(frame, problem) for frame in frames)),)


def _definitions(path: Way, problem: Problem) -> dict[Expr, Expr]:
    found: dict[Expr, Expr] = {}
    for frame in (*path.up, *path.down):
        found |= local_definitions(frame, problem)
    for frames in (path.up, path.down):
        if frames:
            name = pose_name(frames[-1].number, path.meeting)
            found.setdefault(name, problem.readable_matrix(along(frames)))
    if path.down:
        back = pose_name(path.meeting, path.down[-1].number)
        found[back] = problem.readable_matrix(inverse_pose(along(path.down)))
    return found


def _second_route(path: Way, exact: Expr, name: Symbol, problem: Problem) -> Claim:
    def other(point: dict[str, float]) -> object:
        import numpy as np

        at = completed(point, problem.where)
        return np.linalg.solve(numeric_pose(path.down, at), numeric_pose(path.up, at))

    return agreement(
        "composed",
        problem.symbols,
        lambda point: numbers(exact, completed(point, problem.where)),
        lambda point: other(dict(point)),
        T=name.name,
    )
