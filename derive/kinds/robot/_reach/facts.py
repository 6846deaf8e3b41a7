"""What the words about workspaces need to know."""

from __future__ import annotations

from derive.derivation import PageFacts, Phrase, Record
from derive.expression import Expr, Relation


class Limits(Record):
    """Of an arm with slides or limits: the distances that have an end, and the size."""

    distances: tuple[str, ...]
    measure: str
    size: Phrase | None
    rise: Phrase | None  # above the plane square to the first axis
    borders: Phrase | None


class Dexterous(Record):
    """Where every orientation is possible: the borders inside the region, and what it is called."""

    borders: tuple[str, ...]
    measure: bool
    where: Phrase


class Facts(PageFacts):
    """Of what is reached at all, or, in its place, `dexterous`."""

    kinds: Phrase  # what is meant by such a workspace
    orientations: Phrase
    secondary: Phrase | None = None  # what has every orientation, where these words do not name it
    arm: Phrase | None = None
    shoulder: tuple[Expr, Expr] | None = None  # where distances from it count
    description: Phrase | None = None
    within: Relation | None = None  # which distances, in a plane
    closed: Phrase | None = None  # for which lengths there is no hole
    nearer: Phrase | None = None  # than is reached
    plots: tuple[str, ...] = ()
    limits: Phrase | None = None  # of the joints
    limited: Limits | None = None
    dexterous: Dexterous | None = None
