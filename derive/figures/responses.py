"""The response to a unit step drawn, with what is read off it: rise, settling, overshoot, steady state."""

from __future__ import annotations

from collections.abc import Iterator

from derive.control.response import BAND, StepResponse
from derive.derivation import Phrase, Plot, Said, Span
from derive.expression import Approximate, Expr, number
from derive.figures.axes import IN_TIME, axis, short

RESPONSE = Phrase("response")


def stepped(response: StepResponse, output: Expr, unit: str, caption: Phrase) -> Plot:
    """The curve; where it settles at a value that is not zero with its band and its numbers, as far as they
    are within the part that is drawn."""
    final = response.steady_state
    return Plot(
        "step",
        IN_TIME,
        axis(output, unit),
        {RESPONSE: (response.times, response.values)},
        {Phrase("steady-state", _said(final)): final} if final else {},
        band=_band(final) if final else None,
        spans=tuple(_spans(response, final)) if final else (),
        caption=caption,
        alt=_alternative(response),
    )


def _band(final: float) -> tuple[float, float]:
    low, high = sorted((final * float(1 - BAND), final * float(1 + BAND)))
    return low, high


def _spans(response: StepResponse, final: float) -> Iterator[Span]:
    """Those that have a length and an end that is drawn."""
    last, curve = response.times[-1], response.at
    if response.rises and response.rises[0] < response.rises[1] <= last:
        start, end = response.rises
        yield Span(Phrase("rise-span", _said(end - start)), (start, curve(start)), (end, curve(end)))
    if response.settling_time and response.settling_time <= last:
        end = response.settling_time
        yield Span(Phrase("settling-span", _said(end)), (0.0, curve(0.0)), (end, curve(end)))
    if response.overshoot and response.peak_time is not None and response.peak_time <= last:
        at = response.peak_time
        yield Span(Phrase("overshoot-span", _said(response.overshoot)), (at, final), (at, curve(at)))


def _said(value: float) -> dict[str, Said]:
    whole = value == int(value)
    return {"value": number(int(value)) if whole else Approximate(value)}


def _alternative(response: StepResponse) -> Phrase:
    """What is seen, to three digits."""
    final, settled = response.steady_state, response.settling_time
    if not final or settled is None:
        low, high, last = min(response.values), max(response.values), response.values[-1]
        about = {"first": response.values[0], "low": low, "high": high, "last": last}
        about["end"] = response.times[-1]
        return Phrase("seen-course", {name: short(value) for name, value in about.items()})
    about = {"final": final, "settled": settled}
    if not response.overshoot or response.peak_time is None:
        return Phrase("seen-settling", {name: short(value) for name, value in about.items()})
    about |= {"peak": final * (1 + response.overshoot / 100), "time": response.peak_time}
    return Phrase("seen-overshoot", {name: short(value) for name, value in about.items()})
