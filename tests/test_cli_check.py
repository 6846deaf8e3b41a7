from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result

from derive.cli import main

SHEET = r"""title: Answers
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: a1, alpha: 0}
    - {theta: theta2*, d: 0, a: a2, alpha: 0}
  questions:
  - find: forward-kinematics
  - find: jacobian
    rows: [vx, vy]
    answer:
      J: '\begin{bmatrix} -a_1 s_1 - a_2 s_{12} & -a_2 s_{12} \\ a_1 c_1 + a_2 c_{12} & ENTRY \end{bmatrix}'
"""
RIGHT = r"a_2\cos(\theta_1 + \theta_2)"


@pytest.fixture
def sheet(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path / "keys.yaml"


def run(*arguments: str) -> Result:
    return CliRunner().invoke(main, ["check", *arguments])


def records(done: Result) -> list[dict[str, Any]]:
    return list(json.loads(done.stdout)["checks"])


def test_all_equal(sheet: Path) -> None:
    sheet.write_text(SHEET.replace("ENTRY", RIGHT), encoding="utf-8")
    done = run("keys.yaml")
    assert done.exit_code == 0, done.output
    assert done.stdout == "keys.yaml:12: J: equal\n4 entries: 4 equal\n"


def test_one_differs(sheet: Path) -> None:
    sheet.write_text(SHEET.replace("ENTRY", "-a_2 c_{12}"), encoding="utf-8")
    done = run("keys.yaml")
    assert done.exit_code == 1
    assert "keys.yaml:12: J: differs\n    entry (2, 2) differs\n" in done.stdout
    assert "published  -a2*cos(theta1 + theta2)" in done.stdout
    assert "probably   sign\n" in done.stdout
    assert done.stdout.endswith("4 entries: 3 equal, 1 differs\n")


def test_json(sheet: Path) -> None:
    sheet.write_text(SHEET.replace("ENTRY", "-a_2 c_{12}"), encoding="utf-8")
    done = run("keys.yaml", "--format", "json")
    assert done.exit_code == 1
    *same, wrong = records(done)
    assert [each["verdict"] for each in same] == ["equal"] * 3
    assert same[0].keys() == {"problem", "question", "name", "entry", "verdict", "published", "derived"}
    witness = wrong.pop("witness")
    assert witness.keys() == {"a2", "theta1", "theta2"}
    assert wrong == {
        "problem": 1,
        "question": 2,
        "name": "J",
        "entry": [2, 2],
        "verdict": "differs",
        "published": "-a2*cos(theta1 + theta2)",
        "derived": "a2*cos(theta1 + theta2)",
        "diagnosis": "sign",
    }


@pytest.mark.parametrize(
    ("entry", "said"),
    [
        (r"\foo", "the problem has no symbol 'foo'"),
        (r"\frac{a_2", "this { is never closed"),
        ("b_2", "the problem has no symbol 'b_2'"),
        ("", "an entry of this matrix is empty"),
    ],
)
def test_an_answer_that_cannot_be_read(sheet: Path, entry: str, said: str) -> None:
    sheet.write_text(SHEET.replace("ENTRY", entry), encoding="utf-8")
    done = run("keys.yaml")
    assert done.exit_code == 1
    assert said in done.stderr
    _, line, caret, *_ = done.stderr.splitlines()
    assert line[caret.index("^")] in "\\b&{"  # the very character
    assert "Traceback" not in done.output
    assert done.stdout.endswith("1 entry: 1 undecided\n")


def test_every_answer_has_a_verdict(sheet: Path) -> None:
    """A problem that has no answer of ours, a name that is none, and one that is right."""
    planar = SHEET.replace("ENTRY", RIGHT) + "      T_2^0: [[1], [1, 2]]\n"
    more = """\
- motion: [{rotate: x, by: a}]
  find: rotation-matrix
  answer: {R: [[1, 0, 0], [0, cos(a), -sin(a)], [0, sin(a), cos(a)]]}
- function: {variables: [x], value: "exp(x) + x^7 + cos(x) - 3"}
  find: stationary-points
  answer: {solutions: [{x: 1}], minimum: 3}
"""
    sheet.write_text(planar + more, encoding="utf-8")
    done = run("keys.yaml", "--format", "json")
    assert done.exit_code == 1
    found = [(each["problem"], each["name"], each["verdict"]) for each in records(done)]
    assert found == [
        *[(1, "J", "equal")] * 4,
        (1, "T_2^0", "undecided"),
        *[(2, "R", "equal")] * 9,
        (3, "solutions", "undecided"),
        (3, "minimum", "undecided"),
    ]
    assert "2 faults; what they concern is undecided" in done.stderr


def test_all_faults_at_once(sheet: Path) -> None:
    more = "      K: 1\n      T_2^0: [[1], [1, 2]]\n"
    sheet.write_text(SHEET.replace("ENTRY", "x_9") + more, encoding="utf-8")
    done = run("keys.yaml")
    assert "this question has no result 'K'" in done.stderr
    assert "not equally long" in done.stderr
    assert "no symbol 'x_9'" in done.stderr
    assert "3 faults" in done.stderr


def test_a_misspelt_result(sheet: Path) -> None:
    sheet.write_text(SHEET.replace("ENTRY", RIGHT).replace("      J:", "      j:"), encoding="utf-8")
    assert "did you mean J?" in run("keys.yaml").stderr


def test_nothing_to_check(sheet: Path) -> None:
    sheet.write_text(SHEET.partition("    answer:")[0], encoding="utf-8")
    done = run("keys.yaml")
    assert done.exit_code == 1
    assert "no answer to check" in done.stderr


@pytest.mark.parametrize("arguments", [(), ("nothing.yaml",), ("keys.yaml", "--format", "xml")])
def test_a_wrong_command_line(sheet: Path, arguments: tuple[str, ...]) -> None:
    sheet.write_text(SHEET, encoding="utf-8")
    assert run(*arguments).exit_code == 2
