"""What the words about workspaces need to know."""

from __future__ import annotations

from derive.derivation import PageFacts, Phrase, Record, Table
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


class InSection(Record):
    """Of an arm that a first joint turns: what counts, the ends that are known, where the boundary is, and
    how often positions are reached."""

    said: Phrase
    bounds: tuple[str, ...]
    boundary: Phrase | None
    table: Table | None
    counts: Phrase | None


class OnASphere(Record):
    """Of a point that two axes carry that meet: by which joints, between which heights where it is not the
    whole sphere, and to which directions the way from there to it goes."""

    said: Phrase
    part: bool
    directions: Phrase


class InPlane(Record):
    """Of an arm in a plane within ranges: what decides the distance."""

    said: Phrase


class Pointing(Record):
    """Of a point that stays: to where the end-effector points."""

    said: Phrase


class WhereReal(Record):
    """Of an arm that reaches what its inverse has a solution for: whether that rests on a root."""

    root: bool


class Facts(PageFacts):
    """Of what is reached at all, or, in its place, `dexterous`."""

    kinds: Phrase  # what is meant by such a workspace
    orientations: Phrase
    secondary: Phrase | None = None  # what has every orientation, where these words do not name it
    arm: Phrase | None = None
    shoulder: tuple[Expr, Expr] | None = None  # where distances from it count
    description: Phrase | None = None
    folds: Phrase | None = None  # where it is nearest to the shoulder and furthest from it
    within: Relation | None = None  # which distances, in a plane
    closed: Phrase | None = None  # for which lengths there is no hole
    nearer: Phrase | None = None  # than is reached
    plots: tuple[str, ...] = ()
    limits: Phrase | None = None  # of the joints
    limited: Limits | None = None
    dexterous: Dexterous | None = None
    section: InSection | None = None
    sphere: OnASphere | None = None
    plane: InPlane | None = None
    pointing: Pointing | None = None
    real: WhereReal | None = None
