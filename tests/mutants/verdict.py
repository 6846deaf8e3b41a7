"""What became of a mistake: refused, nothing, or something wrong that a reader would get."""

from __future__ import annotations

import difflib
import math
import random
import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from tests.mutants.units import Page, Refused
from tests.random_sheets import value

# From harmless to worst; a mutant counts by its worst outcome.
ORDER = ("same", "form", "crash", "timeout", "refused", "check", "words", "line", "wrong")
DANGEROUS = ("words", "line", "wrong")
POINTS = 3
CLOSE = 1e-6
WHEN = "when"
NAME = re.compile(r"[A-Za-z_]\w*")
KNOWN = {"pi", "sin", "cos", "tan", "sqrt", "atan2", "asin", "acos", "atan", "exp", "log", "abs", "deg"}
MATHEMATICS = re.compile(r"\$\$.*?\$\$|\$[^$]+\$", re.S)
FOOT = re.compile(r"^.*\b(?:Verified|proved|claims)\b.*$", re.M)  # it says how often, which is no mathematics


@dataclass(frozen=True, slots=True)
class Verdict:
    """A class of `ORDER`, and what shows it: the message, or the lines that are not as they were."""

    kind: str
    shown: str = ""


def verdict(right: Page, found: Page | Refused | None) -> Verdict:
    """Of one unit. A result that is another function of its symbols is wrong; a page whose mathematics is not
    as it was has a wrong line or another form, which a person must say; else its words are not as they were.
    """
    match found:
        case None:
            return Verdict("timeout")
        case Refused(message, failed, crash):
            return Verdict("crash" if crash else "check" if failed else "refused", message)
        case Page(text, results):
            wrong = [
                name
                for name in {**right.results, **results}
                if not same(right.results.get(name), results.get(name))
            ]
            if wrong:
                return Verdict("wrong", _told(right, found, wrong))
            before, after = FOOT.sub("", right.text), FOOT.sub("", text)
            if before == after:
                told = list(_whens(right.results)) == list(_whens(results))
                return Verdict("same" if right.results == results else "form" if told else "words", "")
            if sorted(MATHEMATICS.findall(before)) != sorted(MATHEMATICS.findall(after)):
                return Verdict("line", _difference(before, after))
            return Verdict("words", _difference(before, after))
    raise TypeError(found)


def worst(verdicts: list[Verdict]) -> Verdict:
    return max(verdicts, key=lambda each: ORDER.index(each.kind))


def same(right: Any, other: Any) -> bool:
    """Whether results are equal: texts as functions of their symbols, at random points."""
    match right, other:
        case dict(), dict():
            return right.keys() == other.keys() and all(k == WHEN or same(right[k], other[k]) for k in right)
        case list(), list():
            return len(right) == len(other) and (
                all(map(same, right, other)) or _same_in_another_order(right, other)
            )
        case ((int() | float()), (int() | float())):
            return math.isclose(right, other, rel_tol=CLOSE, abs_tol=CLOSE)
        case str(), str():
            return right == other or _same_formula(right, other)
    return bool(right == other)


def _whens(results: Any) -> Iterator[str]:
    """What is said of each branch: words, which the page has too."""
    if isinstance(results, dict):
        for name, value in results.items():
            yield from [str(value)] if name == WHEN else _whens(value)
    elif isinstance(results, list):
        for part in results:
            yield from _whens(part)


def _same_in_another_order(right: list[Any], other: list[Any]) -> bool:
    """Of branches, which are objects: their order says nothing."""
    left = list(other)
    for each in right:
        match_ = next((i for i, one in enumerate(left) if isinstance(one, dict) and same(each, one)), None)
        if match_ is None:
            return False
        del left[match_]
    return True


def _same_formula(right: str, other: str) -> bool:
    names = sorted({*NAME.findall(right), *NAME.findall(other)} - KNOWN)
    met = 0
    for at in _points(names):
        try:
            a, b = complex(value(right, at)), complex(value(other, at))
        except (ArithmeticError, ValueError):
            continue
        except (SyntaxError, NameError, TypeError):
            return False  # texts, or a formula of functions that the reader here does not know
        if math.isnan(abs(a)) or math.isnan(abs(b)):
            continue
        if abs(a - b) > CLOSE * max(1.0, abs(a)):
            return False
        met += 1
        if met == POINTS:
            break
    return met > 0


def _points(names: list[str]) -> Iterator[dict[str, float]]:
    draw = random.Random(" ".join(names))
    for _ in range(30):
        yield {name: draw.uniform(0.2, 1.9) for name in names}


def _told(right: Page, found: Page, names: list[str]) -> str:
    lines = []
    for name in names:
        before, after = right.results.get(name), found.results.get(name)
        if isinstance(before, dict) and isinstance(after, dict):
            for key in {**before, **after}:
                if not same(before.get(key), after.get(key)):
                    lines.append(
                        f"{name} {key}: {str(before.get(key))[:300]}  ->  {str(after.get(key))[:300]}"
                    )
        else:
            lines.append(f"{name}: {str(before)[:300]}  ->  {str(after)[:300]}")
    return "\n".join(lines[:6])


def _difference(before: str, after: str) -> str:
    lines = difflib.unified_diff(before.splitlines(), after.splitlines(), lineterm="", n=0)
    return "\n".join(line[:400] for line in list(lines)[2:] if line[:2] != "@@")[:3000]
