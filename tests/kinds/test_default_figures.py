"""Figures where nothing is said of one: which are drawn, once a sheet, numbered, called by what they show."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from derive.build import assemble, build
from derive.errors import SheetErrors
from derive.figures import arm_sketch
from derive.figures.arm import Joint, Part, Posed
from derive.figures.view import View
from derive.render.page import render_markdown
from derive.sheet.load import load_sheet

ARM = "robot: {links: [{theta: theta1*, d: 0, a: a1, alpha: 0}, {theta: theta2*, d: 0, a: a2, alpha: 0}]}"
SHEET = f"""\
title: x
problems:
- motion: [{{rotate: z, by: 30 deg, about: world}}, {{translate: x, by: b}}]
  find: transform
- {ARM}
  questions:
  - {{find: forward-kinematics}}
  - {{find: inverse-kinematics}}
- {ARM}
  find: jacobian
"""


def sheet(folder: Path, text: str) -> Path:
    path = folder / "sheet.yaml"
    path.write_text(text, encoding="utf-8")
    return path


def page(path: Path, solutions: bool = True) -> str:
    return render_markdown(assemble(load_sheet(path), solutions))


def test_numbers_go_through_the_sheet_and_an_arm_is_drawn_once(tmp_path: Path) -> None:
    written = page(sheet(tmp_path, SHEET))
    captions = [line for line in written.splitlines() if line.startswith("*Figure")]
    assert [caption.split(":")[0] for caption in captions] == ["*Figure 1", "*Figure 2", "*Figure 3"]
    assert "The arm is drawn in Figure 2." in written
    assert "![The frame after each of the steps: 30 deg about z0 and b along x1.](sheet/" in written


def test_what_a_motion_does_is_not_on_the_problem_sheet(tmp_path: Path) -> None:
    written = page(sheet(tmp_path, SHEET), solutions=False)
    assert "problem-1-figure" not in written and "*Figure 1: The arm" in written


def test_no_figures_leaves_out_what_was_not_asked_for(tmp_path: Path) -> None:
    asked = SHEET.replace("  find: jacobian", "  find: jacobian\n  figure: true")
    build([sheet(tmp_path, asked)], ["md"], tmp_path, figures=False)
    names = sorted(path.name for path in (tmp_path / "sheet").iterdir())
    assert names == ["problem-2-2-elbows.svg", "problem-3-figure.svg"]


def test_an_arm_is_drawn_where_its_author_wants_it(tmp_path: Path) -> None:
    arm = ARM.replace("alpha: 0}", "alpha: 90 deg}", 1)
    text = f"title: x\nproblems:\n- {arm}\n  figure: {{at: {{theta2: -30 deg}}}}\n  find: jacobian\n"
    assert "at $\\theta_2 = -30^\\circ$" in page(sheet(tmp_path, text)).replace("with $", "at $")


def test_a_slip_in_what_is_drawn_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    spread = arm_sketch._apart

    def slipped(posed: Posed, size: float, view: View) -> tuple[tuple[Joint, ...], tuple[Part, ...]]:
        joints, stubs = spread(posed, size, view)
        moved = replace(joints[1], at=(joints[1].at[0] + 0.01, *joints[1].at[1:]))
        return (joints[0], moved), stubs

    monkeypatch.setattr(arm_sketch, "_apart", slipped)
    with pytest.raises(SheetErrors) as caught:
        assemble(load_sheet(sheet(tmp_path, SHEET)))
    assert "the joint of theta2 is drawn off its axis" in caught.value.errors[0].message


def test_centers_of_mass_and_points_asked_about_are_marked() -> None:
    exercises = Path(__file__).parents[2] / "exercises"
    for name, number, marks in (("week6", 1, {"o_c1", "o_c2"}), ("week4", 2, {"o_c"})):
        drawing = assemble(load_sheet(exercises / f"{name}.yaml")).problems[number - 1].drawing
        assert drawing and marks <= {getattr(caption.text, "name", "") for caption in drawing.captions}


BODY = """\
title: x
problems:
- frames: [{x: x0, y: y0, z: z0, origin: [a, b, 0]}]
  figure: {body: {corners: {p: [a, 0, 0], q: [0, b, 0], r: [0, 0, c], s: [a, b, c]},
    faces: [[o0, p, o1, q], FACE], lengths: [[o0, p, LENGTH]], angles: [[p, o0, r, ANGLE]]}}
  find: transforms
"""


@pytest.mark.parametrize(
    ("face", "length", "angle", "said"),
    [
        ("[o0, p, r]", "b", "90 deg", "the edge from o0 to p is not as long as is said"),
        ("[o0, p, q, s]", "a", "90 deg", "the face o0, p, q, s is not flat"),
        ("[o0, p, r]", "a", "80 deg", "the angle at o0 is not as large as is said"),
        ("[o0, p, nowhere]", "a", "90 deg", "there is no corner nowhere"),
    ],
)
def test_a_body_that_cannot_be_is_a_fault(
    tmp_path: Path, face: str, length: str, angle: str, said: str
) -> None:
    with pytest.raises(SheetErrors) as caught:
        assemble(
            load_sheet(
                sheet(tmp_path, BODY.replace("FACE", face).replace("LENGTH", length).replace("ANGLE", angle))
            )
        )
    assert said in caught.value.errors[0].message


def test_a_robot_stands_on_no_body(tmp_path: Path) -> None:
    text = f"title: x\nproblems:\n- {ARM}\n  figure: {{body: {{faces: [[o0, p, q]]}}}}\n  find: jacobian\n"
    with pytest.raises(SheetErrors) as caught:
        load_sheet(sheet(tmp_path, text))
    assert "a robot stands on no body" in caught.value.errors[0].message
