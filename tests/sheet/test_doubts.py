"""What is strange about a sheet, as a program that loads it is told."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.algebra.formulas.grammar import parse
from derive.algebra.formulas.likely_mistakes import doubtful_angle, words_like_units
from derive.sheet.load import load_sheet

ROBOT = "links: [{theta: q1*, d: 0, a: A, alpha: B}]"


def warnings(folder: Path, text: str) -> list[tuple[str, int, int]]:
    path = folder / "sheet.yaml"
    path.write_text(text, encoding="utf-8")
    places = [(each.message.split()[0], each.place) for each in load_sheet(path).warnings]
    return [(word, place.line, place.column) for word, place in places if place]


def test_they_stand_in_the_order_of_the_file_and_once(tmp_path) -> None:
    (tmp_path / "arm.yaml").write_text(ROBOT.replace("A", "beta").replace("B", "90"), encoding="utf-8")
    problem = "- robot: arm.yaml\n  find: transform\n  evaluate: {q1: 30}\n"
    found = warnings(tmp_path, "title: t\nwhere: {beta: 50}\nproblems:\n" + problem + problem)
    assert found == [("90", 1, 44), ("30", 6, 18), ("30", 9, 18)]


@pytest.mark.parametrize(
    ("typed", "meant"),
    [
        ("90", "90 deg"), ("-45", "-45 deg"), ("1.570796327", "90 deg"), ("1.5708", "90 deg"),
        ("3.14159", "180 deg"), ("0.5236", "30 deg"), ("-0.7854", "-45 deg"), (" 360", "360 deg"),
    ],
)  # fmt: skip
def test_what_was_probably_meant(typed: str, meant: str) -> None:
    found = doubtful_angle(typed, parse(typed, dimension="any"))
    assert found
    assert meant in found.hint


@pytest.mark.parametrize(
    "typed", ["1.57", "0", "2", "6.2", "90 deg", "90 rad", "pi/2", "theta", "0.3", "1.2345"]
)
def test_what_is_an_angle_in_radians(typed: str) -> None:
    assert doubtful_angle(typed, parse(typed, dimension="any")) is None


def test_words_behind_numbers(tmp_path) -> None:
    assert [each.word for each in words_like_units("3 furlong + 2 L - 4 mu + 5 cm + 2 kgs")] == [
        "furlong",
        "kgs",
    ]
    motion = "- motion: [{translate: x, by: 2 span}, {translate: y, by: OTHER}]"
    sheet = f"title: t\nproblems:\n{motion}\n  find: transform\n"
    assert warnings(tmp_path, sheet.replace("OTHER", "3 span")) == [("span", 3, 33), ("span", 3, 61)]
    assert warnings(tmp_path, sheet.replace("OTHER", "span")) == []  # it is a symbol elsewhere
