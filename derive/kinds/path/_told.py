"""What is said of the shape of a path, and of what is given of it."""

from __future__ import annotations

from derive.algebra.formulas.with_units import measured, unit_of
from derive.derivation import Phrase
from derive.expression import Expr, Matrix, Symbol
from derive.kinds.path._shapes import Along
from derive.kinds.work import Work
from derive.mechanics.paths import Arc, Curve, Line, Path


def given_names(work: Work, along: Along) -> tuple[tuple[Expr, Expr], ...]:
    """What was given by a name that is not its author's; a radius that its start says is told by a line."""
    told = {step.name for step in work.steps}
    names = [name for name in along.given.values() if name.name not in told]
    return tuple((name, _with_unit(work[name])) for name in names if work[name] != name)


def _with_unit(value: Expr) -> Expr:
    """A number or a place with the unit that its author gave it."""
    if not isinstance(value, Matrix):
        return measured(value)
    units = (unit_of(entry) for row in value.rows for entry in row)
    return measured(value, next(filter(None, units), ""))


def shape_told(path: Path, s: Symbol) -> Phrase:
    """By which parameter it is described."""
    match path.shape:
        case Line():
            return Phrase("line-by-length", {"s": s})
        case Arc(pitch=None, axis=axis):
            return Phrase("circle-by-length" if axis is None else "circle-in-space-by-length", {"s": s})
        case Arc():
            return Phrase("helix-by-angle", {"s": s})
        case Curve():
            return Phrase("as-given", {"s": s})
    raise TypeError(f"no path: {path!r}")
