"""What a listener is told of a formula: its boxes in words one after the other, with their ends where needed.

A number above on the right is a power, unless it belongs to a name of the trees that were printed: T_1^0 is
no square. The words are those of `templates/words/_spoken.j2`.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache, lru_cache

from jinja2 import Environment

from derive.render.formula.boxes import (
    Accent,
    Box,
    Digits,
    Fenced,
    Fraction,
    Gap,
    Grid,
    Letter,
    Root,
    Row,
    Scripts,
    Sign,
    Stacked,
    Styled,
    Word,
)
from derive.render.formula.signs import GREEK
from derive.render.phrases import lines_in
from derive.render.skin import environment

GREEK_NAMES = {letter: name for name, letter in reversed(GREEK.items())} | {"φ": "phi", "ε": "epsilon"}
TRANSPOSE, MINUS, BARS = Letter("T"), Sign("−", "prefix"), {"|": "absolute", "‖": "norm"}
DIFFERENTIALS = (Letter("d"), Sign("∂"))
INVERSE = Row((MINUS, Digits("1")))
ATAN2 = {"atan2": (0, 1), "Atan2": (1, 0)}  # where the upper and the lower argument stand
WIDE = 1.0  # em between formulas side by side
FIELD = re.compile(r"\{(\w+)\}")
RAISED = {"2": "squared", "3": "cubed"}


def words() -> dict[str, str]:
    """The words for signs and shapes, by their keys."""
    return _words(environment())


@cache
def _words(templates: Environment) -> dict[str, str]:
    return lines_in("words/_spoken.j2")


def say(key: str, **parts: str | int) -> str:
    """The words of a key with its fields filled; a key without words is its own."""
    line = words().get(key, key)
    return FIELD.sub(lambda field: str(parts[field[1]]), line) if parts else line


def spoken(box: Box, names: frozenset[Box] | None = None) -> str:
    """A formula in words; `names` are the boxes of names whose upper indices are no powers. Where nothing is
    known of them, what has a lower index too is taken for a name."""
    return _spoken(box, names, environment())


@lru_cache(4096)
def _spoken(box: Box, names: frozenset[Box] | None, templates: Environment) -> str:
    said = _Speaker(names).say(box)
    return " ".join(said.split()).replace(" ,", ",").replace(" ;", ";").replace(" .", ".")


@dataclass(frozen=True, slots=True)
class _Speaker:
    names: frozenset[Box] | None
    inside: bool = False  # a fraction

    def say(self, box: Box) -> str:
        match box:
            case Letter(char):
                return letter(char)
            case Digits(text):
                return text
            case Word(text):
                return words().get(text, text)
            case Sign(char):
                return say(char)
            case Gap(em):
                return ";" if em >= WIDE else ""
            case Row(boxes):
                return self.row(boxes)
            case Scripts(base, below, above):
                return self.scripts(box, base, below, above)
            case Fraction(above, below, _, bar):
                return self.fraction(above, below, bar)
            case Grid():
                return self.grid(box)
            case _:
                return self.around(box)

    def around(self, box: Box) -> str:
        match box:
            case Root(inside, None):
                return say("root" if is_short(inside) else "tall-root", inside=self.say(inside))
            case Root(inside, degree) if degree is not None:
                return say("nth-root", degree=self.say(degree), inside=self.say(inside))
            case Fenced(opening, inside, closing) if opening == closing and opening in BARS:
                return say(BARS[opening], inside=self.say(inside))
            case Fenced(opening, inside, closing):
                return " ".join((say(opening), self.say(inside), say(closing)))
            case Accent(mark, over):
                return say(mark, over=self.say(over))
            case Styled(_, inside):
                return self.say(inside)
            case Stacked(base, over, under):
                return " ".join(self.say(part) for part in (base, under, over) if part is not None)
            case _:
                raise TypeError(f"not a box: {box!r}")

    def row(self, boxes: Sequence[Box]) -> str:
        """One after the other; what stands between bars, and what atan2 takes, are told as a whole."""
        said: list[str] = []
        place = 0
        while place < len(boxes):
            box = boxes[place]
            if (end := closed_by(boxes, place)) and isinstance(box, Sign) and box.char in BARS:
                said.append(say(BARS[box.char], inside=self.row(boxes[place + 1 : end])))
            elif isinstance(box, Word) and box.text in ATAN2 and (end := closed_by(boxes, place + 1)):
                said.append(self.arctangent(box.text, arguments(boxes, place + 1, end)))
            else:
                end = place
                said.append(self.say(box))
            place = end + 1
        return " ".join(said)

    def fraction(self, above: Box, below: Box, bar: bool) -> str:
        """One inside another is told with its end, so that it is heard which is which."""
        both = (above, below)
        short = all(map(is_short, both)) or all(map(is_differential, both))
        key = "choose" if not bar else "fraction" if short and not self.inside else "tall"
        speaker = _Speaker(self.names, inside=True)
        return say(key, above=speaker.say(above), below=speaker.say(below))

    def arctangent(self, name: str, given: list[Box]) -> str:
        if len(given) != 2:
            return " ".join((name, *map(self.say, given)))
        above, below = (given[k] for k in ATAN2[name])
        key = "arctangent" if is_short(above) and is_short(below) else "tall-arctangent"
        return say(key, above=self.say(above), below=self.say(below))

    def scripts(self, whole: Box, base: Box, below: Box | None, above: Box | None) -> str:
        if isinstance(base, Accent) and below is not None:  # theta 1 dot
            return say(base.mark, over=self.scripts(whole, base.over, below, above))
        said = self.say(base)
        if isinstance(base, Sign) and base.kind == "large" and below is not None:
            key = "over-all" if above is not None else "over"
            return say(key, base=said, below=self.say(below), above=self.say(above or Row(())))
        if below is not None:
            told = self.index(below)
            plain = isinstance(below, Letter | Digits | Word) or told != self.say(below)
            key = "index" if plain else "tall-index"
            said = say(key, base=said, below=told)
        if above is None:
            return said
        named = below is not None if self.names is None else whole in self.names
        return self.raised(said, above, named or not said)

    def raised(self, base: str, above: Box, name: bool) -> str:
        if above == Sign("∘", "binary"):
            return f"{base} {say('°')}"
        if above == Sign("′") or (isinstance(above, Row) and above.boxes and above.boxes[0] == Sign("′")):
            return f"{base} {self.say(above)}"
        if above == TRANSPOSE:
            return say("transpose", base=base)
        if above == INVERSE:
            return say("inverse", base=base)
        if above == Sign("∗", "binary"):
            return say("starred", base=base)
        if name:
            key = "upper" if isinstance(above, Letter | Digits | Word) or not base else "tall-upper"
            return say(key, base=base, above=self.index(above))
        if isinstance(above, Digits) and above.text in RAISED:
            return say(RAISED[above.text], base=base)
        return say("power" if is_short(above) else "tall-power", base=base, above=self.say(above))

    def index(self, box: Box) -> str:
        """Digits of an index one by one, and the size of a block as one says it."""
        match box:
            case Digits(text):
                return " ".join(text)
            case Row((Digits(rows), Sign("×", _), Digits(columns))):
                return say("by", rows=rows, columns=columns)
            case Row(boxes):
                return " ".join(map(self.index, boxes))
            case _:
                return self.say(box)

    def grid(self, grid: Grid) -> str:
        rows = [[self.say(cell) for cell in row] for row in grid.rows]
        if grid.aligned:
            return " ; ".join(" ".join(row) for row in rows)
        if grid.opening == "{":
            return say("cases", entries="; ".join(" ".join(row) for row in rows))
        if max(map(len, rows)) == 1:
            return say("column", entries=", ".join(row[0] for row in rows))
        if len(rows) == 1:
            return say("row", entries=", ".join(rows[0]))
        told = (say("matrix-row", number=k, entries=", ".join(row)) for k, row in enumerate(rows, 1))
        return say("matrix", rows=len(rows), columns=len(rows[0]), entries="; ".join(told))


def letter(char: str) -> str:
    """A letter by its name; a capital one is said to be."""
    name = GREEK_NAMES.get(char, char)
    if not name[0].isupper():
        return name
    return say("capital", letter=name if len(name) == 1 else name.lower())


def is_short(box: Box) -> bool:
    """Whether it needs no word for its end: a letter with scripts, a number."""
    match box:
        case Scripts(base, below, above):
            return all(is_short(part) for part in (base, below, above) if part is not None)
        case Row(boxes):
            return len(boxes) == 2 and boxes[0] == MINUS and is_short(boxes[1])
        case Sign(char):
            return char in "∂∗∘′"
        case Accent(_, over) | Styled(_, over):
            return is_short(over)
        case _:
            return isinstance(box, Letter | Digits | Word)


def is_differential(box: Box) -> bool:
    """The d f or the d t of a derivative, or the d alone."""
    boxes = box.boxes if isinstance(box, Row) else (box,)
    return boxes[0] in DIFFERENTIALS and len(boxes) <= 2 and all(map(is_short, boxes))


def closed_by(boxes: Sequence[Box], opening: int) -> int:
    """The place of the sign that closes what the one at `opening` opens; 0 where none does."""
    depth = 0
    for place in range(opening, len(boxes)):
        box = boxes[place]
        if isinstance(box, Sign) and box.kind in ("opening", "closing"):
            depth += 1 if box.kind == "opening" else -1
        if depth == 0:
            return place if place > opening else 0
    return 0


def arguments(boxes: Sequence[Box], opening: int, closing: int) -> list[Box]:
    """What stands between the commas of a pair of parentheses."""
    found: list[list[Box]] = [[]]
    depth = 0
    for box in boxes[opening + 1 : closing]:
        if isinstance(box, Sign) and box.kind in ("opening", "closing"):
            depth += 1 if box.kind == "opening" else -1
        if box == Sign(",", "punctuation") and not depth:
            found.append([])
        else:
            found[-1].append(box)
    return [part[0] if len(part) == 1 else Row(tuple(part)) for part in found]
