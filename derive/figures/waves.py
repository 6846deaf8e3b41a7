"""What is switched on and off over time: a voltage by pulse width, and the tracks of an encoder."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from derive.derivation import Curve, Label, Panels, Phrase, Plot, Span
from derive.expression import ONE, Expr, Relation, Symbol
from derive.figures.axes import short

PERIODS = 2  # of a voltage
VOLTAGE = Symbol("u")
LINES = 2  # of a disc
QUARTER = 0.25  # of a line: how far the second track is behind the first
HALF_HEIGHT = 0.5
BEFORE = 0.1  # of a line, before the first edge


def switched(
    levels: Mapping[Label, float],
    mean: tuple[Label, float],
    duty: tuple[Label, float],
    period: Expr,
    frequency: Expr | None = None,
) -> Plot:
    """Two periods of a voltage with its upper and its lower level, in this order, its mean, and when it is
    switched off; times are shares of a period, which is said by its frequency where that has a name."""
    high, low = levels.values()
    _, share = duty
    times = [t for k in range(PERIODS) for t in (k, k, k + share, k + share)]
    values = [low, high, high, low] * PERIODS
    curve: Curve = ((*map(float, times), float(PERIODS)), (*values, low))
    about = {"share": short(100 * share), "height": short(100 * (mean[1] - low) / (high - low or 1.0))}
    long = Relation(period, "=", ONE / frequency) if frequency else period
    caption = Phrase("drawn-wave", {"u": VOLTAGE, "T": long, "mean": mean[0]})
    return Plot(
        "wave", Symbol("t"), VOLTAGE, {"": curve}, {mean[0]: mean[1]}, {duty[0]: share, period: 1.0},
        levels=levels, unscaled=True, caption=caption, alt=Phrase("seen-wave", about),
    )  # fmt: skip


def tracks(edges: int) -> Panels:
    """The tracks of an incremental disc as it turns, with the edges that are counted for each line: those up
    of one track, all of one track, or all of two."""
    two = edges == 4
    spans = (
        Span(Phrase("one-line"), (0.0, 0.0), (1.0, 0.0)),
        Span(Phrase("one-count"), (0.0, 0.0), (1 / edges, 0.0)),
    )
    first = _track("A", 0.0, edges)
    plots = (
        (first, replace(_track("B", QUARTER, edges), spans=spans)) if two else (replace(first, spans=spans),)
    )
    about = {"edges": str(edges)}
    return Panels(
        "tracks", plots, caption=Phrase("drawn-tracks" if two else "drawn-track"),
        alt=Phrase("seen-tracks" if two else "seen-track", about),
    )  # fmt: skip


def _track(name: str, behind: float, edges: int) -> Plot:
    """Dark and light in turn; the dots are at half its height."""
    ups = [k + behind for k in range(LINES)]
    times: list[float] = [-BEFORE]
    values: list[float] = [0.0]
    for up in ups:
        times += [up, up, up + HALF_HEIGHT, up + HALF_HEIGHT]
        values += [0.0, 1.0, 1.0, 0.0]
    end = LINES - BEFORE
    curve: Curve = ((*times, end), (*values, 0.0))
    counted = ups if edges == 1 else [t for up in ups for t in (up, up + HALF_HEIGHT)]
    points = tuple((t, HALF_HEIGHT) for t in counted)
    return Plot(name, Phrase("turned"), Symbol(name), {"": curve}, points=points, unscaled=True)
