"""What was asked and what was found: results in SymPy, numbers in NumPy, the working as data, the page."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from html import escape
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from derive.build import assemble
from derive.derivation import Derivation, Phrase
from derive.door.symbolic import TREES, symbolic
from derive.expression import Symbol
from derive.read_back import read_back
from derive.render.document import Document, ProblemPage, QuestionPage
from derive.render.json_result import plain
from derive.render.latex import Printer
from derive.render.page import render_for_pandoc
from derive.render.phrases import Speech, spoken
from derive.sheet.model import Sheet
from derive.writing import write

if TYPE_CHECKING:
    from derive.door.code import Language

FRAME = (
    '<iframe srcdoc="{page}" style="width: 100%; border: 0" '
    "onload=\"this.style.height = this.contentDocument.documentElement.scrollHeight + 'px'\"></iframe>"
)


@dataclass(frozen=True, slots=True)
class Claim:
    """Something that was verified: what, by which means, at how many places, and which kind of proof it is
    ("step", "law", "second-route", "number")."""

    claim: str
    by: str
    holds: bool
    tried: int
    truth: str


@dataclass(frozen=True, slots=True)
class Step:
    """A line of the working in LaTeX, with the name of what it is about and the rule by which it follows."""

    name: str
    rule: str
    latex: str


@dataclass(frozen=True)
class Answer:
    """The answer to one question, derived and verified when it is first looked at: what is read from it
    raises DeriveError where there is no answer. `sheet` holds this question alone."""

    sheet: Sheet

    @cached_property
    def document(self) -> Document:
        """The page of this question."""
        return assemble(self.sheet)

    @property
    def find(self) -> str:
        """What was asked."""
        return self._question.find

    @cached_property
    def results(self) -> dict[str, Any]:
        """By name: a SymPy expression or matrix (a column is n by 1), a list of solutions, words."""
        assumed = self.sheet.problems[0].assumptions
        found = self._derivation.results.items()
        return {name: symbolic(value, assumed, self._said) for name, value in found}

    @cached_property
    def evaluated(self) -> dict[str, Any]:
        """The numbers at the point asked for: floats, complex numbers, NumPy arrays, solutions by name."""
        return {
            name: _numbers(plain(value, self._spoken)) for name, value in self._derivation.evaluated.items()
        }

    @cached_property
    def claims(self) -> tuple[Claim, ...]:
        """All that was verified of the answer and of what it rests on."""
        return tuple(self._claims())

    @cached_property
    def steps(self) -> tuple[Step, ...]:
        """The working, line by line, what the answer rests on first."""
        printer = Printer(self._page.notation)
        return tuple(
            Step(step.name, step.rule, " = ".join(map(printer.write, step.chain)))
            for worked in self._question.order
            for step in worked.derivation.all_steps()
            if step.chain
        )

    def code(self, language: Language, name: str | None = None) -> str:
        """Functions that compute the results (or the one of this name) from their symbols, with common
        sub-expressions taken out. Raises ValueError for what is no formula."""
        from derive.door.code import functions

        return functions(self.results, language, name)

    def __repr__(self) -> str:
        names = ", ".join(self._derivation.results)
        return f"<answer to {self.find}: {names}>"

    def _repr_markdown_(self) -> str:
        page = render_for_pandoc(self.document, read_back)
        return "\n".join(line for line in page.splitlines() if not line.startswith("!["))

    def _repr_html_(self) -> str:
        """The page with its figures, in a frame of its own so that its style stays there."""
        with TemporaryDirectory() as folder:
            write([self.sheet], [self.document], ["html"], Path(folder), "typst", lambda _: None)
            page = (Path(folder) / f"{self.document.name}.html").read_text(encoding="utf-8")
        return FRAME.format(page=escape(page, quote=True))

    def _repr_latex_(self) -> str:
        printer = Printer(self._page.notation)
        lines = [
            f"{printer.write(Symbol(name))} &= {printer.write(value)}"
            for name, value in self._derivation.results.items()
            if isinstance(value, TREES)
        ]
        return "$\\displaystyle \\begin{aligned} " + " \\\\ ".join(lines) + " \\end{aligned}$"

    # -- what it is read from ---------------------------------------------------------------------

    @property
    def _page(self) -> ProblemPage:
        return self.document.problems[0]

    @property
    def _question(self) -> QuestionPage:
        return self._page.questions[0]

    @property
    def _derivation(self) -> Derivation:
        found = self._question.derivation
        assert found is not None
        return found

    @property
    def _spoken(self) -> Speech:
        return spoken(self._question.folder, self._derivation.kind)

    def _said(self, said: Any) -> str:
        return self._spoken.when(said) if isinstance(said, tuple) else self._spoken.say(said)

    def _claims(self) -> Iterator[Claim]:
        worked = [(each.folder, each.derivation, each.derivation.claims) for each in self._question.order]
        for folder, derivation, claims in (
            *worked,
            (self._question.folder, self._derivation, self._question.claims),
        ):
            speech = spoken(folder, derivation.kind)
            for each in claims:
                by = speech.say(Phrase(each.by))
                yield Claim(speech.claim(each), by, each.holds, each.tried, each.truth)


def _numbers(value: Any) -> Any:
    """Of the JSON: lists of numbers are arrays, pairs of `re` and `im` complex numbers."""
    import numpy as np

    match value:
        case {"re": real, "im": imag}:
            return complex(real, imag)
        case dict():
            return {name: _numbers(each) for name, each in value.items()}
        case list():
            found = [_numbers(each) for each in value]
            if all(isinstance(each, int | float | complex | np.ndarray) for each in found):
                return np.array(found)
            return found
    return value
