"""The angles of the motors of a five-bar linkage or a Delta robot for a point, leg by leg."""

from __future__ import annotations

from typing import Annotated

from pydantic import AfterValidator, Field

from derive.derivation import Branch, Derivation
from derive.errors import NotDerivable
from derive.expression import Symbol, number
from derive.kinds.checks import route
from derive.kinds.fields import Angle, Length, OptionsModel
from derive.kinds.mechanism._facts import LegFacts as Facts
from derive.kinds.mechanism._leg_checks import legs_close
from derive.kinds.mechanism._legs import Solved, legs_of, solved
from derive.kinds.mechanism._stewart import lengths_of_legs
from derive.kinds.pose.euler_angles import known_convention
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.linkages import Delta, FiveBar, Stewart
from derive.names import free

NEEDS = ("motors",)
CLAIMS = ("legs-close|lengths-measured",)
CLAIMED = {"solutions": "legs-close"}
INTRODUCED = "[xyz]"  # where the platform is


class Options(OptionsModel):
    """The pose of the platform; letters stand for what is left out."""

    position: tuple[Length, ...] | None = Field(None, min_length=2, max_length=3)
    """The point [x, y] of a five-bar linkage, or the middle [x, y, z] of a platform."""
    orientation: tuple[Angle, Angle, Angle] | None = None
    """Three angles of a Stewart-Gough platform, which is not turned if they are left out."""
    convention: Annotated[str, AfterValidator(known_convention)] = "ZYX"
    """The order in which the rotations are made: ZYX about current axes, xyz about world axes, as in
    SciPy."""


def derive(robot: FiveBar | Delta | Stewart, options: Options, problem: Problem) -> Derivation:
    """The end of each crank lies on its circle and at the length of its rod from the point (Lynch and Park,
    Modern Robotics, section 7.1; Clavel's Delta in Tsai, Robot Analysis, section 3.5).

    Raises NotDerivable for a point of the wrong size, and where no position of it can be reached.
    """
    if isinstance(robot, Stewart):
        return lengths_of_legs(robot, options.position, (options.convention, options.orientation), problem)
    if options.orientation is not None:
        raise NotDerivable("a platform that never turns has no orientation", "orientation")
    delta = isinstance(robot, Delta)
    axes = "xyz" if delta else "xy"
    wanted = options.position or tuple(Symbol(free(problem.taken, axis, f"p_{axis}")) for axis in axes)
    if len(wanted) != (3 if delta else 2):
        raise NotDerivable(f"{len(wanted)} coordinates are given, {3 if delta else 2} are needed", "position")
    work, point = Work(problem).naming(**dict(zip("xyz", wanted, strict=False)))
    work, legs = legs_of(robot, work, point)
    given = work.typed
    parts, branches = list[Solved](), list[Branch]()
    for leg in legs:
        one = solved(leg, robot, work)
        work = one.work
        parts.append(one)
        branches += one.branches({name: problem.final(value) for name, value in given} | dict(problem.names))
    results = {"solutions": tuple(branches)}
    work = work.claim(route("legs-close", legs_close(robot, work, parts, wanted, results["solutions"])))
    facts = Facts(
        given=given, delta=delta, legs=tuple(
            (number(k), one.lines, (one.ways[0][0], one.ways[1][0])) for k, one in enumerate(parts, 1)
        ),
        across=point[-1], angle=parts[0].angle, angle_results=tuple(one.angle.name for one in parts),
        in_degrees=True,
    )  # fmt: skip
    return work.answer("inverse-kinematics", results, facts)


def measures(robot: FiveBar | Delta | Stewart) -> dict[str, str]:
    """Legs that extend, and the vectors along them."""
    legs = range(1, len(robot.base) + 1) if isinstance(robot, Stewart) else ()
    return {f"{letter}_{k}": "m" for k in legs for letter in "lL"}
