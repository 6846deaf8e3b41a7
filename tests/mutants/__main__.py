"""`python -m tests.mutants` plants mistakes; `python -m tests.mutants lines` wrong signs into lines, and the
same with `sentences` and with `tables`."""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Iterable
from functools import partial
from multiprocessing import get_context
from pathlib import Path
from typing import TypeVar

from tests.mutants.lines import Line, drawn, lines_of, outcome
from tests.mutants.operators import STRATA, WORDS, Mutant
from tests.mutants.said import MADE
from tests.mutants.trial import MOST, Ground, sample, tried
from tests.mutants.units import Lines, Page, Refused, Unit, forked, reached, units, warmed
from tests.mutants.verdict import DANGEROUS, ORDER, Verdict

SLOW = 120.0  # seconds, of a build that is watched line by line
Tried = tuple[Mutant, Verdict, list[str]]
T = TypeVar("T")
R = TypeVar("R")


def ground(folder: Path, part: str = "", jobs: int = 1) -> Ground:
    """Every problem built once, without a mistake; of some sheets, those with a part in their name."""
    pages, lines = {}, {}
    for unit, found in each_of([unit for unit in units(folder) if part in str(unit)], _reached, jobs):
        if found and isinstance(found[0], Page):
            pages[unit], lines[unit] = found[0], found[1]
        else:
            print(f"{unit} is left out: {found and found[0]}", file=sys.stderr)
    order = sorted(pages, key=str)
    return Ground({unit: pages[unit] for unit in order}, {unit: lines[unit] for unit in order})


def _reached(unit: Unit) -> tuple[Unit, tuple[Page | Refused, Lines] | None]:
    return unit, forked(partial(reached, unit), SLOW)


def _among(parts: str, name: str) -> bool:
    return any(part in name for part in parts.split(","))


def main() -> None:
    """Plants, prints what survives as it is found, then a table; `--report` keeps both with every mutant."""
    parser = argparse.ArgumentParser(prog="python -m tests.mutants", description=__doc__)
    parser.add_argument("what", nargs="?", choices=["code", *MADE], default="code")
    parser.add_argument("--count", type=int, default=500, help="mistakes in all")
    parser.add_argument("--each", type=int, default=6, help="of each module")
    parser.add_argument("--most", type=int, default=MOST, help="problems that are built for one mistake")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--only", default="", help="strata, parts of paths or of modules, with commas")
    parser.add_argument("--sheets", default="", help="a part of the names of the problems to build")
    parser.add_argument("--report", type=Path)
    asked = parser.parse_args()
    begun = time.monotonic()
    warmed()
    with tempfile.TemporaryDirectory() as folder:
        field = ground(Path(folder), asked.sheets, asked.jobs)
        print(f"{len(field.pages)} problems, {time.monotonic() - begun:.0f} s", file=sys.stderr, flush=True)
        report = (_lines if asked.what in MADE else _mutants)(field, asked)
    report = f"{report}\n\nseed {asked.seed}, {time.monotonic() - begun:.0f} s\n"
    if asked.report:
        asked.report.write_text(report, encoding="utf-8")


def _mutants(field: Ground, asked: argparse.Namespace) -> str:
    where = (m for m in sample(field, asked.seed) if _among(asked.only, f"{m.stratum} {m.path}"))
    some = [mutant for mutant, _ in zip(where, range(asked.count), strict=False)]
    found: list[Tried] = []
    for each in each_of(some, partial(_mutant, field, asked.seed, asked.most), asked.jobs):
        found.append(each)
        if each[1].kind in DANGEROUS:
            print(told(each), flush=True)
    print(table(found))
    survivors = "\n\n".join(told(each) for each in found if each[1].kind in DANGEROUS)
    every = "\n".join(f"{each[1].kind:<8} {each[0]}" for each in found)
    return f"{table(found)}\n\n{survivors}\n\n{every}"


def _mutant(field: Ground, seed: int, most: int, mutant: Mutant) -> Tried:
    found, on = tried(field, mutant, seed, most)
    return mutant, found, [str(unit) for unit in on]


def _lines(field: Ground, asked: argparse.Namespace) -> str:
    made = [
        line
        for lines in each_of(list(field.pages), partial(_lines_of, asked.what), asked.jobs)
        for line in lines
    ]
    some = drawn([line for line in made if _among(asked.only, line.module)], asked.each, asked.seed)
    found = list(each_of(some, partial(_line, field), asked.jobs))
    count = Counter(kind for _, kind in found)
    told = [f"{kind:<16} {line}" for line, kind in found]
    for line in told:
        if line.startswith("printed"):
            print(line)
    whole = f"{len(made)} {asked.what}, {len(found)} tried: " + ", ".join(
        f"{n} {k}" for k, n in count.most_common()
    )
    print(whole)
    return "\n".join([whole, *sorted(told)])


def _lines_of(what: str, unit: Unit) -> list[Line]:
    return forked(partial(lines_of, what, unit), SLOW) or []


def _line(field: Ground, line: Line) -> tuple[Line, str]:
    return line, outcome(line, field.pages[line.unit])


_work: Callable[..., object]


def each_of(items: list[T], work: Callable[[T], R], jobs: int) -> Iterable[R]:
    """The work done on every item in so many processes, in any order."""
    global _work
    _work = work
    with get_context("fork").Pool(jobs) as pool:
        yield from pool.imap_unordered(_do, items)


def _do(item: object) -> object:
    return _work(item)


def told(each: Tried) -> str:
    """A survivor, where it was built, and what shows that it is wrong."""
    mutant, found, on = each
    return f"{found.kind.upper()}  {mutant}\n  on {', '.join(on)}\n  " + found.shown.replace("\n", "\n  ")


def table(found: list[Tried]) -> str:
    """How many of each stratum came out how."""
    lines = ["".join(f"{name:>10}" for name in ("", "n", *ORDER))]
    for stratum in (*STRATA, WORDS, "all"):
        counts = Counter(verdict.kind for m, verdict, _ in found if stratum in (m.stratum, "all"))
        cells = (stratum, counts.total(), *(counts[kind] for kind in ORDER))
        lines.append("".join(f"{cell:>10}" for cell in cells))
    return "\n".join(lines)


if __name__ == "__main__":
    main()
