r"""The commands of TeX that take something: operators, accents, alphabets, environments."""

from __future__ import annotations

_OPERATORS = """
    cos sin tan cot sec csc arccos arcsin arctan cosh sinh tanh exp log ln det dim ker max min sup inf lim
    arg gcd
"""
_ACCENTS = """
    hat bar vec dot ddot dddot tilde check acute grave breve widehat widetilde overline underline
    overrightarrow overbrace underbrace
"""
_SIZES = "big Big bigg Bigg bigl bigr Bigl Bigr"

OPERATORS = frozenset(_OPERATORS.split())
ACCENTS = frozenset(_ACCENTS.split())
SIZES = frozenset(_SIZES.split())
TEXTS = {"text": "", "textrm": "", "mathrm": "", "operatorname": "", "textbf": "bold", "textit": "italic"}
STYLES = {
    "mathbf": "bold", "mathit": "italic", "mathsf": "sans", "mathtt": "mono", "mathbb": "bb",
    "mathcal": "cal", "mathfrak": "frak", "boldsymbol": "bolditalic", "bm": "bolditalic", "mathrm": "upright",
}  # fmt: skip
SWITCHES = {r"\displaystyle": "display", r"\textstyle": "inline"}
FENCES = {  # of the environments that are matrices
    "matrix": ("", ""), "bmatrix": ("[", "]"), "pmatrix": ("(", ")"), "vmatrix": ("|", "|"),
    "Vmatrix": ("‖", "‖"), "Bmatrix": ("{", "}"), "smallmatrix": ("", ""), "cases": ("{", ""),
    "array": ("", ""),
}  # fmt: skip
ALIGNED = frozenset(("aligned", "split", "gathered"))  # the environments that are lines
