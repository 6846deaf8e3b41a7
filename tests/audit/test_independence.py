"""What the audit takes from the house: records, and no function; and text is never evaluated."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

import derive.audit
from tests.sheets import ROOT

FILES = sorted(Path(derive.audit.__path__[0]).rglob("*.py"))
OURS = ("derive.mechanics", "derive.control")
EVALUATING = {"eval", "exec", "sympify", "parse_expr", "S"}


@pytest.mark.parametrize("file", FILES, ids=[str(file.relative_to(ROOT / "derive")) for file in FILES])
def test_records_only_and_nothing_evaluated(file: Path) -> None:
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith(OURS):
            assert all(alias.name[0].isupper() for alias in node.names), ast.unparse(node)
        if isinstance(node, ast.Call):
            called = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
            assert called not in EVALUATING, ast.unparse(node)
