"""Problems that were worked on before: what is asked of the same problem once more is found already."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field, fields
from typing import TypeAlias

from derive.kinds.problem import Problem

Said: TypeAlias = tuple[str, int]  # all that is said of a problem, and how often it was said before


@dataclass(frozen=True, slots=True)
class Remembered:
    """The problems of the last build, with all that was derived of them."""

    problems: dict[Said, Problem] = field(default_factory=dict)

    @contextmanager
    def used(self) -> Iterator[None]:
        """Within, a problem of which the same is said as of one of these is that one. Where all goes well,
        the problems of this build are remembered then; else those are that were: none is half derived."""
        met: dict[Said, Problem] = {}
        token = _BUILD.set((self.problems, met))
        try:
            yield
        finally:
            _BUILD.reset(token)
        self.problems.clear()
        self.problems.update(met)


_BUILD: ContextVar[tuple[dict[Said, Problem], dict[Said, Problem]] | None] = ContextVar("build", default=None)


def remembered(problem: Problem) -> Problem:
    """The problem as it was worked on before, if it was; texts are compared, which tell 0.10 from 0.1."""
    if (build := _BUILD.get()) is None:
        return problem
    before, met = build
    text = repr([getattr(problem, each.name) for each in fields(problem) if each.name != "memo"])
    said = text, sum(text == other for other, _ in met)
    return met.setdefault(said, before.get(said, problem))
