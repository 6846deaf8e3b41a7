"""A tree of Markdown written in a format; everything a format does not know comes out as plain text."""

from __future__ import annotations

import re
from itertools import groupby
from typing import TYPE_CHECKING

from derive.render.plain_text import (
    html_text,
    latex_text,
    markdown_formula,
    markdown_text,
    typst_string,
    typst_text,
)

if TYPE_CHECKING:
    from markdown_it.tree import SyntaxTreeNode

TEXTS = ("text", "text_special")
PER_TIME = re.compile(r"(?<=[A-Za-z°])/(?=s\b)")  # of a unit, which no line ends within
ADDRESSES = ("https://", "http://", "mailto:")


class Writer:
    """Walks a tree of Markdown and writes each node; a format says how its pieces look."""

    em = strong = ("", "")

    def text(self, text: str) -> str:
        raise NotImplementedError

    def code(self, code: str) -> str:
        raise NotImplementedError

    def link(self, text: str, address: str) -> str:
        raise NotImplementedError

    def formula(self, tex: str) -> str:
        return tex.strip()

    def display(self, formula: str) -> str:
        raise NotImplementedError

    def listed(self, items: list[str], ordered: bool) -> str:
        raise NotImplementedError

    def blocks(self, node: SyntaxTreeNode) -> str:
        return "\n\n".join(filter(None, (self.block(child) for child in node.children)))

    def block(self, node: SyntaxTreeNode) -> str:
        match node.type:
            case "bullet_list" | "ordered_list":
                items = [self.blocks(item) for item in node.children]
                return self.listed(items, node.type == "ordered_list")
            case "math_block":
                return self.display(node.content.strip())
            case "heading":
                return self._between(self.strong, self.inlines(node))
            case "fence" | "code_block":
                return "\n\n".join(map(self.code, node.content.strip().splitlines()))
            case "paragraph":
                return self.inlines(node)
            case "hr":
                return ""
            case _:
                return self.blocks(node)

    def inlines(self, node: SyntaxTreeNode) -> str:
        return "".join(map(self.inline, node.children))

    def inline(self, node: SyntaxTreeNode) -> str:
        match node.type:
            case "text" | "text_special":
                return self.text(node.content)
            case "math_inline":
                return f"${self.formula(node.content)}$"
            case "math_inline_double":
                return self.display(node.content.strip())
            case "softbreak" | "hardbreak":
                return "\n"
            case "em":
                return self._between(self.em, self.inlines(node))
            case "strong":
                return self._between(self.strong, self.inlines(node))
            case "code_inline":
                return self.code(node.content)
            case "link" if str(node.attrs["href"]).startswith(ADDRESSES):
                return self.link(self.inlines(node), str(node.attrs["href"]))
            case "image":  # pictures come by `figure:`, which looks where they are
                return self.text(node.content)
            case _:
                return self.inlines(node)

    def _between(self, marks: tuple[str, str], text: str) -> str:
        return f"{marks[0]}{text}{marks[1]}" if text else ""


class MarkdownWriter(Writer):
    em, strong = ("*", "*"), ("**", "**")

    def inlines(self, node: SyntaxTreeNode) -> str:
        """Neighbouring pieces of text are one: an escaped `1\\.` stays escaped."""
        written = ""
        for plain, group in groupby(node.children, lambda child: child.type in TEXTS):
            if plain:
                continues = written != "" and not written.endswith("\n")
                written += self._text("".join(child.content for child in group), continues)
            else:
                written += "".join(map(self.inline, group))
        return written

    def text(self, text: str) -> str:
        return self._text(text, continues=False)

    def _text(self, text: str, continues: bool) -> str:
        escaped = markdown_text(text, continues)
        return escaped[:-1] + r"\!" if escaped.endswith("!") else escaped  # no picture of a link after it

    def code(self, code: str) -> str:
        return f"`` {code} ``" if "`" in code else f"`{code}`"

    def link(self, text: str, address: str) -> str:
        return f"[{text}](<{address}>)"

    def formula(self, tex: str) -> str:
        return markdown_formula(tex)

    def display(self, formula: str) -> str:
        return f"\n\n$$\n{self.formula(formula)}\n$$\n\n"

    def listed(self, items: list[str], ordered: bool) -> str:
        marks = [f"{place}. " if ordered else "- " for place in range(1, len(items) + 1)]
        return "\n".join(
            mark + item.replace("\n", "\n" + " " * len(mark)) for mark, item in zip(marks, items, strict=True)
        )


class LatexWriter(Writer):
    em, strong = (r"\emph{", "}"), (r"\textbf{", "}")

    def text(self, text: str) -> str:
        return latex_text(text)

    def code(self, code: str) -> str:
        return rf"\texttt{{{latex_text(code)}}}"

    def link(self, text: str, address: str) -> str:
        escaped = re.sub(r"([%#&])", r"\\\1", address)
        return rf"\href{{{escaped}}}{{{text}}}"

    def display(self, formula: str) -> str:
        return f"\n\\[\n{formula}\n\\]\n"

    def listed(self, items: list[str], ordered: bool) -> str:
        name = "enumerate" if ordered else "itemize"
        lines = "\n".join(rf"\item {item}" for item in items)
        return f"\\begin{{{name}}}\\tight\n{lines}\n\\end{{{name}}}"


class TypstWriter(Writer):
    """What ends in a semicolon is a call of Typst's, which takes in nothing of what follows."""

    em, strong = ("#emph[", "];"), ("#strong[", "];")

    def text(self, text: str) -> str:
        return typst_text(PER_TIME.sub("/\N{WORD JOINER}", text))

    def code(self, code: str) -> str:
        return f"#raw({typst_string(code)});"

    def link(self, text: str, address: str) -> str:
        return f"#link({typst_string(address)})[{text}];"

    def formula(self, tex: str) -> str:
        return " ".join(tex.split())

    def display(self, formula: str) -> str:
        return f"\n\n$${self.formula(formula)}$$\n\n"

    def listed(self, items: list[str], ordered: bool) -> str:
        return f"#{'enum' if ordered else 'list'}(" + ", ".join(f"[{item}]" for item in items) + ")"


class HtmlWriter(Writer):
    em, strong = ("<em>", "</em>"), ("<strong>", "</strong>")

    def text(self, text: str) -> str:
        return html_text(text)

    def code(self, code: str) -> str:
        return f"<code>{html_text(code)}</code>"

    def link(self, text: str, address: str) -> str:
        return f'<a href="{html_text(address)}">{text}</a>'

    def formula(self, tex: str) -> str:
        return " ".join(tex.split())

    def display(self, formula: str) -> str:
        return f"\n\n$${self.formula(formula)}$$\n\n"

    def listed(self, items: list[str], ordered: bool) -> str:
        name = "ol" if ordered else "ul"
        lines = "".join(f"<li>{' '.join(item.split())}</li>" for item in items)
        return f"<{name}>{lines}</{name}>"
