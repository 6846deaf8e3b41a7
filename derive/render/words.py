"""Runs the words of a kind: a Jinja template whose sentences refer to the steps of a derivation.

In scope of a words template: `d`, `step(name)`, `facts`, `asked`, `read`, the filters `m`, `each`
and `listed`, and the functions `show`, `answer`, `result`, `inline`, `tell`, `table`, `plot`, `say`,
`listing`, `path`, `em`, `strong`, `items`, `again`, `conditions`, `cited`, `found`, `worked`, `lengthy`. Its
blocks `question` and `phrases` are left out here. A step the words neither show nor tell is an error: nothing
that was derived goes unsaid unnoticed. Steps are told in the order in which they were derived, so that
nothing is used before it is found.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import PurePosixPath
from typing import Any

from jinja2 import Template

from derive.derivation import Cell, Condition, Derivation, Phrase, Step, Table
from derive.expression import (
    Indexed,
    Number,
    Relation,
    column,
    free_symbols,
    walk,
)
from derive.render import twists
from derive.render.chain_links import chain_links
from derive.render.columns import in_order
from derive.render.displays import Displays
from derive.render.facts import parts
from derive.render.latex import Printer
from derive.render.layout import one_line
from derive.render.notation import Notation
from derive.render.phrases import PHRASES, Speech, on_page
from derive.render.printed import Printed
from derive.render.room import abridged
from derive.render.skin import Skin, environment, words_file
from derive.render.so_far import SoFar
from derive.render.tables import columns_of, headed, unit_text
from derive.render.told_so_far import Mathematics, Steps, Trig
from derive.render.typed import relettered, typed_in
from derive.render.untold import EarlyStep, ForgottenFact, ForgottenStep, UnknownFamily, early, forgotten
from derive.render.values import Values, in_unit

QUESTION = "question"  # the block of a words template that asks for its derivation
APART = (QUESTION, PHRASES, "results", "example")  # said elsewhere: see render/questions.py and phrases.py
LANGUAGES = {".m": "matlab", ".py": "python"}


def words(
    derivation: Derivation, folder: str, skin: Skin, notation: Notation, asked: bool = True,
    plots: Mapping[str, str] | None = None, files: Mapping[str, str] | None = None,
    printed: list[Printed] | None = None, so_far: SoFar | None = None, steps: Steps = "full",
    read: bool = True,
) -> str:  # fmt: skip
    """The sentences and equations of a derivation. `plots` maps names of plots to paths without suffix;
    `files` maps names of files to theirs; what is printed from trees is added to `printed`. `so_far` is what
    the sheet has told before, and grows.
    With `steps` less than full only what was asked for is told: its formula and result, or its result alone;
    all of it where that is no formula. Nothing needs the results of what is not `read`.

    Raises ForgottenStep, ForgottenFact, EarlyStep; where the derivation was not asked for, its words may
    leave facts out.
    """
    notation = replace(notation, short_names=frozenset(derivation.facts.short_names))
    seen = [] if printed is None else printed
    already = len(seen)
    printer = Printer(notation)
    speech = on_page(folder, derivation.kind, printer, skin.plain, seen, strong=skin.strong, em=skin.em)
    values = Values(derivation.units, derivation.facts.style, notation.digits)
    speech = replace(speech, measured=values.relation)
    telling = Telling(
        derivation, speech, skin, notation, plots or {}, files or {}, seen, values, asked,
        (folder, derivation.kind), so_far or SoFar(), steps,
    )  # fmt: skip
    for claim in derivation.claims:  # said in the JSON only, but their words must not be missing unnoticed
        telling.speech.claim(claim)
    template = words_of(folder, derivation.kind)
    context = template.new_context({**telling.scope(), "asked": asked, "read": asked or read})
    for block in APART:
        context.blocks[block] = [lambda _: iter(())]
    written = "".join(template.root_render_func(context))
    if "." not in folder:  # the words of another package have laws of their own
        seen.extend(typed_in(written, seen, notation))
        written = relettered(written, seen, notation.letters)
    if left := forgotten(derivation, telling.told.keys() | telling.left_out):
        raise ForgottenStep(derivation.kind, left)
    if asked and (unsaid := telling.unsaid()):
        raise ForgottenFact(derivation.kind, unsaid)
    if first := early(derivation, telling.told):
        raise EarlyStep(derivation.kind, first)
    if steps != "full" and telling.answered:
        seen[already:] = telling.kept
        written = "".join(telling.answered)
    return written.strip()


def words_of(folder: str, kind: str) -> Template:
    """The template with the words of a kind."""
    return environment().get_template(words_file(folder, kind))


@dataclass(slots=True)
class Telling(Displays):
    """What a words template can name."""

    def scope(self) -> dict[str, Any]:
        """What a words template can name."""
        return {
            "d": self.d, "step": self.d.step, "steps": self.steps, "facts": self.d.facts,
            "angular_first": self.notation.angular_first,
            "show": self.show, "answer": self.answer, "result": self.result,
            "inline": self.inline, "tell": self.tell, "table": self.table,
            "plot": self.plot, "em": self.skin.em, "strong": self.skin.strong, "items": self.skin.items,
            "listing": self.listing, "path": self.path, "math": self.math, "formula": self.formula,
            "say": self.say, "each": self.each, "cut": self.cut, "whole": self.whole, "fits": self.fits,
            "lengthy": self.lengthy, "place": self.place, "again": self.again, "conditions": self.conditions,
            "cited": self.cited, "found": self.found, "worked": self.worked,
        }  # fmt: skip

    def inline(self, name: str | Step, trig: Trig = None) -> str:
        """The chain of a step in a line of text."""
        return self.math(self._chain(name, self._printer(trig)), trig)

    def math(self, value: Mathematics, trig: Trig = None, unit: str = "") -> str:
        """Inline mathematics of an expression, a name, or a chain (a tuple) joined by equal signs, which may
        end in a `unit`."""
        printer = replace(self._printer(trig), in_line=True, flat=True)
        *before, last = self._trees(value)
        links = chain_links((*before, in_unit(last, unit)), printer)
        self.printed.append(Printed.inline(one_line(links), links, printer.notation))
        return f"${one_line(links)}$"

    def place(self, point: tuple[Relation, ...]) -> str:
        """A point by its coordinates, (x, y) = (0, 1); what is more than equations is said one by one."""
        names = [relation.left for relation in point if not isinstance(relation.left, Relation)]
        if len(names) < max(2, len(point)) or any(relation.sign != "=" for relation in point):
            return ", ".join(map(self.say, point))
        self.said.extend(part for relation in point for part in parts(relation))
        places = column(names), column(self.speech.styled(relation.right) for relation in point)
        links = chain_links(places, replace(self._printer(None), in_line=True, flat=True))
        links = tuple(replace(link, latex=link.latex.removesuffix("^T")) for link in links)
        self.printed.append(Printed.inline(one_line(links), links, self.notation))
        return f"${one_line(links)}$"

    def each(self, letter: str) -> str:
        """What things of a sort are called, whichever is meant: F_i where there are F_1, F_2 and F_3."""
        stem = letter if "_" in letter else f"{letter}_"
        if not any(name.startswith(stem) and name[len(stem) :].isdecimal() for name in self._names()):
            raise UnknownFamily(self.d.kind, letter)
        return self.math(f"{stem}i")

    def _names(self) -> Iterator[str]:
        """The names in the steps, and those they take for known."""
        chained = (tree for step in self.d.all_steps() for tree in step.chain)
        for tree in (*chained, *self.d.definitions):
            yield from free_symbols(tree)
            for node in walk(tree):
                match node:
                    case Indexed(base, (Number(index),)):
                        yield f"{base}_{index}"

    def say(self, said: Condition | tuple[Condition, ...]) -> str:
        """A phrase, a relation, or several that all hold, in a line of text."""
        self.said.extend(parts(said))
        conditions = said if isinstance(said, tuple) else (said,)
        if self.notation.angular_first:
            conditions = tuple(twists.said(each, self.d) for each in conditions)
        return self.speech.when(conditions)

    def table(self, table: Table, most: int = 1000) -> str:
        """A table; its mathematics is set inline, the unit of a column in its heading. Of more than `most`
        rows the middle is left out."""
        self.said.extend(parts(table))
        shown, units = columns_of(in_order(table, self.notation.columns), self.values)
        rows = [[self._cell(entry) for entry in row] for row in abridged(shown.rows, most)]
        headings = [self._cell(heading) for heading in shown.headings]
        texts = [self.skin.plain(unit_text(unit)) for unit in units]
        return self.skin.table([*headed(headings, texts)], rows)

    def plot(self, name: str, caption: str = "") -> str:
        """The picture of a plot of this derivation."""
        figure = next((each for each in self.d.plots if each.name == name), None)
        alt = caption
        if figure and figure.caption:
            alt = Speech(self.speech.lines).seen_in(figure)
            caption = self.speech.say(figure.caption)
        path = self.plots[name]
        number = self.so_far.figure(path)
        return self.skin.figure(path + ".svg", self.skin.caption(number, caption), alt, solution=True)

    def listing(self, name: str) -> str:
        """A file of this derivation, printed as it stands."""
        language = LANGUAGES.get(PurePosixPath(name).suffix, "text")
        return self.skin.listing(self.d.files[name], language)

    def path(self, name: str) -> str:
        """Where a file of this derivation is kept, seen from the page."""
        return self.skin.plain(self.files.get(name, name))

    def _cell(self, entry: Cell) -> str:
        if isinstance(entry, str):
            return entry
        if isinstance(entry, Phrase | Relation | tuple):
            return self.say(entry)
        return self.math(entry)
