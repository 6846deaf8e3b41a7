"""The results as a table in the terminal and as a page of the documentation."""

from __future__ import annotations

import platform
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from datetime import date
from importlib.metadata import PackageNotFoundError, version
from typing import TYPE_CHECKING

from benchmarks.cases import Case
from benchmarks.commands import Command, faster
from benchmarks.peers import Peer
from benchmarks.race import Cell

if TYPE_CHECKING:
    from rich.table import Table

AGREE = 1e-6  # relative; trees of thousands of terms lose a few digits in floats
PACKAGES = ("sympy", "python-flint", "symengine", "roboticstoolbox-python", "skidy")


@dataclass(frozen=True, slots=True)
class Results:
    """Everything one run found."""

    peers: tuple[Peer, ...]
    cells: Mapping[Case, Mapping[str, Cell]]
    commands: Mapping[Command, float | None]
    rounds: int
    limit: float
    truths: Mapping[str, float] = field(default_factory=dict)


def tables(results: Results) -> Sequence[Table]:
    """For the terminal."""
    from rich.table import Table

    derivations = Table("in process", *(peer.name for peer in results.peers))
    for case, cells in results.cells.items():
        derivations.add_row(f"{case.letter}  {case.title}", *_texts(results.peers, cells))
    whole = Table("whole command", "derive", "aim")
    for command, ratio in results.commands.items():
        whole.add_row(command.title, *_command_texts(command, ratio))
    truths = Table("truths", "share of a build")
    for truth, share in _with_sum(results.truths):
        truths.add_row(truth, share)
    return [table for table in (derivations, whole, truths) if table.row_count]


def page(results: Results, note: str) -> str:
    """The same in Markdown, with the date and the versions."""
    remarks = [f"- {peer.name}: {peer.remark}." for peer in results.peers if peer.remark]
    parts = [
        "# Benchmarks",
        f"{_circumstances()} {note}".strip(),
        f"Every figure is a ratio to `import sympy` in the same run: {_sample(results.rounds)}, "
        "in turn with the import. In process, only the derivation counts, not imports and not "
        "reading the robot; a first derivation, with no cache filled. What takes longer than the import "
        f"runs once; the time limit is {results.limit:g} s. `python3 -m benchmarks` makes this page again.",
        "## Derivations",
        _rows(
            ("", *(peer.name for peer in results.peers)),
            [(f"{c.letter}. {c.title}", *_texts(results.peers, cells)) for c, cells in results.cells.items()],
        ),
        "Answers are compared at a random point where that takes no longer than the limit; one that differs "
        "from ours is marked *differs*. What is derived is not the same everywhere:",
        "\n".join(remarks),
        "## Whole commands",
        _rows(
            ("", "derive", "aim"),
            [(c.title, *_command_texts(c, ratio)) for c, ratio in results.commands.items()],
        ),
        *_processes(results),
        "## Truths",
        "Their share of the time in which all exercises are built to Markdown, by samples of where it goes.",
        _rows(("", "share"), _with_sum(results.truths)),
    ]
    return "\n\n".join(parts) + "\n"


def _processes(results: Results) -> list[str]:
    """What several processes gain."""
    found = faster(results.commands)
    return [f"Two processes are {figure(found)} times as fast as one."] if found else []


def _with_sum(truths: Mapping[str, float]) -> list[tuple[str, str]]:
    """Shares as texts, and what they add up to."""
    whole = {**truths, "all": sum(truths.values())} if truths else {}
    return [(truth, f"{share:.1%}") for truth, share in whole.items()]


def _sample(rounds: int) -> str:
    return "one fresh process" if rounds == 1 else f"the median of {rounds} fresh processes"


def _texts(peers: Sequence[Peer], cells: Mapping[str, Cell]) -> list[str]:
    ours = cells[peers[0].name].value
    return [_text(cells[peer.name], ours) for peer in peers]


def _text(cell: Cell, ours: float | None) -> str:
    if cell.ratio is None:
        return cell.word
    return figure(cell.ratio) + ("" if _agrees(cell.value, ours) else " differs")


def _agrees(value: float | None, ours: float | None) -> bool:
    """Whether two answers are not known to differ."""
    return value is None or ours is None or abs(value - ours) <= AGREE * max(1.0, abs(ours))


def figure(ratio: float) -> str:
    """Two significant digits: 0.017, 0.42, 3.4, 28."""
    return f"{ratio:.0f}" if ratio >= 10 else f"{ratio:#.2g}"


def _command_texts(command: Command, ratio: float | None) -> tuple[str, str]:
    aim = "" if command.aim is None else f"at most {command.aim:g}"
    return "failed" if ratio is None else figure(ratio), aim


def _rows(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    rule = ["---", *["---:"] * (len(head) - 1)]
    return "\n".join("| " + " | ".join(row) + " |" for row in (head, rule, *rows))


def _circumstances() -> str:
    installed = ", ".join(f"{name} {found}" for name in PACKAGES if (found := _version(name)))
    return f"Measured on {date.today():%d %B %Y} with Python {platform.python_version()}, {installed}."


def _version(package: str) -> str | None:
    try:
        return version(package)
    except PackageNotFoundError:
        return None
