"""What an author may write around the subjects and the options of kinds: the pydantic models."""

from __future__ import annotations

from typing import Annotated, Any, Literal, TypeAlias

from pydantic import BaseModel, ConfigDict, Discriminator, Field, Tag

from derive.kinds.fields import Name, Point, Quantity
from derive.sheet.tex import Text

Assumption: TypeAlias = Literal["positive", "nonnegative", "nonzero", "integer", "real"]
Line: TypeAlias = Annotated[Text, Field(max_length=300)]
Steps: TypeAlias = Literal["full", "key", "answers"]
Style: TypeAlias = Literal["spong", "siciliano", "craig", "lynch"]
Letter: TypeAlias = Annotated[Name, Field(pattern=r"^[A-Za-z]+$", max_length=20)]


class _Model(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", arbitrary_types_allowed=True)


class GivenNotation(_Model):
    """How mathematics is printed."""

    atan2: Literal["yx", "xy"] = "yx"
    """yx: atan2(y, x), as in code; xy: Atan2(x, y), as in Spong."""
    trig: Literal["short", "long"] = "short"
    """short: c_1, s_12; long: cos(theta_1)."""
    digits: Annotated[int, Field(ge=1, le=15)] = 3
    """Significant digits of numbers that are evaluated."""
    style: Style | None = None
    """Whose letters, indices of frames and order of columns are used."""
    angles: Literal["deg", "rad"] | None = None
    """The unit of angles that are evaluated; as they were typed if left out."""
    names: Annotated[dict[Letter, Letter], Field(max_length=50)] = {}
    """Letters of the answers, each with your own for it, as {T: H, tau: Q}."""


class GivenSheet(_Model):
    """A sheet of exercises."""

    title: Line
    """The title of the solution sheet."""
    problems: Annotated[list[Any], Field(min_length=1, max_length=1000)]
    """The problems, in order."""
    course: Line = ""
    """The name of the course, printed at the head."""
    author: Line = ""
    """Who wrote the sheet, printed at the head."""
    date: Line = ""
    """A date as it is to be printed."""
    language: Literal["en"] = "en"
    """The language of the pages."""
    steps: Steps = "full"
    """full: all the working; key: formula and result; answers: the result alone."""
    paper: Literal["a4", "letter"] = "a4"
    """The size of the pages."""
    marks: bool = True
    """Whether marks are printed."""
    problems_title: Line = ""
    """The title of the sheet without its solutions."""
    notation: GivenNotation = GivenNotation()
    """How mathematics is printed."""
    symbols: Annotated[dict[Name, Assumption], Field(max_length=500)] = {}
    """What is taken for granted of names, as {L: positive}."""
    where: Annotated[dict[Name, Quantity], Field(max_length=500)] = {}
    """Names kept while working and replaced by their values in the last line, as {h: L/2}."""


class GivenBody(_Model):
    """A body with flat faces, in frame 0. Its corners are named; those at the origins of frames are o0, o1,
    ..."""

    corners: Annotated[dict[Name, Point], Field(max_length=100)] = {}
    """The corners, each by its name and its place."""
    faces: Annotated[list[Annotated[list[Name], Field(min_length=3, max_length=50)]], Field(max_length=100)]
    """The faces, each a list of its corners in order."""
    lengths: Annotated[list[tuple[Name, Name, Quantity]], Field(max_length=100)] = []
    """Lengths written beside edges, as [o0, p, b]."""
    angles: Annotated[list[tuple[Name, Name, Name, Quantity]], Field(max_length=100)] = []
    """Angles written at their arcs, as [corner, vertex, corner, beta]."""


class GivenFigure(_Model):
    """A figure that is drawn."""

    at: Annotated[dict[Name, Quantity], Field(max_length=100)] = {}
    """The values with which names are drawn, as {theta1: 30 deg}."""
    body: GivenBody | None = None
    """A body that frames stand on."""


def _figure_form(value: Any) -> str:
    return "=drawn" if isinstance(value, dict) else "=typed"


FigureField: TypeAlias = Annotated[
    Annotated[GivenFigure, Tag("=drawn")] | Annotated[str, Tag("=typed")], Discriminator(_figure_form)
]


class GivenProblem(_Model):
    """A problem: its subject, and what is asked about it."""

    title: Line = ""
    """The title of the problem."""
    text: Text = ""
    """What is given, in Markdown with mathematics in $...$; single quotes keep the TeX as it is."""
    figure: FigureField = ""
    """true: the subject is drawn; the name of a picture beside the sheet; or how it is drawn. Left out, it is
    drawn where that explains something."""
    given: bool | None = None
    """true prints all that the subject gives, false nothing; left out, what the text does not say."""
    symbols: Annotated[dict[Name, Assumption], Field(max_length=500)] = {}
    """What is taken for granted of names in this problem, as {L: positive}."""
    where: Annotated[dict[Name, Quantity], Field(max_length=500)] = {}
    """Names kept while working and replaced by their values in the last line, as {h: L/2}."""


def _evaluate_form(value: Any) -> str:
    return "=point" if isinstance(value, dict) else "=true"


Evaluate: TypeAlias = Annotated[
    Annotated[dict[Name, Quantity], Field(max_length=500), Tag("=point")]
    | Annotated[Literal["true"], Tag("=true")],
    Discriminator(_evaluate_form),
]


class GivenAsked(_Model):
    """The one question of a problem. Options of the kind stand beside these keys."""

    find: str
    """What is asked: the kind of question."""
    marks: Annotated[int, Field(ge=0, le=10_000)] | None = None
    """How many marks the question has."""
    hint: Text = ""
    """A hint, printed on problem sheets and solution sheets, in Markdown."""
    evaluate: Evaluate | None = None
    """A point at which numbers are wanted too, as {theta1: 30 deg, L: 0.5 m}; true where nothing is left to
    be given."""
    answer: dict[str, Any] | None = None
    """What a book, an old key or a student gave for results, by name; derive check proves it or shows where
    it differs."""
    steps: Steps | None = None
    """full: all the working; key: formula and result; answers: the result alone."""


class GivenQuestion(GivenAsked):
    """A question in a list of questions."""

    text: Text = ""
    """The question in your own words, in Markdown; one is written if it is left out."""


QUESTION_KEYS = frozenset(GivenQuestion.model_fields)
ASKED_KEYS = frozenset(GivenAsked.model_fields)
PROBLEM_KEYS = frozenset(GivenProblem.model_fields)
