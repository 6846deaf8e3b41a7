"""Every frame in the one it is given in, and the last one in the world."""

from __future__ import annotations

from derive.algebra.normal import normal_matrix
from derive.derivation import Derivation, PageFacts
from derive.expression import Expr, Product, Symbol
from derive.kinds.checks import is_rotation
from derive.kinds.fields import NoOptions as Options
from derive.kinds.frames._frames import Axes, pose_name, read_axes, with_local
from derive.kinds.frames._meanings import frames_told
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.frame_tree import along, ancestry, require_closed
from derive.mechanics.frames import Frames
from derive.mechanics.motion import Motion
from derive.mechanics.poses import rotation_part

CLAIMS = ("orthogonal", "right-handed", "as-told")


class Facts(PageFacts):
    product: str  # a step
    single: bool  # whether each frame that is given by moves is given by one
    read: tuple[tuple[Expr, Expr], ...]


def derive(frames: Frames, options: Options, problem: Problem) -> Derivation:
    """T_1^0, T_2^1, ... and their product along the parents of the last frame (Spong et al., section 2.6)."""
    require_closed(frames, problem.names)
    work = with_local(Work(problem), frames)
    names = [pose_name(frame.number, frame.parent) for frame in frames.frames]
    path, whole = ancestry(frames, len(frames.frames)), pose_name(len(frames.frames), 0)
    if len(path) > 1:
        factors = Product(tuple(pose_name(frame.number, frame.parent) for frame in path))
        work = work.line(whole, factors, value=along(path), rule="product").closed(whole)
    results = {name.name: work.final(name) for name in dict.fromkeys((*names, whole))}
    for frame, name in zip(frames.frames, names, strict=True):
        T = normal_matrix(work[name], problem.names)
        work = work.claim(*is_rotation(rotation_part(T), f"R_{frame.number}^{frame.parent}"))
    read = read_axes(work.matrix(whole), len(frames.frames), 0)
    single = all(not isinstance(step.chain[1], Product) for step in work.steps if step.rule == "motion")
    several = len(path) > 1
    facts = Facts(product=whole.name if several else "", single=single, read=read if several else ())
    observed = (step.facts.axes for step in work.steps if isinstance(step.facts, Axes))
    printed = ((Symbol(name), value) for name, value in results.items())
    work = frames_told(work, frames, (*printed, *facts.read, *(axis for axes in observed for axis in axes)))
    moves = (frame.source.moves for frame in frames.frames if isinstance(frame.source, Motion))
    work = work.law("said", facts.single == all(len(each) == 1 for each in moves))
    return work.answer("transforms", results, facts)


def measures(frames: Frames) -> dict[str, str]:
    """Origins are lengths."""
    return {f"o_{frame.number}^{frame.parent}": "m" for frame in frames.frames}
