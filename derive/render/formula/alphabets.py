"""Letters of the alphabets of mathematics, which Unicode has one by one: 𝐀, 𝓁, ℝ."""

from __future__ import annotations

from functools import lru_cache
from unicodedata import lookup, name

_NAMES = {
    "bold": ("BOLD",), "bolditalic": ("BOLD ITALIC",), "italic": ("ITALIC",), "sans": ("SANS-SERIF",),
    "mono": ("MONOSPACE",), "bb": ("DOUBLE-STRUCK",), "cal": ("SCRIPT",), "frak": ("FRAKTUR", "BLACK-LETTER"),
}  # fmt: skip
_OLDER = {"h": "ℎ"}  # in italics, where Planck's constant was first


@lru_cache(1024)
def in_alphabet(text: str, style: str) -> str:
    """A text in an alphabet; what the alphabet lacks stays as it is."""
    return "".join(_letter(char, style) for char in text) if style in _NAMES else text


def _letter(char: str, style: str) -> str:
    if style == "italic" and char in _OLDER:
        return _OLDER[char]
    plain = name(char, "").replace("LATIN ", "").replace("GREEK ", "").replace("LETTER ", "")
    for kind in _NAMES[style]:
        for whole in (f"MATHEMATICAL {kind} {plain}", f"{kind} {plain}"):
            try:
                return lookup(whole)
            except KeyError:
                continue
    return char
