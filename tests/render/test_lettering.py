"""The letters of four books, and those of an author, on pages that are read back."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.build import build
from derive.errors import SheetError, SheetErrors
from derive.render.lettering import HOUSE, Lettering

SHEET = """
title: Letters
notation: {NOTATION}
problems:
- robot:
    gravity: [0, -g, 0]
    links:
    - {theta: theta1*, d: 0, a: a_1, alpha: 0, mass: m_1, com: [-a_1/2, 0, 0], inertia: [0, 0, I_1]}
    - {theta: theta2*, d: 0, a: a_2, alpha: 0, mass: MASS, com: [-a_2/2, 0, 0], inertia: [0, 0, I_2]}
  questions:
  - find: dh-table
  - find: forward-kinematics
  - find: dynamics
"""
SPONG, CRAIG = "a_i alpha_i d_i theta_i", "alpha_i a_i d_i theta_i"
BOOKS = {  # the pose, the inertia matrix and an entry, gravity, the columns of link parameters
    "spong": (r"T_2^0 = T_1^0 T_2^1", "D = D_1 + D_2", r"\partial d_{11}", "g_1 =", SPONG),
    "siciliano": (r"T_2^0 = T_1^0 T_2^1", "B = B_1 + B_2", r"\partial b_{11}", "g_1 =", SPONG),
    "craig": (
        r"{}^0_2 T = {}^0_1 T {}^1_2 T", "M = M_1 + M_2", r"\partial m_{11}", "G_1 =", CRAIG,
    ),
    "lynch": (r"T_{02} = T_{01} T_{12}", "M = M_1 + M_2", r"\partial m_{11}", "g_1 =", CRAIG),
}  # fmt: skip
ROTATIONS = {"craig": "{}^0_i R", "lynch": "R_{0i}"}


def page(tmp_path: Path, notation: str, mass: str = "m_2") -> str:
    sheet = tmp_path / "letters.yaml"
    sheet.write_text(SHEET.replace("{NOTATION}", notation).replace("MASS", mass))
    warnings: list[SheetError] = []
    (text,) = build([sheet], ["md"], None, warn=warnings.append)
    assert isinstance(text, str)
    return text + "".join(each.message for each in warnings)


@pytest.mark.parametrize("book", BOOKS)
def test_a_book(book: str, tmp_path: Path) -> None:
    pose, inertia, entry, gravity, columns = BOOKS[book]
    text = page(tmp_path, f"{{style: {book}}}")
    heading = next(line for line in text.splitlines() if line.startswith("|") and "theta_i" in line)
    assert [cell.strip(" $\\") for cell in heading.split("|")[2:6]] == columns.split()
    assert all(part in text for part in (pose, inertia, entry, gravity))
    assert f"the rotation ${ROTATIONS.get(book, 'R_i^0')}$ maps" in text  # typed in the words


def test_a_letter_that_means_something_else_stays(tmp_path: Path) -> None:
    assert "D = D_1 + D_2" in page(tmp_path, "{style: craig}", "M")
    assert "B = B_1 + B_2" in page(tmp_path, "{style: craig, names: {D: B}}", "M")


def test_letters_of_the_author(tmp_path: Path) -> None:
    text = page(tmp_path, "{names: {T: H, tau: Q, P: U}}")
    assert "H_2^0 = H_1^0 H_2^1" in text and "T_2^0" not in text
    assert r"g_k = Q_k" in text and r"where $Q_k$ is the torque" in text and r"\tau" not in text
    assert "U &= U_1 + U_2" in text and "derivatives of $U$" in text


def test_what_cannot_be_is_a_fault(tmp_path: Path) -> None:
    with pytest.raises(SheetErrors) as found:
        page(tmp_path, "{names: {D: M}}", "M")
    assert found.value.errors[0].message == "D would be printed as M, which means something else here"
    assert "no answer of this sheet has a letter Z" in page(tmp_path, "{names: {Z: H}}")
    for wrong in ("{names: {D: M_1}}", "{style: asada}", "{angles: grad}"):
        with pytest.raises(SheetErrors):
            page(tmp_path, wrong)


def test_long_is_meant(tmp_path: Path) -> None:
    sheet = tmp_path / "long.yaml"
    sheet.write_text(
        "title: Long\nnotation: {trig: long}\nproblems:\n"
        "- motion: [{rotate: z, by: theta_1}]\n  find: euler-angles\n"
    )
    (text,) = build([sheet], ["md"], None)
    assert "c_" not in str(text) and "s_" not in str(text)


@pytest.mark.parametrize(
    ("name", "printed"),
    [("D", "M"), ("D_1", "M_1"), ("d_12", "m_12"), ("d_1", "d_1"), ("D_dot", "M_dot"), ("g_0", "g_0"),
     ("g_1", "G_1"), ("T_1^0", "T_01"), ("T_12^10", "T_10_12"), ("R^T", "R^T"), ("own", "own")],
)  # fmt: skip
def test_names(name: str, printed: str) -> None:
    assert Lettering((("D", "M"), ("g", "G")), frozenset({"own"}), "below").called(name) == printed
    assert HOUSE.called(name) == name
