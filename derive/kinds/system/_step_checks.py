"""What a step response is held to: the curve that its transfer function, as it is printed, has."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from derive.algebra.numbers.floats import number
from derive.control.oracle import poles
from derive.control.oracle.equations import is_close, quotient, value, value_over
from derive.control.oracle.figures import BAND, Figures, Seen, agree
from derive.control.response import StepResponse
from derive.derivation import Claim, Phrase, Plot, Result, Said, Step
from derive.expression import ONE, ZERO, Expr, Measured, Relation, Symbol
from derive.kinds.checks import route
from derive.kinds.fields import TREES
from derive.kinds.system._oracle import Held, as_printed, reals
from derive.kinds.system._pairs import Roots, said_roots
from derive.kinds.system._step_facts import COURSES, FIGURES, NONE, Facts

CLOSE = 1e-6  # of transforms against each other, and of roots against the polynomial they are of
EVERY, FIRST = 16, 6  # samples of the curve that are looked at: each of so many, and the first ones
ORIGIN = Relation(Symbol("s"), "=", ZERO)
TURNED = 0.7 + 0.6j  # where, for each pole, as far from the origin as it


def proofs(
    held: Held,
    transfer: Expr,
    polynomials: tuple[Sequence[float], Sequence[float], Sequence[float]],
    response: StepResponse,
    results: Mapping[str, Result],
    evaluated: Mapping[str, Any],
    told: Facts,
) -> Iterator[Claim]:
    """`transfer` as the page has it; `polynomials` are its numerator and denominator in numbers, and the
    denominator in which nothing has cancelled."""
    num, den, whole = polynomials
    sizes = _sizes(den)
    seen = seen_of(transfer, polynomials)
    yield as_printed("in-complex-numbers", held, transfer)
    yield route("as-large-as-poles", _far_out(held, transfer, (num, den), sizes))
    yield route("modes", _transforms_back(response, transfer, sizes))
    times, values = (each[1:FIRST] + each[FIRST::EVERY] for each in (response.times, response.values))
    yield route("inverse-transform", seen.follows(times, values))
    yield route("long-enough", response.times[-1] >= poles.worth_seeing(num, den))
    yield route("verdict", _courses(told, den, seen))
    yield route("poles-as-printed", _roots(told.poles, den))
    yield route(
        "as-said", _said(held, told, seen, results, evaluated, poles.possible(whole), response.peak_time)
    )
    if told.figures:
        figures = _read_off(results, response)
        yield route("figures", (False,) if figures is None else agree(seen, figures))
    else:
        none = (results[name] == NONE for name in FIGURES if name != "steady_state")
        yield route("no-figures", (not _settles(num, den, sizes), *none))


def seen_of(transfer: Expr, polynomials: Sequence[Sequence[float]]) -> Seen:
    """The response to a unit step, by the function as it is printed."""
    found = poles.roots_of(polynomials[1])
    swing, growth = (max((0.0, *map(part, found))) for part in (lambda z: abs(z.imag), lambda z: z.real))
    return Seen(lambda s: value_over(transfer, s), swing, _sizes(polynomials[1])[0], growth)


def _is_one(height: Said, unit: str) -> bool:
    """Whether a step is of height one, in the unit of what jumps."""
    return height == (Measured(ONE, unit) if unit else 1)


def _settles(num: Sequence[float], den: Sequence[float], sizes: Sequence[float]) -> bool:
    """Whether it comes to rest away from zero: all poles are well left of the imaginary axis."""
    left = all(root.real < -CLOSE * sizes[-1] for root in poles.roots_of(den))
    return left and bool(num) and num[-1] != 0


def _sizes(den: Sequence[float]) -> list[float]:
    """How far from the origin its roots lie."""
    return sorted({abs(root) for root in poles.roots_of(den) if root}) or [1.0]


def written(steps: Sequence[Step], seen: Seen, response: StepResponse) -> Iterator[Claim]:
    """The response as a function of time, as it stands on the page."""
    for step in steps:
        if step.name == "response":
            times = response.times[1:FIRST] + response.times[FIRST::EVERY]
            values = [number(step.result, {"t": time}) for time in times]
            yield route("response-as-written", seen.follows(times, values))


def as_marked(plot: Plot, results: Mapping[str, Result], response: StepResponse) -> Claim:
    """What is marked on the picture is what the page says, and its ends are on the curve."""
    return route("as-marked", _marked(plot, results, response))


def _marked(plot: Plot, results: Mapping[str, Result], response: StepResponse) -> Iterator[bool]:
    told = {name: number(tree, {}) for name, tree in results.items() if isinstance(tree, TREES)}
    final = told.get("steady_state", 0.0)
    (curve,) = plot.series.values()
    yield curve == (response.times, response.values)
    yield [*plot.marks.values()] == ([final] if final else [])
    if plot.band:
        yield all(math.isclose(abs(edge / final - 1), BAND, rel_tol=CLOSE) for edge in plot.band)
    for span in plot.spans:
        x, (end, high) = span.start[0], span.end
        key, said = (
            (span.label.key, span.label.about["value"]) if isinstance(span.label, Phrase) else ("", "")
        )
        size = {
            "rise-span": (end - x, "rise_time"),
            "settling-span": (end - x, "settling_time"),
            "overshoot-span": (100 * (high / final - 1), "overshoot"),
        }.get(key)
        yield size is not None and math.isclose(size[0], told[size[1]], rel_tol=CLOSE)
        yield size is not None and said == results[size[1]]
        yield math.isclose(response.at(end), high, rel_tol=CLOSE)
    drawn = {name for name in FIGURES[:-1] if told.get(name, 0.0) > 0}
    yield len(plot.spans) <= len(drawn)


def _far_out(
    held: Held, transfer: Expr, polynomials: tuple[Sequence[float], Sequence[float]], sizes: Sequence[float]
) -> Iterator[bool]:
    """The function as it is printed, and the polynomials it is said to be of, as far from the origin as
    poles."""
    (point, _), *_ = held.points()
    for size in sizes:
        s = size * TURNED
        ours, other = value(transfer, {"s": s}), held.gain(reals(point), s)
        yield is_close(ours, other, CLOSE) and is_close(quotient(*polynomials, s), other, CLOSE)


def _transforms_back(response: StepResponse, transfer: Expr, sizes: Sequence[float]) -> Iterator[bool]:
    """The elementary transforms of the modes make up that of the response."""
    for size in sizes:
        s = size * TURNED
        yield is_close(response.transform(s), value(transfer, {"s": s}) / s, CLOSE)


def _roots(printed: Roots | None, den: Sequence[float]) -> Iterator[bool]:
    """The poles on the page make up the denominator."""
    found = said_roots(printed)
    yield len(found) == len(den) - 1
    yield printed is None or printed.several == (len(found) > 1)
    for size in {abs(root) for root in found} - {0.0} or {1.0}:
        s = size * TURNED
        yield is_close(poles.product(den[0], found, s), quotient(den, (1.0,), s), CLOSE)


def _read_off(results: Mapping[str, Result], response: StepResponse) -> Figures | None:
    """The figures as they are printed; the times between which it rises, and its peak, as they were found."""
    told = {name: number(tree, {}) for name, tree in results.items() if isinstance(tree, TREES)}
    if response.rises is None or told.keys() != {*FIGURES}:
        return None
    start, _ = response.rises
    rises = (start, start + told["rise_time"])
    return Figures(
        told["steady_state"], rises, told["settling_time"], told["overshoot"], response.peak_time,
        max(response.times[-1], told["settling_time"]),
    )  # fmt: skip


def _said(
    held: Held,
    told: Facts,
    seen: Seen,
    results: Mapping[str, Result],
    evaluated: Mapping[str, Any],
    whole: frozenset[str],
    peak: float | None,
) -> Iterator[bool]:
    """The sentences: numbers of the page and of the JSON are the same; what it has no numbers for, and
    why."""
    for name in FIGURES:
        tree, plain = results[name], evaluated[name]
        yield tree == NONE if plain is None else isinstance(tree, TREES) and _equal(number(tree, {}), plain)
    figures = {phrase.key.removesuffix("-at"): phrase.about for phrase in told.figures}
    yield {name: about["value"] for name, about in figures.items()} == {
        name: results[name] for name in FIGURES[:-1] if results[name] != NONE
    }
    yield dict(told.jump.about)["start"] == Relation(Symbol("t"), "=", ZERO)
    jumping = held.system.output if held.controller else held.system.input
    yield _is_one(told.jump.about["height"], held.system.unit(jumping))
    whose = held.system.input if held.controller is None else None
    yield (told.jump.key, told.jump.about.get("input")) == (
        "reference-jumps" if held.controller else "input-jumps", whose,
    )  # fmt: skip
    given = {**held.problem.where, **(held.given or {})}
    yield {chain[0]: chain[-1] for chain in told.point} == {
        Symbol(name): tree for name, tree in given.items()
    }
    yield is_close(value(told.step, {"s": 0.3 + 1.1j}), 1 / (0.3 + 1.1j))
    time = figures.get("overshoot", {}).get("time")
    shown = peak if figures else None
    yield (
        shown is None
        if not isinstance(time, TREES)
        else shown is not None and _equal(number(time, {}), shown)
    )
    yield told.none == (Phrase("returns") if evaluated["steady_state"] == 0 else None)
    if len(whole) == 1:
        hidden = "unstable" in whole and told.course.key != "grows"
        yield told.hidden == (Phrase("hidden-growth") if hidden else None)


def _courses(told: Facts, den: Sequence[float], seen: Seen) -> Iterator[bool]:
    """What the response does in the end, by the poles and by its slope."""
    possible, about = poles.possible(den), told.course.about
    slope = about.get("slope")
    yield about.get("origin", ORIGIN) == ORIGIN
    if isinstance(slope, TREES):
        yield told.course.key == "drifts" and "integrator" in possible
        yield is_close(number(slope, {}), seen.slope, CLOSE)
    elif told.course.key == "swings" and "integrator" in possible:
        yield not seen.grows
    else:
        yield COURSES[told.course.key] in possible


def _equal(left: float, right: float) -> bool:
    return math.isclose(left, right, rel_tol=1e-12)
