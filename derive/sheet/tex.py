"""Texts of authors: Markdown with mathematics in `$...$`, and nothing that a page could run.

Mathematics goes unchanged into LaTeX, so only commands of a closed list may stand in it; raw HTML
and LaTeX outside of mathematics are refused.
"""

from __future__ import annotations

import re
from difflib import get_close_matches
from typing import Annotated, TypeAlias

from pydantic import AfterValidator

from derive.errors import FormulaError
from derive.sheet.tex_structure import check_structure

MAX_TEXT = 20_000
_COMMANDS = """
    alpha beta gamma delta epsilon varepsilon zeta eta theta vartheta iota kappa lambda mu nu xi pi varpi
    rho varrho sigma varsigma tau upsilon phi varphi chi psi omega Gamma Delta Theta Lambda Xi Pi Sigma
    Upsilon Phi Psi Omega ell hbar imath jmath Re Im partial nabla infty emptyset angle triangle
    cos sin tan cot sec csc arccos arcsin arctan cosh sinh tanh exp log ln det dim ker max min sup inf lim
    arg gcd operatorname mathrm mathbf mathit mathsf mathtt mathbb mathcal mathfrak boldsymbol bm text
    textbf textit textrm frac dfrac tfrac sqrt sum prod int oint iint binom
    hat bar vec dot ddot dddot tilde check acute grave breve widehat widetilde overline underline
    overrightarrow overbrace underbrace overset underset stackrel prime circ bullet star ast dagger
    top bot cdot times div pm mp oplus otimes wedge vee cap cup setminus
    leq geq le ge ll gg neq ne equiv approx cong sim simeq propto parallel perp mid in notin ni subset
    supset subseteq supseteq forall exists neg land lor implies iff to gets mapsto rightarrow leftarrow
    Rightarrow Leftarrow leftrightarrow Leftrightarrow longrightarrow uparrow downarrow
    left right big Big bigg Bigg bigl bigr Bigl Bigr langle rangle lvert rvert lVert rVert vert Vert
    lfloor rfloor lceil rceil lbrace rbrace
    dots ldots cdots vdots ddots quad qquad begin end displaystyle textstyle limits
"""
COMMANDS = frozenset(_COMMANDS.split())
_ENVIRONMENTS = (
    "matrix bmatrix pmatrix vmatrix Vmatrix Bmatrix smallmatrix cases aligned array gathered split"
)
ENVIRONMENTS = frozenset(_ENVIRONMENTS.split())
_MATHS = re.compile(r"(?<!\\)\$([^$\n]+(?:\n[^$\n]+)*)\$")
_COMMAND = re.compile(r"\\([A-Za-z]+|.)", re.DOTALL)
_ENVIRONMENT = re.compile(r"\\(?:begin|end)\s*\{([^}]*)\}")
_HTML = re.compile(r"<(?=[A-Za-z/!?])")
_LATEX = re.compile(r"\\[A-Za-z]+|\\begin|`{3,}\s*\{=|\{=[a-z]+\}")
_PICTURE = re.compile(r"(?<!\\)!\[[^\]]*\]\(")
_LINK = re.compile(r"\]\(\s*(?:javascript|data|file|vbscript):", re.IGNORECASE)


def check_text(text: str) -> str:
    """The text, if nothing in it is dangerous. Raises FormulaError with the offset of what is."""
    if len(text) > MAX_TEXT:
        raise FormulaError(f"a text of more than {MAX_TEXT} characters", 0, "make it several problems")
    if "$$" in text:
        raise FormulaError("$$ cannot stand in a text", text.index("$$"), "write mathematics as $...$")
    end = 0
    for maths in _MATHS.finditer(text):
        _check_prose(text[end : maths.start()], end)
        check_mathematics(maths[1], maths.start(1))
        end = maths.end()
    _check_prose(text[end:], end)
    return text


def check_mathematics(tex: str, offset: int = 0) -> None:
    """Whether TeX holds only commands of the list, put together as they must be. Raises FormulaError."""
    for command in _COMMAND.finditer(tex):
        name = command[1]
        if name.isalpha() and name not in COMMANDS:
            raise FormulaError(f"\\{name} cannot stand in a text", offset + command.start(), _instead(name))
        if name == "^":
            raise FormulaError("\\^ cannot stand in a text", offset + command.start(), "write ^")
    if "^^" in tex:
        raise FormulaError("^^ cannot stand in a text", offset + tex.index("^^"), "write one ^")
    for environment in _ENVIRONMENT.finditer(tex):
        if environment[1].rstrip("*") not in ENVIRONMENTS:
            hint = _hint(environment[1], ENVIRONMENTS)
            raise FormulaError(f"no environment '{environment[1]}' here", offset + environment.start(1), hint)
    check_structure(tex, offset)


def _check_prose(prose: str, offset: int) -> None:
    found = re.search(r"(?<!\\)\$", prose)
    if found:
        raise FormulaError("a $ without its partner", offset + found.start(), "write \\$ for the sign itself")
    if found := _HTML.search(prose):
        raise FormulaError(
            "HTML cannot stand in a text", offset + found.start(), "use Markdown, or \\< for the sign"
        )
    if found := _LATEX.search(prose):
        hint = "put mathematics in $...$, and use Markdown for the rest"
        raise FormulaError("LaTeX outside of $...$ cannot stand in a text", offset + found.start(), hint)
    if found := _PICTURE.search(prose):
        hint = "give it to the problem: figure: picture.png"
        raise FormulaError("a picture cannot stand in a text", offset + found.start(), hint)
    if found := _LINK.search(prose):
        raise FormulaError("a link to this address cannot stand in a text", offset + found.start())


def _instead(name: str) -> str:
    if name in ("degree", "deg"):
        return r"write ^\circ"
    return _hint(name, COMMANDS, "\\")


def _hint(name: str, known: frozenset[str], sign: str = "") -> str:
    close = get_close_matches(name, known, n=1, cutoff=0.8)
    return f"did you mean {sign}{close[0]}?" if close else ""


Text: TypeAlias = Annotated[str, AfterValidator(check_text)]
