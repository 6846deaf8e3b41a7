"""Plain text made safe for a format: nothing in it is markup or a command any more."""

from __future__ import annotations

import re
from html import escape

LETTERS = "αβγδεζηθικλμνξπρστυφχψωΓΔΘΛΞΠΣΥΦΨΩϕϑ"
LETTER_NAMES = (
    "alpha beta gamma delta varepsilon zeta eta theta iota kappa lambda mu nu xi pi rho sigma tau upsilon "
    "varphi chi psi omega Gamma Delta Theta Lambda Xi Pi Sigma Upsilon Phi Psi Omega phi vartheta"
)
LATEX_SPECIAL = {
    "\\": r"\textbackslash{}", "{": r"\{", "}": r"\}", "$": r"\$", "&": r"\&", "#": r"\#", "%": r"\%",
    "_": r"\_", "^": r"\textasciicircum{}", "~": r"\textasciitilde{}", "<": r"\textless{}",
    ">": r"\textgreater{}", "|": r"\textbar{}", '"': r"\textquotedbl{}", "`": r"\textasciigrave{}",
}  # fmt: skip
LATEX_SYMBOLS = {
    "°": r"^\circ", "×": r"\times", "·": r"\cdot", "±": r"\pm", "−": "-", "≤": r"\leq", "≥": r"\geq",
    "≠": r"\neq", "≈": r"\approx", "→": r"\rightarrow", "⇒": r"\Rightarrow", "∞": r"\infty", "√": r"\surd",
    "²": "^2", "³": "^3", "µ": r"\mu", "∂": r"\partial", "∈": r"\in", "∑": r"\sum", "∫": r"\int",
}  # fmt: skip
LATEX = str.maketrans(
    {
        **LATEX_SPECIAL,
        **{sign: f"${command}$" for sign, command in LATEX_SYMBOLS.items()},
        **{letter: rf"$\{name}$" for letter, name in zip(LETTERS, LETTER_NAMES.split(" "), strict=True)},
        "…": r"\dots{}", "\u00a0": "~", "\u2009": r"\,", "\u202f": r"\,", "\u200b": "",
    }
)  # fmt: skip
MARKDOWN_SPECIAL = re.compile(r"([\\`*_\[\]<>$~|])|&(?=#?\w+;)")
TAG_OR_LINK = re.compile(r"<(?=[A-Za-z/!?])|\](?=\()")
MARKDOWN_LINE_START = re.compile(r"^(\s*)(?:([#+\-=])|(\d+)([.)]))", re.MULTILINE)


TYPST_MARKUP = re.compile(r"[!-/:-@\[-`{-~]")  # every sign of ASCII
TYPST_AS_IT_IS = frozenset(",()!;?%&|'")
UNPRINTED = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f]")


def typographic(text: str) -> str:
    """A text with the apostrophes of print."""
    return re.sub(r"(?<=\w)'", "\N{RIGHT SINGLE QUOTATION MARK}", text)


def typst_text(text: str) -> str:
    """Text for a Typst paragraph. A dollar and a backslash stand in no form that begins anything."""
    return TYPST_MARKUP.sub(_typst_sign, UNPRINTED.sub("", text))


def _typst_sign(found: re.Match[str]) -> str:
    sign = found[0]
    if sign in TYPST_AS_IT_IS:
        return sign
    return rf"\u{{{ord(sign):x}}}" if sign in "$\\" else f"\\{sign}"


def typst_string(text: str) -> str:
    """A string of Typst's code."""
    escaped = re.sub(r'[\\"$\n]', lambda found: rf"\u{{{ord(found[0]):x}}}", UNPRINTED.sub("", text))
    return f'"{escaped}"'


def html_text(text: str) -> str:
    """Text for HTML. A dollar is no beginning of a formula."""
    return escape(UNPRINTED.sub("", text)).replace("$", "&#36;")


def latex_text(text: str) -> str:
    """Text for a LaTeX paragraph; Greek letters and signs pdflatex has no text glyph for become math."""
    return text.translate(LATEX)


def markdown_formula(tex: str) -> str:
    """TeX between dollars in Markdown; where mathematics is not known it holds no tag and no link."""
    return TAG_OR_LINK.sub(r"\g<0> ", tex.strip())


def markdown_text(text: str, continues: bool = False) -> str:
    """Text for a Markdown paragraph; one that `continues` a line cannot start a list or a heading."""
    escaped = MARKDOWN_SPECIAL.sub(lambda found: "\\" + found[0], text)
    return escaped if continues else MARKDOWN_LINE_START.sub(_escaped_start, escaped)


def _escaped_start(found: re.Match[str]) -> str:
    blank, sign, digits, mark = found.groups()
    return f"{blank}\\{sign}" if sign else f"{blank}{digits}\\{mark}"
