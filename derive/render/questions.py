"""What the words of a kind say apart from its derivations, in blocks of their own.

`question` is what is asked where the author wrote no text; `results` has a line `name: meaning` for each
result, `example` is a sheet that runs. In scope of the question: its `options` and `subject`, the `name` of
the subject, and the filters `m` and `listed`.
"""

from __future__ import annotations

from typing import Any

from derive.expression import Symbol
from derive.kinds.registry import folder_of
from derive.render.chain_links import chain_links
from derive.render.latex import Printer
from derive.render.layout import one_line
from derive.render.phrases import block_of, lines_in
from derive.render.printed import Printed
from derive.render.skin import block, words_file
from derive.render.values import in_unit
from derive.render.words import QUESTION


def question_text(
    folder: str, kind: str, name: str, subject: Any, options: Any, printer: Printer, printed: list[Printed]
) -> str:
    """The question in Markdown, as an author writes it; "" where the words of the kind ask none. Its
    mathematics is added to `printed`."""

    def mathematics(value: Any, _: Any = None, unit: str = "") -> str:
        trees = [Symbol(each) if isinstance(each, str) else each for each in chained(value)]
        chain = chain_links((*trees[:-1], in_unit(trees[-1], unit)), printer)
        written = one_line(chain)
        printed.append(Printed.inline(written, chain, printer.notation))
        return f"${written}$"

    scope = {
        "options": options,
        "subject": subject,
        "name": name,
        "math": mathematics,
        "angular_first": printer.notation.angular_first,
    }
    return " ".join(block(words_file(folder, kind), QUESTION, scope).split())


def chained(value: Any) -> tuple[Any, ...]:
    """A name and its value, or one expression."""
    return value if isinstance(value, tuple) else (value,)


def results_of(module: str) -> dict[str, str]:
    """The results of the kind in a module, by their names in the JSON, and what they mean."""
    return lines_in(_words(module), "results")


def example_of(module: str) -> str:
    """A sheet that asks the kind in a module, in YAML."""
    return block_of(_words(module), "example")


def _words(module: str) -> str:
    return words_file(folder_of(module), module.rpartition(".")[2])
