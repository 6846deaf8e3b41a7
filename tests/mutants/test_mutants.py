"""The planting itself, and a small sample of it: no wrong result leaves the house."""

from __future__ import annotations

import ast
from functools import partial
from pathlib import Path

import pytest

from tests.mutants.__main__ import ground, told
from tests.mutants.operators import CODE, WORDINGS, code_of, in_code, in_words, put, words_of
from tests.mutants.trial import sample, tried
from tests.mutants.units import Page, forked, warmed
from tests.mutants.verdict import Refused, same, verdict

PLANTED = {
    "sign": ("a + b", "a - b"),
    "sin-cos": ("sin(x)", "cos(x)"),
    "index-swap": ("R[i, j]", "R[j, i]"),
    "off-by-one": ("range(n)", "range(n - 1)"),
    "transpose": ("R.T @ R", "R @ R"),
    "factor": ("a * b", "b"),
    "drop-term": ("a + b", "a"),
    "arg-swap": ("cross(a, b)", "cross(b, a)"),
    "pre-post": ("A @ B", "B @ A"),
    "comparison": ("a < b", "a <= b"),
    "zero-one": ("f(0)", "f(1)"),
    "branch": ("a if b else c", "c if b else a"),
}
SHEETS = "week"  # of which problems are built for the sample
COUNT, SEED = 24, 2


@pytest.mark.parametrize("name", CODE)
def test_every_operator_plants_what_it_says(name: str) -> None:
    before, after = PLANTED[name]
    planted = set()
    for number, _ in enumerate(ast.walk(ast.parse(before))):
        tree = ast.parse(before)
        node = list(ast.walk(tree))[number]
        if (wrong := CODE[name](node)) is not None:
            planted.add(ast.unparse(put(tree, node, wrong)))
    assert after in planted


@pytest.mark.parametrize("stratum", ["mechanics", "control"])
def test_every_mistake_compiles(stratum: str) -> None:
    for mutant in list(in_code(stratum))[::97]:
        assert code_of(mutant).co_qualname == mutant.function


def test_words_are_mutated_outside_of_questions() -> None:
    every = list(in_words())
    assert {mutant.operator for mutant in every} == set(WORDINGS)
    for mutant in every[::31]:
        assert words_of(mutant) != mutant.path.read_text(encoding="utf-8")


def test_results_are_compared_as_functions() -> None:
    assert same({"J": [["a*cos(x)^2"]]}, {"J": [["a - a*sin(x)^2"]]})
    assert not same({"J": "a*cos(x)"}, {"J": "a*sin(x)"})
    assert not same({"J": "a"}, {"K": "a"})
    assert same([{"x": "1"}, {"x": "2"}], [{"x": "2"}, {"x": "1"}])


def test_a_page_is_judged_by_its_worst() -> None:
    right = Page("Then $a + b$ is up.", {"1.results": {"a": "x + y"}})
    assert verdict(right, Page("Then $a + b$ is up.", {"1.results": {"a": "x - y"}})).kind == "wrong"
    assert verdict(right, Page("Then $a - b$ is up.", right.results)).kind == "line"
    assert verdict(right, Page("Then $a + b$ is down.", right.results)).kind == "words"
    assert verdict(right, Page(right.text, {"1.results": {"a": "y + x"}})).kind == "form"
    assert verdict(right, Refused("the answer failed its own check", failed=True)).kind == "check"


@pytest.fixture(scope="module")
def survivors(tmp_path_factory: pytest.TempPathFactory) -> list[str]:
    """What a sample printed wrong, in a process of its own that has imported everything."""
    folder: Path = tmp_path_factory.mktemp("mutants")
    return forked(partial(_sample, folder), 600.0) or ["the sample took too long"]


def _sample(folder: Path) -> list[str]:
    warmed()
    field = ground(folder, SHEETS)
    found = []
    for mutant, _ in zip(sample(field, SEED), range(COUNT), strict=False):
        worst, on = tried(field, mutant, SEED, most=2)
        found.append(told((mutant, worst, [str(unit) for unit in on])))
    return found


def test_no_wrong_result_of_a_sample_is_printed(survivors: list[str]) -> None:
    assert len(survivors) == COUNT
    assert [each for each in survivors if each.startswith("WRONG")] == []
