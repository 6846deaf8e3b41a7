"""Each case of the case file gets its verdict and its diagnosis; a difference has a point that shows it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from ruamel.yaml import YAML

from derive.algebra.numbers.floats import number
from derive.answers.comparing import compare
from derive.answers.diagnosing import diagnose
from derive.answers.latex.letters import Letters
from derive.answers.points import Sampling
from derive.answers.reading import read_text
from derive.answers.terms import Terms

NAMES = frozenset({"theta1", "theta2", "theta1_dot", "theta2_dot", "a1", "a2", "m", "g"})
LETTERS = Letters(NAMES, own=NAMES)
PATH = Path(__file__).parent / "cases" / "two_links.yaml"
CASES = list(YAML(typ="safe").load(PATH.read_text(encoding="utf-8")))
every_case = pytest.mark.parametrize("case", CASES, ids=[str(case["published"]) for case in CASES])


@every_case
def test_verdict(case: dict[str, Any]) -> None:
    theirs, ours = (read_text(str(case[side]), LETTERS).tree for side in ("published", "derived"))
    found = compare(theirs, ours, Terms({}, {}))
    assert found.verdict == case["verdict"]
    if case["verdict"] == "differs" and found.values and found.values[0] is not None:
        at = {name: float(value) for name, value in found.witness.items()}
        assert abs(number(theirs, at) - number(ours, at)) > 1e-4


@every_case
def test_diagnosis(case: dict[str, Any]) -> None:
    if case["verdict"] == "differs" and "diagnosis" in case:
        theirs, ours = (read_text(str(case[side]), LETTERS).tree for side in ("published", "derived"))
        assert diagnose(theirs, ours, Terms({}, {})) == case["diagnosis"]


def test_what_is_positive_has_no_absolute_value() -> None:
    theirs, ours = read_text("sqrt(a1^2 a2^2)", LETTERS).tree, read_text("a1 a2", LETTERS).tree
    assert compare(theirs, ours, Terms({}, {})).verdict == "undecided"
    positive = Sampling(positive=frozenset({"a1", "a2"}))
    assert compare(theirs, ours, Terms({}, {}, positive)).verdict == "equal"


def test_whole_turns_are_nothing_to_an_angle() -> None:
    theirs, ours = read_text("theta1 + 2 pi", LETTERS).tree, read_text("theta1", LETTERS).tree
    assert compare(theirs, ours, Terms({}, {}, angle=True)).verdict == "equal"
    assert compare(theirs, ours, Terms({}, {})).verdict == "differs"


def test_roots_within_roots_are_proved_around_points() -> None:
    root = "sqrt(a1 + sqrt(a2 + sqrt(m + sqrt(g + sqrt(2 + sqrt(a1 a2 + m g))))))"
    theirs, ours = read_text(f"{root} + 0", LETTERS).tree, read_text(root, LETTERS).tree
    assert compare(theirs, ours, Terms({}, {})).verdict == "equal"
    assert compare(ours, ours, Terms({}, {})).verdict == "equal"
