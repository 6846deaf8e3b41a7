"""Where a long formula may be broken: before a plus or a minus, outside of braces and tall brackets."""

from __future__ import annotations

from derive.render.width import width

DEEPEST = 3  # brackets a break may stand inside
OPENING, CLOSING = ("{", r"\left", r"\begin"), ("}", r"\right", r"\end")


def pieces(latex: str, room: float) -> list[str]:
    """The formula in pieces, each but the first beginning with its sign.

    Breaks stand between terms; only a term wider than `room` is broken inside its parentheses too.
    """
    found = [latex]
    for depth in range(DEEPEST + 1):
        if all(width(piece) <= room for piece in found):
            break
        found = [part for piece in found for part in _fitting(piece, depth, room)]
    return found


def _fitting(piece: str, depth: int, room: float) -> list[str]:
    return [piece] if width(piece) <= room else _split(piece, depth)


def _split(latex: str, deepest: int) -> list[str]:
    """Broken before every sign inside at most so many parentheses."""
    found: list[list[str]] = [[]]
    closed = level = 0
    for word in latex.split(" "):
        if word in ("+", "-") and not closed and level <= deepest and found[-1]:
            found.append([])
        found[-1].append(word)
        closed += sum(map(word.count, OPENING)) - sum(map(word.count, CLOSING))
        level += 0 if closed else word.count("(") - word.count(")")
    return [" ".join(words) for words in found]
