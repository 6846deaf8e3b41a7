"""The JSON read back: the text of each result, read by the grammar of sheets, says what its tree does."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from fractions import Fraction
from functools import lru_cache
from math import isfinite
from typing import Any, TypeAlias, get_args

from derive.algebra.fingerprint import fingerprint
from derive.derivation import Branch, Derivation, LinearSystem
from derive.errors import FormulaError, SheetError, SheetErrors
from derive.expression import ZERO, Approximate, Call, Expr, Matrix, Number, rebuild, walk
from derive.kinds.linear_systems import unknowns_of
from derive.kinds.sure import read
from derive.render.document import Document

TREES = get_args(Expr)
DIGITS = 17  # of a float
REMEMBERED = 20_000
REPORT = "please report this with the sheet"

Verdict: TypeAlias = "bool | None"  # None of what cannot be read


def read_json(document: Document, text: str) -> tuple[str, ...]:
    """The results of which a text could not be read. Raises SheetErrors where one is not what was derived."""
    told = [question for problem in json.loads(text)["problems"] for question in problem["questions"]]
    faults, unread = [], dict[str, None]()
    for (problem, question), its in zip(document.questions(), told, strict=True):
        place = f"question {problem.number}.{question.number}"
        for name, verdicts in _compared(question.derivation, its):
            if False in verdicts:
                message = f"{place} failed its own check: {name} as JSON"
                faults.append(SheetError(message, question.place, REPORT))
            elif None in verdicts:
                unread[f"{name} of {place}"] = None
    if faults:
        raise SheetErrors(faults)
    return tuple(unread)


def _compared(derivation: Derivation | None, its: Mapping[str, Any]) -> Iterator[tuple[str, list[Verdict]]]:
    """Each result, formulas and numbers, with the verdicts on what is written of it."""
    if derivation is None:
        return
    for name, result in derivation.results.items():
        yield name, list(_verdicts(result, its["results"][name], name in derivation.matrices))
    for name, found in derivation.evaluated.items():
        yield f"{name} in numbers", list(_verdicts(found, its["evaluated"][name]))


def _verdicts(value: Any, written: Any, rows: bool = False) -> Iterator[Verdict]:
    """Whether each part of a value is written so; what is said in words is not looked at. A matrix is a list
    of rows, a column a flat list unless it is to be `rows` too."""
    match value:
        case Matrix():
            m, n = value.shape
            entries = [[entry] for entry in written] if n == 1 and not rows else written
            yield len(entries) == m and all(isinstance(row, list) and len(row) == n for row in entries)
            for ours, its in zip(value.rows, entries, strict=False):
                for entry, text in zip(ours, its, strict=False):
                    yield _same(entry, text) if isinstance(text, str) else False
        case Branch():
            yield value.true_at == written.get("true_at", True)
            yield from _verdicts({**(value.short or value.values), **value.facts}, written)
        case LinearSystem(unknowns, names=names):
            texts = [each.split(" = ") for each in written["equations"]]
            parts = [unknowns, value.equations, dict(names)]
            yield from _verdicts(parts, [[*unknowns_of(written)], texts, written.get("where", {})])
        case dict():
            for name, part in value.items():
                yield from _verdicts(part, written[name]) if name != "when" else ()
        case list() | tuple():
            yield isinstance(written, list) and len(written) == len(value)
            for part, its in zip(value, written, strict=False):
                yield from _verdicts(part, its)
        case bool() | int() | float() | str() | None:
            yield value == written
        case _ if isinstance(value, TREES):
            yield _same(value, written)


@lru_cache(REMEMBERED)
def _same(tree: Expr, written: str) -> Verdict:
    """Whether a text says what the tree does; None where it cannot be read, as a name with indices."""
    try:
        found = read(written)
    except FormulaError:
        return None
    return fingerprint(_as_digits(tree), DIGITS) == fingerprint(found, DIGITS)


def _as_digits(expr: Expr) -> Expr:
    """With rounded numbers as the digits of which they are written, and Max(0, ..) as it is read."""
    return _written(expr) if any(map(_is_written_otherwise, walk(expr))) else expr


def _is_written_otherwise(node: Expr) -> bool:
    return isinstance(node, Approximate) or (isinstance(node, Call) and node.function == "max")


def _written(expr: Expr) -> Expr:
    if isinstance(expr, Approximate) and isfinite(expr.value):
        return Number(Fraction(repr(float(expr.value))))
    if isinstance(expr, Call) and expr.function == "max" and expr.arguments[0] == ZERO:
        largest: Expr = ZERO
        for part in map(_written, expr.arguments[1:]):
            apart = part if largest == ZERO else largest - part
            largest = (largest + part + Call("abs", (apart,))) / 2
        return largest
    return rebuild(expr, _written)
