"""Answers in words: a case, a description, conditions. Compared as they stand, blanks and order apart."""

from __future__ import annotations

from typing import Any, TypeGuard

from derive.answers.terms import Finding

AS_THEY_STAND = "words are compared as they stand"


def is_spoken(result: Any) -> TypeGuard[str | tuple[str, ...]]:
    """Whether a result is a text or a list of texts."""
    return isinstance(result, str) or (
        isinstance(result, tuple) and bool(result) and all(isinstance(part, str) for part in result)
    )


def heard(published: Any, derived: str | tuple[str, ...]) -> Finding:
    """Equal where the texts are the same; one word that is another differs, and more is not judged."""
    theirs, ours = _words(published), _words(derived)
    if theirs == ours:
        return Finding("equal")
    single = len(ours) == len(theirs) == 1 and " " not in ours[0] + theirs[0]
    return Finding("differs" if single else "undecided", note="" if single else AS_THEY_STAND)


def _words(spoken: Any) -> list[str]:
    listed = spoken if isinstance(spoken, list | tuple) else [spoken]
    return sorted(" ".join(str(text).lower().split()) for text in listed)
