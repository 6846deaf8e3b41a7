"""How things look in one format: the macros of `templates/<format>/skin.j2`, called from Python."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.util import find_spec
from pathlib import Path, PurePosixPath
from typing import Any

from jinja2 import ChoiceLoader, Environment, FileSystemLoader, FunctionLoader, StrictUndefined, pass_context
from jinja2.runtime import Context

from derive.render.formulas import Formulas
from derive.render.layout import Display
from derive.render.plain_text import typst_string

PACKAGE = Path(__file__).resolve().parent.parent

HELD_LINE = "\x1e"  # ends a line of a listing until the page is laid out, which may move other lines


@cache
def environment() -> Environment:
    """The templates, compiled once a process for all formats."""
    made = Environment(
        loader=ChoiceLoader([FileSystemLoader(templates()), FunctionLoader(_beside_the_module)]),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    made.filters["m"] = _mathematics
    made.filters["measured"] = _measured
    made.filters["each"] = _each
    made.filters["listed"] = _listed
    made.filters["place"] = _place
    made.filters["joined"] = joined
    made.filters["said"] = _said
    made.filters["string_of_typst"] = _typst_string
    return made


def words_file(folder: str, kind: str) -> str:
    """The template with the words of a kind."""
    return f"words/{folder}/{kind.replace('-', '_')}.j2"


def _beside_the_module(name: str) -> str | None:
    """The words of another package's kind: `words/their.package/kind.j2` stands beside its module."""
    folder, package, file = PurePosixPath(name).parts if name.count("/") == 2 else ("", "", "")
    spec = find_spec(package) if folder == "words" else None
    for place in spec.submodule_search_locations or () if spec else ():
        path = Path(place, file)
        if path.is_file():
            return path.read_text(encoding="utf-8")
    return None


@pass_context
def _mathematics(context: Context, value: Any, trig: str | None = None) -> str:
    """`{{ expr | m }}`: inline mathematics by the derivation being told."""
    written: str = context["math"](value, trig)
    return written


@pass_context
def _measured(context: Context, value: Any, unit: str) -> str:
    """`{{ expr | measured("m/s^2") }}`: the same with its unit; behind degrees "/s^2"."""
    written: str = context["math"](value, None, unit)
    return written


@pass_context
def _each(context: Context, letter: str) -> str:
    """`{{ "F" | each }}`: F_i, of the things that the derivation being told calls F_1, F_2, ..."""
    written: str = context["each"](letter)
    return written


def _typst_string(text: str) -> str:
    """`{{ text | string_of_typst }}`: a string in Typst's code, with the lines of a listing."""
    return typst_string(text.replace(HELD_LINE, "\n"))


@pass_context
def _place(context: Context, point: Any) -> str:
    """`{{ point | place }}`: (x, y) = (0, 1), of x = 0 and y = 1."""
    written: str = context["place"](point)
    return written


@pass_context
def _said(context: Context, value: Any) -> str:
    """`{{ phrases | map("said") }}`: what each says."""
    written: str = context["say"](value)
    return written


@pass_context
def _listed(context: Context, values: Iterable[Any], conjunction: str = "") -> str:
    """`{{ names | listed }}`: inline mathematics of each, as `a, b and c`."""
    return joined([_mathematics(context, value) for value in values], conjunction)


def joined(texts: Iterable[str], conjunction: str = "") -> str:
    """`{{ texts | joined }}`: as `a, b and c`. Raises ValueError where there is nothing."""
    texts = [*texts]
    if not texts:
        raise ValueError("nothing to list")
    return f" {conjunction or english('conjunction')} ".join(
        filter(None, (", ".join(texts[:-1]), *texts[-1:]))
    )


def english(name: str) -> str:
    """One of the fixed words of a sheet."""
    return str(getattr(environment().get_template("words/_english.j2").module, name))


def _fence(text: str) -> str:
    """Backticks that a text does not hold."""
    longest = max(map(len, re.findall("`+", text)), default=0)
    return "`" * max(3, longest + 1)


@dataclass(frozen=True, slots=True)
class Skin:
    """The look of one format. `prose` turns an author's Markdown into the format, `plain` a plain text;
    `formulas` spells mathematics where the format does not take it in TeX."""

    name: str
    prose: Callable[[str], str]
    plain: Callable[[str], str]
    formulas: Formulas | None = None

    def display(self, display: Display) -> str:
        """A displayed equation."""
        if self.formulas:
            return self._macro("display", self.formulas.display(display))
        return self._macro("display", list(display.lines), display.wide, display.boxed)

    def em(self, text: str) -> str:
        return self._macro("em", text)

    def strong(self, text: str) -> str:
        return self._macro("strong", text)

    def items(self, texts: Iterable[str]) -> str:
        """A bulleted list."""
        return self._macro("items", list(texts))

    def table(self, headings: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
        return self._macro("table", headings, rows)

    def figure(self, path: str, caption: str = "", alt: str = "") -> str:
        """A picture, `path` relative to the page: what stands under it, and in plain text what is seen."""
        return self._macro("figure", path, caption, alt, self.plain(alt))

    def caption(self, number: int | None, said: str) -> str:
        """`Figure 3: what is said`, or what there is of it."""
        return ": ".join(filter(None, (f"{english('figure')} {number}" if number else "", said)))

    def listing(self, text: str, language: str) -> str:
        """A program as it stands."""
        lines = text.rstrip("\n").replace("\r\n", "\n").replace("\t", "    ").split("\n")
        return self._macro("listing", HELD_LINE.join(lines), language, _fence(text))

    def blanks(self, name: str, identity: str, marks: str, total: int | None) -> str:
        """The line for a name, an identity and, where there are any, the marks of so many."""
        return self._macro("blanks", name, identity, marks, total)

    def boxed(self, title: str, text: str) -> str:
        """A paragraph apart from the others, in a frame."""
        return self._macro("boxed", title, text)

    def room(self, lines: int) -> str:
        """So many blank lines."""
        return self._macro("room", lines)

    def above(self, number: int) -> str:
        """The sentence of an answer that an earlier question needed already."""
        return f"{english('above')} {number}."

    def _macro(self, name: str, *arguments: Any) -> str:
        module = environment().get_template(f"{self.name}/skin.j2").module
        return str(getattr(module, name)(*arguments))


def templates() -> Path:
    """The folder that holds `words`, `markdown`, `latex`, `typst` and `html`."""
    installed = PACKAGE / "templates"
    return installed if installed.is_dir() else PACKAGE.parent / "templates"
