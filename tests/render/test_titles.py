"""What a sheet is called without its solutions."""

from __future__ import annotations

import pytest

from derive.render.asking import asks
from derive.render.titles import without_solutions


@pytest.mark.parametrize(
    ("title", "without"),
    [
        ("Exercise solutions for week 3", "Exercises for week 3"),
        ("Solutions to the exercises of week 2", "Exercises of week 2"),
        ("Problem set 4: solutions", "Problem set 4"),
        ("Sheet 2 (with answers)", "Sheet 2"),
        ("Midterm answer key", "Midterm"),
        ("Solutions", "Problems"),
        ("Singular solutions of a wrist", "Singular solutions of a wrist"),
        ("Kinematics", "Kinematics"),
    ],
)
def test_a_title_says_nothing_of_solutions(title: str, without: str) -> None:
    assert without_solutions(title) == without


@pytest.mark.parametrize(
    "text",
    [
        "Where is its end?", "A rod turns. Find its end.", "Find $x$.", "Given its angle, compute the pose.",
        "- Sketch the arm.", "Its length is $l$; derive the pose.", "Fill in the table.",
    ],
)  # fmt: skip
def test_a_text_asks(text: str) -> None:
    assert asks(text)


@pytest.mark.parametrize(
    "text", ["", "A rod turns about one end.", "The arm is used to find parts.", "Its state is at rest."]
)
def test_a_text_that_describes_asks_nothing(text: str) -> None:
    assert not asks(text)
