"""What is given of an arm: its rows or screws, and where dynamics is asked for its bodies and gravity."""

from __future__ import annotations

from collections.abc import Iterator

from derive.algebra.formulas.with_units import measured, unit_of
from derive.derivation import Cell, Phrase, Table
from derive.expression import ZERO, Degrees, number
from derive.given.bodies import bodies
from derive.given.datum import Datum, as_typed, vector
from derive.given.moves import axis_said, moved
from derive.given.screws_held import Misgiven, held
from derive.kinds.problem import Problem, expressions
from derive.kinds.robot._ranges import ranges_told
from derive.kinds.robot._rows.dh_rows import Rows
from derive.mechanics.frames import ByMatrix
from derive.mechanics.motion import Motion
from derive.mechanics.robot import DHRow, FreeRow, Link, Robot, ScrewRow
from derive.mechanics.screws import screw_form

TABLES = ("denavit|dh",)  # where other rows stand beside it, the numbers of a table alone do not say it


def data(robot: Robot, problem: Problem) -> Iterator[Datum]:
    """The chain from base to end-effector, then what it carries. Raises Misgiven."""
    if _asked_for_rows(robot, problem):
        unit = next(filter(None, map(unit_of, expressions(robot))), "")
        yield from _screws(held(screw_form(robot, problem.readable), problem), unit)
    elif robot.by_screws:
        yield from _screws(robot)
    else:
        yield from _rows(robot)
    yield from _ranges(robot)
    yield from bodies(robot, problem)


def _ranges(robot: Robot) -> Iterator[Datum]:
    """The limits of the joints, each as low <= variable <= high."""
    if limits := ranges_told(robot):
        yield Datum(Phrase("ranges" if len(limits) > 1 else "one-range", {"ranges": limits}))


def _asked_for_rows(robot: Robot, problem: Problem) -> bool:
    """Whether its link parameters are what a question wants to be found."""
    if not all(isinstance(link.row, DHRow) for link in robot.links):
        return False
    wanted = [options.convention for kind, options in problem.questions if kind == "dh-table"]
    return any(convention in (None, robot.convention) for convention in wanted)


def _rows(robot: Robot) -> Iterator[Datum]:
    """The link parameters, the moves of the base, of rows of another form, of the tool. Raises Misgiven."""
    if robot.base:
        yield moved("base", robot.base)
    kept = [(i, link, link.row) for i, link in enumerate(robot.links, 1) if isinstance(link.row, DHRow)]
    if kept:
        rows = Rows(
            robot.convention,
            tuple(row for _, _, row in kept),
            tuple(link.variable for _, link, _ in kept),
            tuple(link.joint for _, link, _ in kept),
        )
        table = rows.table()
        if not rows.as_listed(table).holds:
            raise Misgiven("the table has not the columns of its convention, or other rows")
        lines = tuple(
            (str(i), *(ZERO if entry == Degrees(ZERO.value) else entry for entry in line[1:]))
            for (i, _, _), line in zip(kept, table.rows, strict=True)
        )
        mixed = len(kept) < len(robot.links)
        yield Datum(
            Phrase(f"rows-{robot.convention}"), Table(table.headings, lines), words=TABLES if mixed else ()
        )
    for i, link in enumerate(robot.links, 1):
        if isinstance(link.row, FreeRow):
            frames = {"frame": number(i), "before": number(i - 1)}
            yield moved("free-row" if link.variable else "still-row", link.row.moves, frames, link.variable)
    if robot.tool:
        yield moved("tool", robot.tool)


def _screws(robot: Robot, unit: str = "") -> Iterator[Datum]:
    """The axes of the joints and the pose of the end-effector while all joints are at zero; lengths that were
    found, and not typed, are in `unit`."""
    if robot.base:
        yield moved("base", robot.base)
    pairs = [(link, link.row) for link in robot.links if isinstance(link.row, ScrewRow)]
    helical = any(row.pitch != ZERO for _, row in pairs)
    headings: tuple[Cell, ...] = (
        Phrase("joint"), Phrase("variable"), Phrase("sort"), Phrase("axis-of-joint"), Phrase("point-on-axis"),
    )  # fmt: skip
    lines = tuple(_line(i, link, row, helical, unit) for i, (link, row) in enumerate(pairs, 1))
    yield Datum(Phrase("screws"), Table((*headings, Phrase("pitch")) if helical else headings, lines))
    match robot.home:
        case ByMatrix(matrix, rounded):
            yield Datum(Phrase("home"), equations=((as_typed(matrix, rounded),),))
        case Motion(moves) if moves:
            yield moved("home-moves", moves)
    if robot.tool:
        yield moved("tool", robot.tool)


def _line(i: int, link: Link, row: ScrewRow, helical: bool, unit: str) -> tuple[Cell, ...]:
    cells = (str(i), row.by, Phrase(link.joint), axis_said(row.axis), vector(row.through, unit))
    return (*cells, measured(row.pitch)) if helical else cells
