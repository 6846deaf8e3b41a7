"""A sheet as it was understood: frozen values, every formula a tree."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import ModuleType
from typing import Any, Literal, TypeAlias

from derive.errors import Place, SheetError
from derive.expression import Expr
from derive.figures.wish import Wish
from derive.sheet.source import At

Angles: TypeAlias = Literal["deg", "rad"] | None
Steps: TypeAlias = Literal["full", "key", "answers"]


@dataclass(frozen=True, slots=True)
class Notation:
    """How the author wants mathematics printed. `names` are letters of the answers with what stands for them,
    `at` is where this is said."""

    atan2: Literal["yx", "xy"] = "yx"
    trig: Literal["short", "long"] = "short"
    digits: int = 3
    style: str | None = None  # None: the house's own
    angles: Angles = None  # None: as they were typed
    names: Mapping[str, str] = field(default_factory=dict)
    at: At | None = None


@dataclass(frozen=True, slots=True)
class Question:
    """What is asked. `kind` is the module that answers, `options` its own frozen model.

    `evaluate` is the point to evaluate at, empty where nothing is left to give, None where no numbers
    are asked. `answer` is the published answer as typed, `answer_at` where. `place` is where `find` stands.
    """

    number: int
    find: str
    kind: ModuleType
    options: Any
    place: Place
    text: str = ""
    marks: int | None = None
    hint: str = ""
    evaluate: Mapping[str, Expr] | None = None
    answer: Mapping[str, Any] | None = None
    answer_at: At | None = None
    steps: Steps | None = None  # None: as of the sheet


@dataclass(frozen=True, slots=True)
class Problem:
    """A subject and the questions about it. `subject` is a frozen value of mechanics or control.

    `figure` is True or a Wish to draw the subject, None to draw it where that explains something, or the path
    of a picture; it stands at `figure_at`. `where` and `assumptions` include those of the sheet; `warnings`
    are what is strange about the subject. `given` says whether what the subject gives is printed, None where
    the text is to decide.
    """

    number: int
    subject_name: str
    subject: Any
    questions: tuple[Question, ...]
    place: Place
    title: str = ""
    text: str = ""
    figure: bool | Path | Wish | None = None
    where: Mapping[str, Expr] = field(default_factory=dict)
    assumptions: Mapping[str, str] = field(default_factory=dict)
    warnings: tuple[SheetError, ...] = ()
    figure_at: Place | None = None
    given: bool | None = None


@dataclass(frozen=True, slots=True)
class Sheet:
    """A whole sheet; `marks` says whether marks are printed, `problems_title` what it is called without its
    solutions, "" where that is for us to say. `warnings` are all that is strange about it."""

    path: Path
    title: str
    problems: tuple[Problem, ...]
    course: str = ""
    author: str = ""
    date: str = ""
    language: str = "en"
    marks: bool = True
    notation: Notation = Notation()
    warnings: tuple[SheetError, ...] = ()
    problems_title: str = ""
    steps: Steps = "full"
    paper: Literal["a4", "letter"] = "a4"
