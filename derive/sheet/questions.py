"""The questions of a problem: what stands beside `find`, split between all kinds and this one."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice
from types import ModuleType
from typing import Any

from derive.algebra.formulas.quantities import rational
from derive.errors import SheetError, SheetErrors
from derive.expression import Expr
from derive.kinds import registry
from derive.sheet.checked import checked
from derive.sheet.described import built
from derive.sheet.faults import MEANT, MOST, did_you_mean
from derive.sheet.given import ASKED_KEYS, QUESTION_KEYS, GivenAsked, GivenQuestion
from derive.sheet.honoured import idle_options
from derive.sheet.model import Question
from derive.sheet.source import At, Faults
from derive.sheet.subjects.registry import Known
from derive.sheet.where import contradictions, cycle

MANY = 12  # kinds, which are not listed in a hint


def questions(at: At, data: dict[str, Any], subject: str, known: Known) -> tuple[Question, ...]:
    """The questions under `questions:`. Raises SheetErrors."""
    entries = data["questions"]
    if not isinstance(entries, list) or not entries:
        raise at.error("a list of questions is wanted here", ("questions",), "write - find: ...")
    faults = Faults()
    found = []
    for index, entry in enumerate(entries):
        with faults.gathered():
            found.append(_question(at / "questions" / index, entry, index + 1, subject, known))
    faults.settle()
    return tuple(found)


def inline_question(at: At, data: dict[str, Any], subject: str, known: Known) -> Question:
    """The single question of a problem, given on the problem itself. Raises SheetErrors."""
    return _read(at, data, 1, subject, known, ASKED_KEYS, GivenAsked)


def has_option(subject: str, find: Any, name: str) -> bool:
    """Whether a kind of a subject has an option of this name."""
    if not isinstance(find, str):
        return False
    try:
        return name in registry.load(subject, find).Options.model_fields
    except KeyError:
        return False


def _question(at: At, data: Any, number: int, subject: str, known: Known) -> Question:
    if not isinstance(data, dict):
        raise at.error("a question is written as keys and values", (), "write - find: ...")
    return _read(at, data, number, subject, known, QUESTION_KEYS, GivenQuestion)


def _read(
    at: At,
    data: dict[str, Any],
    number: int,
    subject: str,
    known: Known,
    keys: frozenset[str],
    model: type[GivenAsked],
) -> Question:
    _require_one_kind(at, data.get("find"), subject)
    common = {key: value for key, value in data.items() if key in keys}
    faults = Faults()
    given, kind, options = None, None, None
    try:
        given = checked(model, at, common)  # a point is made of numbers: no symbol is a name there
    except SheetErrors as errors:
        faults.extend(_without_find_misspelt(errors, data, at))
    with faults.gathered():
        kind = _kind(at, data, subject)
        rest = {key: value for key, value in data.items() if key not in keys}
        if kind and given and "evaluate" in kind.Options.model_fields:
            rest["evaluate"] = given.evaluate  # some kinds need the point itself: poles, a step response
        if kind:
            options = checked(kind.Options, at, built(kind.Options, at, rest, known), known.names, keys)
        faults.extend(idle_options(options, at))
    if kind is None:
        faults.extend(_misspelt(at, data, subject, keys))
    for name, value in given.evaluate.items() if given and isinstance(given.evaluate, dict) else ():
        if name in known.where and not _same(value, known.where[name]):
            hint = "give it its value in one of the two places"
            faults.append(
                at.fault(f"{name} has a value under where: already", ("evaluate", name), hint, True)
            )
    if given and isinstance(given.evaluate, dict) and (name := cycle({**known.where, **given.evaluate})):
        hint = "give it a value, or one in other symbols"
        faults.append(at.fault(f"the value of {name} leads back to itself", ("evaluate", name), hint))
    elif given and isinstance(given.evaluate, dict):
        put_in = {**known.where, **given.evaluate}
        for name, assumed in sorted(contradictions(put_in, known.assumptions)):
            hint = "change its value, or what is said of it under symbols:"
            message = f"{name} is {assumed} by symbols, and its value is not"
            route = ("evaluate", name) if name in given.evaluate else ("evaluate",)
            faults.append(at.fault(message, route, hint))
    if faults or given is None or kind is None:
        raise SheetErrors(faults)
    evaluate = {} if given.evaluate == "true" else given.evaluate
    text = given.text if isinstance(given, GivenQuestion) else ""
    place = at.place(("find",))
    return Question(
        number, given.find, kind, options, place, text, given.marks, given.hint, evaluate, given.answer,
        at / "answer", given.steps,
    )  # fmt: skip


def _require_one_kind(at: At, typed: Any, subject: str) -> None:
    """Raises SheetErrors for a list of kinds, with commas or as a list of YAML."""
    parts = typed if isinstance(typed, list) else str(typed).split(",")
    several = [part.strip() for part in parts if isinstance(part, str)]
    if len(several) > 1 and all(part in registry.kinds_of(subject) for part in several):
        hint = f"write questions: [{', '.join(f'{{find: {part}}}' for part in several)}]"
        raise at.error("one question asks for one kind", ("find",), hint)


def _same(left: Expr, right: Expr) -> bool:
    return left == right or (rational(left) is not None and rational(left) == rational(right))


def _kind(at: At, data: dict[str, Any], subject: str) -> ModuleType | None:
    """The module of the kind asked for; None where `find` is missing, which is reported elsewhere."""
    typed = data.get("find")
    if not isinstance(typed, str):
        return None
    try:
        return registry.load(subject, typed)
    except KeyError:
        kinds = registry.kinds_of(subject)
        close = did_you_mean(typed, kinds)
        few = f"kinds for {subject}: {', '.join(kinds)}"
        listed = few if len(kinds) < MANY else f"'derive kinds {subject}' lists them"
        hint = close if close.startswith("did") else listed
        fault = at.fault(f"there is no kind '{typed}' for {subject}", ("find",), hint)
        raise SheetErrors([fault]) from None


def _misspelt(at: At, data: dict[str, Any], subject: str, keys: frozenset[str]) -> Iterator[SheetError]:
    """What every question may have, written otherwise, where the kind and its options are not known: the kind
    that is probably meant has no option of this name."""
    close = MEANT.fullmatch(did_you_mean(str(data.get("find")), registry.kinds_of(subject)))
    options = registry.load(subject, close["key"]).Options.model_fields if close else {}
    own = {field.alias or name for name, field in options.items()}
    for key in islice((key for key in data if close and key not in own | keys), MOST):
        if (hint := did_you_mean(key, keys)).startswith("did"):
            yield at.fault(f"unknown key '{key}'", (key,), hint, key=True)


def _without_find_misspelt(errors: SheetErrors, data: dict[str, Any], at: At) -> list[SheetError]:
    """The faults; where `find` is missing and a key looks like it, that key is named instead."""
    if "find" in data:
        return list(errors.errors)
    for key in islice(data, MOST):
        if did_you_mean(key, ["find"]).startswith("did"):
            fault = at.fault(f"unknown key '{key}'", (key,), "did you mean find?", key=True)
            return [fault if "'find'" in error.message else error for error in errors.errors]
    return list(errors.errors)
