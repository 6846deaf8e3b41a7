"""What the words read of an answer about stability."""

from __future__ import annotations

from derive.derivation import PageFacts, Phrase, Record, Table
from derive.expression import Expr, Relation
from derive.kinds.system._plant import AtPoint

NEVER = {"derivative": "never-by-zeros", "epsilon": "never-by-a-zero", "": "never"}


class StabilityAtPoint(AtPoint):
    met: Phrase | None = None  # whether the conditions hold


class Around(Record):
    """What is said before and after a step of the array."""

    before: Phrase | None = None
    after: Phrase | None = None


class Facts(PageFacts):
    criterion: Phrase
    factor: Expr | None
    coefficients: Phrase  # what they say
    array: Table | None
    second: Phrase | None  # of its rows, where that begins with a zero
    concluded: tuple[Phrase, ...]  # from the first column
    needed: Phrase | None
    conditions: tuple[Relation, ...]  # none where they never hold
    one_sign: Phrase | None  # the same in other words
    limit: Phrase | None
    critical: tuple[tuple[Expr, ...], ...] | None
    at: StabilityAtPoint | None

    def said(self, *keys: str) -> Phrase | None:
        """What is concluded, if it is one of these."""
        return next((each for each in self.concluded if each.key in keys), None)

    @property
    def never(self) -> bool:
        return self.said(*NEVER.values()) is not None

    @property
    def marginal(self) -> tuple[Relation, ...] | None:
        """The conditions under which it is marginally stable though it is never stable."""
        said = self.said("marginal", "marginal-where")
        found = said.about.get("conditions", ()) if said else None
        return tuple(c for c in found if isinstance(c, Relation)) if isinstance(found, tuple) else None
