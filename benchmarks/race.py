"""Peers on cases, each in a process of its own, in turn with `import sympy`."""

from __future__ import annotations

import json
import select
import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from statistics import median

from benchmarks.cases import Case
from benchmarks.peers import Peer

START = 60.0  # seconds that imports may take; they are not counted
LONG = 1.0  # seconds; what takes longer is not repeated
TIMED_IMPORT = "from time import perf_counter as t; a = t(); import sympy; print(t() - a)"


@dataclass(frozen=True, slots=True)
class Cell:
    """One peer on one case: `ratio` to `import sympy`, or `word` why there is none; `value` is the
    number by which answers are compared."""

    ratio: float | None = None
    word: str = ""
    value: float | None = None


def race(
    case: Case, peers: Sequence[Peer], rounds: int, limit: float, say: Callable[[str], None]
) -> dict[str, Cell]:
    """A cell for each peer by its name. The first run says whether there will be more."""
    imports: list[float] = []
    found: dict[str, list[Cell]] = {peer.name: [] for peer in peers}
    for turn in range(rounds):
        imports.append(import_sympy())
        for peer in peers:
            before = found[peer.name]
            if turn and (before[-1].ratio is None or before[-1].ratio > LONG):
                continue
            say(f"{case.letter} {peer.name}, {turn + 1} of {rounds}")
            before.append(once(peer, case, limit))
            imports.append(import_sympy())
    unit = median(imports)
    return {name: _median(cells, unit) for name, cells in found.items()}


def import_sympy() -> float:
    """Seconds of the import alone, in a fresh process."""
    done = subprocess.run([sys.executable, "-c", TIMED_IMPORT], capture_output=True, text=True, check=True)
    return float(done.stdout)


def once(peer: Peer, case: Case, limit: float) -> Cell:
    """One run; `ratio` still in seconds. Killed at the time limit."""
    command = [sys.executable, "-m", "benchmarks.worker", peer.module, case.letter]
    with subprocess.Popen(command, bufsize=0, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as process:
        try:
            return _read(_lines(process, (START, limit, limit)), limit)
        finally:
            process.kill()


def _lines(process: subprocess.Popen[bytes], waits: Sequence[float]) -> Iterator[dict[str, object]]:
    """What the worker says, each line within its time; `late` where it says nothing, `failed` at its end."""
    assert process.stdout is not None
    for wait in waits:
        ready, _, _ = select.select([process.stdout], [], [], wait)
        line = process.stdout.readline() if ready else None
        yield {"late": True} if line is None else json.loads(line) if line else {"failed": True}


def _read(lines: Iterator[dict[str, object]], limit: float) -> Cell:
    first = next(lines)
    if "missing" in first:
        return Cell(word="not installed")
    if "ready" not in first:
        return Cell(word="failed")
    second = next(lines)
    if "cannot" in second:
        return Cell(word="no")
    if "late" in second:
        return Cell(word=f"> {limit:g} s")
    if "seconds" not in second:
        return Cell(word="failed")
    value = next(lines).get("value")
    return Cell(float(str(second["seconds"])), value=value if isinstance(value, float) else None)


def _median(cells: Sequence[Cell], unit: float) -> Cell:
    times = [cell.ratio for cell in cells if cell.ratio is not None]
    return Cell(median(times) / unit, value=cells[0].value) if times else cells[0]
