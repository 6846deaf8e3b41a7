"""Joints of a redundant arm that are left to be chosen: the others are found as if these stood still."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Annotated, Any, TypeAlias, get_args

from pydantic import PlainValidator, ValidationInfo, WithJsonSchema

from derive.derivation import Branch, Derivation, Phrase, Result
from derive.errors import FormulaError, NotDerivable
from derive.expression import Expr, Symbol
from derive.kinds.fields import Place, read_name
from derive.kinds.problem import Memo, Problem
from derive.kinds.robot._chain import chain_of
from derive.kinds.robot._inverse.facts import Facts
from derive.kinds.robot._inverse.given import Given, goal_of
from derive.kinds.robot._inverse.ranges import Ranges
from derive.kinds.robot._inverse.refused import rank_at
from derive.kinds.robot._inverse.sampled import sample_points
from derive.kinds.robot._inverse.target import Target
from derive.kinds.robot._rows.by_rows import by_rows
from derive.kinds.values_at import Here
from derive.mechanics.robot import Robot

TREES = get_args(Expr)


def read(typed: Any, info: ValidationInfo) -> tuple[str, ...]:
    """One name or several. Raises FormulaError."""
    if typed == ():
        return ()
    names = tuple(map(read_name, typed if isinstance(typed, list | tuple) else [typed]))
    if not names or len(set(names)) < len(names):
        raise FormulaError("names of joint variables are wanted here, each once", hint="write [theta7]")
    return names


Free: TypeAlias = Annotated[
    tuple[str, ...],
    PlainValidator(read),
    WithJsonSchema(
        {"type": ["string", "array"], "items": {"type": "string"}, "description": "joint variables to choose"}
    ),
]


def derive(problem: Problem, free: tuple[str, ...], given: Given, place: Place | None) -> Derivation:
    """The inverse of the arm with these joints held, in which they are names like lengths."""
    robot: Robot = problem.subject
    _refuse(problem, free, given)
    if robot.by_screws:
        return by_rows("inverse-kinematics", problem, given=given, free=free, evaluate=place)
    signs = {**problem.assumptions, **dict.fromkeys(free, "real")}
    arm, order = holding(robot, free), problem.style.order  # names stand in sums as they do before
    other = replace(problem, subject=arm, assumptions=signs, memo=Memo(), order=order)
    _refuse_out_of_range(problem, free, place)
    found = other.ask("inverse-kinematics", given=given, evaluate=place)
    facts = found.facts
    assert isinstance(facts, Facts)
    turning = [link.variable for link in robot.links if link.joint == "revolute" and link.variable in free]
    facts = replace(
        facts,
        held=Phrase("held" if len(free) == 1 else "several-held", {"joints": tuple(map(Symbol, free))}),
        angle_results=(*facts.angle_results, *filter(None, turning)),
    )
    evaluated = dict(found.evaluated)
    if solutions := evaluated.get("solutions"):
        here = Here.of(dict(place or ()), problem.where, problem.style)
        own = {name: here.scalar(Symbol(name)) for name in free if name in here.point}
        evaluated["solutions"] = [
            _in_order(robot, {**own, **each}) if each.get("real", True) else each for each in solutions
        ]
    results = {name: _with(robot, free, name, result) for name, result in found.results.items()}
    uses = (problem.ask("forward-kinematics"),)
    return replace(found, uses=uses, results=results, facts=facts, evaluated=evaluated)


def holding(robot: Robot, free: tuple[str, ...]) -> Robot:
    """The arm with some joints standing still, where their variables say."""
    links = tuple(
        replace(link, joint="fixed", variable=None, range=None) if link.variable in free else link
        for link in robot.links
    )
    return replace(robot, links=links)


def _with(robot: Robot, free: tuple[str, ...], name: str, result: Result) -> Result:
    """The solutions with the joints that are chosen, each by itself, and their order."""
    if name == "order" and isinstance(result, tuple):
        return (*free, *(each for each in result if isinstance(each, str)))
    if name != "solutions":
        return result
    own = {name: Symbol(name) for name in free}
    branches = result if isinstance(result, tuple) else ()
    return tuple(
        replace(
            each,
            values=_in_order(robot, {**own, **each.values}),
            short={**own, **each.short} if each.short else {},
        )
        for each in branches
        if isinstance(each, Branch)
    )


def _in_order(robot: Robot, solution: Mapping[str, Any]) -> dict[str, Any]:
    """Joint values in the order of the rows, then what else is told."""
    if any(isinstance(value, TREES) for value in solution.values()):
        return dict(solution)  # formulas stand in the order in which they are evaluated
    joints = {name: solution[name] for name in robot.variables if name in solution}
    return {**joints, **solution}


def _refuse(problem: Problem, free: tuple[str, ...], given: Given) -> None:
    """Raises NotDerivable where these are no joints, or more than can be chosen."""
    robot: Robot = problem.subject
    if strange := [name for name in free if name not in robot.variables]:
        known = ", ".join(robot.variables)
        raise NotDerivable(f"'{strange[0]}' under free is no joint variable; they are {known}", "free")
    chain = chain_of(problem)
    goal = goal_of(given, chain, problem)
    target = Target.of(problem, chain, goal)
    spare = len(robot.variables) - rank_at(target, sample_points(chain, goal, problem, 2))
    if len(free) > spare:
        count = {0: "none", 1: "one"}.get(spare, str(spare))
        raise NotDerivable(
            f"free names {len(free)} of the {len(robot.variables)} joint variables, but what is given leaves "
            f"{count} of them to be chosen",
            "free",
        )


def _refuse_out_of_range(problem: Problem, free: tuple[str, ...], place: Place | None) -> None:
    """Raises NotDerivable where a joint is put beyond the ends of its range."""
    robot: Robot = problem.subject
    links = tuple(link if link.variable in free else replace(link, range=None) for link in robot.links)
    ranges = Ranges.of(replace(problem, subject=replace(robot, links=links)), place)
    here = Here.of(dict(place or ()), problem.where, problem.style)
    for name in ranges.limits or {}:
        value = here.point.get(name)
        if value is not None and not ranges.within(name, value):
            raise NotDerivable(f"{name} is put outside of its range", "evaluate")
