"""A disk of the size that was found is read all the way round, and one that is a size smaller."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from fractions import Fraction
from math import tau
from typing import TYPE_CHECKING

from derive.algebra.numbers.floats import number as at
from derive.algebra.numbers.floats import scalar_number
from derive.expression import ONE, Expr, Relation, replace
from derive.kinds.problem import Problem
from derive.kinds.sensor._facts import SizeFacts
from derive.kinds.sensor._oracle import counts_of_a_line, readings
from derive.kinds.work import Work
from derive.mechanics.sensing import Encoder, Incremental

if TYPE_CHECKING:
    from derive.kinds.sensor.encoder_size import Options

EXACTLY = 1e-9  # as a share: rounding of floats where a size fits exactly


def enough(
    encoder: Encoder, options: Options, results: Mapping[str, Expr], problem: Problem
) -> Iterator[bool]:
    """The disk found is fine enough, and the turns are; what is one smaller is not."""
    gear = at(problem.final(encoder.gear or ONE), {})
    if options.resolution is not None:
        finest = at(problem.final(options.resolution), {})
        name = "lines" if isinstance(encoder.disc, Incremental) else "bits"
        size = round(at(results[name], {}))
        yield tau / gear / _counts(encoder, size, problem) <= finest * (1 + EXACTLY)
        yield size == 1 or tau / gear / _counts(encoder, size - 1, problem) > finest * (1 - EXACTLY)
    if options.range is not None:
        turns, bits = gear * at(problem.final(options.range), {}) / tau, round(at(results["turn_bits"], {}))
        yield readings(bits) >= turns * (1 - EXACTLY)
        yield bits == 1 or readings(bits - 1) < turns * (1 + EXACTLY)


def _counts(encoder: Encoder, size: int, problem: Problem) -> float:
    """Of a turn of the motor."""
    disc = encoder.disc
    if not isinstance(disc, Incremental):
        return readings(size)
    return size * counts_of_a_line(round(at(problem.final(disc.edges), {})))


def as_told(told: SizeFacts, work: Work) -> Iterator[bool]:
    """The inequalities hold as they are written; the next smaller power, or whole number, does not do."""
    yield told.given == work.typed
    for name, relation in told.found:
        sides, signs = [relation.right], [relation.sign]
        left = relation.left
        while isinstance(left, Relation):
            sides, signs, left = [left.right, *sides], [left.sign, *signs], left.left
        values = [_exact(replace(side, work.definitions), work) for side in (left, *sides)]
        for before, sign, after in zip(values, signs, values[1:], strict=False):
            yield {"<": before < after, "<=": before <= after, ">=": before >= after}[sign]
        size = _exact(work[name], work)
        yield max(values) == (size if signs == [">="] else 2**size)
        yield signs[0] != ">=" or min(values) > size - 1
        yield signs[0] != "<" or min(values) == 2 ** (size - 1)


def _exact(tree: Expr, work: Work) -> Fraction:
    scalar = work.scalar(tree)
    return Fraction(scalar_number(scalar, {}) if scalar.constant is None else scalar.constant)
