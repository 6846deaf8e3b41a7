"""What the words say of joints on a path."""

from __future__ import annotations

from derive.derivation import Condition, PageFacts, Phrase, Table
from derive.expression import Symbol
from derive.kinds.path._moving import Way


class Facts(PageFacts):
    """The path; the coordinates and the branch; what is found over time."""

    way: Way
    place: Symbol
    coordinates: tuple[Symbol, ...]
    chosen: Phrase
    when: tuple[Condition, ...]
    joints: tuple[str, ...]  # steps
    table: Table | None = None
    drawn: bool = False
