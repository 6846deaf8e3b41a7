"""What an answer about stability is held to: the roots themselves."""

from __future__ import annotations

import random
from collections.abc import Iterable, Iterator, Mapping
from fractions import Fraction
from functools import partial

from derive.algebra.numbers.balls import number_sign
from derive.algebra.scalar import Scalar
from derive.control.oracle.equations import Numeric
from derive.control.rational import at
from derive.control.roots import roots
from derive.control.routh import remainder
from derive.control.signals import signals
from derive.derivation import Claim, Step
from derive.expression import ZERO, Expr, Symbol, number
from derive.kinds.checks import close, law, random_points, route
from derive.kinds.meanings import valued
from derive.kinds.system._routh_steps import Array, entry_steps
from derive.kinds.system._stability_answer import Answer, right_of_axis
from derive.kinds.system._stability_limit import frequency_squared, limiting

POINTS_OF_MOTION, NEARLY = 2, 1e-7


def claims_about(answer: Answer) -> Iterator[Claim]:
    """Auxiliary polynomials divide, sign changes count roots, a hidden motion solves the equations."""
    array = answer.array
    if "epsilon" not in array.mended:
        for i, row in enumerate(array.rows, 1):
            if row.origin == "derivative":
                left = remainder(array.polynomial, array.rows[i - 2].polynomial)
                yield law("auxiliary-divides", (not any(left),), row=i - 1)
    if found := [*_in_general(array)]:
        yield route("entries", found)
    limit = limiting(answer)
    if limit is not None and frequency_squared(answer) is not None:
        yield law("row-divides", _divides(answer, limit))
    if not answer.symbols:
        right = right_of_axis(roots(array.polynomial))
        yield route("sign-changes", (answer.changes == right,))
    if len(answer.hidden) > 1:
        yield route("hidden-motion", map(partial(_solves, answer), range(POINTS_OF_MOTION)))


def _in_general(array: Array) -> Iterator[bool]:
    """Whether the formula of each entry is the law of the array for any entries that are not zero."""
    size = len(array.rows[0].entries)
    drawn = random.Random(size)
    entry = {
        (i, j): drawn.uniform(1.0, 2.0) if j <= size and array.trees[i - 1][j - 1] != ZERO else 0.0
        for i in range(1, len(array.rows) + 1)
        for j in range(1, size + 2)
    }
    names: dict[Expr, float] = {array.name(*place): value for place, value in entry.items()}
    for (i, j), step in _formulas(array):
        first, second = entry[i - 2, 1], entry[i - 1, 1]
        wanted = entry[i - 2, j + 1] - first * entry[i - 1, j + 1] / second
        yield close(valued(step.chain[1], names), wanted)


def _formulas(array: Array) -> Iterator[tuple[tuple[int, int], Step]]:
    """The steps with the formulas of entries, by row and column."""
    for step in entry_steps(array):
        if step.rule == "entry":
            row, column = step.name.removeprefix("entry_").split("_")
            yield (int(row), int(column)), step


def _solves(answer: Answer, seed: int) -> bool:
    """Whether the equations as typed are singular at the roots of the hidden factor, at random values."""
    import numpy

    system = answer.plant.system
    names = sorted(system.names - {each.name for each in signals(system)} - {"s", "pi"})
    *_, point = random_points(names, seed + 1)
    place = dict[Expr, Expr]({Symbol(k): number(Fraction(x)) for k, x in point.items()})
    for root in roots(at(answer.hidden, place)):
        try:
            matrix = Numeric.of(system, system.input, point).matrix(root)
        except ZeroDivisionError:  # s stands in a denominator
            continue
        sizes = numpy.linalg.svd(matrix, compute_uv=False)
        if sizes[-1] > NEARLY * max(1.0, sizes[0]):
            return False
    return True


def _divides(answer: Answer, limit: Scalar) -> bool:
    """The remainder after the row of s^2 holds what makes the row of s vanish as a factor."""
    array = answer.array
    left = remainder(array.polynomial, array.rows[-3].polynomial)
    return all(not each or _is_free(each / limit, limit) for each in left)


def _is_free(value: Scalar, factor: Scalar) -> bool:
    """Whether nothing of the factor is left in the denominator."""
    if value.denominator is None:
        return True
    below = Scalar(value.ring, value.denominator)
    both = below + factor
    common = below.into(both.ring).numerator.gcd(factor.into(both.ring).numerator)
    return bool(common.is_constant())


def signs_at(values: Iterable[Scalar], place: Mapping[Expr, Expr]) -> list[int]:
    """1, 0 or -1 of each at a point, decided exactly."""
    return [number_sign(each) for each in at(values, place)]
