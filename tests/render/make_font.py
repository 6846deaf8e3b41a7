"""Makes the font of the mathematics in HTML, a subset of Latin Modern Math.

`python -m tests.render.make_font latinmodern-math.otf` with the font of a TeX installation; needed again
where formulas can hold a new sign.
"""

from __future__ import annotations

import sys
import unicodedata
from pathlib import Path

from fontTools import subset

from derive.render.formula.alphabets import in_alphabet
from derive.render.formula.mathml import ACCENTS
from derive.render.formula.signs import CHARACTERS, COMMANDS, GREEK
from derive.render.skin import templates

FONT = templates() / "html" / "mathematics.woff"
NAME = "Sheet Math"  # what is changed is not called as before, which its licence asks for
ALPHABETS = {"italic": "Aaα", "bold": "Aaα0", "bolditalic": "α", "cal": "A", "bb": "A"}
LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"


def letters() -> set[str]:
    """Everything that is set: ASCII, Greek, the signs, and letters of the alphabets."""
    of = {"A": LETTERS, "a": LETTERS.lower(), "α": "".join(GREEK.values()), "0": "0123456789"}
    others = {
        char for style, kinds in ALPHABETS.items() for kind in kinds for char in in_alphabet(of[kind], style)
    }
    signs = {sign.char for sign in (*COMMANDS.values(), *CHARACTERS.values())}
    return {
        *map(chr, range(0x20, 0x7F)),
        *GREEK.values(),
        *signs,
        *"".join(ACCENTS.values()),
        *"√−°·\xa0",
        *others,
    }


def main(source: str) -> None:
    """Writes the font and says what it lacks."""
    options = subset.Options(flavor="woff", hinting=False, desubroutinize=True, layout_features=[])
    font = subset.load_font(source, options)
    lacking = letters() - {*map(chr, font.getBestCmap())}
    subsetter = subset.Subsetter(options)
    subsetter.populate(unicodes=[ord(char) for char in letters()])
    subsetter.subset(font)
    for record in font["name"].names:
        if record.nameID in (1, 3, 4, 6, 16):
            record.string = NAME if record.nameID != 6 else NAME.replace(" ", "")
    subset.save_font(font, str(FONT), options)
    print(f"{FONT}: {FONT.stat().st_size} bytes, without", *(unicodedata.name(char) for char in lacking))


if __name__ == "__main__":
    main(str(Path(sys.argv[1])))
