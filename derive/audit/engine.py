"""What is audited, and what came of it: each result as text against what SymPy makes of the subject."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import mpmath
import sympy

from derive.audit.asked import EVALUATED, Asked, Beyond, Holds, Same, Test
from derive.audit.budget import Exhausted, one_answer
from derive.audit.equations import is_system
from derive.audit.points import (
    DIGITS,
    NEAR,
    ROUNDED,
    Irrational,
    Number,
    Point,
    Value,
    agree,
    floating,
    shown,
)
from derive.audit.registry import Auditor, angles_of, auditor
from derive.audit.text import Unreadable

PLACES = 2  # points at which an answer is tried
SEEDS = 8  # drawn at most, where something is divided by zero at some
MARGIN = 15  # digits that are lost on the way


@dataclass(frozen=True, slots=True)
class Audited:
    """Every result is what SymPy finds."""

    results: int


@dataclass(frozen=True, slots=True)
class NotAudited:
    """Nothing can be said, and why."""

    reason: str


@dataclass(frozen=True, slots=True)
class Contradicted:
    """A result, as `C[2][1]` with rows and columns from 1, and what it should be."""

    name: str
    ours: str
    theirs: str


Outcome: TypeAlias = Audited | NotAudited | Contradicted


def audit(asked: Asked) -> Outcome:
    """What SymPy says of an answer. Raises Endless."""
    who = auditor(asked.subject_name, asked.kind)
    if who is None:
        return NotAudited("nobody audits this kind yet")
    try:
        with one_answer(), mpmath.workdps(DIGITS + MARGIN):
            return _judged(asked, who)
    except Exhausted:
        return NotAudited("it is too much work")
    except (Unreadable, NotImplementedError) as reason:
        return NotAudited(str(reason))
    except Exception as accident:  # of an auditor: no answer is refused, or passed, because of it
        return NotAudited(f"the auditor failed ({type(accident).__name__}: {accident})")


def _judged(asked: Asked, who: Auditor) -> Outcome:
    tested: set[str] = set()
    beyond: dict[str, str] = {}
    for point, tests in _places(asked, who):
        for test in tests:
            if isinstance(test, Beyond):
                beyond[test.name] = test.reason
            elif wrong := _wrong(asked, test, point):
                return wrong
            else:
                tested.add(test.name)
    plain = {name for name in asked.evaluated if _plain(asked, name)}
    if wrong := next(_wrong_numbers(asked, (n for n in plain if EVALUATED + n not in tested)), None):
        return wrong
    names = asked.results.keys() | {EVALUATED + name for name in asked.evaluated.keys() - plain}
    beyond |= dict.fromkeys(names - tested - beyond.keys(), "not tested")
    if beyond:
        return NotAudited("; ".join(f"{name}: {reason}" for name, reason in sorted(beyond.items())))
    return Audited(len(tested)) if tested else NotAudited("there is no result")


def _places(asked: Asked, who: Auditor) -> Iterator[tuple[Point, list[Test]]]:
    """The tests at some points; in fractions where everything there is one."""
    angles = angles_of(asked.subject_name, asked.subject)
    found, exact = 0, True
    for seed in range(SEEDS):
        point = Point(seed, exact, angles, asked.assumptions)
        try:
            try:
                yield point, _all_tests(asked, who, point)
            except Irrational:
                exact = False
                point = Point(seed, exact, angles, asked.assumptions)
                yield point, _all_tests(asked, who, point)
        except ZeroDivisionError:
            continue
        found += 1
        if found == PLACES:
            return
    raise NotImplementedError("something is divided by zero at every point tried")


def _all_tests(asked: Asked, who: Auditor, point: Point) -> list[Test]:
    """Those of an auditor, with our values found on the way: Irrational is raised here or nowhere."""
    tests = list(who(asked, point))
    for test in tests:
        if isinstance(test, Same) and asked.answered(test.name):
            asked.ours(test.name, point)
    return tests


def _wrong(asked: Asked, test: Same | Holds, point: Point) -> Contradicted | None:
    if isinstance(test, Holds):
        return None if test.holds else Contradicted(test.name, "as printed", test.said)
    if not asked.answered(test.name):
        return Contradicted(test.name, "no such result", shown(test.theirs))
    read = asked.result(test.name)
    near = ROUNDED if _rounded(read) else NEAR
    return next(_differences(test.name, read, asked.ours(test.name, point), test.theirs, near), None)


def _wrong_numbers(asked: Asked, names: Iterable[str]) -> Iterator[Contradicted]:
    """Numbers under `evaluated` that the results do not have at the point that the author gave."""
    for name in sorted(names):
        read, ours = asked.result(EVALUATED + name), asked.ours(EVALUATED + name, asked.here)
        yield from _differences(EVALUATED + name, read, ours, asked.ours(name, asked.here), ROUNDED)


def _plain(asked: Asked, name: str) -> bool:
    """Whether a result and its numbers are formulas, which can be compared as they are."""
    told = asked.results.get(name)
    return (_formulas(told) or is_system(told)) and _formulas(asked.evaluated[name])


def _formulas(value: object) -> bool:
    """Whether these are texts or numbers, in lists or alone."""
    if isinstance(value, list):
        return all(map(_formulas, value))
    return isinstance(value, str | int | float)


def _differences(
    name: str, read: Any, ours: Value, theirs: Value, near: mpmath.mpf, scale: Number = 0
) -> Iterator[Contradicted]:
    """Where two values differ; numbers are as sure as the largest of those beside them lets them be."""
    if isinstance(ours, list) != isinstance(theirs, list):
        yield Contradicted(name, shown(ours), shown(theirs))
    elif not isinstance(ours, list) or not isinstance(theirs, list):
        if not agree(ours, theirs, scale or 1, near):
            yield Contradicted(name, f"{_short(read)} = {shown(ours)}", shown(theirs))
    elif len(ours) != len(theirs):
        yield Contradicted(name, f"{len(ours)} entries", f"{len(theirs)}")
    else:
        scale = scale or _size(theirs)
        for i, (part, own, other) in enumerate(zip(read, ours, theirs, strict=True), 1):
            yield from _differences(f"{name}[{i}]", part, own, other, near, scale)


def _size(values: Value) -> Number:
    """The largest of some numbers."""
    if isinstance(values, list):
        return max((_size(value) for value in values), default=mpmath.mpf(0))
    return abs(floating(values))


def _rounded(read: Any) -> bool:
    """Whether there is a float in what was read."""
    return any(map(_rounded, read)) if isinstance(read, list) else bool(read.has(sympy.Float))


def _short(expr: Any, most: int = 60) -> str:
    text = str(expr)
    return text if len(text) <= most else text[:most] + "..."


def counted(outcomes: Sequence[Outcome]) -> Mapping[str, int]:
    """How many answers had each outcome, by its name."""
    return {
        kind.__name__: sum(isinstance(one, kind) for one in outcomes)
        for kind in (Audited, NotAudited, Contradicted)
    }
