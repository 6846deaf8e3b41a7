"""Every field of the language as tables in Markdown: of a sheet, of each subject, of what can be asked."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from derive.kinds import registry as kinds
from derive.sheet.fields_listed import Field, Fields, listed
from derive.sheet.given import ASKED_KEYS, GivenProblem, GivenQuestion, GivenSheet
from derive.sheet.subjects import registry as subjects

HEAD = "| field | what it is for | what may stand there |\n|---|---|---|"
OPTIONS_HEAD = "| `find` | field | what it is for | what may stand there |\n|---|---|---|---|"


def reference() -> str:
    """The sections, one after the other."""
    around = {"Sheet": GivenSheet, "Problem": GivenProblem, "Question": GivenQuestion}
    parts = [_section(title, _tables(model)) for title, model in around.items()]
    for subject in subjects.subjects():
        shown = [*_tables(subjects.load(subject).Given), *_options(subject)]
        parts.append(_section(f"`{subject}`", shown))
    return "\n".join(parts)


def _section(title: str, blocks: list[str]) -> str:
    return "\n\n".join([f"### {title}", *blocks]) + "\n"


def _tables(model: Any) -> list[str]:
    """A table for each form, the first ones those of the model itself."""
    return [_table(each) for each in listed(model)]


def _table(form: Fields) -> str:
    rows = "\n".join(f"| {_cells(field)} |" for field in form.fields)
    return f"`{form.form}` {form.about}\n\n{HEAD}\n{rows}"


def _options(subject: str) -> Iterator[str]:
    """What may stand beside `find`, in one table, then the forms inside of it."""
    rows, inner = [], dict[str, Fields]()
    for kind in kinds.kinds_of(subject):
        first, *more = listed(kinds.load(subject, kind).Options) or (None,)
        own = [field for field in (first.fields if first else ()) if field.name not in ASKED_KEYS]
        rows += [f"| `{kind}` | {_cells(field)} |" for field in own]
        inner |= {each.form: each for each in more}
    if rows:
        yield "\n".join([f"Beside `find`, where the subject is `{subject}`:\n\n{OPTIONS_HEAD}", *rows])
    yield from map(_table, inner.values())


def _cells(field: Field) -> str:
    cells = (f"`{field.name}`", field.said, field.form)
    return " | ".join(cell.replace("|", r"\|").replace("*", r"\*") for cell in cells)
