"""What slides alone reach: a segment, a rectangle, a box."""

from __future__ import annotations

from derive.derivation import Phrase, Said
from derive.expression import Expr, Symbol, multiply
from derive.kinds.robot._reach.ranged import Ranged, within_brackets
from derive.kinds.robot._reach.shapes import Shape
from derive.kinds.robot._reach.spans import Span

ENDLESS = {"rectangle": "endless-rectangle", "box": "endless-box"}


def box(ranged: Ranged, rows: tuple[int, ...]) -> Shape:
    spans = tuple(map(ranged.span, rows))
    names = tuple(Symbol(ranged.chain.joint(i).variable) for i in rows)
    endless = tuple(name for name, span in zip(names, spans, strict=True) if span.high is None)
    about: dict[str, Said] = {"names": names, "endless": endless}
    what = ("segment", "rectangle", "box")[len(rows) - 1]
    whole = ("whole-line", "whole-plane", "whole-space")[len(rows) - 1]
    key = what if not endless else ENDLESS[what] if len(endless) < len(rows) else whole
    formulas: dict[str, tuple[Expr, ...]] = {}
    measure = "" if endless else ("", "area", "volume")[len(rows) - 1]
    if measure:
        written = multiply(*(within_brackets(span) for span in spans))
        formulas[measure] = (written, ranged.order.simple(written))
    return Shape(
        "box", rows, Span(None, None), formulas, Phrase("slides" if len(rows) > 1 else "slide", about),
        Phrase(key, about), measure=measure, sides=spans,
    )  # fmt: skip
