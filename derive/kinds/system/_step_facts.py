"""What the words read of a step response, and the names of what is read off it."""

from __future__ import annotations

from derive.derivation import PageFacts, Phrase
from derive.expression import Expr
from derive.kinds.system._pairs import Roots

FIGURES = ("rise_time", "settling_time", "overshoot", "steady_state")
COURSES = {"settles": "stable", "drifts": "integrator", "grows": "unstable", "swings": "oscillator"}
NONE = "none"  # a number that this response does not have


class Facts(PageFacts):
    jump: Phrase  # of what, and when
    step: Expr  # its transform
    point: tuple[tuple[Expr, ...], ...]
    poles: Roots | None
    course: Phrase  # what it does in the end
    figures: tuple[Phrase, ...]  # that are read off
    none: Phrase | None  # why there are none though it settles
    hidden: Phrase | None  # what grows unseen
