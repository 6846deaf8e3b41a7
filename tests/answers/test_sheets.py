"""Answers in sheets: what was published is equal, its misprints differ, and what we print reads back."""

from __future__ import annotations

import json
from pathlib import Path
from shutil import copytree
from typing import Any

import pytest
from ruamel.yaml import YAML

from derive.answers.findings import Check
from derive.build import working_on
from derive.check import check
from derive.derivation import Derivation
from derive.kinds.problem import TREES
from derive.render.latex import latex
from derive.render.notation import Notation
from derive.sheet.load import load_sheet
from derive.verify import answered
from tests.sheets import ROOT

PUBLISHED = ROOT / "tests" / "published"
EXERCISES = ROOT / "exercises"
SHEETS = ("week2", "week3", "week4", "week6", "dc-motor")


def plain(path: Path) -> Any:
    return YAML(typ="safe").load(path.read_text(encoding="utf-8"))


def checked(sheet: str, answers: list[tuple[int, int, str, Any]], folder: Path) -> list[Check]:
    """The checks of a sheet of the exercises with answers put into it."""
    data = plain(EXERCISES / f"{sheet}.yaml")
    for problem, question, name, value in answers:
        entry = data["problems"][problem - 1]
        place = entry["questions"][question - 1] if "questions" in entry else entry
        found = place.setdefault("answer", {})
        if name == "solutions":
            found.setdefault(name, []).append(value)
        else:
            found[name] = value
    copytree(EXERCISES / "robots", folder / "robots", dirs_exist_ok=True)
    path = folder / f"{sheet}.yaml"
    path.write_text(json.dumps(data), encoding="utf-8")
    return list(check([path]).checks)


def entries(sheet: str, key: str) -> list[tuple[int, int, str, Any]]:
    """What was published, by problem and question; links inside a chain are no results."""
    return [
        (e.get("problem", 1), e.get("question", 1), "solutions" if "branch" in e else e["name"], e[key])
        for e in plain(PUBLISHED / f"{sheet}.yaml")
        if key in e and e.get("link", -1) == -1
    ]


@pytest.mark.parametrize("sheet", SHEETS)
def test_what_was_published_is_equal(sheet: str, tmp_path: Path) -> None:
    found = checked(sheet, entries(sheet, "value"), tmp_path)
    assert found
    assert [each for each in found if each.verdict != "equal"] == []


def test_the_misprints_differ(tmp_path: Path) -> None:
    found = checked("week6", entries("week6", "misprint"), tmp_path)
    wrong = [(each.name, each.entry, each.diagnosis) for each in found if each.verdict != "equal"]
    assert wrong[:2] == [("T_c2", (2, 1), wrong[0][2]), ("T_c2", (2, 2), wrong[1][2])]
    assert wrong[2:] == [("J_c1", (), "shape"), ("J_c2", (), "shape")]
    assert all(each.note == "rows of zeros are missing" for each in found if each.diagnosis == "shape")


def test_a_kinetic_energy_without_its_half(tmp_path: Path) -> None:
    sheet = """\
title: Energy
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: L, alpha: 0, mass: m, com: [-L/2, 0, 0], inertia: [I_x, I_y, I_z]}
    gravity: [0, -g, 0]
  find: energy
  answer: {K: m (L/2)^2 theta1_dot^2/2 + I_z theta1_dot^2}
"""
    (tmp_path / "energy.yaml").write_text(sheet, encoding="utf-8")
    (found,) = check([tmp_path / "energy.yaml"]).checks
    assert (found.verdict, found.diagnosis) == ("differs", "factor 2 in one term")


def as_latex(derivation: Derivation, notation: Notation) -> dict[str, str]:
    results = derivation.results
    return {name: latex(tree, notation) for name, tree in results.items() if isinstance(tree, TREES)}


@pytest.mark.parametrize("sheet", ["week3", "week6", "planar-2r", "lagrange", "dc-motor"])
@pytest.mark.parametrize("trig", ["short", "long"])
def test_what_we_print_reads_back(sheet: str, trig: str, tmp_path: Path) -> None:
    notation = Notation("yx", "short" if trig == "short" else "long", 12)
    printed = []
    for problem in load_sheet(EXERCISES / f"{sheet}.yaml").problems:
        working = working_on(problem)
        for question in problem.questions:
            for name, value in as_latex(answered(question, working), notation).items():
                printed.append((problem.number, question.number, name, value))
    found = checked(sheet, printed, tmp_path)
    assert found
    assert [each for each in found if each.verdict != "equal"] == []


PLANAR = """\
title: Planar arm
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: a1, alpha: 0}
    - {theta: theta2*, d: 0, a: a2, alpha: 0}
  where: {D: (x^2 + y^2 - a1^2 - a2^2)/(2 a1 a2)}
  symbols: {a1: positive, a2: positive}
  find: inverse-kinematics
  given: [x, y]
  answer:
    solutions:
"""
DOWN = "{theta2: acos(D), theta1: 'atan2(y, x) - atan2(a2 sin(theta2), a1 + a2 cos(theta2))'}"
UP = "{theta2: -acos(D), theta1: 'atan2(y, x) - atan2(a2 s2, a1 + a2 c2)'}"


def solved(folder: Path, *solutions: str) -> list[Check]:
    path = folder / "planar.yaml"
    path.write_text(PLANAR + "".join(f"    - {each}\n" for each in solutions), encoding="utf-8")
    return list(check([path]).checks)


def test_solutions_are_a_set(tmp_path: Path) -> None:
    for listed in ((DOWN, UP), (UP, DOWN)):
        assert {each.verdict for each in solved(tmp_path, *listed)} <= {"equal", "undecided"}


def test_a_wrong_solution_differs(tmp_path: Path) -> None:
    right, wrong = solved(tmp_path, DOWN, UP.replace("- atan2", "+ atan2"))
    assert right.verdict != "differs"
    assert wrong.verdict == "differs"
    assert wrong.witness


def test_a_missing_solution_is_told(tmp_path: Path) -> None:
    *_, missing = solved(tmp_path, DOWN)
    assert (missing.verdict, missing.diagnosis) == ("differs", "a solution is missing")


def test_a_transposed_matrix(tmp_path: Path) -> None:
    turned = [
        ["c1", "s1", "0", "0"],
        ["-s1", "c1", "0", "0"],
        ["0", "0", "1", "0"],
        ["L c1", "L s1", "0", "1"],
    ]
    found = checked("week6", [(1, 1, "T_1^0", turned)], tmp_path)
    assert {each.diagnosis for each in found if each.verdict == "differs"} == {"transposed"}


BIAS = """\
title: An acceleration
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: a1, alpha: 0}
  find: jacobian-derivative
  rows: [vx, vy]
  answer: {b_1: -a1*theta1_dot^2*cos(theta1), b_2: a1*theta1_dot^2*sin(theta1)}
"""


def test_entries_that_have_names_on_the_page(tmp_path: Path) -> None:
    path = tmp_path / "bias.yaml"
    path.write_text(BIAS, encoding="utf-8")
    assert [each.verdict for each in check([path]).checks] == ["equal", "differs"]
