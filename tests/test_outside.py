"""Sheets from outside, each with what must come of it: see tests/outside/README.md."""

from __future__ import annotations

import json
import random
import re
from pathlib import Path
from typing import Any

import pytest
import sympy
from click.testing import CliRunner, Result
from ruamel.yaml import YAML

from derive.cli import main

HERE = Path(__file__).parent / "outside"
CASES = sorted(path.name.removesuffix(".expect.yaml") for path in HERE.glob("*.expect.yaml"))
KEYS = {
    "because", "run", "question", "results", "evaluated", "to", "contains", "page", "not_page", "json",
    "not_json", "verdicts", "note", "fault", "at", "hint", "warning", "seconds",
}  # fmt: skip
POINTS = 4
STEP = re.compile(r"\[(\d+)\]|\.?([^.\[\]]+)")
NAME = re.compile(r"[A-Za-z_]\w*")
FUNCTIONS = {
    "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sqrt", "exp", "log", "Abs", "sign", "pi", "I",
    "sinh", "cosh", "tanh", "cosec", "Derivative", "Rational",
}  # fmt: skip


def test_every_sheet_has_its_expectation() -> None:
    """And the other way round: a case whose name is misspelt would never run."""
    sheets = {path.stem for path in HERE.glob("*.yaml") if not path.stem.endswith(".expect")}
    assert sheets == set(CASES)


@pytest.mark.parametrize("name", CASES)
def test_case(name: str) -> None:
    expect = YAML(typ="safe").load((HERE / f"{name}.expect.yaml").read_text(encoding="utf-8"))
    assert expect.keys() <= KEYS, f"unknown keys {expect.keys() - KEYS}"
    assert expect["because"]
    sheet = str(HERE / f"{name}.yaml")
    if expect.get("run") == "check":
        _checked(expect, sheet)
    elif "fault" in expect:
        _refused(expect, _run(sheet, "--format", "json", "--output", "-"))
    else:
        _built(expect, sheet)


def _run(*arguments: str) -> Result:
    done = CliRunner().invoke(main, list(arguments))
    assert "should not have" not in done.stderr, done.stderr
    assert done.exception is None or isinstance(done.exception, SystemExit), repr(done.exception)
    assert "please report this" not in done.stderr, done.stderr
    return done


def _refused(expect: dict[str, Any], done: Result) -> None:
    assert done.exit_code == 1, done.output
    _said(expect, done.stderr, "fault", "at", "hint")


def _said(expect: dict[str, Any], report: str, *keys: str) -> None:
    for text in (text for key in keys for text in _list(expect.get(key, []))):
        assert str(text) in report, report


def _list(value: Any) -> list[Any]:
    return value if isinstance(value, list) else [value]


def _checked(expect: dict[str, Any], sheet: str) -> None:
    done = _run("check", sheet)
    if "fault" in expect:
        _refused(expect, done)
        return
    _said(expect, done.output, "note")
    found = json.loads(_run("check", sheet, "--format", "json").stdout)["checks"]
    verdicts = [entry["verdict"] for entry in found]
    wanted = expect["verdicts"]
    assert verdicts == (wanted if isinstance(wanted, list) else [wanted] * len(verdicts)), done.output
    assert verdicts
    assert done.exit_code == (0 if set(verdicts) == {"equal"} else 1)


def _built(expect: dict[str, Any], sheet: str) -> None:
    done = _run(sheet, "--format", "json", "--output", "-")
    assert done.exit_code == 0, done.stderr
    _said(expect, done.stderr, "warning", "at", "hint")
    if "warning" not in expect:
        assert not done.stderr, done.stderr
    questions = [q for problem in json.loads(done.stdout)["problems"] for q in problem["questions"]]
    found = questions[expect.get("question", 1) - 1]
    assert all(check["holds"] for check in found["checks"])
    for path, value in expect.get("results", {}).items():
        assert _same(_at(found["results"], path), value, 1e-9), (path, _at(found["results"], path))
    for path, value in expect.get("evaluated", {}).items():
        got = _at(found["evaluated"], path)
        assert _same(got, value, float(expect.get("to", 1e-6))), (path, got)
    for path, value in expect.get("contains", {}).items():
        part = found["evaluated"] if "evaluated" in found and path in found["evaluated"] else found["results"]
        tolerance = float(expect.get("to", 1e-6))
        assert any(_same(entry, value, tolerance) for entry in _at(part, path)), _at(part, path)
    _stands(expect, "json", done.stdout)
    if "page" in expect or "not_page" in expect:
        page = _run(sheet, "--format", "md", "--output", "-")
        assert page.exit_code == 0, page.stderr
        _stands(expect, "page", page.stdout)


def _stands(expect: dict[str, Any], key: str, text: str) -> None:
    plain = " ".join(text.split())
    for part in _list(expect.get(key, [])):
        assert " ".join(str(part).split()) in plain, f"{part} is missing in\n{text}"
    for part in _list(expect.get(f"not_{key}", [])):
        assert " ".join(str(part).split()) not in plain, f"{part} stands in\n{text}"


def _at(value: Any, path: str) -> Any:
    """A part by its path, indices counted from 1; a result may have brackets or points in its own name."""
    if path in value:
        return value[path]
    for index, key in STEP.findall(path):
        value = value[int(index) - 1] if index else value[key]
    return value


def _same(got: Any, wanted: Any, tolerance: float) -> bool:
    """Lists entry by entry, of an object the keys that are wanted; formulas by their values."""
    if isinstance(wanted, list):
        return (
            isinstance(got, list)
            and len(got) == len(wanted)
            and all(_same(a, b, tolerance) for a, b in zip(got, wanted, strict=True))
        )
    if isinstance(wanted, dict):
        return isinstance(got, dict) and all(
            key in got and _same(got[key], entry, tolerance) for key, entry in wanted.items()
        )
    if isinstance(wanted, bool) or wanted is None or isinstance(got, bool) or got is None:
        return bool(got is wanted)
    if str(got) == str(wanted):
        return True
    return _equal_in_value(str(got), str(wanted), tolerance)


def _equal_in_value(got: str, wanted: str, tolerance: float) -> bool:
    try:
        left, right = _read(got), _read(wanted)
    except (sympy.SympifyError, SyntaxError, TypeError):
        return False
    names = sorted(left.free_symbols | right.free_symbols, key=str)
    draw = random.Random(got)
    for _ in range(POINTS if names else 1):
        at = {name: draw.uniform(0.3, 1.7) for name in names}
        a, b = (complex(side.evalf(30, subs=at)) for side in (left, right))
        if not abs(a - b) <= tolerance * max(abs(b), 1 if abs(b) < tolerance else abs(b)):
            return False
    return True


def _read(text: str) -> Any:
    letters = {name: sympy.Symbol(name) for name in NAME.findall(text) if name not in FUNCTIONS}
    return sympy.sympify(text, locals={**letters, "abs": sympy.Abs}, rational=True)
