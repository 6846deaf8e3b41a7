"""A switched voltage is integrated over a period."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import islice, pairwise

from derive.algebra.numbers.floats import Point
from derive.algebra.numbers.floats import number as at
from derive.derivation import Plot
from derive.errors import NotDerivable
from derive.expression import ZERO, Expr
from derive.expression import replace as put_in
from derive.kinds.checks import close, random_points
from derive.kinds.problem import Problem
from derive.kinds.sensor._facts import VoltageFacts
from derive.kinds.sensor._oracle import mean_of_wave
from derive.kinds.work import Work
from derive.mechanics.sensing import PulseWidth

DRAWS, POINTS = 200, 3
SEEN = 0.4  # a duty of which both parts are seen well


def sampled(voltage: PulseWidth, problem: Problem, results: dict[str, Expr]) -> Iterator[bool]:
    """The wave switched in floats, for the duty and for the time on that are found; a given mean is that one.
    Raises NotDerivable for a duty that no wave has."""
    for point in islice(_points(problem, results["duty"]), POINTS):

        def worth(tree: Expr, here: Point = point) -> float:
            return at(problem.final(tree), here)

        high, low, duty, mean = map(worth, (voltage.high, voltage.low, results["duty"], results["mean"]))
        yield close(mean_of_wave(high, low, duty, 1.0), mean)
        yield all(close(worth(given), duty) for given in (voltage.duty,) if given is not None)
        yield all(close(worth(given), mean) for given in (voltage.mean,) if given is not None)
        if voltage.frequency is not None:
            frequency = worth(voltage.frequency)
            yield close(frequency * at(results["t_on"], point), duty)
            yield close(mean_of_wave(high, low, at(results["t_on"], point), 1 / frequency), mean)


def _points(problem: Problem, duty: Expr) -> Iterator[Point]:
    """Those at which the duty is one. Raises NotDerivable where there are none."""
    found = [each for each in random_points(problem.symbols, DRAWS) if 0 <= at(duty, each) <= 1]
    if not found:
        raise NotDerivable("a duty is between 0 and 1, and no values make this one so", "duty")
    yield from found


def drawn_values(
    voltage: PulseWidth, problem: Problem, results: Mapping[str, Expr]
) -> tuple[float, float, float]:
    """The upper and the lower level and the duty: as they are known, else some that belong together."""
    point = _shown(problem, results)
    high, low, duty = (at(problem.final(x), point) for x in (voltage.high, voltage.low, results["duty"]))
    return high, low, duty


def _shown(problem: Problem, results: Mapping[str, Expr]) -> Point:
    """Of the points the one whose duty is seen best."""
    return min(_points(problem, results["duty"]), key=lambda point: abs(at(results["duty"], point) - SEEN))


def as_drawn(
    plot: Plot, voltage: PulseWidth, problem: Problem, results: Mapping[str, Expr]
) -> Iterator[bool]:
    """The area under the wave that is drawn, over its length, is the mean that is marked, and the result."""
    (curve,), (mean,) = plot.series.values(), plot.marks.values()
    area = sum((b - a) * (u + v) / 2 for (a, b), (u, v) in zip(*map(pairwise, curve), strict=True))
    yield close(area / (curve[0][-1] - curve[0][0]), mean)
    point = _shown(problem, results)
    yield close(mean, at(problem.final(results["mean"]), point))
    off, *_ = plot.moments.values()
    yield close(off, at(problem.final(results["duty"]), point))


def said(voltage: PulseWidth, work: Work, told: VoltageFacts) -> Iterator[bool]:
    """The names in the sentences stand for what is given, and the law for the area under the wave."""
    problem, names = work.problem, work.definitions
    yield told.given == work.typed and told.inverse == (voltage.duty is None)
    yield told.timed == (voltage.frequency is not None)
    typed = [(told.high, voltage.high), (told.low or ZERO, voltage.low)]
    typed += [] if voltage.duty is None else [(told.duty, voltage.duty)]
    yield from (work.scalar(name) == work.scalar(tree) for name, tree in typed)
    (law,) = (step.chain for step in work.steps if step.rule == "area")
    for point in islice(_points(problem, problem.final(put_in(told.duty, names))), POINTS):
        left, right, high, low, duty = (
            at(problem.final(put_in(each, names)), point)
            for each in (*law, told.high, told.low or ZERO, told.duty)
        )
        yield close([left, right], [mean_of_wave(high, low, duty, 1.0)] * 2)
