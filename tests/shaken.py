"""Every exercise and every example with its numbers changed at random: does it still build?

What comes of it may be refused, as out of reach or unstable, but not by a check of ours: then an answer or a
check is wrong. `python -m tests.shaken --rounds 2 --seed 1` prints those that fail.
"""

from __future__ import annotations

import argparse
import random
import re
import shutil
import tempfile
from collections import Counter
from collections.abc import Iterator
from functools import partial
from pathlib import Path

from derive.errors import SheetErrors
from derive.sheet.load import load_sheet
from tests.mutants.__main__ import each_of
from tests.mutants.units import Refused, Unit, built, forked, units, warmed
from tests.sheets import ROOT

UNITS = "mm|m|deg|kg|s|N|rad|V|A|ohm|H"
NUMBER = re.compile(rf"(?<![\w.^*/\[-])(-?)(\d+\.\d+|\d+(?=\s*(?:{UNITS})\b))")
KEPT, TURNED = 0.35, 0.06  # shares of the numbers
SPANS = ((0.5, 1.7), (0.8, 1.25), (0.95, 1.05))
SLOW = 60.0  # seconds of one problem


def shaken(text: str, roll: random.Random) -> str:
    """A sheet with most of its decimals, and of its numbers with a unit, changed."""

    def change(found: re.Match[str]) -> str:
        sign, size = found.groups()
        if roll.random() < KEPT:
            return found[0]
        changed = f"{float(size) * roll.uniform(*roll.choice(SPANS)):.{roll.choice((2, 3))}g}"
        if roll.random() < TURNED:
            sign = "" if sign else "-"
        return found[0] if "e" in changed else f"{sign}{float(changed):g}"

    return NUMBER.sub(change, text)


def shaken_units(folder: Path, seed: int, rounds: int) -> Iterator[Unit]:
    """The problems of the sheets that can still be read, which are written to a folder."""
    shutil.copytree(ROOT / "exercises" / "robots", folder / "robots")
    sheets = sorted({unit.sheet for unit in units(folder)})
    for k in range(rounds):
        roll = random.Random(f"{seed}.{k}")
        for sheet in sheets:
            path = folder / f"{sheet.stem}-{k}.yaml"
            path.write_text(shaken(sheet.read_text(encoding="utf-8"), roll), encoding="utf-8")
            try:
                count = len(load_sheet(path).problems)
            except SheetErrors:
                continue
            yield from (Unit(path, i) for i in range(count))


def failed(unit: Unit) -> str:
    """What went wrong in a problem; nothing where it was built, or refused as it should be."""
    found = forked(partial(built, unit), SLOW)
    if found is None:
        return f"it takes more than {SLOW:.0f} s"
    wrong = isinstance(found, Refused) and (found.failed or found.crash)
    return found.message if wrong else ""


def _failed(unit: Unit) -> tuple[Unit, str]:
    return unit, failed(unit)


def main() -> None:
    """Prints what fails, and leaves its sheets where it says."""
    parser = argparse.ArgumentParser(prog="python -m tests.shaken", description=__doc__)
    parser.add_argument("--rounds", type=int, default=1, help="sheets made of each")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2)
    asked = parser.parse_args()
    warmed()
    folder = Path(tempfile.mkdtemp())
    count = Counter[bool]()
    for unit, message in each_of([*shaken_units(folder, asked.seed, asked.rounds)], _failed, asked.jobs):
        count[bool(message)] += 1
        if message:
            print(f"{unit.sheet}, problem {unit.problem + 1}: {message}", flush=True)
    print(f"{count.total()} problems, {count[True]} failed")


if __name__ == "__main__":
    main()
