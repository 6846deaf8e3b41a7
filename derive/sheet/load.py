"""A sheet from its file: read, understood, and every fault in it reported at once."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import islice
from pathlib import Path
from typing import Any

from derive.errors import SheetError, SheetErrors, position
from derive.expression import free_symbols
from derive.figures.wish import Polyhedron, Wish
from derive.kinds.figures import DRAWN
from derive.known.files import lies_below
from derive.sheet.checked import checked
from derive.sheet.cut import cut_fault, cut_off
from derive.sheet.doubts import POINTS, angles_of, doubts_about
from derive.sheet.faults import MOST, did_you_mean, untold
from derive.sheet.given import PROBLEM_KEYS, GivenFigure, GivenProblem, GivenSheet
from derive.sheet.honoured import ignored
from derive.sheet.model import Notation, Problem, Question, Sheet
from derive.sheet.named_files import missing
from derive.sheet.questions import has_option, inline_question, questions
from derive.sheet.reader import read
from derive.sheet.source import At, Faults
from derive.sheet.subject import read_subject, subject_name, subject_place
from derive.sheet.subjects import registry
from derive.sheet.subjects.registry import Known
from derive.sheet.unfilled import unfilled
from derive.sheet.unused import unused
from derive.sheet.where import contradictions, cycle, nested


def load_sheet(path: Path) -> Sheet:
    """The sheet in a file. Raises SheetErrors with every fault of it."""
    return sheet_of(At(read(path)))


def sheet_of(at: At) -> Sheet:
    """The sheet in a source already read. Raises SheetErrors."""
    if not isinstance(at.value(), dict):
        hint = "start it with title: ..., then problems:"
        raise at.error("a sheet is written as keys and values", (), hint)
    faults = Faults()
    given, known = None, Known(assumptions=dict.fromkeys(_declared(at.value()), ""))
    with faults.gathered():
        given = checked(GivenSheet, at, at.value(), _declared(at.value()))
        known = _known(at, given, Known())
    problems = _problems(at, known, faults)
    faults += unfilled(at.source, faults)
    if faults or given is None:
        raise SheetErrors(_distinct(faults))
    notation = Notation(**dict(given.notation), at=at / "notation")
    return Sheet(
        at.source.path,
        given.title,
        tuple(problems),
        given.course,
        given.author,
        given.date,
        given.language,
        given.marks,
        notation,
        _warnings(at, problems),
        given.problems_title,
        given.steps,
        given.paper,
    )


def _warnings(at: At, problems: list[Problem]) -> tuple[SheetError, ...]:
    """All that is strange about a sheet, in the order of the file."""
    strange = (warning for problem in problems for warning in problem.warnings)
    return tuple(sorted(_distinct([*at.source.doubts, *strange, *unused(at, problems)]), key=position))


def _problems(at: At, known: Known, faults: Faults) -> list[Problem]:
    """Every problem that can be understood; what cannot is added to the faults."""
    entries = at.value(("problems",))
    found = []
    for index, entry in enumerate(entries if isinstance(entries, list) else ()):
        with faults.gathered():
            found.append(_problem(at / "problems" / index, entry, index + 1, known))
    return found


def _problem(at: At, data: Any, number: int, outer: Known) -> Problem:
    if not isinstance(data, dict):
        raise at.error("a problem is written as keys and values", (), "write - title: ...")
    faults = Faults()
    given, known = None, outer
    names = outer.names | _declared(data)
    with faults.gathered():
        given = checked(GivenProblem, at, {key: data[key] for key in data if key in _own(data)}, names)
        known = _known(at, given, outer)
    subject: Any = None
    asked: tuple[Question, ...] = ()
    name = ""
    with faults.gathered():
        name = subject_name(at, data)
    if not name:
        faults.settle()
    with faults.gathered():
        asked = _asked(at, data, name, known)
    with faults.gathered():
        place = subject_place(at, name)
        typed = read_subject(place, name, known)
        faults.extend(ignored(asked, name, typed, place))
        subject = registry.load(name).build(typed, place, known)
        faults.extend(_unmet(asked, name, subject, place))
    if faults or given is None:
        raise SheetErrors(faults)
    strange = (*_strange(name, subject, place, known), *_doubts(at, data, subject))
    if place.source is not at.source:
        strange = (*place.source.doubts, *strange)
    figure = _figure(at, given.figure, name)
    where = at.place()
    return Problem(
        number, name, subject, asked, where, given.title, given.text, figure, known.where,
        known.assumptions, strange, at.place(("figure",)), given.given,
    )  # fmt: skip


def _own(data: dict[str, Any]) -> frozenset[str]:
    """The keys of the problem itself; beside `find`, a `given` that is not true or false may be an option."""
    typed = data.get("given", "true")
    if typed in ("true", "false") or not any(has_option(key, data.get("find"), "given") for key in data):
        return PROBLEM_KEYS
    return PROBLEM_KEYS - {"given"}


def _asked(at: At, data: dict[str, Any], name: str, known: Known) -> tuple[Question, ...]:
    own = _own(data)
    rest = {key: value for key, value in data.items() if key not in own and key != name}
    if "questions" not in rest:
        if "find" not in rest:
            raise SheetErrors([_nothing_asked(at, rest)])
        return (inline_question(at, rest, name, known),)
    strange = [key for key in rest if key != "questions"]
    faults = Faults(_unknown(at, key) for key in strange[:MOST])
    faults += untold(len(strange) - MOST, faults)
    found: tuple[Question, ...] = ()
    with faults.gathered():
        found = questions(at, data, name, known)
    faults.settle()
    return found


def _unknown(at: At, key: str) -> SheetError:
    if cut_off(at, (key,)):
        return cut_fault(at, (key,))
    if key == "find":
        hint = "put it under questions: as - find: ..."
        return at.fault("a problem has either 'find' or 'questions'", (key,), hint, key=True)
    hint = did_you_mean(key, (*PROBLEM_KEYS, "questions"), "a problem has")
    return at.fault(f"unknown key '{key}'", (key,), hint, key=True)


def _nothing_asked(at: At, rest: dict[str, Any]) -> SheetError:
    for key in islice(rest, MOST):
        if (close := did_you_mean(key, ("questions", "find"))).startswith("did"):
            return at.fault(f"unknown key '{key}'", (key,), close, key=True)
    return at.fault("nothing is asked in this problem", (), "add questions: with - find: ...")


def _unmet(asked: tuple[Question, ...], name: str, subject: Any, place: At) -> list[SheetError]:
    """What the kinds need of the subject and it does not have, each said once."""
    missing = getattr(registry.load(name), "missing", None)
    needs = {need: None for question in asked for need in getattr(question.kind, "NEEDS", ())}
    return [fault for need in needs for fault in missing(subject, need, place)] if missing else []


def _strange(name: str, subject: Any, place: At, known: Known) -> tuple[SheetError, ...]:
    """What is strange about a subject, though it can be worked with."""
    warnings = getattr(registry.load(name), "warnings", None)
    return tuple(warnings(subject, place, known)) if warnings else ()


def _doubts(at: At, data: dict[str, Any], subject: Any) -> Iterator[SheetError]:
    """What is strange about the values given to angles of the subject."""
    angles = angles_of(subject)
    entries = data.get("questions")
    asked = [at / "questions" / k for k in range(len(entries))] if isinstance(entries, list) else [at]
    yield from doubts_about(At(at.source), "where", angles)
    yield from doubts_about(at, "where", angles)
    for question in asked:
        for key in POINTS:
            yield from doubts_about(question, key, angles)


def _known(at: At, given: GivenSheet | GivenProblem, outer: Known) -> Known:
    where = {**outer.where, **given.where}
    if name := cycle(where):
        hint = "give it a value, or one in other names"
        raise at.error(f"the value of {name} leads back to itself", ("where", name), hint)
    if name := nested(where):
        hint = "give a name on the way to it no value"
        message = f"with the values of its names put in, {name} is nested too deeply"
        raise at.error(message, ("where", name), hint)
    assumptions: Mapping[str, str] = {**outer.assumptions, **given.symbols}
    for name, assumed in sorted(contradictions(where, assumptions)):
        key = "where" if name in given.where else "symbols"
        hint = "change its value, or what is said of it under symbols:"
        raise at.error(f"{name} is {assumed} by symbols, and its value is not", (key, name), hint)
    return Known(where, assumptions)


def _declared(data: Any) -> frozenset[str]:
    """The names under `symbols` and `where`, as typed, which are never read as units."""
    blocks = [data.get(key) for key in ("symbols", "where")] if isinstance(data, dict) else []
    return frozenset(name for block in blocks if isinstance(block, dict) for name in block)


def _figure(at: At, typed: str | GivenFigure, subject: str) -> bool | Path | Wish | None:
    if not typed:
        return None
    if isinstance(typed, GivenFigure):
        return _wish(at / "figure", typed, subject)
    if typed == "true" and subject not in DRAWN:
        hint = f"{', '.join(sorted(DRAWN))} can be drawn; else give the path of a picture beside the sheet"
        raise at.error(f"there is no drawing of a {subject}", ("figure",), hint)
    if typed in ("true", "false"):
        return typed == "true"
    folder = at.source.path.parent
    path = folder / typed
    if not lies_below(path, folder):
        raise at.error("the picture lies outside the folder of the sheet", ("figure",))
    if fault := missing(path, typed, "picture"):
        raise at.error(fault, ("figure",), "its path is relative to the sheet")
    return path


def _wish(at: At, typed: GivenFigure, subject: str) -> Wish:
    """How a subject is to be drawn. Raises SheetErrors for what cannot be."""
    if typed.body and subject != "frames":
        raise at.error(f"a {subject} stands on no body", ("body",), "a body is drawn with frames")
    if subject not in DRAWN:
        raise at.error(f"there is no drawing of a {subject}")
    for name, value in typed.at.items():
        if unknown := sorted(free_symbols(value)):
            raise at.error(f"{name} is drawn with a number, and {unknown[0]} is none", ("at", name))
    if not typed.body:
        return Wish(typed.at)
    body = Polyhedron(
        typed.body.corners,
        tuple(map(tuple, typed.body.faces)),
        tuple(typed.body.lengths),
        tuple(typed.body.angles),
    )
    return Wish(typed.at, body)


def _distinct(faults: list[SheetError]) -> list[SheetError]:
    return list({(fault.place, fault.message): fault for fault in faults}.values())
