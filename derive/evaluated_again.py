"""The numbers under `evaluate`, found again from the text of the results, with digits that are sure.

What was evaluated in floats must be what the text of the result comes to at the author's point, as near as
floats can be; where rounding told in the digits the sure number is taken. Branches that are said not to be
real are shown not to be.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Any, get_args

from derive.derivation import Claim, Derivation, LinearSystem
from derive.errors import DivisionByZero, FormulaError, NotDerivable, NotReal
from derive.expression import Expr, Number, free_symbols
from derive.kinds.checks import flat
from derive.kinds.linear_systems import solved_as_written
from derive.kinds.sure import MARGIN, read, rounding, sure
from derive.render.json_result import plain
from derive.render.phrases import Speech

TREES = get_args(Expr)
UNDECIDED = (NotDerivable, FormulaError, KeyError)
NOWHERE = (NotReal, DivisionByZero)
BALLS = "ball-arithmetic"
PARTLY = 1e-9  # relative: of the numbers before the symbols that are left
TRIES = 3
ABOUT = ("when", "real", "true_at", "feasible")


@dataclass(slots=True)
class Again:
    """The point of one question; `same` has a truth for each number that was found again, `left` the results
    of which some could not be. `branches` are the values of unknowns there, once for each branch."""

    point: Mapping[str, Expr]
    branches: Sequence[Mapping[str, Expr]] = ()
    name: str = ""
    same: list[bool] = field(default_factory=list)
    left: dict[str, None] = field(default_factory=dict)

    def result(self, name: str, found: Any, text: Any) -> Any:
        """What was found of a result, its numbers sure."""
        self.name = name
        return self.value(found, text, self.point)

    def value(self, found: Any, text: Any, names: Mapping[str, Expr]) -> Any:
        """What was found, its numbers sure, in the shape of the result."""
        match found, text:
            case bool(), _:
                return found
            case float() | int(), str():
                return self._number(found, text, names)
            case list(), list() if len(found) == len(text):
                return [self.value(each, its, names) for each, its in zip(found, text, strict=True)]
            case list(), {"equations": [*_]}:
                return self._solved(found, text, names)
            case LinearSystem(), {"equations": [*equations]}:
                self._put_in(found, equations, {**names, **_told_with(text)})
            case dict(), dict():
                return self._branch(found, text, names)
            case tree, str() if isinstance(tree, TREES) and (formula := self._formula(text)):
                self._partly(tree, formula, names)
            case (float() | int(), [dict(), *_]):
                self._of_a_branch(found, text, names)
            case (float() | int() | list(), str() | list()):
                self.same.append(False)
        return found

    def _number(self, found: float, text: str, names: Mapping[str, Expr]) -> float:
        """The sure number; of one that is a number already, and no formula, what was found by other means."""
        formula = self._formula(text)
        if formula is None:
            return found
        if isinstance(formula, Number):
            self.same.append(abs(found - formula.value) <= PARTLY * max(1.0, abs(found)))
            return found
        if free_symbols(formula) - names.keys():
            self._partly(Number(Fraction(found)), formula, names)
            return found
        try:
            number = float(sure(formula, names))
            self.same.append(abs(found - number) <= rounding(formula, names))
        except NOWHERE:
            self.same.append(False)
        except UNDECIDED:
            self.left[self.name] = None
        else:
            return found if abs(found - number) <= MARGIN * abs(number) or abs(number) < MARGIN else number
        return found

    def _solved(self, found: list[Any], text: dict[str, Any], names: Mapping[str, Expr]) -> list[Any]:
        """The solution of equations, solved again as they are written."""
        try:
            numbers = solved_as_written(text, names)
        except NOWHERE:
            self.same.append(False)
        except UNDECIDED:
            self.left[self.name] = None
        else:
            size = max(1.0, *map(abs, numbers))
            self.same += (abs(a - b) <= PARTLY * size for a, b in zip(flat(found), numbers, strict=False))
            width = len(found[0]) if isinstance(found[0], list) else 0
            rows = range(0, len(found) * width, width or 1)
            return [numbers[k : k + width] for k in rows] if width else numbers[: len(found)]
        return found

    def _put_in(self, found: LinearSystem, equations: list[str], names: Mapping[str, Expr]) -> None:
        """Equations in the symbols that are left, each as it is written."""
        for (ours, value), its in zip(found.equations, equations, strict=True):
            left, right = map(read, its.split(" = "))
            self._partly(ours - value, left - right, names)

    def _formula(self, text: str) -> Expr | None:
        """What is written, where it can be read."""
        try:
            return read(text)
        except FormulaError:
            self.left[self.name] = None
            return None

    def _partly(self, found: Expr, formula: Expr, names: Mapping[str, Expr]) -> None:
        """What has the value of the result at every branch, or whatever the letters are that are left."""
        letters = free_symbols(formula) | free_symbols(found)
        at_branches = [
            {**names, **branch} for branch in self.branches if letters <= names.keys() | branch.keys()
        ]
        tried = len(self.same)
        for there in at_branches or _draws(letters, names):
            try:
                ours, its = float(sure(found, there)), float(sure(formula, there))
            except (*NOWHERE, *UNDECIDED):
                continue
            near = PARTLY * (max(1.0, abs(its)) if at_branches else abs(its))
            self.same.append(abs(ours - its) <= rounding(found, there) + near)
        if len(self.same) == tried:
            self.left[self.name] = None

    def _of_a_branch(
        self, found: float, branches: Sequence[dict[str, Any]], names: Mapping[str, Expr]
    ) -> None:
        """One number of a result in several branches, as of a trajectory, is that of one of them."""
        same = []
        for branch in branches:
            formula = self._formula(str(branch.get(self.name)))
            with suppress(*NOWHERE, *UNDECIDED):
                if formula is not None and free_symbols(formula) <= names.keys():
                    near = rounding(formula, names) + PARTLY * max(1.0, abs(found))
                    same.append(abs(found - float(sure(formula, names))) <= near)
        if same:
            self.same.append(any(same))
        else:
            self.left[self.name] = None

    def _branch(
        self, found: dict[str, Any], text: dict[str, Any], names: Mapping[str, Expr]
    ) -> dict[str, Any]:
        """Its values, names that it says on the way before what rests on them."""
        known, values = dict(names), dict(found)
        if found.get("real", True) and _ends_nowhere(text, names):
            self.same.append(True)  # floats found a number where there certainly is none, 0/0 by rounding
            return {"when": found["when"], "real": False}
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


def _ends_nowhere(text: Mapping[str, Any], names: Mapping[str, Expr]) -> bool:
    """Whether a branch that is told so has a name without a value, found in turn."""
    known = dict(names)
    for name, its in text.items():
        if name not in ABOUT and isinstance(its, str):
            if _is_nowhere(its, known):
                return True
            with suppress(FormulaError):
                known[name] = read(its)
    return False


def _told_with(equations: Mapping[str, Any]) -> dict[str, Expr]:
    """What names in equations stand for."""
    return {name: read(text) for name, text in equations.get("where", {}).items()}


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
) -> tuple[Derivation, Claim | None, tuple[str, ...]]:
    """The answer with sure numbers, the claim about them (None where none of its results is a formula), and
    the results of which some could not be found again.

    `branches` says whether those of the answer are formulas that were evaluated one by one.
    """
    again = Again({**answer.in_turn, **point}, list(_unknowns(answer)))
    values = dict(answer.evaluated)
    for name, found in answer.evaluated.items():
        if name in answer.results and (branches or not _has_branches(found)):
            text = plain(answer.results[name], speech, name in answer.matrices)
            values[name] = again.result(name, found, text)
    left = tuple(again.left)
    if not again.same:
        return answer, None, left
    claim = Claim("evaluated", BALLS, all(again.same), tried=len(again.same))
    return replace(answer, evaluated=values), claim, left


def _unknowns(answer: Derivation) -> Iterator[Mapping[str, Expr]]:
    """The numbers that unknowns have in each branch that is real at the point."""
    for found in filter(_has_branches, answer.evaluated.values()):
        for branch in found:
            if isinstance(branch, dict) and "when" in branch:  # a pole is two numbers
                numbers = {name: value for name, value in branch.items() if type(value) is float}
                yield {name: Number(Fraction(value)) for name, value in numbers.items()}


def _has_branches(found: Any) -> bool:
    return isinstance(found, list) and any(isinstance(each, dict) for each in found)
