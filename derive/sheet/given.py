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
    """How mathematics is printed. `names` are letters of the answers, each with the author's own for it."""

    atan2: Literal["yx", "xy"] = "yx"
    trig: Literal["short", "long"] = "short"
    digits: Annotated[int, Field(ge=1, le=15)] = 3
    style: Style | None = None
    angles: Literal["deg", "rad"] | None = None
    names: Annotated[dict[Letter, Letter], Field(max_length=50)] = {}


class GivenSheet(_Model):
    """The top of a sheet. Its problems are read one by one. `problems_title` is what the sheet is called
    without its solutions."""

    title: Line
    problems: Annotated[list[Any], Field(min_length=1, max_length=1000)]
    course: Line = ""
    author: Line = ""
    date: Line = ""
    language: Literal["en"] = "en"
    steps: Steps = "full"
    paper: Literal["a4", "letter"] = "a4"
    marks: bool = True
    problems_title: Line = ""
    notation: GivenNotation = GivenNotation()
    symbols: Annotated[dict[Name, Assumption], Field(max_length=500)] = {}
    where: Annotated[dict[Name, Quantity], Field(max_length=500)] = {}


class GivenBody(_Model):
    """A body with flat faces, in frame 0. Corners are named, those at the origins of frames o0, o1, ...; a
    face is the list of its corners in order; `lengths` writes a length beside an edge, `angles` the name of
    an angle (corner, vertex, corner) at its arc."""

    corners: Annotated[dict[Name, Point], Field(max_length=100)] = {}
    faces: Annotated[list[Annotated[list[Name], Field(min_length=3, max_length=50)]], Field(max_length=100)]
    lengths: Annotated[list[tuple[Name, Name, Quantity]], Field(max_length=100)] = []
    angles: Annotated[list[tuple[Name, Name, Name, Quantity]], Field(max_length=100)] = []


class GivenFigure(_Model):
    """A figure that we draw: the values with which names are drawn, and a body that frames stand on."""

    at: Annotated[dict[Name, Quantity], Field(max_length=100)] = {}
    body: GivenBody | None = None


def _figure_form(value: Any) -> str:
    return "=drawn" if isinstance(value, dict) else "=typed"


FigureField: TypeAlias = Annotated[
    Annotated[GivenFigure, Tag("=drawn")] | Annotated[str, Tag("=typed")], Discriminator(_figure_form)
]


class GivenProblem(_Model):
    """A problem, apart from its subject and its questions. `given: true` prints all that its subject gives,
    `false` nothing; left out, what the text does not say."""

    title: Line = ""
    text: Text = ""
    figure: FigureField = ""
    given: bool | None = None
    symbols: Annotated[dict[Name, Assumption], Field(max_length=500)] = {}
    where: Annotated[dict[Name, Quantity], Field(max_length=500)] = {}


def _evaluate_form(value: Any) -> str:
    return "=point" if isinstance(value, dict) else "=true"


Evaluate: TypeAlias = Annotated[
    Annotated[dict[Name, Quantity], Field(max_length=500), Tag("=point")]
    | Annotated[Literal["true"], Tag("=true")],
    Discriminator(_evaluate_form),
]


class GivenAsked(_Model):
    """What may stand beside `find` whatever the kind, `text` apart."""

    find: str
    marks: Annotated[int, Field(ge=0, le=10_000)] | None = None
    hint: Text = ""
    evaluate: Evaluate | None = None
    answer: dict[str, Any] | None = None
    steps: Steps | None = None


class GivenQuestion(GivenAsked):
    """A question in a list of questions."""

    text: Text = ""


QUESTION_KEYS = frozenset(GivenQuestion.model_fields)
ASKED_KEYS = frozenset(GivenAsked.model_fields)
PROBLEM_KEYS = frozenset(GivenProblem.model_fields)
