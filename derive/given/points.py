"""What is given of measured points: their coordinates in both frames."""

from __future__ import annotations

from collections.abc import Iterator

from derive.derivation import Phrase, Table
from derive.given.datum import Datum, vector
from derive.kinds.problem import Problem
from derive.mechanics.fitting import PointPairs


def data(points: PointPairs, problem: Problem) -> Iterator[Datum]:
    """A table of the pairs."""
    pairs = zip(points.source, points.target, strict=True)
    lines = tuple((str(i), vector(a), vector(b)) for i, (a, b) in enumerate(pairs, 1))
    yield Datum(Phrase("points"), Table((Phrase("point"), Phrase("in-A"), Phrase("in-B")), lines))
