"""Answers in numbers: the point that an author gives under `evaluate`, and what is wrong about it."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from dataclasses import replace
from difflib import get_close_matches
from typing import TYPE_CHECKING

from derive.derivation import Claim, Derivation
from derive.errors import SheetError, SheetErrors
from derive.evaluated_again import evaluated_again
from derive.kinds.problem import Problem as Working
from derive.sheet.faults import did_you_mean
from derive.sheet.model import Problem, Question
from derive.sheet.source import At
from derive.verify import failed, speech_of

if TYPE_CHECKING:
    from derive.kinds.values_at import Here

BASE = re.compile(r"_d?dot$")  # what a rate has more than its variable
MISSPELT = 0.85  # how like a name another is that was meant: theta2 of thetha2, but not of theta3


def strange_names(problem: Problem, working: Working, answers: list[Derivation]) -> Iterator[SheetError]:
    """Values under `evaluate` for what stands nowhere in the problem; with a hint where one of
    the sheet's own names is misspelt."""
    from derive.kinds.point_names import point_names

    if not any(question.evaluate for question in problem.questions):
        return
    names = point_names(working, answers)
    own = sorted(name for name in names if BASE.sub("", name) in working.symbols | working.where.keys())
    for question in problem.questions:
        for name in sorted((question.evaluate or {}).keys() - names):
            place = question.place
            if question.answer_at:
                place = At(question.answer_at.source, question.answer_at.route[:-1]).key(("evaluate", name))
            hint = did_you_mean(name, own) if _misspelt(name, own) else ""
            yield SheetError(f"'{name}' stands nowhere in this problem", place, hint)


def _misspelt(name: str, names: Collection[str]) -> bool:
    """Whether one of the names was meant: q1 of q_1, theta2 of thetha2."""
    plain = name.replace("_", "")
    return any(each.replace("_", "") == plain for each in names) or bool(
        get_close_matches(name, names, n=1, cutoff=MISSPELT)
    )


def with_numbers(
    answer: Derivation, question: Question, working: Working
) -> tuple[Derivation, tuple[Claim, ...], tuple[str, ...]]:
    """The answer with its results in numbers, each found a second time, and those of which some could not be.
    Raises SheetErrors."""
    own = bool(answer.evaluated or answer.files)
    if not own and question.evaluate is not None:
        answer = evaluated(answer, question, working)
    if not answer.evaluated:
        return answer, (), ()
    speech = speech_of(answer, working)
    point = {**working.where, **(question.evaluate or {})}
    answer, claim, left = evaluated_again(answer, point, speech, branches=not own)
    if claim and not claim.holds:
        raise SheetErrors([failed(claim, speech, question)])
    return answer, (claim,) if claim else (), left


def evaluated(answer: Derivation, question: Question, working: Working) -> Derivation:
    """The answer with its results in numbers at the point its author gave. Raises SheetErrors."""
    from derive.kinds.values_at import NOT_REAL, Here, values_at

    given = question.evaluate or {}
    here = Here.of(given, working.where, working.style)
    try:
        return replace(answer, evaluated=values_at(answer, here))
    except KeyError:
        missing = _missing(answer, here)
        message = f"no value is known for {', '.join(missing)}"
        wanted = f"{missing[0]} a value" if len(missing) == 1 else "them values"
        fault = SheetError(message, question.place, f"give {wanted} under evaluate: or where:")
    except NOT_REAL as error:
        fault = SheetError(
            f"the answer has no real value at this point ({error})", question.place, "choose another point"
        )
    raise SheetErrors([fault])


def _missing(answer: Derivation, here: Here) -> list[str]:
    """The names without a value that the results ask for, found by giving each the value 1 in turn."""
    from derive.kinds.values_at import NOT_REAL, values_at

    missing: list[str] = []
    while True:
        try:
            values_at(answer, replace(here, point={**here.point, **dict.fromkeys(missing, 1.0)}))
        except KeyError as error:
            if error.args[0] in missing:
                break
            missing.append(error.args[0])
        except NOT_REAL:
            break
        else:
            break
    return sorted(missing)
