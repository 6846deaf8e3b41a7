"""Sheets as Python sees them: problems, questions, and answers that are derived when they are looked at."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from os import PathLike
from pathlib import Path

from derive.door.answers import Answer
from derive.sheet import model
from derive.sheet.load import load_sheet, sheet_of
from derive.sheet.reader import read_text
from derive.sheet.source import At


@dataclass(frozen=True)
class Question:
    """What is asked, in the words of its author, by the name of its kind."""

    number: int
    find: str
    text: str
    marks: int | None
    alone: model.Sheet

    @cached_property
    def answer(self) -> Answer:
        """What was found, with all that it rests on."""
        return Answer(self.alone)


@dataclass(frozen=True)
class Problem:
    """A subject and the questions about it."""

    number: int
    title: str
    text: str
    questions: tuple[Question, ...]


@dataclass(frozen=True)
class Sheet:
    """A sheet that was read and understood; nothing of it is derived yet."""

    title: str
    problems: tuple[Problem, ...]
    read: model.Sheet

    def __iter__(self) -> Iterator[Problem]:
        return iter(self.problems)


def load(path: str | PathLike[str]) -> Sheet:
    """The sheet in a file. Raises DeriveError with every fault of it."""
    return _sheet(load_sheet(Path(path)))


def loads(text: str, path: str | PathLike[str] = "sheet.yaml") -> Sheet:
    """The sheet in a text; robots and pictures that it names are found beside `path`. Raises DeriveError."""
    return _sheet(sheet_of(At(read_text(text, Path(path)))))


def _sheet(read: model.Sheet) -> Sheet:
    problems = (
        Problem(each.number, each.title, each.text, tuple(_questions(read, each))) for each in read.problems
    )
    return Sheet(read.title, tuple(problems), read)


def _questions(read: model.Sheet, problem: model.Problem) -> Iterator[Question]:
    for each in problem.questions:
        alone = replace(read, problems=(replace(problem, questions=(each,)),))
        yield Question(each.number, each.find, each.text, each.marks, alone)
