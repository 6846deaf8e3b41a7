"""robot: an open chain given by Denavit-Hartenberg rows, free motions, or the screw axes of its joints."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from typing import Annotated, Literal

from pydantic import Field

from derive.errors import SheetError
from derive.expression import Expr, Symbol, walk
from derive.kinds.fields import Acceleration, OptionsModel, Starred
from derive.mechanics.robot import DHRow, FreeRow, JointType, Link, Robot, Row
from derive.sheet.body_faults import body_faults, body_warnings, matrix_faults
from derive.sheet.coupled import coupling_faults, coupling_warnings, opened
from derive.sheet.range_faults import range_faults
from derive.sheet.source import At, Faults, Route
from derive.sheet.subjects.link import (
    BODY_KEYS,
    DHLink,
    FreeLink,
    LinkField,
    ScrewLink,
    body,
    friction,
    lacking,
    motor,
)
from derive.sheet.subjects.moves import MoveField, RotateJoint, joint_move, move
from derive.sheet.subjects.registry import Known
from derive.sheet.subjects.screws import HomeField, home_pose, joint_type, screw_row

# Every kind has the whole chain; bodies, motors, friction and gravity are not needed for its pose, and ranges
# change no formula: workspaces and inverse kinematics, which they change, read them from the links.
HARMLESS = frozenset(
    f"links.{part}"
    for part in ("mass", "com", "inertia", "about", "motor", "friction", "screw.through", "screw.pitch")
) | {"name", "convention", "base", "tool", "gravity", "home", "links.range"}
NO_JOINT = "a star marks the joint variable: write {name}*"


class Given(OptionsModel):
    """An open chain: its links, and what stands before and after them."""

    name: str = ""
    """What the robot is called."""
    convention: Literal["standard", "modified"] = "standard"
    """Where frames stand on the links: standard (Spong, Siciliano) or modified (Craig, Khatib)."""
    links: Annotated[list[LinkField], Field(min_length=1, max_length=30)]
    """A row for each link, with its body where dynamics is asked."""
    base: Annotated[tuple[MoveField, ...], Field(max_length=20)] = ()
    """A fixed motion before the first row."""
    tool: Annotated[tuple[MoveField, ...], Field(max_length=20)] = ()
    """A fixed motion after the last row."""
    gravity: tuple[Acceleration, Acceleration, Acceleration] | None = None
    """The acceleration of gravity in the base frame, as [0, 0, -g]."""
    home: HomeField | None = None
    """The pose of the end-effector while all joints are at zero, of a robot given by screws."""


def build(given: Given, at: At, known: Known) -> Robot:
    """The robot. Raises SheetErrors: joints without a star, variables used twice, half a body, a
    negative mass."""
    faults = Faults([*_star_faults(given, at, known), *_repeated(given, at), *_half_bodies(given, at)])
    links = tuple(_link(row) for row in given.links)
    base, tool = (tuple(move(entry) for entry in moves) for moves in (given.base, given.tool))
    robot = opened(Robot(given.name, given.convention, links, base, tool, given.gravity), known.where)
    faults += [*_mixed(given, at), *body_faults(robot, at, known), *coupling_faults(robot, at)]
    faults += [*matrix_faults(given.links, at, known), *range_faults(robot, at, known)]
    if not faults and given.home is not None:
        robot = replace(robot, home=home_pose(given.home, at / "home", known))
        faults += coupling_faults(robot, at)
    faults.settle()
    return robot


def warnings(subject: Robot, at: At, known: Known) -> list[SheetError]:
    """What is strange about the robot, though it can be worked with."""
    return [*body_warnings(subject.links, at, known), *coupling_warnings(subject, at)]


def missing(subject: Robot, need: str, at: At) -> list[SheetError]:
    """The faults where a kind needs "bodies" or "gravity" and the robot has none."""
    if need == "gravity" and subject.gravity is None:
        return [at.fault("'gravity' is missing", (), "add gravity: [0, 0, -g], in the base frame", key=True)]
    if need != "bodies":
        return []
    hint = "add mass: m, com: center and inertia: point (or others)"
    return [
        at.fault(f"link {index + 1} has no mass", ("links", index), hint)
        for index, link in enumerate(subject.links)
        if link.body is None
    ]


def _link(given: LinkField) -> Link:
    joint, variable = _joint(given)
    if isinstance(given, FreeLink):
        row: Row = FreeRow(tuple(joint_move(entry) for entry in given.motion))
    elif isinstance(given, ScrewLink):
        row = screw_row(given.screw, given.variable.expr)
    else:
        row = DHRow(given.theta.expr, given.d.expr, given.a, given.alpha)
    return Link(row, joint, variable, body(given), motor(given), friction(given), given.range)


def _starred(given: LinkField) -> Iterator[tuple[Route, JointType, Starred]]:
    """Where in a row a star may stand, which joint it would make, and what stands there."""
    if isinstance(given, DHLink):
        yield ("theta",), "revolute", given.theta
        yield ("d",), "prismatic", given.d
        return
    if isinstance(given, ScrewLink):
        yield ("variable",), joint_type(given.screw), given.variable
        return
    for index, entry in enumerate(given.motion):
        joint: JointType = "revolute" if isinstance(entry, RotateJoint) else "prismatic"
        yield ("motion", index, "by"), joint, entry.by


def _joint(given: LinkField) -> tuple[JointType, str | None]:
    for _, joint, starred in _starred(given):
        if starred.variable:
            return joint, starred.variable
    return "fixed", None


def _star_faults(given: Given, at: At, known: Known) -> list[SheetError]:
    found: list[SheetError] = []
    variables = frozenset(
        each.variable for row in given.links for _, _, each in _starred(row) if each.variable
    )
    for index, row in enumerate(given.links):
        stars = [(route, starred) for route, _, starred in _starred(row) if starred.variable]
        if len(stars) > 1:
            hint = "give each joint a row of its own"
            found.append(at.fault("two joint variables in one row", ("links", index, *stars[1][0]), hint))
        elif not stars:
            found.extend(_forgotten(row, index, at, known, variables))
    if not found and not variables:
        found.append(
            at.fault("no joint moves: nothing is starred", ("links",), NO_JOINT.format(name="theta1"))
        )
    return found


def _forgotten(
    row: LinkField, index: int, at: At, known: Known, variables: frozenset[str]
) -> Iterator[SheetError]:
    """A row without a star where a name reads like its joint variable, and is declared nowhere and the
    variable of no other row."""
    for route, _, starred in _starred(row):
        for name in _names(starred.expr):
            if re.fullmatch(rf"(theta|q|d)_?{index + 1}", name) and name not in known.names | variables:
                hint = (
                    NO_JOINT.format(name=name) + f"; if it is constant, declare it: symbols: {{{name}: real}}"
                )
                yield at.fault(f"row {index + 1} has no joint variable", ("links", index, *route), hint)
                return


def _mixed(given: Given, at: At) -> Iterator[SheetError]:
    """Screw axes are those of the base frame: rows of other forms, and a home without screws, are faults."""
    screws = [isinstance(row, ScrewLink) for row in given.links]
    hint = "give every joint its screw, or every link its row"
    if any(screws) and not all(screws):
        index = screws.index(False) if screws[0] else screws.index(True)
        yield at.fault("screws and other rows stand in one robot", ("links", index), hint)
    if given.home is not None and not any(screws):
        hint = "leave it out; the last row, or tool:, says where the end-effector is"
        yield at.fault("home: belongs to a robot of screws", ("home",), hint, key=True)
    if all(screws) and "convention" in given.model_fields_set:
        hint = "leave it out; screws follow no convention"
        yield at.fault("convention: belongs to Denavit-Hartenberg rows", ("convention",), hint, key=True)
    for index, row in enumerate(given.links):
        if isinstance(row, ScrewLink) and row.variable.variable is None:
            yield at.fault("this screw has no joint variable", ("links", index, "variable"), "write theta1*")
        if isinstance(row, ScrewLink) and row.com == "center":
            hint = "give the point, in the base frame while all joints are at zero, as [L/2, 0, 0]"
            yield at.fault("a link given by a screw has no center", ("links", index, "com"), hint)


def _names(expr: Expr) -> list[str]:
    return [node.name for node in walk(expr) if isinstance(node, Symbol)]


def _repeated(given: Given, at: At) -> Iterator[SheetError]:
    seen: dict[str, int] = {}
    for index, row in enumerate(given.links):
        for route, _, starred in _starred(row):
            if starred.variable is None:
                continue
            first = seen.setdefault(starred.variable, index)
            if first != index:
                message = f"{starred.variable} is the joint variable of row {first + 1} already"
                yield at.fault(message, ("links", index, *route), "give each joint a name of its own")


def _half_bodies(given: Given, at: At) -> Iterator[SheetError]:
    for index, row in enumerate(given.links):
        for key in lacking(row):
            yield at.fault(f"the body of link {index + 1} has no '{key}'", ("links", index), BODY_KEYS[key])
