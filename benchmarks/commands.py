"""Whole commands, from the shell to the files on disk."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from time import perf_counter

from benchmarks.cases import SHEETS

ROOT = Path(__file__).parent.parent
EXERCISES = ROOT / "exercises"
LIMIT = 60.0  # seconds
DERIVE = "from derive.__main__ import main; main()"


@dataclass(frozen=True, slots=True)
class Command:
    """What is typed after `derive`, and the ratio that is the aim (None: none is set).

    With `again` it was typed before, and nothing has changed since; else nothing is known of earlier builds.
    `copies` are sheets that differ in their titles only.
    """

    title: str
    sheets: tuple[Path, ...] = ()
    options: str = ""
    aim: float | None = None
    again: bool = False
    copies: int = 0


TWO, ONE = (f"all exercise sheets to Markdown and LaTeX, {how}" for how in ("two at a time", "one at a time"))
COMMANDS = (
    Command("derive --version", options="--version", aim=0.3),
    Command("PUMA 560 to JSON, every c_ijk", (SHEETS / "puma.yaml",), "--format json", 6.0),
    Command("7R pose and Jacobian to JSON", (SHEETS / "seven-joints.yaml",), "--format json", 3.0),
    Command("week6 to Markdown and LaTeX", (EXERCISES / "week6.yaml",), "--format md,tex"),
    Command("week3 to Markdown", (EXERCISES / "week3.yaml",), "--format md"),
    Command("week3 to Markdown and PDF: at most 0.3 more", (EXERCISES / "week3.yaml",), "--format md,pdf"),
    Command(
        "week3 to Markdown and PDF, unchanged", (EXERCISES / "week3.yaml",), "--format md,pdf", 0.4, True
    ),
    Command("100 sheets to Markdown and LaTeX, unchanged", (), "--format md,tex", 1.0, True, 100),
    Command(ONE, (EXERCISES,), "--format md,tex --jobs 1"),
    Command(TWO, (EXERCISES,), "--format md,tex --jobs 2"),
    Command("all exercise sheets to PDF", (EXERCISES,), "--format pdf"),
    Command("all exercise sheets to Markdown, LaTeX and PDF", (EXERCISES,), "--format md,tex,pdf"),
    Command("week6 to JSON, audited by SymPy", (EXERCISES / "week6.yaml",), "--format json --audit", 10.0),
    Command(f"all exercise sheets, audited, in {LIMIT:.0f} s", (EXERCISES,), "--format json --audit"),
)


def time_commands(rounds: int, say: Callable[[str], None]) -> dict[Command, float | None]:
    """Medians as ratios to a process that only imports SymPy; None for one that fails or hangs."""
    imports: list[float] = []
    found: dict[Command, list[float | None]] = {command: [] for command in COMMANDS}
    for turn in range(rounds):
        for command in COMMANDS:
            say(f"{command.title}, {turn + 1} of {rounds}")
            imports.append(_timed(["-c", "import sympy"]) or 0.0)
            found[command].append(_derive(command))
    return {command: _ratio(times, median(imports)) for command, times in found.items()}


def _derive(command: Command) -> float | None:
    with TemporaryDirectory() as folder:
        typed = [
            *map(str, (*command.sheets, *_copies(command.copies, Path(folder)))),
            *command.options.split(),
        ]
        if typed != ["--version"]:
            typed += ["--output", f"{folder}/output"]
        known = {"DERIVE_CACHE": f"{folder}/cache"}
        if command.again and _timed(["-c", DERIVE, *typed], known) is None:
            return None
        return _timed(["-c", DERIVE, *typed], known)


def _copies(count: int, folder: Path) -> Iterator[Path]:
    """Sheets that differ in their titles."""
    text = (EXERCISES / "rotation-vector.yaml").read_text(encoding="utf-8")
    for number in range(count):
        path = folder / f"copy{number}.yaml"
        path.write_text(text.replace("title: ", f"title: {number} ", 1), encoding="utf-8")
        yield path


def faster(commands: Mapping[Command, float | None]) -> float | None:
    """How many times as fast two processes are as one; None where that was not measured."""
    found = {command.title: ratio for command, ratio in commands.items()}
    one, two = found.get(ONE), found.get(TWO)
    return one / two if one and two else None


def _timed(arguments: list[str], more: Mapping[str, str] | None = None) -> float | None:
    environment = {**os.environ, **(more or {})}
    start = perf_counter()
    try:
        subprocess.run(
            [sys.executable, *arguments],
            cwd=ROOT,
            env=environment,
            capture_output=True,
            check=True,
            timeout=LIMIT,
        )
    except (subprocess.CalledProcessError, subprocess.TimeoutExpired):
        return None
    return perf_counter() - start


def _ratio(times: list[float | None], unit: float) -> float | None:
    good = [seconds for seconds in times if seconds is not None]
    return median(good) / unit if len(good) == len(times) else None
