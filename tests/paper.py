"""What stands in the text of a problem, as a reader of the page sees it: names, numbers and words."""

from __future__ import annotations

import re
import unicodedata
from fractions import Fraction

from derive.render.names import name_latex

TOKEN = re.compile(r"(?P<number>\d+(?:\.\d+)?(?:e-?\d+)?)\s*(?P<unit>%|[cm]m\b|ms\b)?|(?P<name>[A-Za-z_]\w*)")
POWER = re.compile(r"(?<=[ /])(m|s|rad|deg|kg|N)\^[23]")  # of a unit
NO_NAME = re.compile(  # units, functions, and words that go without saying
    "m|s|kg|N|V|A|Hz|H|ohm|rad|deg|mm|cm|ms|km|g|a?sin|a?cos|a?tan|atan2|sqrt|exp|log|abs|sign|pi"
    "|True|base|geometric|spong|clamped|com"
)
SIZES = {"%": 100, "cm": 100, "mm": 1000, "ms": 1000}
NUMERALS = re.compile(
    r"\b(?:(zero)|(one|first)|(two|second)|(three|third)|(four|fourth)|(five|fifth)|(six|sixth)|(seven|seventh)"
    r"|(eight|eighth)|(nine|ninth)|(ten|tenth)|(eleven)|(twelve))\b",
    re.IGNORECASE,
)
SAID = {  # words of the language for which pages say others
    "inverse": "inverse|integrat", "velocity": "velocit|rates",
    "center": "half way", "current": "current|own", "fixed": "world", "origin": "origin|joint",
    "angle": r"angle|\\theta|θ", "planar": "plan", "spatial": "spa", "spherical": "spher", "rows": "row",
    "svd": "singular value", "tool": "tool|own frame|end-effector", "positive": "positive|> 0",
    "natural": "natural|accelerations at the ends", "ZYX": "ZYX|yaw|x.*y.*z", "XYZ": "XYZ|x.*y.*z",
    "ZYZ": "ZYZ|z.*y", "revolute": "revolute|pin", "prismatic": "prismatic|slid", "P": "proportional|P ",
    "quintic": "quintic|degree five", "cycloidal": "cycloid", "bang": "shortest time|at least",
    "euler": "Euler angles", "angles": "angles", "slerp": "unit quaternions", "axis": "one axis",
    "UPS": "universal.*(prismatic|slider).*spherical", "SPS": "spherical.*(prismatic|slider).*spherical",
}  # fmt: skip
SAME = re.compile(
    "world|point|armature|field|speed|standard|modified|incremental|absolute|newton|gradient|pose|orientation"
    "|body|analytic|khatib|universal|space|PD|PI|PID"
)
EVERY = re.compile(r"\d+$")  # I_i is said of I_1 too


class Text:
    """A text in Markdown."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.dense = re.sub(r"[\s{}]|\\[,;:!]|\\mathrm|\\text", "", text)
        self.letters = re.sub(r"\\[A-Za-z]+|[\s{}]", "", "|".join(re.findall(r"\$([^$]+)\$", text)))
        plain = re.sub(r"_\{[^{}]*\}|_\w", "", text)
        self.numbers = {Fraction(each) for each in re.findall(r"\d+(?:\.\d+)?", plain)}
        self.numbers |= {Fraction((found.lastindex or 1) - 1) for found in NUMERALS.finditer(text)}

    def has(self, found: re.Match[str]) -> bool:
        """Whether what a TOKEN found in a sheet stands here."""
        if found["number"]:
            value, size = Fraction(found["number"]), SIZES.get(found["unit"], 1)
            return value in (0, 1) or not self.numbers.isdisjoint({value, value / size})
        name = found["name"]
        if name in SAID or SAME.fullmatch(name):
            said = SAID.get(name, name)
            return re.search(said, self.text, re.IGNORECASE | re.DOTALL) is not None
        return NO_NAME.fullmatch(name) is not None or self.has_name(name)

    def defines(self, name: str) -> bool:
        """Whether it says what the name stands for."""
        return f"{re.sub(r'[{}]', '', name_latex(name))}=" in self.dense

    def has_name(self, name: str) -> bool:
        wanted = re.sub(r"[{}]|\\mathrm", "", name_latex(name))
        if len(wanted) == 1:
            return re.search(rf"{wanted}(?!_)" if wanted not in "xyz" else wanted, self.letters) is not None
        either = rf"{re.escape(wanted)}|{re.escape(EVERY.sub('i', wanted))}"
        return re.search(rf"(?:{either})(?![0-9])", self.dense) is not None


class Paper(Text):
    """The same as `pdftotext` sees it: letters of mathematics are letters of the text, without dots."""

    def __init__(self, text: str) -> None:
        plain = unicodedata.normalize("NFKC", text)
        super().__init__(plain)
        self.dense = re.sub(r"[\s\u0300-\u036f]", "", unicodedata.normalize("NFD", plain))

    def defines(self, name: str) -> bool:
        return self.has_name(name, "=")

    def has_name(self, name: str, then: str = "") -> bool:
        parts = re.fullmatch(r"([A-Za-z]+)_?(\w*)", re.sub("_?d?dot$", "", name))
        stem, index = parts.groups() if parts else (name, "")
        ends = (index, EVERY.sub("i", index))
        return any(_lettered(stem) + _lettered(end) + then in self.dense for end in ends)


def _lettered(word: str) -> str:
    """A Greek letter for its name; anything else as it is."""
    size = "SMALL" if word.islower() else "CAPITAL"
    try:
        return unicodedata.lookup(f"GREEK {size} LETTER {word.upper()}")
    except KeyError:
        return word
