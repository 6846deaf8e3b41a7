"""How things look in one format: the macros of `templates/<format>/skin.j2`, called from Python."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from contextvars import ContextVar
from dataclasses import dataclass
from functools import cache
from importlib.util import find_spec
from pathlib import Path, PurePosixPath
from typing import Any, TypeVar

from jinja2 import (
    BaseLoader,
    ChoiceLoader,
    Environment,
    FileSystemLoader,
    FunctionLoader,
    PrefixLoader,
    StrictUndefined,
    pass_context,
)
from jinja2.runtime import Context

from derive.errors import NotAsWritten
from derive.render.compiled import compiled_before
from derive.render.formulas import Formulas
from derive.render.layout import Display
from derive.render.plain_text import typographic, typst_string
from derive.render.untold import Withheld

D = TypeVar("D", bound="Dressing")

PACKAGE = Path(__file__).resolve().parent.parent

HELD_LINE = "\x1e"  # ends a line of a listing until the page is laid out, which may move other lines


HOUSE = "house"  # the folder in which our templates are found whatever stands before them
AS_GIVEN = ("display", "em", "strong", "items", "table", "boxed")  # print each text that they are given


class Dressing(Environment):
    """The templates of the house, or of one's own before them."""

    own: frozenset[str] = frozenset()  # the paths of one's own

    def layers(self, name: str) -> tuple[str, ...]:
        """What stands at a path: our template, and before it one's own."""
        return (f"{HOUSE}/{name}", name) if name in self.own else (name,)

    def text(self, name: str) -> str:
        """A file among the templates, as it stands."""
        assert self.loader is not None
        return self.loader.get_source(self, name)[0]

    def begin(self) -> None:
        """A page begins."""


DRESSING: ContextVar[Dressing | None] = ContextVar("dressing", default=None)


def environment() -> Dressing:
    """The templates that pages are made with here."""
    return DRESSING.get() or _undressed()


@cache
def _undressed() -> Dressing:
    """Those of the house, compiled once for all formats."""
    made = with_templates(Dressing)
    made.bytecode_cache = compiled_before(made)
    return made


def with_templates(kind: type[D], before: BaseLoader | None = None) -> D:
    """Our templates in an environment of this kind, behind others."""
    house = FileSystemLoader(templates())
    loaders = [house, FunctionLoader(_beside_the_module), PrefixLoader({HOUSE: house})]
    made = kind(
        loader=ChoiceLoader([*([before] if before else []), *loaders]),
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


def named(name: str, template: str) -> Any:
    """What a template calls so: a macro, a text. Where one's own template has no such name, ours has."""
    modules = (environment().get_template(each).module for each in reversed(environment().layers(template)))
    return next(found for module in modules if (found := getattr(module, name, None)) is not None)


def block(template: str, name: str, scope: dict[str, Any]) -> str:
    """A block of a template, that of ours where one's own has none; "" where neither has."""
    layers = [environment().get_template(each) for each in reversed(environment().layers(template))]
    found = [layer.blocks[name] for layer in layers if name in layer.blocks]
    context = layers[0].new_context(scope)
    context.blocks[name] = found
    return "".join(found[0](context)) if found else ""


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
    return str(named(name, "words/_english.j2"))


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

    def title(self, text: str) -> str:
        """A title, with the apostrophes that texts have."""
        return self.plain(typographic(text))

    def display(self, display: Display) -> str:
        """A displayed equation."""
        if self.formulas:
            return self._macro("display", self.formulas.display(display))
        return self._macro("display", list(display.lines), display.wide, display.boxed)

    def numbered(self, written: str, number: int) -> str:
        """A display as it was written, with the number of its equation at the margin."""
        return self._macro("numbered", written, number)

    def em(self, text: str) -> str:
        return self._macro("em", text)

    def strong(self, text: str) -> str:
        return self._macro("strong", text)

    def items(self, texts: Iterable[str]) -> str:
        """A bulleted list."""
        return self._macro("items", list(texts))

    def table(self, headings: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
        if any(len(row) != len(headings) for row in rows):
            raise NotAsWritten("a row of a table has more cells than headings, or fewer")
        return self._macro("table", headings, rows)

    def figure(self, path: str, caption: str = "", alt: str = "", solution: bool = False) -> str:
        """A picture, `path` relative to the page: what stands under it, and in plain text what is seen. That
        of a `solution` may stand a little later."""
        return self._macro("figure", path, caption, alt, self.plain(alt), solution)

    def caption(self, number: str, said: str) -> str:
        """`Figure 3: what is said`, or what there is of it."""
        return ": ".join(filter(None, (f"{english('figure')} {number}", said)))

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

    def above(self, number: int, equation: str | None) -> str:
        """The sentence of an answer that an earlier question needed already; its equation may be numbered."""
        named = f", {english('equation')} {equation}" if equation else ""
        return f"{english('above')} {number}{named}."

    def _macro(self, name: str, *arguments: Any) -> str:
        template = f"{self.name}/skin.j2"
        written = str(named(name, template)(*arguments))
        if name in AS_GIVEN and template in environment().own:
            require_texts(written, arguments, template, name)
        return written


def templates() -> Path:
    """The folder that holds `words`, `markdown`, `latex`, `typst` and `html`."""
    installed = PACKAGE / "templates"
    return installed if installed.is_dir() else PACKAGE.parent / "templates"


def require_texts(written: str, given: Any, template: str, macro: str = "") -> None:
    """Raises Withheld where a text that a template was given is not among what it wrote."""
    if isinstance(given, list | tuple):
        for part in given:
            require_texts(written, part, template, macro)
    elif isinstance(given, str) and given not in written and given.replace(r"&\qquad ", "& ") not in written:
        raise Withheld(template, given, macro)
