"""A free vector, a point or a twist, given in one frame, in another."""

from __future__ import annotations

from dataclasses import replace

from pydantic import Field, model_validator

from derive.algebra.normal import normal_matrix
from derive.algebra.numbers.floats import numbers
from derive.derivation import Claim, Derivation, PageFacts, Step
from derive.expression import Expr, Indexed, Matrix, Product, Sum, Symbol, column
from derive.kinds.checks import agreement, is_rotation, links
from derive.kinds.fields import OptionsModel, Quantity
from derive.kinds.frames._frames import is_given, numeric_pose, origin_name, pose_name, rotation_name
from derive.kinds.frames._twist_step import moved, twist_step
from derive.kinds.problem import Problem
from derive.kinds.values_at import completed
from derive.mechanics.frame_tree import relative, require_closed, way
from derive.mechanics.frames import Frames
from derive.mechanics.poses import position_part, rotation_part

RESULTS = {
    "v^0": "the vector in frame `to`",
    "p^0": "or the point in frame `to`",
    "V^0": "or the twist in frame `to` (6, linear part first)",
}
EXAMPLE = """\
title: A velocity in another frame
problems:
- frames:
  - {matrix: [[0, -1, 0, 1], [1, 0, 0, -1], [0, 0, 1, 0], [0, 0, 0, 1]]}
  find: change-of-frame
  vector: [3, 1, 0]
  from: 1
  to: 0
"""


class Options(OptionsModel):
    """`vector` (free: a velocity, a force), `point` (bound) or `twist` (the velocity of the point at the
    origin of the frame, then the angular velocity), its frame `from`, the frame wanted `to`."""

    vector: tuple[Quantity, Quantity, Quantity] | None = None
    point: tuple[Quantity, Quantity, Quantity] | None = None
    twist: tuple[Quantity, Quantity, Quantity, Quantity, Quantity, Quantity] | None = None
    source: int | None = Field(default=None, alias="from", ge=0)
    target: int = Field(default=0, alias="to", ge=0)

    @model_validator(mode="after")
    def _one_of_them(self) -> Options:
        if sum(given is not None for given in (self.vector, self.point, self.twist)) != 1:
            raise ValueError("give either vector: (free) or point: (bound) or twist:")
        return self


class Facts(PageFacts):
    free: bool
    twist: bool
    name: str
    pose: Symbol
    rotation: Symbol
    origin: Symbol
    skew: Expr


def derive(frames: Frames, options: Options, problem: Problem) -> Derivation:
    """v^0 = R_1^0 v^1; p^0 = R_1^0 p^1 + o_1^0 (Spong et al., sections 2.3 and 2.6); of a twist the adjoint
    (Lynch and Park, section 3.3.2)."""
    require_closed(frames, problem.names)
    source = len(frames.frames) if options.source is None else options.source
    given: tuple[Expr, ...] = options.vector or options.point or options.twist or ()
    # The vector counts as given too, where it is asked how numbers are to be written.
    wide = replace(problem, subject=(frames, given))
    T = relative(frames, source, options.target)
    R, o = wide.readable_matrix(rotation_part(T)), wide.readable_matrix(position_part(T))
    if options.twist:
        steps, definitions = twist_step(options.twist, source, options.target, R, o, wide)
    else:
        only, definitions = _step(options, source, R, o, column(given), wide)
        steps = (only,)
    step = steps[-1]
    exact = step.chain[-1]
    claims = (
        *links(steps, {**problem.names, **definitions}),
        *is_rotation(normal_matrix(R, problem.names), f"R_{source}^{options.target}"),
        _second_route(frames, options, source, exact, wide),
    )
    path = way(frames, source, options.target)
    direct = len(path.up) == 1 and not path.down and is_given(path.up[0])
    uses = () if direct else (problem.ask("transform", source=source, target=options.target),)
    facts = Facts(
        free=options.vector is not None,
        twist=options.twist is not None,
        name=step.name,
        pose=pose_name(source, options.target),
        rotation=rotation_name(source, options.target),
        origin=origin_name(source, options.target),
        skew=Indexed("S", (origin_name(source, options.target),)),
    )
    return Derivation(
        "change-of-frame", steps, {step.name: exact}, claims, definitions, uses=uses, facts=facts
    )


def _step(
    options: Options, source: int, R: Matrix, o: Matrix, given: Matrix, problem: Problem
) -> tuple[Step, dict[Expr, Expr]]:
    """The vector rotated, or the point rotated and shifted."""
    letter = "v" if options.vector is not None else "p"
    name, before = Symbol(f"{letter}^{options.target}"), Symbol(f"{letter}^{source}")
    R_name, o_name = rotation_name(source, options.target), origin_name(source, options.target)
    turned, written = Product((R_name, before)), Product((R, given))
    definitions: dict[Expr, Expr] = {R_name: R, o_name: o, before: given}
    names, numbers_in = (turned, written) if letter == "v" else (Sum((turned, o_name)), Sum((written, o)))
    value = problem.readable_matrix(normal_matrix(numbers_in))
    exact = problem.final(value)
    last = () if exact == value else (exact,)
    definitions[name] = value
    chain = (name, names, numbers_in, value, *last)
    return Step(name.name, chain, "change-of-frame"), definitions


def _second_route(frames: Frames, options: Options, source: int, exact: Expr, problem: Problem) -> Claim:
    path = way(frames, source, options.target)
    entries = options.vector or options.point or ()

    def other(point: dict[str, float]) -> object:
        import numpy as np

        at = completed(point, problem.where)
        if options.twist:
            T = np.linalg.solve(numeric_pose(path.down, at), numeric_pose(path.up, at))
            return moved(T, options.twist, at)
        last = 0.0 if options.vector is not None else 1.0
        lifted = np.array([*numbers(column(entries), at), last])
        T = np.linalg.solve(numeric_pose(path.down, at), numeric_pose(path.up, at))
        return (T @ lifted)[:3]

    return agreement(
        "in-numbers",
        problem.symbols,
        lambda point: numbers(exact, completed(point, problem.where)),
        lambda point: other(dict(point)),
    )
