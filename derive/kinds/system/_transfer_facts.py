"""What the words read of a transfer function."""

from __future__ import annotations

from derive.derivation import PageFacts, Phrase, Record
from derive.expression import Symbol
from derive.kinds.system._drift import DriftAtPoint


class Told(Record):
    """What is said before a step."""

    said: Phrase


class Facts(PageFacts):
    described: Phrase  # by its equations
    inside: Phrase | None  # signals of a motor
    start: Phrase | None  # of what is eliminated
    found: Phrase  # the transfer function
    input: Symbol
    output: Symbol
    cancelled: Phrase | None
    nature: Phrase | None  # improper, or integrating
    at: DriftAtPoint | None
    drawn: bool
