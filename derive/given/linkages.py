"""What is given of a linkage: the lengths of its bars, and where its pivots lie."""

from __future__ import annotations

from collections.abc import Iterator

from derive.algebra.formulas.with_units import measured
from derive.derivation import Phrase, Table
from derive.expression import ZERO, number
from derive.given.datum import Datum, vector
from derive.mechanics.linkages import Delta, FiveBar, FourBar, Linkage, SliderCrank, Stewart


def of_linkage(linkage: Linkage) -> Iterator[Datum]:
    """Its bars, and the angle of its crank."""
    if isinstance(linkage, FiveBar):
        bars = dict(zip(("first", "second"), map(measured, linkage.cranks), strict=True))
        bars |= dict(zip(("third", "fourth"), map(measured, linkage.couplers), strict=True))
        yield Datum(
            Phrase("five-bar", bars | {"ground": measured(linkage.ground)}), words=("crank", "coupler")
        )
        return
    if isinstance(linkage, Stewart):
        points = zip(linkage.base, linkage.platform, strict=True)
        rows = ((number(k), vector(a), vector(b)) for k, (a, b) in enumerate(points, 1))
        table = Table((Phrase("leg"), Phrase("base-point"), Phrase("platform-point")), tuple(rows))
        yield Datum(Phrase("stewart"), table)
        return
    if isinstance(linkage, Delta):
        sizes = {name: measured(getattr(linkage, name)) for name in ("base", "platform", "arm", "forearm")}
        yield Datum(Phrase("delta", sizes), words=("platform", "forearm|rod"))
        return
    if isinstance(linkage, FourBar):
        names, key = ["crank", "coupler", "rocker", "ground"], "four-bar"
        words: tuple[str, ...] = ("four-bar|four bar|quadrilateral", "coupler")
    else:
        names, key = ["crank", "rod"], "slider-crank"
        words = ("slider", "rod|coupler")
    yield Datum(Phrase(key, {name: measured(getattr(linkage, name)) for name in names}), words=words)
    if isinstance(linkage, SliderCrank) and linkage.offset != ZERO:
        yield Datum(
            Phrase("offset", {"offset": measured(linkage.offset)}), words=("offset|height|below|above",)
        )
    yield Datum(Phrase("crank-angle", {"angle": linkage.angle}), words=("angle",))
