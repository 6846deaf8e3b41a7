"""Matrices as printed in a book, compared with derived ones by normal form."""

from __future__ import annotations

from derive.algebra.formulas.grammar import parse
from derive.algebra.normal import normal, normal_matrix
from derive.algebra.readable.operation_count import operations
from derive.expression import Matrix


def matrix(text):
    """Rows on lines, entries between commas; an indented line goes on with the row before."""
    rows = [line.split(",") for line in text.strip().replace(",\n  ", ", ").splitlines()]
    return Matrix(tuple(tuple(parse(entry.strip()) for entry in row) for row in rows))


def same(derived, published):
    """Equal entry by entry."""
    return normal_matrix(derived) == normal_matrix(published)


def no_longer(derived, published):
    """Each entry has at most as many operations as the published one."""
    pairs = zip(sum(derived.rows, ()), sum(published.rows, ()), strict=True)
    return all(operations(ours) <= operations(theirs) for ours, theirs in pairs)


def same_scalar(derived, text):
    return normal(derived) == normal(parse(text))
