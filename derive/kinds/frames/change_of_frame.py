"""A free vector, a point or a twist, given in one frame, in another."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from typing import Any

from pydantic import Field, model_validator

from derive.algebra.normal import normal, normal_matrix
from derive.algebra.numbers.floats import Point, number, numbers
from derive.derivation import Derivation, PageFacts, Phrase, Step
from derive.expression import (
    ONE,
    ZERO,
    Expr,
    Indexed,
    Matrix,
    Number,
    Symbol,
    add,
    column,
    is_negative,
    multiply,
    walk,
)
from derive.kinds.checks import is_rotation
from derive.kinds.fields import OptionsModel, Quantity
from derive.kinds.frames._frames import is_given, origin_name, pose_name, rotation_name
from derive.kinds.frames._meanings import frames_told
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.elementary import skew
from derive.mechanics.frame_places import seen
from derive.mechanics.frame_tree import relative, require_closed, way
from derive.mechanics.frames import Frames
from derive.mechanics.poses import position_part, rotation_part

NO_BLOCK = Symbol("0_3x3")
NOTHING = Matrix(((ZERO,) * 3,) * 3)
CLAIMS = ("orthogonal", "right-handed", "as-told", "said")


class Options(OptionsModel):
    """What is to be written in another frame, and which frames these are."""

    vector: tuple[Quantity, Quantity, Quantity] | None = None
    """A free vector: a velocity, a force."""
    point: tuple[Quantity, Quantity, Quantity] | None = None
    """A bound vector: the coordinates of a point."""
    twist: tuple[Quantity, Quantity, Quantity, Quantity, Quantity, Quantity] | None = None
    """The velocity of the point at the origin of the frame, then the angular velocity."""
    source: int | None = Field(default=None, alias="from", ge=0)
    """The frame in which it is given; the last one if left out."""
    target: int = Field(default=0, alias="to", ge=0)
    """The frame in which it is wanted."""

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
    rotation: Symbol | None  # of what is turned
    origin: Symbol | None  # where it counts
    together: bool  # whether that is the origin of the other frame, so that a point is only turned
    skew: Expr | None  # of a twist


def derive(frames: Frames, options: Options, problem: Problem) -> Derivation:
    """v^0 = R_1^0 v^1; p^0 = R_1^0 p^1 + o_1^0 (Spong et al., sections 2.3 and 2.6); of a twist the adjoint
    (Lynch and Park, section 3.3.2)."""
    require_closed(frames, problem.names)
    source = len(frames.frames) if options.source is None else options.source
    given: tuple[Expr, ...] = options.vector or options.point or options.twist or ()
    # The vector counts as given too, where it is asked how numbers are to be written.
    wide = replace(problem, subject=(frames, given))
    T, path = relative(frames, source, options.target), way(frames, source, options.target)
    R, o = rotation_name(source, options.target), origin_name(source, options.target)
    known: dict[Expr, Expr] = {
        R: wide.readable_matrix(rotation_part(T)),
        o: wide.readable_matrix(position_part(T)),
    }
    work, name = _board(Work(wide, known), options, source, column(given), R, o)
    work = work.claim(*is_rotation(normal_matrix(known[R], problem.names), R.name))
    there = partial(_coordinates, frames, source, options)
    whole = pose_name(source, options.target)
    printed = ((name, work.final(name)), (whole, Matrix(((R, o), (ZERO, ONE)))))
    work = frames_told(work, frames, printed, there, lambda at: {NO_BLOCK: numbers(NOTHING, at)})
    if not (len(path.up) == 1 and not path.down and is_given(path.up[0])):
        work = replace(work, uses=(problem.ask("transform", source=source, target=options.target),))
    result = f"{_usual(options)}^{options.target}"
    facts = Facts(
        free=options.vector is not None,
        twist=options.twist is not None,
        name=name.name,
        pose=whole,
        rotation=None if options.twist else R,
        origin=None if options.vector else o,
        together=options.point is not None and _is_zero(work.entries(o)),
        skew=Indexed("S", (o,)) if options.twist else None,
        page_names={result: name.name},
    )
    shifted = any(o in walk(tree) for tree in work.steps[-1].chain)
    twist = work.matrix(name).shape == (6, 1)
    work = work.law("said", ((facts.free or facts.together) != shifted, facts.twist == twist))
    units = _units(options, name, Symbol(f"{name.name.partition('^')[0]}^{source}"))
    return work.answer("change-of-frame", {result: work.final(name)}, facts, units=units)


def _units(options: Options, *names: Symbol) -> dict[Expr | Phrase, str]:
    """That of the components of a vector or a point, where all are typed with the same."""
    parts = options.vector or options.point or ()
    found = {part.unit if isinstance(part, Number) else "" for part in parts if part != ZERO}
    unit = found.pop() if len(found) == 1 else ""
    return dict.fromkeys(names, unit) if unit else {}


def _board(
    work: Work, options: Options, source: int, given: Matrix, R: Symbol, o: Symbol
) -> tuple[Work, Symbol]:
    """The vector rotated, the point rotated and shifted, or the twist moved; and its name there."""
    letter = _letter(options, work.problem, given)
    name, before = Symbol(f"{letter}^{options.target}"), Symbol(f"{letter}^{source}")
    work = work.knowing({before: given})
    if options.twist:
        return twist_lines(work, name, before, R, o), name
    named, written = R * before, work[R] * given
    formulas = (named, written) if options.vector else (named + o, written + work[o])
    together = options.point is not None and _is_zero(work.entries(o))
    if together:
        formulas = (named, written)
    plain = together and all(isinstance(part, Symbol) for (part,) in given.rows)
    value = _row_by_row(work.matrix(R), given) if plain else None
    return work.line(name, *formulas, value=value, rule="change-of-frame").closed(name), name


def _letter(options: Options, problem: Problem, given: Matrix) -> str:
    """That of the components where they share one, as u_x, u_y and u_z do."""
    names = [part.name for (part,) in given.rows if isinstance(part, Symbol)]
    stems = {name.removesuffix(f"_{axis}") for name, axis in zip(names, "xyz", strict=False)}
    own = stems.pop() if len(names) == len(given.rows) == 3 and len(stems) == 1 else ""
    usual = _usual(options)
    clash = own in (*names, "o") or any(
        f"{own}^{k}" in problem.taken for k in (options.source, options.target)
    )
    return usual if clash else own or usual


def _usual(options: Options) -> str:
    return "V" if options.twist else "v" if options.vector else "p"


def _is_zero(entries: tuple[Expr, ...]) -> bool:
    return not any(map(normal, entries))


def _row_by_row(R: Matrix, given: Matrix) -> Matrix:
    """R times a column (3 by 1) of symbols, the terms in their order."""
    return column(
        add(*(_term(part, entry) for entry, (part,) in zip(row, given.rows, strict=True) if normal(entry)))
        for row in R.rows
    )


def _term(part: Expr, entry: Expr) -> Expr:
    return -multiply(part, -entry) if is_negative(entry) else multiply(part, entry)


def _coordinates(frames: Frames, source: int, options: Options, target: int, at: Point) -> Any:
    """Those of the quantity in a frame, in NumPy."""
    import numpy as np

    T = seen(frames, source, target, at)
    if options.twist:
        return moved(T, options.twist, at)
    last = 0.0 if options.vector is not None else 1.0
    return (T @ np.array([*numbers(column(options.vector or options.point or ()), at), last]))[:3]


def twist_lines(work: Work, V: Symbol, before: Symbol, R: Symbol, o: Symbol) -> Work:
    """S(o), and V^0 = [[R, S(o) R], [0, R]] V^1 (Lynch and Park, section 3.3.2; linear part first)."""
    S_name = Indexed("S", (o,))
    (x,), (y,), (z,) = work.matrix(o).rows
    S = skew((x, y, z))
    work = work.knowing({S_name: S, NO_BLOCK: NOTHING})
    work = work.showing(Step("S_o", (S_name, S), "skew"))
    adjoint = Matrix(((R, S_name * R), (NO_BLOCK, R)))
    written = work.readable(work.value(adjoint)) * work[before]
    return work.line(V, adjoint * before, written, rule="change-of-frame").closed(V)


def moved(T: Any, twist: tuple[Expr, ...], point: Mapping[str, float]) -> Any:
    """The second route: [V^0] = T [V^1] T^-1, in NumPy."""
    import numpy as np

    v1, v2, v3, x, y, z = (number(part, point) for part in twist)
    bracket = np.array([[0, -z, y, v1], [z, 0, -x, v2], [-y, x, 0, v3], [0, 0, 0, 0]])
    B = T @ bracket @ np.linalg.inv(T)
    return np.array([*B[:3, 3], B[2, 1], B[0, 2], B[1, 0]])
