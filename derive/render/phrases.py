"""What a derivation says in words: phrases by their keys, and relations as mathematics.

A phrase is a line `key: words with {fields}` in the block `phrases` of the words of its kind, in that of
`_phrases.j2` in their folder, or in that of the `_phrases.j2` that all folders share. `{field}` writes what
the derivation gives for it, several things as "a and b"; `**words**` are strong and
`*words*` emphasised. In plain text `{field:typed}` writes mathematics as
it is typed in a sheet, x^2 and 90 deg.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from math import isclose
from string import Formatter
from typing import TypeVar

from jinja2 import TemplateNotFound

from derive.algebra.infix import SYMPY_NAMES, text
from derive.algebra.normal import normal
from derive.algebra.readable.form import readable
from derive.algebra.readable.terms import Style
from derive.derivation import (
    Caption,
    Claim,
    Condition,
    Drawing,
    Figure,
    Label,
    Panels,
    Phrase,
    Plot,
    Result,
    Said,
    Words,
)
from derive.expression import PI, Approximate, Degrees, Expr, Quotient, Relation, walk
from derive.render.latex import Printer
from derive.render.layout import Chain
from derive.render.notation import Notation
from derive.render.printed import Printed, links_of, says
from derive.render.skin import block as written_block
from derive.render.skin import environment, joined, words_file
from derive.render.untold import Untold

PHRASES = "phrases"  # the block of a words template that holds them
STRONG, EM = ("**", "\x1e"), ("*", "\x1f")  # what is typed, and what stands for it until a phrase is written
T = TypeVar("T")
LATEX_SIGNS = {"<=": r"\leq", ">=": r"\geq", "!=": r"\neq"}


class PhraseError(Untold):
    """Words of a kind are missing, or are not written as they have to be."""


def in_text(tree: Expr, notation: str = "") -> str:
    """A tree in plain text: as SymPy reads it, or as it is `typed` in a sheet."""
    if notation != "typed":
        return text(tree)
    if isinstance(tree, Degrees):
        return f"{tree.value} deg"
    typed = text(tree).replace("**", "^")
    for ours, theirs in SYMPY_NAMES.items():
        typed = typed.replace(f"{theirs}(", f"{ours}(")
    return typed


@dataclass(frozen=True, slots=True)
class Speech:
    """How the derivations of one kind say things in one format: `tree` writes an expression (in the notation
    a field asks for), `formula` sets mathematics in a line of text, `plain` makes words safe;
    `measured` gives a value its unit."""

    lines: Mapping[str, str]
    tree: Callable[[Expr, str], str] = in_text
    formula: str = "{}"
    plain: Callable[[str], str] = str
    strong: Callable[[str], str] = str
    em: Callable[[str], str] = str
    signs: Mapping[str, str] = field(default_factory=dict)
    styled: Callable[[Expr], Expr] = lambda tree: tree
    seen: Callable[[Chain, str], None] = lambda chain, written: None
    measured: Callable[[Relation], Relation] = lambda relation: relation
    digits: int = 3  # of a number that is rounded

    def say(self, said: Said, notation: str = "") -> str:
        """A phrase or a relation as it stands in a text. Raises PhraseError."""
        match said:
            case Phrase():
                return self._stressed("".join(self._phrase(said)))
            case Relation():
                relation = self.measured(self.in_style(said))
                written = self._relation(relation, notation)
                self.seen(links_of(relation), written)
                return self.formula.format(written)
            case str() | int():
                return self.plain(str(said))
            case tuple():
                return joined([self.say(part, notation) for part in said])
            case _:
                tree = self.styled(said)
                written = self.tree(tree, notation)
                self.seen(says(tree, written), written)
                return self.formula.format(written)

    def seen_in(self, figure: Figure) -> str:
        """What a figure shows, for those who do not see it: all of it. Raises PhraseError."""
        if not figure.alt:
            return self.say(figure.caption) if figure.caption else ""
        told = {name for _, name, _, _ in Formatter().parse(self._line(figure.alt.key)) if name}
        if left := sorted(figure.alt.about.keys() - told):
            raise PhraseError(f"the words for '{figure.alt.key}' leave out {', '.join(left)}")
        return self.say(figure.alt)

    def when(self, conditions: Iterable[Condition]) -> str:
        """Conditions that all hold: `elbow up, theta2 > 0`. Raises TypeError for a text, which is no list."""
        if isinstance(conditions, str):
            raise TypeError(conditions)
        return ", ".join(map(self.say, conditions))

    def results(self, results: Mapping[str, Result]) -> dict[str, Result]:
        """The results, with texts for those that are said in words."""
        return {name: self._result(result) for name, result in results.items()}

    def _result(self, result: Result) -> Result:
        if isinstance(result, Phrase):
            return self.say(result)
        parts = result if isinstance(result, tuple) else ()
        return tuple(self.say(part) for part in parts if isinstance(part, Phrase | Relation)) or result

    def figure(self, figure: Figure) -> Figure:
        """The figure with the words of its labels."""
        if isinstance(figure, Panels):
            return replace(figure, plots=tuple(map(self._plot, figure.plots)))
        if isinstance(figure, Drawing):
            return replace(figure, captions=tuple(map(self._caption, figure.captions)))
        return self._plot(figure)

    def _caption(self, caption: Caption) -> Caption:
        said = caption.text
        return replace(caption, text=Words(self.say(said))) if isinstance(said, Phrase) else caption

    def _plot(self, plot: Plot) -> Plot:
        return replace(
            plot,
            x_label=self.say(plot.x_label),
            y_label=self.say(plot.y_label),
            series=self._named(plot.series),
            marks=self._named(plot.marks),
            moments=self._named(plot.moments),
            levels=self._named(plot.levels),
            regions=self._named(plot.regions),
            arms=self._named(plot.arms),
            arrows=self._named(plot.arrows),
            spans=tuple(replace(span, label=self.say(span.label)) for span in plot.spans),
        )

    def _named(self, things: Mapping[Label, T]) -> dict[Label, T]:
        return {self.say(name): thing for name, thing in things.items()}

    def claim(self, claim: Claim) -> str:
        """What was verified."""
        return self.say(Phrase(claim.key, claim.about))

    def _phrase(self, phrase: Phrase) -> Iterable[str]:
        for place, (words, name, notation, _) in enumerate(Formatter().parse(self._line(phrase.key))):
            stressed = words.replace(*STRONG).replace(*EM)
            yield self.plain(f"x{stressed}")[1:] if place else self.plain(stressed)  # what continues a line
            if name is None:
                continue
            if name not in phrase.about:
                raise PhraseError(f"nothing fills the field {{{name}}} of the words for '{phrase.key}'")
            filled = self.say(phrase.about[name], notation or "")
            if not filled and phrase.about[name] != "":
                raise PhraseError(f"the field {{{name}}} of the words for '{phrase.key}' is said as nothing")
            yield filled

    def _stressed(self, written: str) -> str:
        for (_, mark), stressed in ((STRONG, self.strong), (EM, self.em)):
            parts = enumerate(written.split(mark))
            written = "".join(stressed(part) if k % 2 else part for k, part in parts)
        return written

    def _line(self, key: str) -> str:
        if key not in self.lines:
            raise PhraseError(f"no words for '{key}': write '{key}: ...' in the block {PHRASES} of the kind")
        return self.lines[key]

    def in_style(self, relation: Relation) -> Relation:
        left = relation.left
        first = self.in_style(left) if isinstance(left, Relation) else self.styled(left)
        return Relation(first, relation.sign, self.styled(relation.right))

    def _relation(self, relation: Relation, notation: str) -> str:
        left = relation.left
        first = self._relation(left, notation) if isinstance(left, Relation) else self.tree(left, notation)
        sign = sign_of(relation, self.digits) if self.signs else relation.sign
        return f"{first} {sign} {self.tree(relation.right, notation)}"


def _is_rounded(tree: Expr, digits: int) -> bool:
    """Whether a number in it has more digits than are shown; 0.5 is 0.5."""
    found = (node.value for node in walk(tree) if isinstance(node, Approximate))
    return any(not isclose(float(f"{each:.{digits}g}"), each, rel_tol=1e-9) for each in found)


def sign_of(relation: Relation, digits: int) -> str:
    """In LaTeX, between the two last sides; what is rounded is not equal."""
    left = relation.left.right if isinstance(relation.left, Relation) else relation.left
    if relation.sign == "=" and (_is_rounded(left, digits) or _is_rounded(relation.right, digits)):
        return r"\approx"
    return LATEX_SIGNS.get(relation.sign, relation.sign)


def spoken(folder: str, kind: str) -> Speech:
    """How the derivations of a kind speak in plain text: in the JSON, in messages."""
    return Speech(lines_of(folder, kind))


def on_page(
    folder: str, kind: str, printer: Printer, plain: Callable[[str], str], printed: list[Printed],
    style: Style | None = None, strong: Callable[[str], str] = str, em: Callable[[str], str] = str,
) -> Speech:  # fmt: skip
    """How they speak on a page; decimals and fixed angles are written in the author's `style`, and what is
    printed from trees is added to `printed`."""
    return written(lines_of(folder, kind), printer, plain, printed, style, strong, em)


def written(
    lines: Mapping[str, str], printer: Printer, plain: Callable[[str], str], printed: list[Printed],
    style: Style | None = None, strong: Callable[[str], str] = str, em: Callable[[str], str] = str,
) -> Speech:  # fmt: skip
    """The same with phrases that are given."""

    in_line = replace(printer, in_line=True, flat=True)

    def tree(expr: Expr, _: str) -> str:
        return in_line.write(expr)

    def styled(expr: Expr) -> Expr:
        return _in_style(expr, style or Style())

    def seen(chain: Chain, formula: str) -> None:
        printed.append(Printed.inline(formula, chain, printer.notation))

    return Speech(
        lines, tree, "${}$", plain, strong, em, LATEX_SIGNS, styled, seen, digits=printer.notation.digits
    )


def in_figure(folder: str, kind: str, notation: Notation) -> Speech:
    """How they speak in a figure: words, and mathematics in LaTeX between dollars."""
    printer = Printer(notation)
    return Speech(
        lines_of(folder, kind),
        lambda tree, _: printer.write(tree),
        "${}$",
        signs=LATEX_SIGNS,
        digits=notation.digits,
    )


def lines_of(folder: str, kind: str) -> dict[str, str]:
    """The phrases that the derivations of a kind may say, by their keys. Raises PhraseError where two say the
    same: what is not the same is not said in the same words."""
    lines = shared_lines() | lines_in(f"words/{folder}/_phrases.j2") | lines_in(words_file(folder, kind))
    if alike := [key for key, times in Counter(lines.values()).items() if times > 1]:
        raise PhraseError(f"{words_file(folder, kind)}: two keys say the same: '{alike[0]}'")
    return lines


def shared_lines() -> dict[str, str]:
    """The phrases that every derivation may say."""
    return lines_in("words/_phrases.j2")


def lines_in(name: str, block: str = PHRASES) -> dict[str, str]:
    """The lines `key: words` of a block of a template, ours and before them those of one's own; none where
    there is no such template. Raises PhraseError for a line that is none."""
    found: dict[str, str] = {}
    for layer in environment().layers(name):
        lines = [line.partition(": ") for line in block_of(layer, block).splitlines() if line]
        if wrong := [key for key, _, words in lines if not words]:
            raise PhraseError(f"{name}: a line of the block {block} is 'key: words', not '{wrong[0]}'")
        found |= {key: words for key, _, words in lines}
    return found


def block_of(name: str, block: str) -> str:
    """A block of a template that holds nothing but text; "" where there is none."""
    try:
        return written_block(name, block, {})
    except TemplateNotFound:
        return ""


def _in_style(tree: Expr, style: Style) -> Expr:
    """Written anew where it holds what this style writes otherwise."""
    nodes = [*walk(tree)]
    fixed = style.degrees and PI in nodes
    fractions = style.decimals and any(isinstance(node, Quotient) for node in nodes)
    return readable(normal(tree), style) if fixed or fractions else tree
