"""Whether a published scalar is the derived one: proved by normal form, or refuted by a point.

`differs` is said only where both have values at a point and these surely differ; what neither can decide is
`undecided`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

from flint import arb

from derive.algebra.normal import normal, walk_over
from derive.answers.budget import ROOTS, bounded, too_many_turns
from derive.answers.points import Names, apart, has_none_at
from derive.answers.regions import is_principal, proved_around
from derive.answers.rounding import ROUNDED, rounded
from derive.answers.terms import Finding, Terms, values, where_both_are
from derive.errors import FormulaError, NotDerivable
from derive.expression import Approximate, Call, Expr, Number, Symbol, children, walk

UNDECIDED = (NotDerivable, FormulaError, ValueError, ZeroDivisionError, OverflowError, RecursionError)
MOST_ROOTS = 5  # different roots and inverse functions in a tree whose normal form is asked for
MOST_NODES = 200
LONG = 20_000  # nodes of any tree
TIGHT = 1e-9  # relative: as near as a number in floating point is known
COMPUTED = "to the digits computed"
WHOLE_TURNS = "up to whole turns"
AGREES = "they agree wherever it was tried, which is no proof"
TURNS = "they agree wherever it was tried; an angle is too large a multiple of another for a proof"


def compare(published: Expr, derived: Expr, terms: Terms) -> Finding:
    """What can be said about a published scalar and the derived one."""
    if proved(published, derived, terms):
        return Finding("equal")
    found = _looked_up(published, derived, terms)
    doubtful = found.verdict == "differs" or _is_rounded(derived)
    if doubtful and (note := rounded(published, derived, terms)):
        return Finding("equal" if note == ROUNDED else "undecided", note=note)
    if found.verdict != "undecided" or not found.values:
        return found
    if _is_rounded(derived) and _gap(found.values) < TIGHT:
        return Finding("equal", note=COMPUTED)
    points = where_both_are(published, derived, terms)
    if proved_around(published, derived, terms.names, points, terms.angle):
        return Finding("equal")
    if not terms.angle and proved_around(published, derived, terms.names, points, angle=True):
        bounded_both = is_principal(published) and is_principal(derived)
        return Finding("equal", note="" if bounded_both else WHOLE_TURNS)
    return replace(found, note=found.note or unproved(published, derived, terms))


def unproved(published: Expr, derived: Expr, terms: Terms) -> str:
    """Why what agrees wherever it was tried is not proved."""
    parts = bounded((published, derived), terms.names, LONG)
    return TURNS if parts and too_many_turns(parts) else AGREES


def proved(published: Expr, derived: Expr, terms: Terms) -> bool:
    """Whether the normal form shows them equal, as a whole, or part by part where they are built alike."""
    if published == derived and _mean_the_same(published, terms):
        return True
    if light((published, derived), terms.names):
        return _proved_whole(published, derived, terms)
    parts, others = children(published), children(derived)
    if type(published) is not type(derived) or not parts or len(parts) != len(others):
        return False
    if isinstance(published, Call) and isinstance(derived, Call) and published.function != derived.function:
        return False
    plain = replace(terms, angle=False)
    return all(proved(one, other, plain) for one, other in zip(parts, others, strict=True))


def _mean_the_same(tree: Expr, terms: Terms) -> bool:
    """Whether each name in a tree stands for the same on both sides."""
    pending, seen = [tree], set[Expr]()
    while pending:
        for node in walk(pending.pop()):
            if isinstance(node, Symbol) and node not in seen:
                seen.add(node)
                ours, theirs = terms.derived.get(node), terms.published.get(node)
                if ours != theirs:
                    return False
                pending.extend([ours] if ours is not None else [])
    return True


def light(trees: Sequence[Expr], names: Sequence[Names]) -> bool:
    """Whether the normal forms of trees are found in a moment: roots within roots take long, angles that are
    large multiples of each other too."""
    found = [bounded([tree], [known], LONG) for tree, known in zip(trees, names, strict=True)]
    for parts in found:
        if parts is None:
            return False
        roots = len({part for part in parts if isinstance(part, Call) and part.function in ROOTS})
        if roots > MOST_ROOTS or (roots > 1 and len(parts) > MOST_NODES):
            return False
    return not too_many_turns([part for parts in found if parts for part in parts])


def _proved_whole(published: Expr, derived: Expr, terms: Terms) -> bool:
    """Equal as they stand, or for what is said to be positive."""
    positive = terms.sampling.positive
    roots: Names = {Symbol(name): Symbol(f"{name}_root") ** Number(Fraction(2)) for name in positive}
    for more in ({}, roots) if roots else ({},):
        theirs, ours = {**terms.published, **more}, {**terms.derived, **more}
        if terms.angle and _turned(published, derived, theirs, ours):
            return True
        try:
            if normal(published, theirs) == normal(derived, ours):
                return True
        except UNDECIDED:
            continue
    return False


def _turned(published: Expr, derived: Expr, theirs: Names, ours: Names) -> bool:
    try:
        one = walk_over([published], theirs).trig(published)
        other = walk_over([derived], ours).trig(derived)
        return bool(one[0] == other[0] and one[1] == other[1])
    except UNDECIDED:
        return False


def _looked_up(published: Expr, derived: Expr, terms: Terms) -> Finding:
    """What values at points tell. A finding that is undecided has values where some were compared."""
    best, agreed, bare = None, None, None
    for point, theirs, ours in values(published, derived, terms):
        if ours is None:
            continue
        if theirs is None:
            if has_none_at(published, terms.published, point):
                bare = bare or Finding("differs", point, (None, float(ours.mid())))
            continue
        numbers = float(theirs.mid()), float(ours.mid())
        if _apart(theirs, ours, derived, terms):
            if best is None or _gap(numbers) > 100 * _gap(best.values):
                best = Finding("differs", point, numbers)
        else:
            agreed = agreed or Finding("undecided", values=numbers)
    if best is None and agreed is None:
        return bare or Finding("undecided", note="no point was found where both have a real value")
    return best or _signs(published, derived, terms) or agreed or Finding("undecided")


def _signs(published: Expr, derived: Expr, terms: Terms) -> Finding | None:
    """Undecided, with the reason, where they agree for positive parameters and differ for others."""
    for point, theirs, ours in values(published, derived, terms, odd=True):
        if theirs is not None and ours is not None and _apart(theirs, ours, derived, terms):
            names = sorted(name for name in point if point[name] < 0 and name not in terms.sampling.signed)
            listed = ", ".join(names)
            return Finding(
                "undecided", note=f"equal where {listed} > 0, not everywhere: declare it under symbols"
            )
    return None


def _apart(theirs: arb, ours: arb, derived: Expr, terms: Terms) -> bool:
    return apart(theirs, ours, terms.angle, terms.sampling.rounded or _is_rounded(derived))


def _is_rounded(derived: Expr) -> bool:
    """Whether it is known in floating point only."""
    return any(isinstance(node, Approximate) for node in walk(derived))


def _gap(values: tuple[float | None, float | None] | None) -> float:
    """How far two values are apart, as against their size."""
    if values is None or values[0] is None or values[1] is None:
        return 0.0
    size = max(abs(values[0]), abs(values[1])) or 1.0
    return abs(values[0] - values[1]) / size
