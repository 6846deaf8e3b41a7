"""Branches in numbers, as the JSON says them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from derive.algebra.numeric import number
from derive.derivation import Branch
from derive.errors import NotDerivable
from derive.kinds.evaluation import Place
from derive.kinds.problem import Problem
from derive.kinds.values_at import completed


def point_of(place: Place, problem: Problem) -> dict[str, float]:
    """Every name that has a value."""
    return dict(completed({name: number(value, {}) for name, value in place}, problem.where))


def told(branches: Sequence[Branch], found: Sequence[dict[str, float] | None]) -> list[dict[str, Any]]:
    """As the JSON says it: `real` is false where a branch does not reach."""
    return [
        {**values, "when": branch.when} if values else {"when": branch.when, "real": False}
        for branch, values in zip(branches, found, strict=True)
    ]


def unknown(error: KeyError) -> NotDerivable:
    name = error.args[0]
    return NotDerivable(f"no value is known for {name}; give it one under evaluate: or where:")
