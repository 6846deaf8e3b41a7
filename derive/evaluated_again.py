"""The numbers under `evaluate`, found again from the text of the results, with digits that are sure.

What was evaluated in floats must be what the text of the result comes to at the author's point, as near as
floats can be; where rounding told in the digits the sure number is taken. Branches that are said not to be
real are shown not to be.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Any, get_args

from derive.derivation import Claim, Derivation
from derive.errors import DivisionByZero, FormulaError, NotDerivable, NotReal
from derive.expression import Expr, Number, free_symbols
from derive.kinds.sure import MARGIN, read, rounding, sure
from derive.render.json_result import plain
from derive.render.phrases import Speech

TREES = get_args(Expr)
UNDECIDED = (NotDerivable, FormulaError, KeyError)
NOWHERE = (NotReal, DivisionByZero)
BALLS = "ball-arithmetic"
PARTLY = 1e-9  # relative: of the numbers before the symbols that are left
TRIES = 3
ABOUT = ("when", "real", "true_at")


@dataclass(slots=True)
class Again:
    """The point of one question; `same` has a truth for each number that was found again."""

    point: Mapping[str, Expr]
    same: list[bool] = field(default_factory=list)

    def value(self, found: Any, text: Any, names: Mapping[str, Expr]) -> Any:
        """What was found, its numbers sure; of another shape than the result it is another's to check."""
        match found, text:
            case bool(), _:
                return found
            case float() | int(), str():
                return self._number(found, text, names)
            case list(), list() if len(found) == len(text):
                return [self.value(each, its, names) for each, its in zip(found, text, strict=True)]
            case dict(), dict():
                return self._branch(found, text, names)
            case tree, str() if isinstance(tree, TREES):
                self._partly(tree, text, names)
        return found

    def _number(self, found: float, text: str, names: Mapping[str, Expr]) -> float:
        """The sure number; one that is a number already, and no formula, was found by other means."""
        try:
            if isinstance(written := read(text), Number):
                self.same.append(abs(found - written.value) <= PARTLY * max(1.0, abs(found)))
                return found
            number = float(sure(text, names))
            self.same.append(abs(found - number) <= rounding(text, names))
        except NOWHERE:
            self.same.append(False)
        except UNDECIDED:
            pass
        else:
            return found if abs(found - number) <= MARGIN * abs(number) or abs(number) < MARGIN else number
        return found

    def _partly(self, found: Expr, text: str, names: Mapping[str, Expr]) -> None:
        """A tree in the letters that are left has the value of the result, whatever these are."""
        result = read(text)
        for there in _draws(free_symbols(result) | free_symbols(found), names):
            try:
                ours, its = sure(found, there), sure(result, there)
            except (*NOWHERE, *UNDECIDED):
                continue
            apart = abs(float(ours - its))
            self.same.append(apart <= rounding(found, there) + PARTLY * abs(float(its)))

    def _branch(
        self, found: dict[str, Any], text: dict[str, Any], names: Mapping[str, Expr]
    ) -> dict[str, Any]:
        """Its values, names that it says on the way before what rests on them."""
        known, values = dict(names), dict(found)
        nowhere = False
        for name, its in text.items():
            if name in ABOUT or not isinstance(its, str):
                continue
            if found.get("real", True):
                values[name] = self.value(found[name], its, known) if name in found else None
            else:
                nowhere |= _is_nowhere(its, known)
            with suppress(FormulaError):
                known[name] = read(its)
        if not found.get("real", True):
            self.same.append(nowhere)
        return {name: values[name] for name in found}


def _is_nowhere(text: str, names: Mapping[str, Expr]) -> bool:
    """Whether a formula certainly has no real value at the point."""
    try:
        sure(text, names)
    except NOWHERE:
        return True
    except UNDECIDED:
        return False
    return False


def _draws(letters: frozenset[str], names: Mapping[str, Expr]) -> Iterator[Mapping[str, Expr]]:
    """The point, and values for the letters that it leaves open; the same ones on every machine."""
    left = sorted(letters - names.keys())
    draw = random.Random(" ".join(left))
    for _ in range(TRIES):
        yield {**names, **{name: Number(Fraction(draw.randint(2, 19), 10)) for name in left}}


def evaluated_again(
    answer: Derivation, point: Mapping[str, Expr], speech: Speech, branches: bool
) -> tuple[Derivation, Claim | None]:
    """The answer with sure numbers, and the claim about them; None where none of its results is a formula.

    `branches` says whether those of the answer are formulas that were evaluated one by one.
    """
    again, values = Again(point), dict(answer.evaluated)
    for name, found in answer.evaluated.items():
        if name in answer.results and (branches or not _has_branches(found)):
            text = plain(answer.results[name], speech, name in answer.matrices)
            values[name] = again.value(found, text, point)
    if not again.same:
        return answer, None
    claim = Claim("evaluated", BALLS, all(again.same), tried=len(again.same))
    return replace(answer, evaluated=values), claim


def _has_branches(found: Any) -> bool:
    return isinstance(found, list) and any(isinstance(each, dict) for each in found)
