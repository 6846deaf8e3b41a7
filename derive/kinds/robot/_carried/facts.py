"""What the words say of joints on a path."""

from __future__ import annotations

from derive.derivation import Condition, PageFacts, Phrase, Record, Table
from derive.expression import Expr, Symbol
from derive.kinds.path._moving import Way


class Integrated(Record):
    """How the rates were integrated: from where, with which step."""

    start: Phrase
    least: Phrase | None  # where more joints move than are needed
    step: Expr
    closing: Phrase | None = None  # of a closed path, whether the joints come back too


class Facts(PageFacts):
    """The path; the coordinates and the branch, or how the rates were integrated; what is found over time."""

    way: Way
    place: Symbol
    coordinates: tuple[Symbol, ...] = ()
    chosen: Phrase | None = None
    when: tuple[Condition, ...] = ()
    joints: tuple[str, ...] = ()  # steps
    in_time: tuple[tuple[str, ...], ...] = ()  # steps of joint variables, rates and accelerations
    integrated: Integrated | None = None
    table: Table | None = None
    drawn: bool = False
    ranges: Phrase | None = None  # where joints have some
