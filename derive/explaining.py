"""What was proved of each answer, by what and at how many places, and what was not: `build --explain`."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby
from textwrap import wrap

from derive.derivation import Claim, Derivation
from derive.json_back import read_json
from derive.read_back import reading_of
from derive.render.document import Document, QuestionPage
from derive.render.foot import Proved
from derive.render.json_result import render_json
from derive.render.phrases import Speech, spoken
from derive.render.printed import Reading

WIDTH = 79
MEANS = {"law": "law, exactly", "second-route": "second route", "number": "certain digits"}


def explained(documents: Iterable[Document]) -> Iterator[str]:
    """Lines for a terminal, question by question."""
    for document in documents:
        for problem, question in document.questions():
            yield f"{document.name}, question {problem.number}.{question.number}, {question.find}"
            yield from _question(question)
        yield from _in_all(document)
        yield from _unread(document)


def _question(question: QuestionPage) -> Iterator[str]:
    if not question.order and not question.claims:
        yield from _wrapped("found and proved in the answer to a question before it")
    for worked in question.order:
        derivation, speech = worked.derivation, spoken(worked.folder, worked.derivation.kind)
        if derivation.kind != question.find:
            yield from _wrapped(f"rests on {derivation.kind}:")
        yield from _claims(derivation.claims, speech)
        yield from _not_compared(derivation)
    if question.derivation:
        yield from _claims(question.claims, spoken(question.folder, question.derivation.kind))
    if question.once:
        yield from _wrapped(f"numbers that could not be found again: {', '.join(question.once)}")


def _claims(claims: Sequence[Claim], speech: Speech) -> Iterator[str]:
    """Comparisons as a number, every other claim in its words."""
    if steps := sum(claim.tried for claim in claims if claim.truth == "step"):
        yield from _wrapped(f"lines and results: {_counted(steps, 'comparison')}")
    others = [claim for claim in claims if claim.truth in MEANS]
    told = [(MEANS[claim.truth], speech.claim(claim), claim.tried) for claim in others]
    for (means, words), same in groupby(told, key=lambda each: each[:2]):
        tried = sum(each[2] for each in same)
        places = f", {_counted(tried, 'place')}" if tried > 1 or means != MEANS["law"] else ""
        yield from _wrapped(f"{means}{places}: {words}")


def _not_compared(derivation: Derivation) -> Iterator[str]:
    """Lines that stand alone: what is given, a value that only laws and routes are about, a law untried."""
    compared = {claim.about.get("step") for claim in derivation.claims}
    steps = [step for step in derivation.all_steps() if len(step.chain) > 1 and step.name not in compared]
    laws = [step.name for step in steps if step.rule == "law"]
    alone = [step.name for step in steps if step.rule != "law"]
    if alone:
        yield from _wrapped(f"no two sides to compare: {', '.join(dict.fromkeys(alone))}")
    if laws:
        yield from _wrapped(f"laws not tried: {', '.join(dict.fromkeys(laws))}")
    if derivation.alone:
        yield from _wrapped(f"results that no line could be compared with: {', '.join(derivation.alone)}")


def _in_all(document: Document) -> Iterator[str]:
    """How often each truth was tried, over the whole page."""
    proved = Proved.of(document.verified(), Reading())
    yield f"{document.name}, in all:"
    yield from _wrapped(
        f"{_counted(proved.steps, 'comparison')} of lines; {_counted(proved.laws, 'law')}, exactly; "
        f"{_counted(proved.routes, 'comparison')} with a second route, "
        f"at {_counted(proved.places, 'place')}; "
        f"{_counted(proved.numbers, 'number')} with certain digits"
    )


def _unread(document: Document) -> Iterator[str]:
    if not document.solutions:
        return
    reading = reading_of(document)
    yield f"{document.name}, the page: {_counted(reading.read, 'formula')} read back"
    for formula in reading.unread:
        yield from _wrapped(f"could not be read back: {formula}")
    for result in read_json(document, render_json(document)):
        yield from _wrapped(f"could not be read in the JSON: {result}")


def _counted(count: int, what: str) -> str:
    return f"{count} {what}{'' if count == 1 else 's'}"


def _wrapped(text: str) -> list[str]:
    return wrap(text, WIDTH, initial_indent="  ", subsequent_indent="    ", break_long_words=False)
