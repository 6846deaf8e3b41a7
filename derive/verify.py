"""An answer, verified: every claim of it and of what it rests on holds, and one of them proves it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from derive.derivation import Claim, Derivation, Phrase
from derive.errors import DivisionByZero, NotAsWritten, NotDerivable, Place, SheetError, SheetErrors
from derive.expression import Number, walk
from derive.kinds.checks import SECOND_ROUTE
from derive.kinds.measured import InDecimals
from derive.kinds.problem import Problem, expressions
from derive.kinds.registry import words_folder
from derive.named import strangers
from derive.quoted import misquoted
from derive.sheet.model import Question
from derive.sheet.source import At

if TYPE_CHECKING:
    from derive.render.phrases import Speech

FAR = 1e12  # times as large: of the sum of such floats a claim at 1e-9 has too few digits left
UNPROVED = "nothing proves the answer of '{}': links from line to line hold of a wrong formula too"
AS_WRITTEN = (
    "the answer failed its own check: a formula of it, read as it is written, is not the value it stands for"
)
UNKNOWN = "the answer failed its own check: it does not say what these names stand for: {}"
MISQUOTED = (
    "the answer failed its own check: a sentence says the opposite of a line, a result or what was typed ({})"
)
REPORT = "please report this with the sheet"
PROVE = "its author must claim a law or an independent route: see 'What proves an answer' in CONTRIBUTING.md"


def answered(question: Question, working: Problem) -> Derivation:
    """The answer to a question, verified. Raises SheetErrors where there is none, or a claim fails."""
    try:
        derivation = working.answer(question.find, question.options)
    except DivisionByZero as error:
        key = _zero_of(question)
        said = f"a division by zero, with {key} = 0" if key else str(error)
        raise SheetErrors([SheetError(said, _place_of(key, question, working))]) from error
    except NotDerivable as error:
        place = _place_of(error.about, question, working)
        raise SheetErrors([SheetError(str(error), place)]) from error
    except NotAsWritten as error:
        raise SheetErrors([SheetError(AS_WRITTEN, question.place, REPORT)]) from error
    except (OverflowError, ZeroDivisionError) as error:
        message = f"a number of this answer is too large, or divided by zero ({error})"
        raise SheetErrors([SheetError(message, question.place, "check the values of the sheet")]) from error
    except Exception as error:  # an accident of ours: where it was is told with it
        error.add_note(f"{question.place}: ")
        raise
    for rested_on, claim in _claims(derivation):
        if not claim.holds:
            raise SheetErrors([_failure(rested_on, claim, question, working)])
    if not derivation.proved:
        raise SheetErrors([SheetError(UNPROVED.format(derivation.kind), question.place, PROVE)])
    if unknown := strangers(derivation, question.options, working):
        raise SheetErrors([SheetError(UNKNOWN.format(", ".join(sorted(unknown))), question.place, REPORT)])
    if alone := [*misquoted(derivation, question.options, working)]:
        raise SheetErrors([SheetError(MISQUOTED.format(", ".join(alone)), question.place, REPORT)])
    return derivation


def in_decimals(answers: Sequence[Derivation], place: Place) -> list[Derivation]:
    """The answers to the questions of a problem with rounded data. Raises SheetErrors."""
    try:
        return list(map(InDecimals(), answers))
    except NotAsWritten as error:
        raise SheetErrors([SheetError(AS_WRITTEN, place, REPORT)]) from error


def _failure(derivation: Derivation, claim: Claim, question: Question, working: Problem) -> SheetError:
    """What is told of a claim that does not hold: an accident of ours, or numbers that floats cannot hold."""
    apart = far_apart((working.subject, *working.where.values())) if claim.by == SECOND_ROUTE else None
    if apart:
        small, large = apart
        message = f"numbers as far apart as {small:.3g} and {large:.3g} cannot be checked in floating point"
        return SheetError(message, question.place, "give them in other units")
    return failed(claim, speech_of(derivation, working), question)


def far_apart(value: Any) -> tuple[float, float] | None:
    """The smallest and the largest number of a subject, where floats that add them lose the smaller one."""
    sizes = sorted(
        abs(float(node.value))
        for tree in expressions(value)
        for node in walk(tree)
        if isinstance(node, Number) and node.value
    )
    return (sizes[0], sizes[-1]) if sizes and sizes[-1] > FAR * sizes[0] else None


def failed(claim: Claim, speech: Speech, question: Question) -> SheetError:
    """What is told of an accident of ours."""
    said, means = speech.claim(claim), speech.say(Phrase(claim.by))
    message = f"the answer failed its own check: {said} (by {means})"
    return SheetError(message, question.place, REPORT)


def speech_of(derivation: Derivation, working: Problem) -> Speech:
    """How a derivation says in plain text what it says in words."""
    from derive.render.phrases import spoken

    return spoken(words_folder(working.name, derivation.kind), derivation.kind)


def _zero_of(question: Question) -> str:
    """The first option that is zero, as it is written."""
    fields = type(question.options).model_fields if question.options else {}
    return next(
        (
            field.alias or name
            for name, field in fields.items()
            if isinstance(value := getattr(question.options, name), Number) and not value.value
        ),
        "",
    )


def _place_of(about: str, question: Question, working: Problem) -> Place:
    """Where an option of a question stands, or a key of its subject;
    else the question itself."""
    answer = question.answer_at
    if about and answer is not None:
        route = tuple(int(step) if step.isdigit() else step for step in about.split("/"))
        asked, problem = At(answer.source, answer.route[:-1]), At(answer.source, answer.route[:2])
        for at in (asked, problem / working.name):
            if at.value(route) is not None:
                return at.key(route)
    return question.place


def _claims(derivation: Derivation) -> Iterator[tuple[Derivation, Claim]]:
    """Those of the answer and of all it rests on, with the derivation that makes each."""
    yield from ((derivation, claim) for claim in derivation.claims)
    for used in derivation.uses:
        yield from _claims(used)
