"""One wrong sign in one printed line, sentence or table of a derivation: who sees it?

Every step of every problem is counted where it is made, as is every phrase and every table; some of those of
each module are drawn, and each gets one wrong sign, nothing else.
"""

from __future__ import annotations

import random
import sys
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from inspect import signature
from typing import Any

import pytest

from tests.mutants.said import MADE
from tests.mutants.units import Page, Refused, Unit, built, forked
from tests.mutants.verdict import FOOT, verdict

SHARED = (
    "derive.kinds.work",
    "derive.kinds.chains",
    "derive.derivation",
    "dataclasses",
)  # make steps for others


@dataclass(frozen=True, slots=True)
class Line:
    """A step, a phrase or a table (`what`) of a problem with one place that is wrong, by its number among
    those that can be made; its module and its name."""

    unit: Unit
    number: int
    module: str
    name: str
    what: str

    def __str__(self) -> str:
        return f"{self.unit}  {self.module}  {self.name}"


@contextmanager
def _made(what: str, met: list[tuple[str, str]], wrong_at: int = -1) -> Iterator[None]:
    """Wrong versions are counted as the right ones are made; one takes the place of its own."""
    kind, versions = MADE[what]
    make: Any = kind.__init__
    taken = signature(make)

    def noted(*args: Any, **more: Any) -> None:
        asked = taken.bind(*args, **more)
        for name, field, wrong in [*versions(asked.arguments)]:
            if len(met) == wrong_at:
                asked.arguments[field] = wrong
            met.append((_module(), name))
        make(*asked.args, **asked.kwargs)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(kind, "__init__", noted)
        yield


def _module() -> str:
    """The one that makes a step, and none of those through which all make theirs."""
    frame = sys._getframe(2)
    while frame.f_back and frame.f_globals.get("__name__", "").startswith(SHARED):
        frame = frame.f_back
    return str(frame.f_globals.get("__name__"))


def lines_of(what: str, unit: Unit) -> list[Line]:
    """All that are made for a problem and can be wrong."""
    met: list[tuple[str, str]] = []
    with _made(what, met):
        built(unit)
    return [Line(unit, number, module, name, what) for number, (module, name) in enumerate(met)]


def drawn(lines: list[Line], each: int, seed: int) -> list[Line]:
    """So many lines of every module, not two of one name while there are others."""
    draw = random.Random(seed)
    found: list[Line] = []
    lines = sorted(lines, key=str)
    for module in sorted({line.module for line in lines}):
        own = [line for line in lines if line.module == module]
        draw.shuffle(own)
        rank: dict[Line, int] = {}
        count = Counter[str]()
        for line in own:
            rank[line] = count[line.name]
            count[line.name] += 1
        found += sorted(own, key=rank.__getitem__)[:each]
    return found


def outcome(line: Line, right: Page) -> str:
    """`refused`, `not on the page`, or `printed`; with `json` where a result is wrong too."""
    found = forked(partial(_with, line))
    if not isinstance(found, Page):
        return "crash" if isinstance(found, Refused) and found.crash else "refused"
    if FOOT.sub("", found.text) == FOOT.sub("", right.text) and found.results == right.results:
        return "not on the page"
    return "printed, json" if verdict(right, found).kind == "wrong" else "printed"


def _with(line: Line) -> Page | Refused:
    with _made(line.what, [], line.number):
        return built(line.unit)
