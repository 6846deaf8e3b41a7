"""The JSON read back: the text of each result, read by the grammar of sheets, says what its tree does."""

from __future__ import annotations

import json
from collections.abc import Iterator
from fractions import Fraction
from functools import lru_cache
from math import isfinite
from typing import Any, get_args

from derive.algebra.fingerprint import fingerprint
from derive.derivation import Branch
from derive.errors import FormulaError, SheetError, SheetErrors
from derive.expression import Approximate, Expr, Matrix, Number, rebuild
from derive.kinds.sure import read
from derive.render.document import Document

TREES = get_args(Expr)
DIGITS = 17  # of a float
REMEMBERED = 20_000
REPORT = "please report this with the sheet"


def read_json(document: Document, text: str) -> tuple[str, ...]:
    """The results of which a text could not be read. Raises SheetErrors where one is not what was derived."""
    told = [question for problem in json.loads(text)["problems"] for question in problem["questions"]]
    faults, unread = [], dict[str, None]()
    for (problem, question), its in zip(document.questions(), told, strict=True):
        results = question.derivation.results if question.derivation else {}
        for name, result in results.items():
            found = its["results"][name]
            rows = question.derivation is not None and name in question.derivation.matrices
            shaped = not isinstance(result, Matrix) or _is_shaped(result, found, rows)
            same = [_same(tree, written) for tree, written in _pairs(result, found)]
            place = f"question {problem.number}.{question.number}"
            if not shaped or False in same:
                message = f"{place} failed its own check: {name} as JSON"
                faults.append(SheetError(message, question.place, REPORT))
            elif None in same:
                unread[f"{name} of {place}"] = None
    if faults:
        raise SheetErrors(faults)
    return tuple(unread)


def _is_shaped(result: Matrix, written: Any, rows: bool) -> bool:
    """A matrix is a list of rows, a column a flat list unless it is to be `rows` too."""
    m, n = result.shape
    if n == 1 and not rows:
        return len(written) == m and all(isinstance(entry, str) for entry in written)
    return len(written) == m and all(isinstance(row, list) and len(row) == n for row in written)


def _pairs(result: Any, written: Any) -> Iterator[tuple[Expr, Any]]:
    """The formulas of a result with what is written of each."""
    match result:
        case Matrix(rows):
            entries = [entry for row in rows for entry in row]
            yield from zip(entries, _flat(written), strict=True)
        case Branch():
            for name, tree in (result.short or result.values).items():
                yield from _pairs(tree, written[name])
        case tuple():
            for part, its in zip(result, written, strict=True):
                yield from _pairs(part, its)
        case _ if isinstance(result, TREES):
            yield result, written


def _flat(rows: Any) -> Iterator[Any]:
    for part in rows:
        if isinstance(part, list):
            yield from _flat(part)
        else:
            yield part


@lru_cache(REMEMBERED)
def _same(tree: Expr, written: str) -> bool | None:
    """Whether a text says what the tree does; None where it cannot be read, as a name with indices."""
    try:
        found = read(written)
    except FormulaError:
        return None
    return fingerprint(_as_digits(tree), DIGITS) == fingerprint(found, DIGITS)


def _as_digits(expr: Expr) -> Expr:
    """With rounded numbers as the digits of which they are written."""
    if isinstance(expr, Approximate) and isfinite(expr.value):
        return Number(Fraction(repr(float(expr.value))))
    return rebuild(expr, _as_digits)
