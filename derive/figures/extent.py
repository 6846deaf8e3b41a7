"""How large mathematics is on paper, about: a box has to be drawn before its label is set."""

from __future__ import annotations

from derive.algebra.infix import text
from derive.expression import Expr, Number, Power, Product, Quotient, Sum, Symbol

LETTER, BROAD, DIGIT, SIGN = 5.9, 9.2, 5.1, 12.4  # points, of letters that are ten high
BROAD_LETTERS = frozenset("mwMWKRDGHNOQVXTAUYCPFE")
HIGH, RAISED, BAR = 10.0, 3.5, 5.0
SMALL = 0.72  # an index
SURE = 1.06  # that nothing is smaller than it is


def extent(tree: Expr) -> tuple[float, float]:
    """Width and height in points, at most a little too large."""
    wide, high = _extent(tree)
    return SURE * wide, high


def _extent(tree: Expr) -> tuple[float, float]:
    match tree:
        case Symbol(name):
            return _name(name), HIGH
        case Number():
            return DIGIT * len(text(tree)), HIGH
        case Quotient(above, below):
            (a, high), (b, low) = _extent(above), _extent(below)
            return max(a, b) + 4.0, high + low + BAR
        case Power(base, exponent):
            (a, high), (b, _) = _extent(base), _extent(exponent)
            return a + SMALL * b + (8.0 if isinstance(base, Sum) else 0.0), high + RAISED
        case Sum(terms):
            parts = [_extent(term) for term in terms]
            return sum(wide for wide, _ in parts) + SIGN * (len(parts) - 1), max(high for _, high in parts)
        case Product(factors):
            parts = [_extent(factor) for factor in factors]
            fences = sum(8.0 for factor in factors if isinstance(factor, Sum))
            return sum(wide for wide, _ in parts) + fences, max(high for _, high in parts)
    return LETTER * len(text(tree)), HIGH


def _name(name: str) -> float:
    """A letter with its index."""
    letter, _, index = name.partition("_")
    stem = letter.rstrip("0123456789")
    index += letter[len(stem) :]
    if index in ("dot", "ddot"):
        index = ""
    broad = BROAD if stem in BROAD_LETTERS else LETTER + 1.0
    return broad + SMALL * LETTER * len(index.replace("_", ""))
