"""Every frame in the one it is given in, and the last one in the world."""

from __future__ import annotations

from derive.algebra.normal import normal_matrix
from derive.algebra.numbers.floats import numbers
from derive.derivation import Claim, Derivation, PageFacts, Result, Step
from derive.expression import Expr, Matrix, Product, Symbol
from derive.kinds.checks import agreement, is_rotation, links
from derive.kinds.fields import OptionsModel
from derive.kinds.frames._frames import (
    local_definitions,
    local_steps,
    numeric_pose,
    pose_name,
    read_axes,
)
from derive.kinds.problem import Problem
from derive.kinds.values_at import completed
from derive.mechanics.frame_tree import along, ancestry, require_closed
from derive.mechanics.frames import Frame, Frames
from derive.mechanics.poses import rotation_part

RESULTS = {
    "T_1^0, T_2^1, ...": "each frame in the one it is given in (4 by 4)",
    "T_n^0": "the last frame in the world (4 by 4)",
}
EXAMPLE = """\
title: Two frames read off a figure
problems:
- frames:
  - {x: -x0, y: -z0, z: -y0, origin: [0, c + e, a - d]}
  - {x: z1, y: -x1, z: -y1, origin: [b, a - d, 0]}
  find: transforms
"""


class Options(OptionsModel):
    """Nothing to choose."""


class Facts(PageFacts):
    product: str  # a step
    read: tuple[tuple[Expr, Expr], ...]


def derive(frames: Frames, options: Options, problem: Problem) -> Derivation:
    """T_1^0, T_2^1, ... and their product along the parents of the last frame (Spong et al., section 2.6)."""
    require_closed(frames, problem.names)
    path = ancestry(frames, len(frames.frames))
    found = [step for frame in frames.frames for step in local_steps(frame, problem)]
    definitions: dict[Expr, Expr] = {}
    for frame in frames.frames:
        definitions |= local_definitions(frame, problem)
    product = _product(path, problem)
    steps = (*found, *product)
    definitions |= {Symbol(step.name): step.chain[-1] for step in product}
    results = _results(frames, definitions, problem)
    claims = (
        *links(steps, {**problem.names, **definitions}),
        *_laws(frames, definitions, problem),
        *(_second_route(path, results[step.name], step.name, problem) for step in product),
    )
    return Derivation(
        "transforms", steps, results, claims, definitions, facts=_facts(frames, product, definitions)
    )


def _product(path: tuple[Frame, ...], problem: Problem) -> tuple[Step, ...]:
    """T_n^0 where it is not one of the given frames itself."""
    if len(path) < 2:
        return ()
    name = pose_name(path[-1].number, 0)
    factors = Product(tuple(pose_name(frame.number, frame.parent) for frame in path))
    written = problem.readable_matrix(along(path))
    exact = problem.final(written)
    last = () if exact == written else (exact,)
    return (Step(name.name, (name, factors, written, *last), "product"),)


def _results(frames: Frames, definitions: dict[Expr, Expr], problem: Problem) -> dict[str, Result]:
    names = [pose_name(frame.number, frame.parent) for frame in frames.frames]
    whole = pose_name(len(frames.frames), 0)
    return {name.name: problem.final(definitions[name]) for name in dict.fromkeys((*names, whole))}


def _laws(frames: Frames, definitions: dict[Expr, Expr], problem: Problem) -> list[Claim]:
    claims: list[Claim] = []
    for frame in frames.frames:
        T = normal_matrix(definitions[pose_name(frame.number, frame.parent)], problem.names)
        claims += is_rotation(rotation_part(T), f"R_{frame.number}^{frame.parent}")
    return claims


def _second_route(path: tuple[Frame, ...], result: Result, name: str, problem: Problem) -> Claim:
    if not isinstance(result, Matrix):
        raise TypeError(f"{name} is no matrix")
    return agreement(
        "composed",
        problem.symbols,
        lambda point: numbers(result, completed(point, problem.where)),
        lambda point: numeric_pose(path, completed(point, problem.where)),
        T=name,
    )


def _facts(frames: Frames, product: tuple[Step, ...], definitions: dict[Expr, Expr]) -> Facts:
    name = product[0].name if product else ""
    last = len(frames.frames)
    whole = definitions[Symbol(name)] if product else None
    return Facts(product=name, read=read_axes(whole, last, 0) if isinstance(whole, Matrix) else ())
