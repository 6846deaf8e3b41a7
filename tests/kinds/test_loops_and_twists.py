"""Frames given twice, and twists in another frame: Lynch and Park, Modern Robotics, example 3.23."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from derive.algebra.numbers.floats import numbers
from derive.build import assemble, build
from derive.derivation import Derivation
from derive.errors import SheetErrors
from derive.expression import number
from derive.kinds.problem import Problem
from derive.mechanics.frames import ByMatrix, Frame, Frames
from derive.sheet.load import load_sheet
from tests.kinds.published import matrix, same

# The mixed forms: by observation, by a motion, by a matrix, and again by observation.
CLOSED = """
  - {x: y0, y: -x0, z: z0, origin: [a, 0, 0]}
  - {motion: [{translate: x, by: b}, {rotate: z, by: 90 deg}]}
  - {matrix: [[1, 0, 0, c], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]], in: 1}
  - {frame: 2, in: 0, x: -x0, y: -y0, z: z0, origin: [a, b, 0]}
  - {frame: 3, in: 2, x: -y2, y: z2, z: -x2, origin: [0, b - c, 0]}
"""
OPEN = CLOSED.replace("origin: [a, b, 0]", "origin: [a, b, h]")


def sheet(folder: Path, frames: str, question: str) -> Path:
    path = folder / "loop.yaml"
    path.write_text(f"title: t\nproblems:\n- frames:{frames}  find: {question}\n", encoding="utf-8")
    return path


def asked(folder: Path, frames: str, question: str) -> Derivation:
    ((_, found),) = assemble(load_sheet(sheet(folder, frames, question))).questions()
    assert found.derivation
    assert all(claim.holds for claim in found.derivation.claims)
    return found.derivation


def test_a_loop_that_closes(tmp_path: Path) -> None:
    found = asked(tmp_path, CLOSED, "loop")
    identity = matrix("1,0,0,0\n0,1,0,0\n0,0,1,0\n0,0,0,1")
    assert found.results["closes"] == "yes, yes"
    assert same(found.results["E_1"], identity) and same(found.results["E_2"], identity)


def test_other_questions_can_be_asked_of_it(tmp_path: Path) -> None:
    found = asked(tmp_path, CLOSED, "transforms")
    assert list(found.results) == ["T_1^0", "T_2^1", "T_3^1", "T_3^0"]


def test_a_loop_that_does_not_close(tmp_path: Path) -> None:
    found = asked(tmp_path, OPEN, "loop")
    assert found.results["closes"] == "no, yes"
    assert same(found.results["E_1"], matrix("1,0,0,0\n0,1,0,0\n0,0,1,h\n0,0,0,1"))
    (page,) = build([sheet(tmp_path, OPEN, "loop")], ["md"], None)
    assert "does not close" in page and "the origins differ" in page


@pytest.mark.parametrize(
    "question", ["transforms", "transform", "inverse", "change-of-frame, point: [1, 0, 0]"]
)
def test_nothing_else_is_derived_from_a_contradiction(tmp_path: Path, question: str) -> None:
    question = question if "," not in question else "change-of-frame\n  point: [1, 0, 0]"
    with pytest.raises(SheetErrors) as caught:
        assemble(load_sheet(sheet(tmp_path, OPEN, question)))
    assert "frame 2 is given twice" in caught.value.errors[0].message


FAULTS = {
    "frame 1 is given again": "\n  - {x: x0, y: y0, z: z0}\n  - {frame: 1, x: x0, y: y0, z: z0}\n",
    "frame 3 is given before frame 2": "\n  - {x: x0, y: y0, z: z0}\n  - {frame: 3, x: x1, y: y1, z: z1}\n",
}


@pytest.mark.parametrize("fault", FAULTS)
def test_faults(tmp_path: Path, fault: str) -> None:
    with pytest.raises(SheetErrors) as caught:
        load_sheet(sheet(tmp_path, FAULTS[fault], "loop"))
    assert fault in caught.value.errors[0].message


def test_no_loop(tmp_path: Path) -> None:
    with pytest.raises(SheetErrors) as caught:
        assemble(load_sheet(sheet(tmp_path, "\n  - {x: x0, y: y0, z: z0}\n", "loop")))
    assert "no frame is given twice" in caught.value.errors[0].message


def twist(*parts: str) -> tuple:
    return tuple(map(number, parts))


def test_the_twist_of_a_car() -> None:
    """V_s = (0, 0, 2, -2, -4, 0) of V_b = (0, 0, -2, 2.8, 4, 0), the angular part first there."""
    T = matrix("-1,0,0,4\n0,1,0,2/5\n0,0,-1,0\n0,0,0,1")
    problem = Problem("frames", Frames((Frame(1, 0, ByMatrix(T)),)))
    found = problem.ask("change-of-frame", twist=twist("14/5", "4", "0", "0", "0", "-2"), source=1)
    assert numbers(found.results["V^0"], {}) == [-2, -4, 0, 0, 0, 2]
    assert all(claim.holds for claim in found.claims)
    back = problem.ask("change-of-frame", twist=twist("-2", "-4", "0", "0", "0", "2"), source=0, target=1)
    assert np.allclose(numbers(back.results["V^1"], {}), [2.8, 4, 0, 0, 0, -2])
