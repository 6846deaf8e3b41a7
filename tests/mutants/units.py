"""One problem of a sheet: the smallest thing that is built, and what of the code it reaches."""

from __future__ import annotations

import json
import os
import pickle
import signal
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from importlib import import_module
from pathlib import Path
from pkgutil import walk_packages
from typing import Any

import pytest
from jinja2 import Environment, Template

import derive
from derive.build import derive_all
from derive.errors import SheetErrors
from derive.kinds import registry
from derive.render.questions import example_of
from derive.render.skin import environment, templates
from derive.sheet.load import load_sheet
from derive.sheet.subjects.registry import subjects
from derive.writing import render
from tests.sheets import SHEETS

Lines = dict[str, frozenset[int]]  # reached, by file
OUT_OF_TIME = 20.0  # seconds: a build of one problem takes one or two


@dataclass(frozen=True, slots=True)
class Unit:
    """A problem by its place on a sheet."""

    sheet: Path
    problem: int

    def __str__(self) -> str:
        return f"{self.sheet.stem}__{self.problem + 1}"


@dataclass(frozen=True, slots=True)
class Page:
    """What a reader gets: the page, and the results as the JSON has them."""

    text: str
    results: dict[str, Any]


@dataclass(frozen=True, slots=True)
class Refused:
    """What was said instead of a page; `failed` where a check of ours did, `crash` where the program did."""

    message: str
    failed: bool = False
    crash: bool = False


def built(unit: Unit) -> Page | Refused:
    """The page of one problem, or why there is none."""
    try:
        sheet = load_sheet(unit.sheet)
        alone = replace(sheet, problems=(sheet.problems[unit.problem],))
        (document,) = derive_all([alone], True, lambda _: None)
        page = render(document, "md")
        (told,) = json.loads(render(document, "json"))["problems"]
    except SheetErrors as errors:
        message = "; ".join(error.message for error in errors.errors)
        return Refused(message, "check" in message or "prove" in message or "read back" in message)
    except Exception as error:
        return Refused(f"{type(error).__name__}: {error}", crash=True)
    results = {
        f"{question['number']}.{part}": question[part]
        for question in told["questions"]
        for part in ("results", "evaluated")
        if part in question
    }
    return Page(page, results)


def units(folder: Path) -> list[Unit]:
    """Every problem of the exercises and of the examples of kinds, which are written to a folder."""
    sheets = list(SHEETS)
    for module in sorted({m for subject in subjects() for m in registry.kinds_of(subject).values()}):
        path = folder / f"example-{module.removeprefix('derive.kinds.').replace('.', '-')}.yaml"
        path.write_text(example_of(module), encoding="utf-8")
        sheets.append(path)
    return [Unit(sheet, i) for sheet in sheets for i in range(len(load_sheet(sheet).problems))]


def warmed() -> None:
    """Imports every module and compiles every template, and runs nothing else: what is forked begins here."""
    for module in walk_packages(derive.__path__, "derive."):
        if not module.name.endswith("__main__"):
            import_module(module.name)
    import_module("numpy")
    for path in sorted(templates().rglob("*.j2")):
        environment().get_template(str(path.relative_to(templates())))


def forked(work: Callable[[], Any], limit: float = OUT_OF_TIME) -> Any:
    """What some work gives in a process of its own; None where it takes too long or dies."""
    with tempfile.TemporaryFile() as answer:
        child = os.fork()
        if not child:
            signal.setitimer(signal.ITIMER_REAL, limit)  # ends the process
            try:
                pickle.dump(work(), answer)
                answer.flush()
            finally:
                os._exit(0)
        os.waitpid(child, 0)
        answer.seek(0)
        try:
            return pickle.load(answer)
        except EOFError:
            return None


def reached(unit: Unit) -> tuple[Page | Refused, Lines]:
    """A unit as it is built without a mistake, and the lines of derive and of templates that this runs."""
    from coverage import Coverage

    folder = Path(derive.__file__).parent
    watch = Coverage(data_file=None, include=[f"{folder}/*"], messages=False)
    with _templates_used() as used:
        watch.start()
        page = built(unit)
        watch.stop()
    data = watch.get_data()
    lines: Lines = {file: frozenset(data.lines(file) or ()) for file in data.measured_files()}
    return page, lines | {str(templates() / name): frozenset() for name in used}


@contextmanager
def _templates_used() -> Iterator[set[str]]:
    """The names of those that are asked for, by pages and by each other."""
    used: set[str] = set()
    get = Environment.get_template

    def noted(self: Environment, name: Any, *others: Any, **more: Any) -> Template:
        used.add(str(name))
        return get(self, name, *others, **more)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Environment, "get_template", noted)
        yield used
