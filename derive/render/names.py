"""Plain names printed properly: `theta1` is \\theta_1, `T_1^0` is T_1^0, `theta1_dot` is \\dot{\\theta}_1."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cache

GREEK_NAMES = (
    "alpha beta gamma delta epsilon varepsilon zeta eta theta vartheta iota kappa lambda mu nu xi pi "
    "rho sigma tau upsilon phi varphi chi psi omega Gamma Delta Theta Lambda Xi Pi Sigma Upsilon Phi "
    "Psi Omega nabla"
)
GREEK = frozenset(GREEK_NAMES.split(" "))
WORD = re.compile(r"[A-Za-z]+")
SHORT_WORDS = frozenset({"on", "up", "in"})  # of two letters that are no indices
STEM_AND_INDEX = re.compile(r"([A-Za-z]+)(\d+[xyz]?)")  # theta1, r11, v1x
LETTER_AND_AXES = re.compile(r"([A-Za-z])([xyz]{1,2}\d*)")  # Ixx, Ixx1, vx
ANGULAR = re.compile("w[xyz]")  # a row of a Jacobian
ANGULAR_CHANGE = re.compile("alpha[xyz]")
SIZE = re.compile(r"(\d+)x(\d+)")  # the zero block 0_3x1
ACCENTS = {"dot": r"\dot", "ddot": r"\ddot"}


@dataclass(frozen=True, slots=True)
class Name:
    """A name in its parts, each LaTeX already; `index` is the plain subscript ("12" of theta12), `before` the
    superscript and the subscript that stand before the stem."""

    stem: str
    lower: str = ""
    upper: str = ""
    index: str = ""
    before: tuple[str, str] = ("", "")

    def __str__(self) -> str:
        upper, lower = self.before
        led = f"{{}}{script('^', upper)}{script('_', lower)} " if upper else ""
        return led + self.stem + script("_", self.lower) + script("^", self.upper)

    def led(self) -> Name:
        """The name of a pose or a vector with its frames before it: {}^0_1 T, {}^0 o_1 (Craig, chapter 2)."""
        if self.stem.isupper():
            return Name(self.stem, index=self.index, before=(self.upper, self.lower))
        return Name(self.stem, self.lower, index=self.index, before=(self.upper, ""))


def script(mark: str, inner: str) -> str:
    """`_1`, `_{12}`, `^T`, or nothing."""
    if not inner:
        return ""
    bare = len(inner) == 1 or re.fullmatch(r"\\[A-Za-z]+", inner)
    return f"{mark}{inner}" if bare else f"{mark}{{{inner}}}"


@cache
def name_latex(name: str) -> str:
    """The LaTeX of a symbol's or a result's name."""
    return str(name_parts(name))


@cache
def name_parts(name: str) -> Name:
    """The parts of a plain name, as LaTeX."""
    plain, accent = _accented(name.removesuffix("*"))
    head, _, upper = plain.partition("^")
    stem, index = _split(head)
    top = _subscript(upper) + (r"\ast" if name.endswith("*") else "")
    written = f"{accent}{{{_stem(stem)}}}" if accent else _stem(stem)
    return Name(written, _lower(stem, index), top, index)


def stem_of(name: str) -> str:
    """The letter or word that a plain name begins with, as it was typed."""
    plain, _ = _accented(name.removesuffix("*"))
    stem, _ = _split(plain.partition("^")[0])
    return stem if name.startswith(stem) else plain[0]


def _accented(name: str) -> tuple[str, str]:
    """The name without its dots, and the accent: `theta1_ddot`, `qdot`."""
    for suffix in ("ddot", "dot"):
        if name.endswith(f"_{suffix}"):
            return name.removesuffix(f"_{suffix}"), ACCENTS[suffix]
        if name.endswith(suffix) and len(name) == len(suffix) + 1:
            return name[0], ACCENTS[suffix]
    return name, ""


def _split(head: str) -> tuple[str, str]:
    """The stem and the subscript of a name: `L_c`, `theta1`, `Ixx`, `theta1_c`; an angular velocity `wx`."""
    if ANGULAR.fullmatch(head):
        return "omega", head[1]
    if ANGULAR_CHANGE.fullmatch(head):
        return "alpha", head[-1]
    stem, _, index = head.partition("_")
    if stem in GREEK:
        return stem, index
    for pattern in (LETTER_AND_AXES, STEM_AND_INDEX):
        if found := pattern.fullmatch(stem):
            return found[1], found[2] + index
    return stem, index


def _stem(stem: str) -> str:
    if stem in GREEK or stem == "sum":  # which stands before what is summed, over its indices
        return "\\" + stem
    if re.fullmatch("cal[A-Z]", stem):  # a Lagrangian beside a length L
        return rf"\mathcal{{{stem[3]}}}"
    return stem if len(stem) == 1 or not WORD.fullmatch(stem) else rf"\mathrm{{{stem}}}"


def _lower(stem: str, index: str) -> str:
    """The subscript; the Jacobians J_v1 and J_w1 carry that of a velocity."""
    if stem == "J" and len(index) > 1 and index[0] in "vw":
        velocity = "v" if index[0] == "v" else r"\omega"
        return velocity + script("_", _subscript(index[1:].lstrip("_")))
    return _subscript(index)


def _subscript(plain: str) -> str:
    """The inside of a subscript: Greek words become letters, words of three letters stay upright."""
    if found := SIZE.fullmatch(plain):
        return rf"{found[1]} \times {found[2]}"
    return ",".join(_piece(piece) for piece in plain.split("_")) if plain else ""


def _piece(piece: str) -> str:
    found = re.fullmatch(r"([A-Za-z]+)(.*)", piece)
    if not found:
        return piece
    word, rest = found.groups()
    if word in GREEK:
        return "\\" + word + script("_", rest)
    counted = set(word) <= set("xyz") or set(word) <= set("ijk")  # axes, or indices side by side
    upright = (len(word) > 2 and word.islower() and not counted) or word in SHORT_WORDS
    return rf"\mathrm{{{word}}}{rest}" if upright else piece
