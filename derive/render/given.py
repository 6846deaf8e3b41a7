"""What is given, on a page: sentences, tables, equations and lists in the words of its subject."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import groupby

from derive.algebra.formulas.with_units import measured
from derive.derivation import Cell, Table
from derive.expression import Number
from derive.given.datum import Chain, Datum
from derive.render.chain_links import chain_links
from derive.render.formulas import spelt
from derive.render.latex import Printer
from derive.render.layout import lay_out
from derive.render.notation import Notation
from derive.render.phrases import Speech, lines_in, written
from derive.render.printed import Printed
from derive.render.skin import Skin
from derive.render.tables import columns_of, headed, unit_text
from derive.render.values import Values

AS_TYPED = Values(digits=15)  # what is given is not rounded
SHARED, OWN = "words/_given.j2", "words/{}/_given.j2"


def given_words(
    data: Iterable[Datum], subject: str, skin: Skin, notation: Notation, printed: list[Printed]
) -> str:
    """The data one after the other, sentences side by side; what is printed from trees is added to
    `printed`."""
    telling = Telling(subject, skin, notation, printed)
    groups = groupby(((telling.datum(each), is_sentence(each)) for each in data), key=lambda told: told[1])
    parts = ((" " if sentences else "\n\n").join(text for text, _ in group) for sentences, group in groups)
    return spelt("\n\n".join(parts), skin.formulas, printed)


def is_sentence(datum: Datum) -> bool:
    """Whether it leads to nothing."""
    return not (datum.table or datum.equations or datum.items)


@dataclass(frozen=True, slots=True)
class Telling:
    """Data being told in one format, in the words of their subject."""

    subject: str
    skin: Skin
    notation: Notation
    printed: list[Printed]

    def datum(self, datum: Datum) -> str:
        """A sentence, and what it leads to."""
        speech = self.speech(datum.room or self.subject)
        parts = [speech.say(datum.said)]
        if datum.items:
            parts.append(self.skin.items(map(speech.say, datum.items)))
        if datum.equations:
            parts.append(self.display(datum.equations))
        if datum.table:
            parts.append(self.table(datum.table))
        return "\n".join(parts)

    def speech(self, subject: str) -> Speech:
        """Words in a line of text, or in a cell of a table."""
        lines = lines_in(SHARED) | lines_in(OWN.format(subject))
        printer = Printer(self.notation)
        strong, em = self.skin.strong, self.skin.em
        return written(lines, printer, self.skin.plain, self.printed, strong=strong, em=em)

    def display(self, equations: tuple[Chain, ...]) -> str:
        """Equations side by side, or one below the other."""
        printer = Printer(self.notation)
        display = lay_out(tuple(chain_links(chain, printer) for chain in equations), self.notation)
        self.printed.append(Printed.display(display, self.notation))
        return self.skin.display(display)

    def table(self, table: Table) -> str:
        """A number has the unit that its author gave it, in the heading where a column has one."""
        speech = self.speech(self.subject)
        shown, units = columns_of(table, AS_TYPED)

        def cell(entry: Cell, unit: str) -> str:
            return speech.say(measured(entry) if isinstance(entry, Number) and not unit else entry)

        rows = [[cell(entry, unit) for entry, unit in zip(row, units, strict=True)] for row in shown.rows]
        texts = [self.skin.plain(unit_text(unit)) for unit in units]
        return self.skin.table([*headed([speech.say(each) for each in shown.headings], texts)], rows)
