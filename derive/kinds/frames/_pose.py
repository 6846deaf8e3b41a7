"""The pose of one frame in another."""

from __future__ import annotations

from derive.kinds.frames._frames import is_given, pose_name, rotation_name
from derive.kinds.pose._given import Given, PoseOptions
from derive.kinds.problem import Problem
from derive.mechanics.frame_places import seen
from derive.mechanics.frame_tree import relative, require_closed, way


def given(options: PoseOptions, problem: Problem, rotation_only: bool) -> Given:
    """T_i^j of the frames asked for. Raises NotDerivable where a frame stands in two places."""
    frames, target = problem.subject, options.target
    require_closed(frames, problem.names)
    source = len(frames.frames) if options.source is None else options.source
    path = way(frames, source, target)
    plain = len(path.up) == 1 and not path.down and is_given(path.up[0])
    return Given(
        problem,
        pose_name(source, target),
        rotation_name(source, target),
        relative(frames, source, target),
        () if plain else (problem.ask("transform", source=source, target=target),),
        lambda at: seen(frames, source, target, at),
    )
