"""The auditors of a subject: `KINDS` of the module or package in `subjects` that is named after it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from importlib import import_module
from importlib.util import find_spec
from typing import TypeAlias

from derive.audit.asked import Asked, Test
from derive.audit.points import Point

SUBJECTS = "derive.audit.subjects"
Auditor: TypeAlias = Callable[[Asked, Point], Iterator[Test]]


def angles_of(subject_name: str, subject: object) -> frozenset[str]:
    """The names that are angles, by `angles(subject)` of the module of a subject where it has one."""
    angles = getattr(import_module(f"{SUBJECTS}.{subject_name}"), "angles", None)
    return frozenset(angles(subject)) if angles else frozenset()


def auditor(subject: str, kind: str) -> Auditor | None:
    """Who audits this kind of answer, if anyone does."""
    name = f"{SUBJECTS}.{subject}"
    if find_spec(name) is None:
        return None
    kinds: Mapping[str, Auditor] = import_module(name).KINDS
    return kinds.get(kind)
