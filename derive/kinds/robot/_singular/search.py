"""Singular configurations sought in numbers, along lines through the joint variables; each has to lie in one
of the sets that are told."""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import pairwise
from typing import Any

from derive.algebra.numbers.floats import number
from derive.derivation import Branch, Phrase
from derive.expression import Expr, Relation

LINES, SAMPLES, HALVINGS = 5, 64, 60
PARABOLAS = 8
LOW, NOTHING = 0.3, 1e-12  # of the largest value on a line: what may lead down to zero, and what is zero
SMALL = 1e-5  # a singular value, relative to the largest; differences leave less
CLOSE = 1e-5  # of a variable or an equation, at a zero found
Values = dict[str, float]


def zeros_along(
    value: Callable[[Values], float],
    at: Mapping[str, float],
    names: Sequence[str],
    slides: Sequence[str],
    lines: int = LINES,
    samples: int = SAMPLES,
) -> Iterator[Values]:
    """Where a function changes its sign, or touches zero as a square does, on lines at random, which an angle
    follows for a whole turn."""
    draw = random.Random(" ".join(names))
    for _ in range(lines):
        start = {name: draw.uniform(-math.pi, math.pi) for name in names}
        way = {name: draw.choice((-1, 1)) * draw.uniform(0.5, 1.0) for name in names}
        if slides:
            start |= {name: draw.uniform(-2.0, 2.0) for name in slides}

        def there(s: float, start: Values = start, way: Values = way) -> Values:
            return {**at, **{name: start[name] + s * way[name] for name in names}}

        def height(s: float, there: Callable[[float], Values] = there) -> float:
            return value(there(s))

        marks = [2 * math.pi * k / samples for k in range(samples + 1)]
        heights = list(map(height, marks))
        for (a, fa), (b, fb) in pairwise(zip(marks, heights, strict=True)):
            if fa * fb < 0:
                yield there(_halved(height, a, b, fa))
        yield from map(there, _touched(height, marks, heights))


def _touched(value: Callable[[float], float], marks: list[float], heights: list[float]) -> Iterator[float]:
    """Where a function comes down to zero and goes up again on the same side."""
    highest = max(map(abs, heights))
    triples = zip(marks, marks[2:], heights, heights[1:], heights[2:], strict=False)
    for start, end, before, here, after in triples:
        low = abs(here) <= min(abs(before), abs(after)) and abs(here) < LOW * highest
        if low and before * here > 0 and here * after > 0:
            at = _lowest(lambda s: abs(value(s)), start, end)
            if abs(value(at)) < NOTHING * highest:
                yield at


def _lowest(value: Callable[[float], float], a: float, b: float) -> float:
    """The place of the only minimum between two places, by parabolas through three closer and closer ones."""
    middle, apart = (a + b) / 2, (b - a) / 2
    for _ in range(PARABOLAS):
        before, here, after = (value(middle + step * apart) for step in (-1, 0, 1))
        bend = before - 2 * here + after
        if bend > 0:
            middle -= apart * max(-1.0, min(1.0, (after - before) / (2 * bend)))
        apart /= 10
    return middle


def _halved(value: Callable[[float], float], a: float, b: float, fa: float) -> float:
    """The zero between two signs."""
    for _ in range(HALVINGS):
        middle = (a + b) / 2
        a, b = (middle, b) if value(middle) * fa > 0 else (a, middle)
    return (a + b) / 2


def inside(branch: Branch, here: Values, slides: Sequence[str]) -> bool:
    """Whether a configuration lies in a set, by its values and equations as they are told."""
    try:
        return all(
            _near(here[name], number(value, here), name in slides) for name, value in branch.values.items()
        ) and all(_holds(each, here) for each in branch.when if isinstance(each, Phrase))
    except (ValueError, ZeroDivisionError):
        return False


def _near(one: float, other: float, slide: bool) -> bool:
    gap = one - other
    return abs(gap if slide else math.remainder(gap, 2 * math.pi)) < CLOSE


def _holds(said: Phrase, here: Values) -> bool:
    """The equations of a set; of what a configuration looks like nothing is asked here."""
    equations = said.about.get("equations", ())
    relations = (
        [each for each in equations if isinstance(each, Relation)] if isinstance(equations, tuple) else []
    )
    return all(_met(each, here) for each in relations)


def _met(relation: Relation, here: Values) -> bool:
    left, right = relation.left, relation.right
    if isinstance(left, Relation):
        return False
    gap = number(left, here) - number(right, here)
    return abs(gap) < CLOSE or abs(math.remainder(gap, 2 * math.pi)) < CLOSE


def put(values: Mapping[str, Expr], at: Values) -> Values | None:
    """A point moved to these values; None where they are not real."""
    here = dict(at)
    try:
        for _ in values:  # a value may hold another one
            here |= {name: number(value, here) for name, value in values.items()}
    except ValueError:
        return None
    return here


def placed(values: Mapping[str, Expr], points: Iterator[Values], most: int = 3) -> Iterator[Values]:
    """Points moved to these values, where they are real."""
    count = 0
    for at in points:
        here = put(values, at)
        if here is None:
            continue
        yield here
        count += 1
        if count == most:
            return


def singular_values(J: Any) -> Any:
    """Of a matrix (an array, m by n), the largest first."""
    import numpy as np

    return np.linalg.svd(J, compute_uv=False)


def rank_at(J: Any) -> int:
    """Singular values that are more than differences leave."""
    values = singular_values(J)
    return int((values > SMALL * max(1.0, values[0])).sum())
