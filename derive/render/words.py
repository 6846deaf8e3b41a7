"""Runs the words of a kind: a Jinja template whose sentences refer to the steps of a derivation.

In scope of a words template: `d`, `step(name)`, `facts`, `asked`, the filters `m`, `each`
and `listed`, and the functions `show`, `answer`, `inline`, `tell`, `table`, `plot`, `say`, `listing`, `path`,
`em`, `strong`, `items`, `again`, `conditions`, `cited`, `found`. Its blocks `question` and `phrases` are
left out here. A step the words neither show nor tell is an error: nothing that was derived goes unsaid
unnoticed. Steps are told in the order in which they were derived, so that nothing is used before it is
found.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import PurePosixPath
from typing import Any, Literal

from jinja2 import Template

from derive.derivation import Cell, Condition, Derivation, Phrase, Step, Table
from derive.expression import (
    Degrees,
    Expr,
    Indexed,
    Number,
    Relation,
    Symbol,
    column,
    free_symbols,
    number,
    walk,
)
from derive.render import twists
from derive.render.columns import in_order
from derive.render.entries import NAMED_BEYOND, Names, with_named_entries
from derive.render.facts import Sayable, parts, sayable
from derive.render.latex import Printer, is_approximate
from derive.render.layout import FRAMED, LINE, Chain, Display, Link, lay_out, one_line
from derive.render.notation import Notation
from derive.render.phrases import LATEX_SIGNS, PHRASES, Speech, on_page
from derive.render.printed import Naming, Printed, links_of
from derive.render.room import abridged, has_room, kept
from derive.render.skin import Skin, environment, joined, words_file
from derive.render.so_far import Equation, SoFar
from derive.render.tables import columns_of, headed, unit_text
from derive.render.typed import relettered, typed_in
from derive.render.untold import EarlyStep, ForgottenFact, ForgottenStep, UnknownFamily, early, forgotten
from derive.render.values import Values, in_unit

QUESTION = "question"  # the block of a words template that asks for its derivation
APART = (QUESTION, PHRASES, "results", "example")  # said elsewhere: see render/questions.py and phrases.py
Mathematics = Expr | Step | str | int | tuple[Expr, ...]
Shown = str | Step | tuple[Expr, ...]  # a step or a bare chain
Trig = Literal["short", "long"] | None
Steps = Literal["full", "key", "answers"]
LANGUAGES = {".m": "matlab", ".py": "python"}


def words(
    derivation: Derivation, folder: str, skin: Skin, notation: Notation, asked: bool = True,
    plots: Mapping[str, str] | None = None, files: Mapping[str, str] | None = None,
    printed: list[Printed] | None = None, so_far: SoFar | None = None, steps: Steps = "full",
) -> str:  # fmt: skip
    """The sentences and equations of a derivation. `plots` maps names of plots to paths without suffix;
    `files` maps names of files to theirs; what is printed from trees is added to `printed`. `so_far` is what
    the sheet has told before, and grows.
    With `steps` less than full only what was asked for is told: its formula and result, or its result alone;
    all of it where that is no formula.

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
    context = template.new_context({**telling.scope(), "asked": asked})
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


def chain_links(chain: tuple[Expr, ...], printer: Printer) -> Chain:
    """The links of a chain, with the sign that stands before each."""
    links: list[Link] = []
    rounded = False
    for expr in chain:
        now = is_approximate(expr)
        links.append(Link(r"\approx" if now or rounded else "=", printer.write(expr), expr))
        rounded = now
    return tuple(links)


def _numbers(references: Iterable[str | None]) -> str:
    found = [*references]
    return f" {joined([*filter(None, found)])}" if all(found) else ""


def signed_links(relation: Relation, printer: Printer) -> Chain:
    """The sides of a relation, with the sign that stands before each."""
    left, sign = relation.left, LATEX_SIGNS.get(relation.sign, relation.sign)
    last = Link(sign, printer.write(relation.right), relation.right)
    if isinstance(left, Relation):
        return (*signed_links(left, printer), last)
    return Link("=", printer.write(left), left), last


@dataclass(slots=True)
class Telling:
    """One derivation being told in one format; remembers which steps were."""

    d: Derivation
    speech: Speech
    skin: Skin
    notation: Notation
    plots: Mapping[str, str]
    files: Mapping[str, str]
    printed: list[Printed]
    values: Values
    asked: bool
    of: tuple[str, str]  # the folder and the kind
    so_far: SoFar
    level: Steps
    displays: int = 0
    told: dict[str, int] = field(default_factory=dict)  # steps, and when each was told first
    left_out: set[str] = field(default_factory=set)  # steps of which the page need not speak
    said: list[Sayable] = field(default_factory=list)
    answered: list[str] = field(default_factory=list)  # what stands in frames
    kept: list[Printed] = field(default_factory=list)  # and its mathematics

    def scope(self) -> dict[str, Any]:
        """What a words template can name."""
        return {
            "d": self.d, "step": self.d.step, "steps": self.steps, "facts": self.d.facts,
            "angular_first": self.notation.angular_first,
            "show": self.show, "answer": self.answer, "inline": self.inline, "tell": self.tell,
            "table": self.table,
            "plot": self.plot, "em": self.skin.em, "strong": self.skin.strong, "items": self.skin.items,
            "listing": self.listing, "path": self.path, "math": self.math, "formula": self.formula,
            "say": self.say, "each": self.each, "cut": self.cut, "whole": self.whole, "fits": self.fits,
            "place": self.place, "again": self.again, "conditions": self.conditions,
            "cited": self.cited, "found": self.found, "worked": self.worked,
        }  # fmt: skip

    def steps(self, *rules: str) -> list[Step]:
        """The outer steps of these rules, in their order."""
        return [step for step in self.d.steps if step.rule in rules]

    def again(self, explained: Phrase | Step | str | Iterable[Phrase]) -> str:
        """Where the sheet has explained this already, in these words: a phrase or several, the law of
        a step, or what the template calls so; "" where nowhere. It is told by that, and a short line will
        do: "as before", or "as in Problem 1"."""
        match explained:
            case Phrase() | str():
                about: object = explained
            case Step():
                self._note(explained)
                about = explained.chain
            case _:
                explained = about = tuple(explained)
        self.said.extend(parts(explained.chain if isinstance(explained, Step) else explained))
        return self.so_far.explanation((*self.of, about))

    def cited(self, *whats: Step | Expr) -> str:
        """ " (2) and (5)": the numbers of the equations of this problem that say what these names are, and of
        laws that the sheet has told; "" where one of them was not displayed."""
        return self._references(
            self.so_far.law(self.values.shown(what.chain))
            if isinstance(what, Step)
            else self.so_far.value(what, self.d)
            for what in whats
        )

    def found(self, *kinds: str) -> str:
        """The same for the answers of these kinds, on which this one rests."""
        return self._references(self.so_far.answer(kind, self.d) for kind in kinds)

    def worked(self) -> str:
        """ " (2) and (3)", the answers of an earlier question of this problem, worked in the very lines
        of this one; what both know need not be said again. "" where there is none."""
        before = self.so_far.same_working(self.d)
        if before is None or self.level == "answers":
            return ""
        self.tell(*self.d.steps)
        self.said.extend(fact for _, fact in sayable(before))
        return _numbers(self.so_far.answers_of(before))

    def _references(self, found: Iterator[str | None]) -> str:
        """None where the page has answers alone: what they rest on is not on it."""
        return "" if self.level == "answers" else _numbers(found)

    def answer(self, *names: Shown, trig: Trig = None, entries: str = "", lines: int = 2) -> str:
        """The same as `show` for what was asked, which stands in a frame."""
        return self.show(*names, trig=trig, entries=entries, lines=lines, answer=True)

    def show(
        self, *names: Shown, trig: Trig = None, entries: str = "", lines: int = 2, answer: bool = False
    ) -> str:
        """A displayed equation of one or several steps (or bare chains), side by side where they fit.

        Long entries of a matrix too wide for the page are named, and listed after it; `entries` are words to
        stand before the list, and then no matrix is wider than a line. A spare link is left out where it
        takes more than so many `lines`.
        """
        printer, widest = self._printer(trig), LINE if entries else NAMED_BEYOND
        boxed = answer and self.asked
        whole = [self._chain(name, printer, lines) for name in names]
        if boxed and self.level == "answers":
            whole = [(chain[0], chain[-1]) if len(chain) > 1 else chain for chain in whole]
        parts = [
            with_named_entries(chain, printer, widest, self._entries(name))
            for chain, name in zip(whole, names, strict=True)
        ]
        both = zip(whole, parts, strict=True)
        namings = tuple(
            Naming(chain[0], chain[-1], shown[-1], tuple((name, tree) for name, tree in listed))
            for chain, (shown, listed) in both
            if listed
        )
        first = len(self.printed)
        shown = self._display(tuple(chain for chain, _ in parts), printer, namings, answer)
        listed = [self._display(chains, printer) for _, chains in parts if chains]
        written = "".join((shown, f"\n{entries}\n" if entries and listed else "", *listed))
        if boxed:
            self.answered.append(written)
            self.kept.extend(self.printed[first:])
        return written

    def _display(
        self, chains: tuple[tuple[Expr, ...], ...], printer: Printer, namings: tuple[Naming, ...] = (),
        answer: bool = False,
    ) -> str:  # fmt: skip
        links = tuple(chain_links(chain, printer) for chain in chains)
        boxed = answer and self.asked
        display = lay_out(links, printer.notation, FRAMED if boxed else LINE)
        self.printed.append(Printed.display(display, printer.notation, namings))
        written = self.skin.display(replace(display, boxed=boxed))
        self.displays += 1
        equation = Equation(self.so_far.problem, chains, self.d, self.displays, answer)
        return self.so_far.marked(written, equation, boxed)

    def conditions(self, relations: tuple[Relation, ...]) -> str:
        """Conditions that all hold, side by side; where they are the answer, in a frame."""
        self.said.extend(parts(relations))
        printer = self._printer(None)
        styled = tuple(map(self.speech.in_style, relations))
        display = lay_out(tuple(signed_links(each, printer) for each in styled), printer.notation, FRAMED)
        self.printed.append(Printed(display.lines, tuple(map(links_of, styled)), printer.notation))
        written = self.skin.display(replace(display, boxed=self.asked))
        if self.asked:
            self.answered.append(written)
            self.kept.append(self.printed[-1])
        return written

    def formula(self, *lines: str) -> str:
        """A general law, displayed as the words write it in LaTeX; what is derived goes through `show`."""
        self.printed.append(Printed(lines, (), self.notation))
        return self.skin.display(Display(lines))

    def inline(self, name: str | Step, trig: Trig = None) -> str:
        """The chain of a step in a line of text."""
        return self.math(self._chain(name, self._printer(trig)), trig)

    def tell(self, *names: str | Step) -> str:
        """Marks steps as told in prose; prints nothing."""
        for name in names:
            self._note(self._step(name))
        return ""

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
            alt = Speech(self.speech.lines).say(figure.alt or figure.caption)
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

    def unsaid(self) -> list[str]:
        """The facts that could be said and were not."""
        return list(dict.fromkeys(name for name, fact in sayable(self.d) if fact not in self.said))

    def _note(self, step: Step) -> None:
        self.told.setdefault(step.name, len(self.told))

    def _step(self, name: str | Step) -> Step:
        return self.d.step(name) if isinstance(name, str) else name

    def _entries(self, name: Shown) -> Names:
        return {} if isinstance(name, tuple) else self._step(name).entries

    def _chain(self, name: Shown, printer: Printer, lines: int = 2) -> tuple[Expr, ...]:
        """The chain of a step, without the spare links that are too long for a page."""
        if isinstance(name, tuple):
            self.said.extend(name)
            return self.values.shown(name)
        step = self._step(name)
        self._note(step)
        self.said.extend(step.chain)
        chain = kept(step, printer, lines) if step.spare else step.chain
        return self.values.shown(
            twists.line(step.rule, chain, self.d) if self.notation.angular_first else chain
        )

    def cut(self, name: str | Step) -> bool:
        """Whether a link of this step is too long for a page and left out."""
        step = self._step(name)
        return kept(step, self._printer(None)) != step.chain

    def whole(self, steps: Iterable[Step]) -> list[Step]:
        """Those of the steps of which nothing is left out; of the others the page need not speak."""
        found = [(step, self.cut(step)) for step in steps]
        self.left_out.update(step.name for step, cut in found if cut)
        return [step for step, cut in found if not cut]

    def fits(self, table: Table) -> bool:
        """Whether the page has room for a table."""
        return has_room(table, self._printer(None))

    def _printer(self, trig: Trig) -> Printer:
        """That of the sheet; a display may ask for another way to write angles, where the sheet does not."""
        if not trig or self.notation.trig == "long":
            return Printer(self.notation)
        return Printer(replace(self.notation, trig=trig))

    def _trees(self, value: Mathematics) -> tuple[Expr, ...]:
        """The chain of what is written in a line of text."""
        self.said.extend(parts(value))
        match value:
            case str():
                return (Symbol(value),)
            case int():
                return (number(value),)
            case Step():
                self._note(value)
                return self.values.shown(value.chain)
            case (name, (Number() | Degrees()) as typed) if typed.unit:
                return name, in_unit(typed, typed.unit)
            case tuple():
                return self.values.shown(value)
            case _:
                return self.values.shown((value,))

    def _cell(self, entry: Cell) -> str:
        if isinstance(entry, str):
            return entry
        if isinstance(entry, Phrase | Relation | tuple):
            return self.say(entry)
        return self.math(entry)
