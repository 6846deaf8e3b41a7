"""What is asked where the author wrote no text: the block `question` in the words of each kind.

In scope of the block: `options` and `subject` of the question, `name` of the subject, and the filters `m`
and `listed`.
"""

from __future__ import annotations

from typing import Any

from derive.render.latex import Printer
from derive.render.names import name_latex
from derive.render.notation import Notation
from derive.render.words import QUESTION, words_of


def question_text(folder: str, kind: str, name: str, subject: Any, options: Any, notation: Notation) -> str:
    """The question in Markdown, as an author writes it; "" where the words of the kind ask none."""
    template = words_of(folder, kind)
    block = template.blocks.get(QUESTION)
    if block is None:
        return ""
    printer = Printer(notation)

    def mathematics(value: Any, _: Any = None) -> str:
        return f"${name_latex(value) if isinstance(value, str) else printer.write(value)}$"

    scope = {"options": options, "subject": subject, "name": name, "math": mathematics}
    return " ".join("".join(block(template.new_context(scope))).split())
