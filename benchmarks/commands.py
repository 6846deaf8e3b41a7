"""Whole commands, from the shell to the files on disk."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from time import perf_counter

from benchmarks.cases import SHEETS

ROOT = Path(__file__).parent.parent
EXERCISES = ROOT / "exercises"
LIMIT = 60.0  # seconds
DERIVE = "from derive.cli import main; main()"


@dataclass(frozen=True, slots=True)
class Command:
    """What is typed after `derive`, and the ratio that is the aim (None: none is set)."""

    title: str
    sheets: tuple[Path, ...]
    formats: str
    aim: float | None = None
    audit: bool = False


COMMANDS = (
    Command("PUMA 560 to JSON, every c_ijk", (SHEETS / "puma.yaml",), "json", 6.0),
    Command("7R pose and Jacobian to JSON", (SHEETS / "seven-joints.yaml",), "json", 3.0),
    Command("week6 to Markdown and LaTeX", (EXERCISES / "week6.yaml",), "md,tex"),
    Command("week3 to Markdown", (EXERCISES / "week3.yaml",), "md"),
    Command("week3 to Markdown and PDF: at most 0.3 more", (EXERCISES / "week3.yaml",), "md,pdf"),
    Command("all exercise sheets to PDF", (EXERCISES,), "pdf"),
    Command("all exercise sheets to Markdown, LaTeX and PDF", (EXERCISES,), "md,tex,pdf"),
    Command("week6 to JSON, audited by SymPy", (EXERCISES / "week6.yaml",), "json", 10.0, audit=True),
    Command(f"all exercise sheets, audited, in {LIMIT:.0f} s", (EXERCISES,), "json", audit=True),
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
        typed = [*map(str, command.sheets), "--format", command.formats, "--output", folder]
        typed += ["--audit"] * command.audit
        return _timed(["-c", DERIVE, *typed])


def _timed(arguments: list[str]) -> float | None:
    start = perf_counter()
    try:
        subprocess.run([sys.executable, *arguments], cwd=ROOT, capture_output=True, check=True, timeout=LIMIT)
    except (subprocess.CalledProcessError, subprocess.TimeoutExpired):
        return None
    return perf_counter() - start


def _ratio(times: list[float | None], unit: float) -> float | None:
    good = [seconds for seconds in times if seconds is not None]
    return median(good) / unit if len(good) == len(times) else None
