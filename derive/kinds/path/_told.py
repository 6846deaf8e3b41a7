"""What is said of the shape of a path, and of what is given of it."""

from __future__ import annotations

from derive.derivation import Phrase
from derive.expression import Expr, Symbol
from derive.kinds.path._shapes import Along
from derive.kinds.work import Work
from derive.mechanics.paths import Arc, Curve, Line, Path


def given_names(work: Work, along: Along) -> tuple[tuple[Expr, Expr], ...]:
    """What was given by a name that is not its author's; a radius that its start says is told by a line."""
    told = {step.name for step in work.steps}
    names = [name for name in along.given.values() if name.name not in told]
    return tuple((name, work[name]) for name in names if work[name] != name)


def shape_told(path: Path, s: Symbol) -> Phrase:
    """By which parameter it is described."""
    match path.shape:
        case Line():
            return Phrase("line-by-length", {"s": s})
        case Arc(pitch=None):
            return Phrase("circle-by-length", {"s": s})
        case Arc():
            return Phrase("helix-by-angle", {"s": s})
        case Curve():
            return Phrase("as-given", {"s": s})
    raise TypeError(f"no path: {path!r}")
