"""Every result the course's solution sheets print, against what the sheets of exercises/ derive."""

from __future__ import annotations

import math
import re
from functools import cache
from pathlib import Path
from typing import Any

import pytest
import sympy
from ruamel.yaml import YAML

from derive.algebra.formulas.grammar import parse
from derive.algebra.infix import text
from derive.algebra.normal import normal, normal_matrix
from derive.algebra.readable.operation_count import operations
from derive.build import assemble
from derive.derivation import Branch, Derivation
from derive.expression import Expr, Matrix, Symbol
from derive.sheet.load import load_sheet
from derive.sheet.model import Sheet
from tests.trees import sympy_letters, value

HERE = Path(__file__).parent
SHEETS = sorted(path.stem for path in (HERE / "published").glob("*.yaml"))
JOINTS = re.compile(r"\b([cs])(\d+)\b")


def published(sheet: str) -> list[dict[str, Any]]:
    return list(YAML(typ="safe").load((HERE / "published" / f"{sheet}.yaml").read_text(encoding="utf-8")))


CASES = [(sheet, entry) for sheet in SHEETS for entry in published(sheet)]
NAMES = [
    f"{s}-{e.get('problem', 1)}.{e.get('question', 1)}-{e['name']}-{k}" for k, (s, e) in enumerate(CASES)
]
every_case = pytest.mark.parametrize(("sheet", "entry"), CASES, ids=NAMES)


@cache
def derived(sheet: str) -> tuple[Sheet, dict[tuple[int, int], Derivation]]:
    loaded = load_sheet(HERE.parent / "exercises" / f"{sheet}.yaml")
    found = {(p.number, q.number): q.derivation for p, q in assemble(loaded).questions() if q.derivation}
    return loaded, found


def read(printed: Any) -> Expr:
    """A published formula or list of rows, the abbreviations c1, s12 written out."""
    if isinstance(printed, list):
        return Matrix(tuple(tuple(map(read, row)) for row in printed))
    return parse(JOINTS.sub(_trig, str(printed)))


def _trig(found: re.Match[str]) -> str:
    function = {"c": "cos", "s": "sin"}[found[1]]
    return f"{function}({' + '.join(f'theta{digit}' for digit in found[2])})"


def answer(sheet: str, entry: dict[str, Any]) -> Derivation:
    return derived(sheet)[1][entry.get("problem", 1), entry.get("question", 1)]


def where(sheet: str, entry: dict[str, Any]) -> dict[Expr, Expr]:
    problem = derived(sheet)[0].problems[entry.get("problem", 1) - 1]
    return {Symbol(name): tree for name, tree in problem.where.items()}


def ours(sheet: str, entry: dict[str, Any]) -> Expr:
    """The derived expression of an entry: a result, a link of a step (the last one, or `link`), or what a
    name of the page stands for."""
    found, name = answer(sheet, entry), entry["name"]
    if name in found.results and "link" not in entry:
        result = found.results[name]
        assert not isinstance(result, tuple | float | str)
        return result
    steps = [step for used in rests_on(found) for step in used.all_steps() if step.name == name]
    if not steps:
        return next(d.definitions[Symbol(name)] for d in rests_on(found) if Symbol(name) in d.definitions)
    return steps[0].chain[entry.get("link", -1)]


def rests_on(found: Derivation) -> list[Derivation]:
    return [found, *(d for used in found.uses for d in rests_on(used))]


def pairs(sheet: str, entry: dict[str, Any]) -> list[tuple[Expr, Expr]]:
    """(ours, theirs) for every entry."""
    if "branch" in entry:
        branch = answer(sheet, entry).results["solutions"]
        assert isinstance(branch, tuple)
        chosen = branch[entry["branch"] - 1]
        assert isinstance(chosen, Branch)
        assert chosen.values.keys() == entry["value"].keys()
        return [(chosen.values[name], read(theirs)) for name, theirs in entry["value"].items()]
    mine, theirs = ours(sheet, entry), read(entry["value"])
    if isinstance(theirs, Matrix):
        assert isinstance(mine, Matrix)
        assert mine.shape == theirs.shape
        return list(zip(sum(mine.rows, ()), sum(theirs.rows, ()), strict=True))
    return [(mine, theirs)]


@every_case
def test_it_is_what_we_derive(sheet: str, entry: dict[str, Any]) -> None:
    names = where(sheet, entry)
    for mine, theirs in pairs(sheet, entry):
        if "digits" in entry:
            assert math.isclose(value(mine, {}), value(theirs, {}), abs_tol=0.5 * 10 ** -entry["digits"])
        else:
            assert normal(mine, names) == normal(theirs, names), (text(mine), text(theirs))


@every_case
def test_ours_is_no_longer(sheet: str, entry: dict[str, Any]) -> None:
    if "digits" in entry or entry.get("longer"):
        return
    for mine, theirs in pairs(sheet, entry):
        assert operations(mine) <= operations(theirs), (text(mine), text(theirs))


@pytest.mark.parametrize("name", [f"r_{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3)])
def test_sympy_counts_the_stanford_arm_so_too(name: str) -> None:
    entry = next(e for e in published("week3") if e["name"] == name)
    ((mine, theirs),) = pairs("week3", entry)
    counts = [sympy.count_ops(sympy_letters(expr), visual=False) for expr in (mine, theirs)]
    assert counts[0] <= counts[1]


MISPRINTS = [(sheet, entry) for sheet, entry in CASES if "misprint" in entry]


@pytest.mark.parametrize(("sheet", "entry"), MISPRINTS, ids=[e["name"] for _, e in MISPRINTS])
def test_the_misprint_differs(sheet: str, entry: dict[str, Any]) -> None:
    names = where(sheet, entry)
    assert normal_matrix(ours(sheet, entry), names) != normal_matrix(read(entry["misprint"]), names)


def test_the_kinetic_energy_needs_its_half() -> None:
    """K = 1/2 qdot^T D qdot only with the 1/2 before both parts of K_i (week 6)."""
    D = ours("week6", {"name": "D"})
    assert isinstance(D, Matrix)
    d_22 = normal(D.rows[1][1])
    rate = normal(parse("theta2_dot^2"))
    moving, turning = (
        normal(parse(each)) for each in ("m (L/2)^2 theta2_dot^2", "101 m L^2/1200 theta2_dot^2")
    )
    assert moving / 2 + turning / 2 == d_22 * rate / 2
    assert moving / 2 + turning != d_22 * rate / 2
