"""What the audit takes from the house: records, and no function; text is never evaluated; what SymPy does
that may be dear is counted before it begins."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

import derive.audit
from tests.sheets import ROOT

FILES = sorted(Path(derive.audit.__path__[0]).rglob("*.py"))
OURS = ("derive.mechanics", "derive.control")
EVALUATING = {"eval", "exec", "sympify", "parse_expr", "S"}
PRICED = "algebra.py"  # what is dear has its price there
DEAR = {"apart", "cancel", "expand", "factor", "groebner", "linsolve", "simplify", "solve", "trigsimp"}
METHODS = {"LUsolve", "charpoly", "det", "eigenvals", "inv"}  # of a matrix


@pytest.mark.parametrize("file", FILES, ids=[str(file.relative_to(ROOT / "derive")) for file in FILES])
def test_records_only_and_nothing_evaluated(file: Path) -> None:
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith(OURS):
            assert all(alias.name[0].isupper() for alias in node.names), ast.unparse(node)
        if isinstance(node, ast.Call):
            called = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
            assert called not in EVALUATING, ast.unparse(node)


@pytest.mark.parametrize("file", FILES, ids=[str(file.relative_to(ROOT / "derive")) for file in FILES])
def test_what_may_be_dear_has_its_price(file: Path) -> None:
    if file.name == PRICED:
        return
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Attribute):
            dear = {"sympy": DEAR, "mpmath": set()}.get(ast.unparse(node.value), METHODS)
            assert node.attr not in dear, ast.unparse(node)
