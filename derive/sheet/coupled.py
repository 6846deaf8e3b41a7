"""Joint variables beyond their own row: where they may stand, and where an answer could not be right."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass, replace
from typing import TypeVar, cast, get_args

from derive.errors import SheetError
from derive.expression import Expr, Symbol, free_symbols
from derive.expression import replace as replaced
from derive.kinds.problem import expressions
from derive.mechanics.moments import given_moments
from derive.mechanics.motion import Axis, Move
from derive.mechanics.robot import FreeRow, Robot, ScrewRow
from derive.sheet.source import At, Route

TREES = get_args(Expr)
Part = TypeVar("Part")


def opened(robot: Robot, where: Mapping[str, Expr]) -> Robot:
    """The robot without those names of `where` that stand for functions of its joint variables: they move."""
    moving: dict[Expr, Expr] = {}
    for _ in where:  # one may hold another
        held = set(robot.variables) | {name.name for name in moving if isinstance(name, Symbol)}
        moving = {
            Symbol(name): replaced(value, moving)
            for name, value in where.items()
            if not free_symbols(value).isdisjoint(held)
        }
    return _with(robot, moving) if moving else robot


def _with(part: Part, values: Mapping[Expr, Expr]) -> Part:
    """Every tree of a frozen value with names replaced."""
    if isinstance(part, TREES):
        return cast(Part, replaced(part, values))
    if isinstance(part, tuple):
        return cast(Part, tuple(_with(each, values) for each in part))
    if is_dataclass(part) and not isinstance(part, type):
        return replace(part, **{each.name: _with(getattr(part, each.name), values) for each in fields(part)})
    return part


def coupling_faults(robot: Robot, at: At) -> Iterator[SheetError]:
    """Joint variables in masses, motors, gravity, directions and screws."""
    for route, tree, message, hint in _fixed_places(robot):
        for name in robot.variables:
            if name in free_symbols(tree):
                yield at.fault(message.format(name=name), route, hint)
                break


def coupling_warnings(robot: Robot, at: At) -> Iterator[SheetError]:
    """Inertias that change."""
    for index, link in enumerate(robot.links):
        held = {name for tree in given_moments(link.body) for name in free_symbols(tree)} if link.body else ()
        if names := [name for name in robot.variables if name in held]:
            message = f"the inertia of link {index + 1} changes with {names[0]}"
            hint = "it counts as it stands; what moves inside the link has energy of its own, which does not"
            yield at.fault(message, ("links", index, "inertia"), hint)


def _fixed_places(robot: Robot) -> Iterator[tuple[Route, Expr, str, str]]:
    """(where, what stands there, what is wrong with a joint variable in it, what to do)."""
    for index, link in enumerate(robot.links):
        route: Route = ("links", index)
        if link.body:
            hint = "a mass that comes or goes brings or takes momentum; give what moves a link of its own"
            message = f"the mass of link {index + 1} cannot change with {{name}}"
            yield (*route, "mass"), link.body.mass, message, hint
        if link.motor:
            message = f"the motor of link {index + 1} cannot change with {{name}}"
            hint = "only motors with a constant ratio and inertia are derived"
            yield (*route, "motor", "inertia"), link.motor.inertia, message, hint
            yield (*route, "motor", "ratio"), link.motor.ratio, message, hint
        match link.row:
            case FreeRow(made):
                yield from _axes(made, (*route, "motion"))
            case ScrewRow(axis, through, _, pitch):
                message = "a screw is given while all joints are at zero, so {name} cannot stand in it"
                for tree in (*_trees(axis), *through, pitch):
                    yield (*route, "screw"), tree, message, "let the variable of the joint hold it"
    yield from _axes(robot.base, ("base",))
    yield from _axes(robot.tool, ("tool",))
    for index, tree in enumerate(robot.gravity or ()):
        yield ("gravity", index), tree, "gravity cannot change with {name}", "it is that of the base frame"
    if robot.home is not None:
        message = "home: is the pose while all joints are at zero, so {name} cannot stand in it"
        for tree in expressions(robot.home):
            yield ("home",), tree, message, "let the variable of a joint hold it"


def _axes(moves: tuple[Move, ...], route: Route) -> Iterator[tuple[Route, Expr, str, str]]:
    for k, move in enumerate(moves):
        for tree in _trees(move.axis):
            hint = "turn the axes by a move of its own before this one"
            yield (*route, k, move.kind), tree, "the axis of a move cannot change with {name}", hint


def _trees(axis: Axis) -> tuple[Expr, ...]:
    return () if isinstance(axis, str) else axis
