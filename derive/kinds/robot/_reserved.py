"""Names an answer needs for itself."""

from __future__ import annotations

from derive.errors import NotDerivable
from derive.kinds.problem import Problem


def reserve(problem: Problem, *names: str) -> None:
    """Raises NotDerivable where a name of the answer is one of the sheet's own, before the two are mixed."""
    taken = sorted(set(names) & problem.symbols)
    if taken:
        raise NotDerivable(
            f"the sheet's own '{taken[0]}' is also a name of this answer; choose another name for it"
        )
