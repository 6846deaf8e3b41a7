"""One frame in another."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from pydantic import Field

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.derivation import Derivation, PageFacts, Phrase, Record
from derive.expression import Call, Expr, Product, Symbol
from derive.kinds.checks import is_rotation
from derive.kinds.fields import OptionsModel
from derive.kinds.frames._frames import is_given, local_definitions, local_matrix, pose_name
from derive.kinds.frames._meanings import frames_told
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.frame_tree import Way, along, relative, require_closed, way
from derive.mechanics.frames import Frame, Frames
from derive.mechanics.poses import inverse_pose, rotation_part

CLAIMS = ("orthogonal", "right-handed", "as-told")


class Options(OptionsModel):
    """Which frame is wanted, seen from which."""

    source: int | None = Field(default=None, alias="from", ge=0)
    """The frame that is wanted; the last one if left out."""
    target: int = Field(default=0, alias="to", ge=0)
    """The frame that it is seen from."""


class LineTold(Record):
    said: Phrase
    step: str
    stands: bool = False  # already, with the frames that are given


class Facts(PageFacts):
    told: tuple[LineTold, ...]


def derive(frames: Frames, options: Options, problem: Problem) -> Derivation:
    """T of frame `from` in frame `to`, over the frame both stand in (Spong et al., section 2.6)."""
    require_closed(frames, problem.names)
    source = len(frames.frames) if options.source is None else options.source
    path = way(frames, source, options.target)
    name = pose_name(source, options.target)
    T = relative(frames, source, options.target)
    work = _board(path, name, T, problem)
    R = rotation_part(normal_matrix(work[name], problem.names))
    work = work.claim(*is_rotation(R, f"R_{source}^{options.target}"))
    asked = pose_name(source, options.target)
    work = frames_told(work, frames, ((asked, name), (name, work.final(name))))
    facts = Facts(told=tuple(_told(work, path, source, options.target)))
    work = work.law("said", _said(work, facts, frames))
    return work.answer("transform", {name.name: work.final(name)}, facts)


def _told(work: Work, path: Way, source: int, target: int) -> Iterator[LineTold]:
    """What is said before each line."""
    *before, last = work.steps
    for step in before:
        said = Phrase("way-back") if step.rule == "inverse" else Phrase("along", {"meeting": path.meeting})
        yield LineTold(said=said, step=step.name)
    if last.rule == "inverse":
        said = Phrase("way-back")
    elif len(path.up) == 1 and not path.down:
        between = {"source": source, "target": target}
        said = Phrase("given-already", between) if work.uses else Phrase("given-here", between)
    elif not before and _found_first(work, source, target):
        said = Phrase("found-already", {"source": source, "target": target})
    else:
        said = Phrase("indices-cancel")
    yield LineTold(said=said, step=last.name, stands=said.key in ("given-already", "found-already"))


def _found_first(work: Work, source: int, target: int) -> bool:
    """Whether the first question of all is about the frames one by one, and ends with this pose."""
    first = next((kind for kind, _ in work.problem.questions), "")
    frames = work.problem.subject.frames
    return first == "transforms" and (source, target) == (len(frames), 0)


def _said(work: Work, facts: Facts, frames: Frames) -> Iterator[bool]:
    """Which sentence stands before a line, by what stands in it."""
    for step, told in zip(work.steps, facts.told, strict=True):
        formula = step.chain[1]
        back = isinstance(formula, Call) and formula.function == "inverse"
        yield told.step == step.name and (told.said.key == "way-back") == back
        if told.said.key == "found-already":
            yield (told.said.about["source"], told.said.about["target"]) == (len(frames.frames), 0)
        if told.said.key.startswith("given"):
            source, target = (told.said.about[name] for name in ("source", "target"))
            yield any((each.number, each.parent) == (source, target) for each in frames.frames)
        else:
            yield back or isinstance(formula, Product)


def _board(path: Way, name: Symbol, T: ScalarMatrix, problem: Problem) -> Work:
    """The way down turned round, then the way up, each frame in the one before."""
    frames, down, up = (*path.up, *path.down), path.down, path.up
    work = Work(problem)
    for frame in frames:
        work = work.knowing(local_definitions(frame, problem))
    if any(not is_given(frame) for frame in frames):
        work = replace(work, uses=(problem.ask("transforms"),))
    parts: tuple[Expr, ...] = tuple(pose_name(frame.number, frame.parent) for frame in up)
    if down:
        there, back = pose_name(down[-1].number, path.meeting), pose_name(path.meeting, down[-1].number)
        if len(down) > 1:
            work = _product(work, there, down)
        work = work.line(back, Call("inverse", (there,)), value=inverse_pose(along(down)), rule="inverse")
        if not up:
            return work
        if len(up) > 1:
            whole = pose_name(up[-1].number, path.meeting)
            work, parts = _product(work, whole, up), (whole,)
        parts = (back, *parts)
    shown = () if parts in ((name,), ()) else (Product(parts),)
    given = () if down or len(up) < 2 else _given(up, problem)
    return work.line(name, *shown, *given, value=T, rule="product").closed(name)


def _product(work: Work, name: Symbol, frames: tuple[Frame, ...]) -> Work:
    factors = Product(tuple(pose_name(frame.number, frame.parent) for frame in frames))
    return work.line(name, factors, value=along(frames), rule="product")


def _given(frames: tuple[Frame, ...], problem: Problem) -> tuple[Expr, ...]:
    """The matrices of the problem put into the product, where all of them are given."""
    if not all(map(is_given, frames)):
        return ()
    return (Product(tuple(local_matrix(frame, problem) for frame in frames)),)
