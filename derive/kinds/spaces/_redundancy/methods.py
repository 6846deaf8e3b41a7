"""The methods by their names."""

from __future__ import annotations

from collections.abc import Callable

from derive.kinds.spaces._redundancy.board import Board
from derive.kinds.spaces._redundancy.found import Found
from derive.kinds.spaces._redundancy.given import Given
from derive.kinds.spaces._redundancy.one_task import damped, least_norm, null_space, weighted
from derive.kinds.spaces._redundancy.two_tasks import extended, task_priority

METHODS: dict[str, Callable[[Given, Board], Found]] = {
    "least-norm": least_norm,
    "weighted": weighted,
    "damped": damped,
    "null-space": null_space,
    "task-priority": task_priority,
    "extended": extended,
}
