"""What is given, on a page: sentences, tables, equations and lists in the words of its subject."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import groupby

from derive.derivation import Cell, Table
from derive.expression import Number
from derive.given.datum import Datum
from derive.render.formulas import spelt
from derive.render.latex import Printer
from derive.render.layout import lay_out
from derive.render.notation import Notation
from derive.render.phrases import Speech, lines_in, written
from derive.render.printed import Printed
from derive.render.skin import Skin
from derive.render.words import chain_links

SHARED, OWN = "words/_given.j2", "words/{}/_given.j2"


def given_words(
    data: Iterable[Datum], subject: str, skin: Skin, notation: Notation, printed: list[Printed]
) -> str:
    """The data one after the other, sentences side by side; what is printed from trees is added to
    `printed`."""
    printer = Printer(notation)
    lines = lines_in(SHARED) | lines_in(OWN.format(subject))
    speech = written(lines, printer, skin.plain, printed, strong=skin.strong, em=skin.em)
    telling = [(_told(datum, speech, skin, printer, printed), _is_sentence(datum)) for datum in data]
    groups = groupby(telling, key=lambda told: told[1])
    parts = ((" " if sentences else "\n\n").join(text for text, _ in group) for sentences, group in groups)
    return spelt("\n\n".join(parts), skin.formulas, printed)


def _is_sentence(datum: Datum) -> bool:
    return not (datum.table or datum.equations or datum.items)


def _told(datum: Datum, speech: Speech, skin: Skin, printer: Printer, printed: list[Printed]) -> str:
    parts = [speech.say(datum.said)]
    if datum.items:
        parts.append(skin.items(map(speech.say, datum.items)))
    if datum.equations:
        display = lay_out(tuple(chain_links(chain, printer) for chain in datum.equations), printer.notation)
        printed.append(Printed.display(display, printer.notation))
        parts.append(skin.display(display))
    if datum.table:
        parts.append(_table(datum.table, speech, skin))
    return "\n".join(parts)


def _table(table: Table, speech: Speech, skin: Skin) -> str:
    rows = [[_cell(entry, speech) for entry in row] for row in table.rows]
    return skin.table([_cell(heading, speech) for heading in table.headings], rows)


def _cell(entry: Cell, speech: Speech) -> str:
    """A number has the unit that its author gave it."""
    unit = entry.unit if isinstance(entry, Number) and entry.value else ""
    return f"{speech.say(entry)} {unit}".rstrip()
