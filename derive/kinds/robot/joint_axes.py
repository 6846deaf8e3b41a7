"""The axis of every joint and a point on it, and the poses they are read from, in the base frame."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from itertools import islice
from typing import Any

from pydantic import Field

from derive.algebra.infix import text
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.numbers.floats import Point, completed, numbers
from derive.derivation import Derivation, PageFacts, Phrase, Said
from derive.expression import Expr, Symbol, symbols
from derive.kinds.checks import TRIES, close, random_points, route
from derive.kinds.fields import OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.robot._by_index import by_index
from derive.kinds.robot._chain import LINKS_ALONE, axis_lines, chain_of, oracle_of, pose_name
from derive.kinds.robot._columns import pose_lines
from derive.kinds.robot._couplings import motion_lines
from derive.kinds.robot._families import said_of_each
from derive.kinds.robot._units import of_variables
from derive.kinds.work import Work
from derive.mechanics.chain import Chain
from derive.mechanics.oracle import Oracle
from derive.mechanics.oracle.astray import Astray
from derive.mechanics.oracle.instant import Instant
from derive.mechanics.poses import rotation_part
from derive.mechanics.robot import Robot

POINTS = 2
VECTORS = {"z": "vector-z", "x": "vector-x", "o": "vector-o", "k": "vector-k", "p": "vector-p"}
measures = of_variables


class Options(OptionsModel):
    """How many of the axes are wanted."""

    to: int | None = Field(None, ge=1)
    """The last row whose joint is wanted; all of them if left out."""


def claims_of(robot: Robot, options: Options) -> tuple[str, ...]:
    """Where a variable moves several rows, axes belong to these and not to joints."""
    return ("names",) if robot.coupled else ("names", "of-its-joint")


class Facts(PageFacts):
    vectors: tuple[Phrase, ...]  # what is read off the poses
    beside: tuple[Phrase, ...]  # of axes that are those of no frame


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """z and o (3 by 1 each, base frame) of each joint: the third columns of the poses are the axes, the
    fourth their points (Spong et al., section 4.6).

    Raises NotDerivable where a row is asked for that the arm does not have."""
    found, rows = chain_of(problem), len(robot.links)
    last = options.to or rows
    to = None if last == rows or found.coupling else options.to
    work = Work(problem).resting_on(problem.ask("forward-kinematics", to=to))
    axes = axis_lines(Work(problem), found, to)
    if found.coupling:
        axes = motion_lines(axes, found.coupling)
    results = {s.name: problem.final(s.result) for s in axes.steps if s.rule != "law"}
    work = pose_lines(work, found, to - 1 if to else rows).step(*axes.steps)
    work = work.knowing({pose_name(i): problem.readable_matrix(found.T[i]) for i in range(1, last + 1)})
    columns = {name: value for name, value in results.items() if name[0] in "zo"}
    for i in range(1, last):
        told = columns if i == 1 else {}  # all of them once, as they are printed
        ours = partial(_told, found.T[i], told)
        other = partial(_composed, oracle_of(problem), i, tuple(told))
        work = work.agrees("poses-composed", problem.symbols, ours, other, frame=i)
    if not found.coupling:
        named = [step.chain[0] for step in axes.steps]
        work = work.claim(route("of-its-joint", _of_its_joint(problem, named, last)))
    work = by_index(work, results)
    vectors = [step.chain[0] for step in axes.steps if step.rule == "extract"]
    aside = [name for name in vectors if text(name)[0] in "kp"]
    own, ways = [name for name in vectors if name not in aside], _ways(found, aside)
    beside = _together(aside) if found.coupling else tuple(_lying(problem.subject, *way) for way in ways)
    if ways:
        work = work.claim(route("along", _are_along(problem, beside)))
    facts = Facts(vectors=said_of_each(VECTORS, own), beside=beside)
    return work.answer("joint-axes", results, facts, unread=LINKS_ALONE)


def _together(names: Sequence[Expr]) -> tuple[Phrase, ...]:
    """What directions and points of axes are called, of joints that are coupled."""
    return (Phrase("beside", {"vectors": said_of_each(VECTORS, names)}),) if names else ()


def _ways(found: Chain, names: Sequence[Expr]) -> list[tuple[int, str]]:
    """The joints that have a direction and a point of their own, each with the axis of the frame before that
    its axis is along, "" where it is along none or that frame is moved with the base."""
    ways = []
    for i in () if found.coupling else (int(text(name).removeprefix("k_")) for name in names[::2]):
        joint = found.joint(i)
        way = (rotation_part(joint.before) @ joint.axis).entries
        along = (letter for letter, part in zip("xyz", way, strict=True) if part == 1 and i > 1)
        ways.append((i, next(along, "") if joint.type != "helical" else ""))
    return ways


def _lying(robot: Robot, i: int, letter: str) -> Phrase:
    """Where the axis of a joint lies that is that of no frame."""
    about: dict[str, Said] = {"joint": i, "k": Symbol(f"k_{i}"), "p": Symbol(f"p_{i}")}
    if not letter:
        return Phrase("axis-beside" if i > 1 else "axis-beside-base", about)
    sort = "axis-slides" if robot.links[i - 1].joint == "prismatic" else "axis-turns"
    return Phrase(sort, {**about, "letter": Symbol(letter), "frame": i - 1})


def _are_along(problem: Problem, told: Sequence[Phrase]) -> Iterator[bool]:
    """Whether what is said of a joint has its number, and axes that are said to be along those of frames are,
    in numbers."""
    import numpy as np

    for about in (each.about for each in told):
        yield (about["k"], about["p"]) == symbols(f"k_{about['joint']} p_{about['joint']}")
    for point in islice(random_points(problem.symbols, TRIES), POINTS):
        arm = Instant(oracle_of(problem), completed(point, problem.where))
        poses = arm.oracle.poses(arm.at)
        for about in (each.about for each in told):
            match about.get("joint"), about.get("letter"), about.get("frame"):
                case int(i), Symbol(letter), int(frame):
                    k = arm.axis(i)
                    yield close(k / np.linalg.norm(k), poses[frame][:3, "xyz".index(letter)])


def _of_its_joint(problem: Problem, named: Sequence[Expr], last: int) -> Iterator[bool]:
    """Whether the axes and points that are told are those of the joints, by what they are called, in any arm
    of this sort."""
    robot = problem.subject
    rows = [i for i, link in enumerate(robot.links[:last], 1) if link.variable]
    lines = [*zip(map(text, named[::2]), map(text, named[1::2]), strict=True)]
    for point in islice(random_points(problem.symbols, TRIES), POINTS):
        arm = Instant(Astray(robot, problem.where), completed(point, problem.where))
        fits = [[_is_of_joint(arm, i, *line) for line in lines] for i in rows]
        yield from map(any, (*fits, *zip(*fits, strict=True)))


def _is_of_joint(arm: Instant, i: int, axis: str, o: str) -> bool:
    """z_k is an axis of frame k and o_k its origin; k_i and p_i are numbered by the row of the joint."""
    import numpy as np

    letter, number = axis.split("_")
    if letter == "k":
        return o == f"p_{i}" and int(number) == i
    T, k = arm.oracle.poses(arm.at)[int(number)], arm.axis(i)
    own = close(k / np.linalg.norm(k), T[:3, 2]) and close(arm.on_axis(i, [*T[:3, 3]]), T[:3, 3])
    return own and o == f"o_{number}"


def _told(T: ScalarMatrix, columns: Mapping[str, Expr], at: Point) -> list[Any]:
    return [numbers(T, at), *(numbers(column, at) for column in columns.values())]


def _composed(oracle: Oracle, i: int, columns: tuple[str, ...], at: Point) -> list[Any]:
    """The pose of frame i, and z_k and o_k of others: their third and fourth columns."""
    poses = oracle.poses(at)
    return [poses[i], *(poses[int(name[2:])][:3, 2 if name[0] == "z" else 3] for name in columns)]
