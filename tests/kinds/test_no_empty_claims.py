"""No claim of a kind can hold of nothing: `law` and `route` are given what they are to count.

`all(())` is true, and so is a literal True; a claim made of one of these is a stamp and no check.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

from derive.kinds import registry

MAKERS = ("law", "route", "every")
OURS = ("checks.py", "links.py", "declared.py", "told.py")


def name_of(called: ast.expr) -> str:
    match called:
        case ast.Name(name) | ast.Attribute(_, name):
            return name
    return ""


def can_be_empty(call: ast.Call) -> bool:
    """Whether a claim is made by hand, or told to hold by a constant, an `all(...)` or an `any(...)`."""
    made = name_of(call.func)
    if made not in MAKERS:
        return made == "Claim"
    match call.args[1:2]:
        case [ast.Constant()]:
            return True
        case [ast.Call(func)] | [ast.UnaryOp(_, ast.Call(func))]:
            return name_of(func) in ("all", "any")
    return False


def offenders() -> Iterator[str]:
    for path in registry.KINDS.rglob("*.py"):
        if path.parent != registry.KINDS or path.name not in OURS:
            calls = (node for node in ast.walk(parsed(path)) if isinstance(node, ast.Call))
            yield from (str(path.relative_to(registry.KINDS)) for call in calls if can_be_empty(call))


def parsed(path: Path) -> ast.Module:
    return ast.parse(path.read_text(encoding="utf-8"))


def test_claims_count_what_they_hold_of() -> None:
    assert sorted(offenders()) == []
