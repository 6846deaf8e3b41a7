"""What can be asked, said in text: the kinds of every subject, and sheets to start from."""

from __future__ import annotations

import inspect
from collections.abc import Iterable
from textwrap import wrap
from types import ModuleType
from typing import Any

from derive.errors import SheetError, SheetErrors
from derive.kinds import registry as kinds
from derive.render.questions import example_of, results_of
from derive.render.skin import templates
from derive.sheet.faults import did_you_mean
from derive.sheet.fields_listed import Field, listed
from derive.sheet.subjects import registry as subjects

WIDTH = 110
SCHEMA = "derive-schema.json"  # beside a sheet: what an editor reads
COMMENTS = f"""\
# yaml-language-server: $schema={SCHEMA}
# Build it with: derive {{name}}.yaml
# Everything stays exact until it is printed: 0.1 m is 1/10, 30 deg is pi/6. A star marks a joint
# variable (theta1*). 'derive kinds' lists what can be asked.
"""


def overview() -> str:
    """Every kind with its first line, under its subject."""
    lines = []
    for subject in subjects.subjects():
        lines.append(f"{subject}: {_meaning(subject)}")
        width = max((len(kind) for kind in kinds.kinds_of(subject)), default=0)
        for kind in kinds.kinds_of(subject):
            lines.append(f"  {kind:<{width}}  {_first_line(kinds.load(subject, kind))}")
        lines.append("")
    lines.append("'derive kinds SUBJECT' shows how a subject is described, 'derive kinds SUBJECT KIND' or")
    lines.append("'derive kinds KIND' the options, the results and an example of one question.")
    return "\n".join(lines) + "\n"


def table() -> str:
    """Subjects and what can be asked of each, as a Markdown table for a page of documentation."""
    rows = ["| subject | what it is | `find` |", "|---|---|---|"]
    for subject in subjects.subjects():
        asked = ", ".join(f"`{kind}`" for kind in kinds.kinds_of(subject))
        rows.append(f"| `{subject}` | {_meaning(subject).removesuffix('.')} | {asked} |")
    return "\n".join(rows) + "\n"


def describe(name: str, kind: str | None = None) -> str:
    """All about a subject, or about what can be asked of it; of a name that means different things of
    different subjects, about each of them. Raises SheetErrors."""
    if kind is not None:
        _require(name, subjects.subjects(), "subject")
        _require(kind, kinds.kinds_of(name), "kind", f" for {name}")
        return _described(kind, [name], kinds.load(name, kind))
    about = [_subject(name)] if name in subjects.subjects() else []
    if about and not any(name in kinds.kinds_of(subject) for subject in subjects.subjects()):
        return about[0]
    return "\n".join([*about, *(_described(name, owners, module) for owners, module in _find(name))])


def _subject(subject: str) -> str:
    """What a subject is, how it is described, and what can be asked of it."""
    module = subjects.load(subject)
    asked = {kind: _first_line(kinds.load(subject, kind)) for kind in kinds.kinds_of(subject)}
    example = example_of(next(iter(kinds.kinds_of(subject).values())))
    blocks = [inspect.getdoc(module) or "", _fields("Fields", module.Given)]
    blocks += [_listed("What can be asked", asked), "Example:\n\n" + _indented(example.strip())]
    blocks += [f"'derive kinds {subject} KIND' shows the options and the results of one question."]
    return "\n\n".join(blocks) + "\n"


def _require(name: str, known: Iterable[str], what: str, whose: str = "") -> None:
    """Raises SheetErrors for a name that is not known, with the one that was probably meant."""
    if name not in (names := list(known)):
        hint = did_you_mean(name, names, f"{what}s{whose}")
        raise SheetErrors([SheetError(f"there is no {what} '{name}'{whose}", None, hint)])


def _described(kind: str, owners: list[str], module: ModuleType) -> str:
    blocks = [f"{kind} ({', '.join(owners)})", inspect.getdoc(module) or ""]
    blocks.append(_fields("Options", module.Options))
    blocks.append(_listed("Results", results_of(module.__name__)))
    blocks.append("Example:\n\n" + _indented(example_of(module.__name__).strip()))
    return "\n\n".join(block for block in blocks if block) + "\n"


def starter(name: str, kind: str | None) -> str:
    """A sheet to start from under a few comments: a tour of the language, or the example of a kind.
    Raises SheetErrors."""
    if kind is None:
        return COMMENTS.format(name=name) + (templates() / "tour.yaml").read_text(encoding="utf-8")
    _, module = _find(kind)[0]
    return COMMENTS.format(name=name) + example_of(module.__name__).strip() + "\n"


def _find(kind: str) -> list[tuple[list[str], ModuleType]]:
    """The modules of a kind, each with the subjects it can be asked of; that of robots first."""
    found: dict[str, list[str]] = {}
    for subject in sorted(subjects.subjects(), key=lambda name: name != "robot"):
        if kind in (known := kinds.kinds_of(subject)):
            found.setdefault(known[kind], []).append(subject)
    if not found:
        every = {known for subject in subjects.subjects() for known in kinds.kinds_of(subject)}
        _require(kind, every | set(subjects.subjects()), "kind")
    return [(sorted(owners), kinds.load(owners[0], kind)) for owners in found.values()]


def _fields(title: str, model: Any) -> str:
    """The fields of a model under a title, and those of what may stand inside of it."""
    blocks = []
    for index, each in enumerate(listed(model)):
        head = title if index == 0 else f"  {each.form}"
        entries = {field.name: _sentence(field) for field in each.fields}
        blocks.append(_listed(head, entries, each.about.replace("`", "")))
    return "\n\n".join(blocks)


def _sentence(field: Field) -> str:
    return f"{field.said} [{field.form}]" if field.said and field.form else field.said or field.form


def _listed(title: str, entries: dict[str, str], about: str = "") -> str:
    width = max((len(name) for name in entries), default=0)
    lines = [_wrapped(meaning, f"  {name:<{width}}  ") for name, meaning in entries.items()]
    head = [f"{title}:", *([_wrapped(about, "  "), ""] if about else ())]
    return "\n".join([*head, *lines]) if lines else f"{title}: none"


def _wrapped(text: str, first: str) -> str:
    lines = wrap(text, WIDTH, initial_indent=first, subsequent_indent=" " * len(first))
    return "\n".join(lines) or first.rstrip()


def _indented(text: str, by: int = 4) -> str:
    return "\n".join(f"{' ' * by}{line}".rstrip() for line in text.splitlines())


def _meaning(subject: str) -> str:
    return _first_line(subjects.load(subject)).partition(": ")[2]


def _first_line(module: ModuleType) -> str:
    return (inspect.getdoc(module) or "").partition("\n")[0]
