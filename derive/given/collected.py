"""All that a problem gives: by its subject, by the names it defines, and by its questions."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from importlib import import_module
from typing import Any

from derive.expression import Expr
from derive.given import asked, names
from derive.given.datum import Datum
from derive.kinds.problem import Problem


def of_problem(problem: Problem) -> Iterator[Datum]:
    """What the subject gives, and what its names stand for."""
    yield from import_module(f"derive.given.{problem.name}").data(problem.subject, problem)
    yield from names.data(problem)


def says_in_questions(subject: str) -> bool:
    """Whether the questions that are ours name what such a subject gives."""
    return getattr(import_module(f"derive.given.{subject}"), "IN_QUESTIONS", False)


def of_question(options: Any, at: Mapping[str, Expr]) -> Iterator[Datum]:
    """What stands beside `find`, and the point at which numbers are wanted."""
    return asked.data(options, at)
