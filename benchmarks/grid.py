"""Every arm by every question: `python3 -m benchmarks.grid [--arms SUB] [--kinds SUB]`.

Each question has a process of its own, with a limit of processor time and of memory. It is asked in letters,
and where that is refused at a point.
"""

from __future__ import annotations

import json
import random
import resource
import signal
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from multiprocessing import get_context
from multiprocessing.connection import Connection
from pathlib import Path
from tempfile import TemporaryDirectory
from time import process_time
from typing import Any

import click

from benchmarks.arms import ARMS, ORIENTATION, POINT, POSE, Arm, V, W
from derive.__main__ import keep_to_one_thread
from derive.errors import SheetError
from derive.mechanics.robot import Robot

KINDS = (
    "inverse-kinematics", "singularities", "inverse-velocity", "workspace", "regressor", "forward-dynamics",
    "operational-space-inertia",
)  # fmt: skip
HEAVY = KINDS[4:]
NO_NUMBERS = ("singularities",)  # what takes no `evaluate`
SECONDS, BYTES = 10, 10**9
WORDS = 9  # of a refusal
OURS = "please report"  # how the hint of a fault of ours begins
LOADED = ("derive.jobs.one", "derive.mechanics.oracle", "derive.render.skin", "numpy")


@click.command()
@click.option("--arms", default="", help="Those whose name holds this.")
@click.option("--kinds", default="", help="Likewise of the questions.")
@click.option("--jobs", default=1, show_default=True, help="Processes at a time.")
def main(arms: str, kinds: str, jobs: int) -> None:
    """What is answered, as a table."""
    keep_to_one_thread()
    asked = [kind for kind in KINDS if kinds in kind]
    chosen = [arm for arm in ARMS if arms in arm.name]
    print("\n".join(_row(cells) for cells in (["arm", *asked], ["---"] * (len(asked) + 1))), flush=True)
    with ThreadPoolExecutor(jobs) as pool:
        found = pool.map(lambda pair: cell(*pair), ((arm, kind) for arm in chosen for kind in asked))
        for arm in chosen:
            print(_row([arm.name, *(next(found) for _ in asked)]), flush=True)


def _row(cells: list[str]) -> str:
    return "| " + " | ".join(cells) + " |"


def cell(arm: Arm, kind: str) -> str:
    """What came of a question, and the seconds of processor time that it took."""
    context = get_context("forkserver")
    context.set_forkserver_preload(list(LOADED))
    here, there = context.Pipe(duplex=False)
    worker = context.Process(target=_work, args=(arm, kind, there))
    worker.start()
    there.close()
    try:
        return str(here.recv())
    except EOFError:
        worker.join()
        return f"stopped: {_reason(-(worker.exitcode or 0))}"


def _reason(number: int) -> str:
    return {signal.SIGXCPU: f"{SECONDS} s", signal.SIGABRT: f"{BYTES:.0e} bytes"}.get(
        number, f"signal {number}"
    )


def _work(arm: Arm, kind: str, there: Connection) -> None:
    begun = process_time()
    resource.setrlimit(resource.RLIMIT_CPU, (int(begun) + SECONDS, int(begun) + SECONDS + 1))
    resource.setrlimit(resource.RLIMIT_DATA, (BYTES, BYTES))
    try:
        said = _asked(arm, kind)
    except MemoryError:
        said = f"stopped: {BYTES:.0e} bytes"
    there.send(f"{said} {process_time() - begun:.1f}")


def _asked(arm: Arm, kind: str) -> str:
    """In letters, then at a point."""
    first = _refusal(sheet(arm, kind))
    if not first:
        return "answered"
    if _is_ours(first) or kind in NO_NUMBERS:
        return _told(first)
    second = _refusal(sheet(arm, kind, {name: round(v, 12) for name, v in values(arm, kind)}))
    return _told(second) if second else "at a point"


def _told(fault: SheetError) -> str:
    words = fault.message.replace("|", "/").split()
    more = " ..." if len(words) > WORDS else ""
    return f"{'failed' if _is_ours(fault) else 'refused'}: {' '.join(words[:WORDS])}{more}"


def _is_ours(fault: SheetError) -> bool:
    return (fault.hint or "").startswith(OURS)


def _refusal(described: dict[str, Any]) -> SheetError | None:
    """Why the sheet has no page and no JSON."""
    from derive.jobs.one import done
    from derive.jobs.wanted import Task, Wanted

    with TemporaryDirectory() as folder:
        path = Path(folder) / "sheet.yaml"
        path.write_text(json.dumps(described), encoding="utf-8")
        outcome = done(Task("build", path), Wanted(("md", "json")), None, lambda _: None)
    return outcome.accident or next(iter((*outcome.faults, *outcome.made.faults)), None)


def sheet(arm: Arm, kind: str, at: dict[str, float] | None = None) -> dict[str, Any]:
    """A question about an arm, with bodies where they count."""
    robot: dict[str, Any] = {"convention": arm.convention, "links": list(arm.links())}
    if arm.tool:
        robot["tool"] = list(arm.tool)
    if kind in HEAVY:
        robot["gravity"] = list(arm.gravity)
        robot["links"] = [{**link, **_body(i)} for i, link in enumerate(robot["links"], 1)]
    asked: dict[str, Any] = {"find": kind}
    if kind == "inverse-kinematics":
        asked |= {"given": arm.given, **({"free": arm.free} if arm.free else {})}
    if arm.rows and kind in ("singularities", "inverse-velocity", "operational-space-inertia"):
        asked["rows"] = arm.rows
    return {"title": arm.name, "problems": [{"robot": robot, **asked, **({"evaluate": at} if at else {})}]}


def _body(i: int) -> dict[str, Any]:
    return {
        "mass": f"m{i}",
        "com": [f"x{i}", f"y{i}", f"z{i}"],
        "inertia": [f"{j}{i}" for j in ("Ix", "Iy", "Iz")],
    }


def robot_of(arm: Arm, kind: str) -> Robot:
    """The arm as it is read."""
    from derive.sheet.load import sheet_of
    from derive.sheet.reader import read_text
    from derive.sheet.source import At

    subject = sheet_of(At(read_text(json.dumps(sheet(arm, kind)), Path("sheet.yaml")))).problems[0].subject
    assert isinstance(subject, Robot)
    return subject


def values(arm: Arm, kind: str) -> Iterator[tuple[str, float]]:
    """A value for every name that the answer can hold."""
    from derive.expression import free_symbols
    from derive.kinds.problem import expressions
    from derive.mechanics.oracle import Oracle

    robot = robot_of(arm, kind)
    draw = random.Random(arm.name)
    letters = sorted(
        {name for tree in expressions(robot) for name in free_symbols(tree)} - {*robot.variables}
    )
    at = {name: draw.uniform(0.2, 0.9) for name in letters}
    q = {name: draw.uniform(0.3, 1.2) for name in robot.variables}
    n = range(1, len(robot.variables) + 1)
    yield from at.items()
    match kind:
        case "inverse-kinematics":
            T = Oracle(robot, {}).tool({**at, **q})
            places = {name: (i, 3) for i, name in enumerate(POINT)} if arm.given != ORIENTATION else {}
            if arm.given in (POSE, ORIENTATION):
                places |= {f"r{i + 1}{j + 1}": (i, j) for i in range(3) for j in range(3)}
            yield from ((name, float(T[i, j])) for name, (i, j) in places.items())
            yield from ((name, q.get(name, 0.5)) for name in arm.free)
        case "inverse-velocity":
            yield from q.items()
            yield from ((name, draw.uniform(-1, 1)) for name in arm.rows or (*V, *W))
        case "forward-dynamics" | "regressor":
            yield from q.items()
            yield from ((f"{name}_dot", draw.uniform(-1, 1)) for name in q)
            yield from (
                ((f"tau_{i}", 1.0) for i in n)
                if kind == "forward-dynamics"
                else ((f"{name}_ddot", draw.uniform(-1, 1)) for name in q)
            )
        case "operational-space-inertia":
            yield from q.items()


if __name__ == "__main__":
    main()
