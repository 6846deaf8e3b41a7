"""`figure: true`: what is drawn stands where the forward kinematics puts it, and everything is named."""

from __future__ import annotations

from itertools import pairwise
from math import dist
from pathlib import Path

import pytest

from derive.build import assemble, build
from derive.derivation import Drawing, Phrase
from derive.errors import SheetErrors
from derive.expression import Symbol
from derive.kinds.figures import DRAWN, figure_of
from derive.kinds.problem import Problem
from derive.render.figures import draw
from derive.sheet.load import load_sheet

ROBOTS = Path(__file__).parents[2] / "exercises" / "robots"
EVERY = sorted(path.stem for path in ROBOTS.glob("*.yaml"))
PLANAR = """\
robot:
    links:
    - {theta: theta1*, d: 0, a: a1, alpha: 0}
    - {theta: theta2*, d: 0, a: 0.5 m, alpha: 0}"""
MOTOR = "motor: {control: armature, output: angle}"
FRAMES = """\
frames:
  - {x: -x0, y: -z0, z: -y0, origin: [0, c + e, a - d]}
  - {x: z1, y: -x1, z: -y1, origin: [b, a - d, 0]}"""
MOTION = "motion: [{rotate: x, by: alpha, about: world}, {translate: z, by: b}]"


def drawn(tmp_path: Path, subject: str, top: str = "") -> Drawing:
    kinds = {"robot": "dh-table", "motor": "transfer-function", "frames": "transforms", "motion": "transform"}
    kind = kinds[subject.partition(":")[0]]
    sheet = tmp_path / "sheet.yaml"
    sheet.write_text(f"title: x\n{top}\nproblems:\n- {subject}\n  find: {kind}\n", encoding="utf-8")
    (problem,) = load_sheet(sheet).problems
    return figure_of(Problem(problem.subject_name, problem.subject, problem.where))


def written(drawing: Drawing, role: str) -> list[str]:
    return [
        str(c.text.name if isinstance(c.text, Symbol) else c.text) for c in drawing.captions if c.role == role
    ]


def test_a_planar_arm_lies_in_the_paper(tmp_path: Path) -> None:
    found = drawn(tmp_path, PLANAR)
    links = [stroke.places for stroke in found.strokes if stroke.role == "link"]
    lengths = [dist(*places) for places in links]
    assert lengths == pytest.approx([0.5, 0.5])  # a symbol is drawn as long as the lengths that are known
    assert links[0][1] == pytest.approx(links[1][0])
    assert written(found, "angle") == ["theta1", "theta2"]
    assert {"x0", "x1", "x2", "y0"} <= {*written(found, "x"), *written(found, "y")}
    assert not written(found, "z")


@pytest.mark.parametrize("name", EVERY)
def test_every_robot_can_be_drawn(tmp_path: Path, name: str) -> None:
    robot = (ROBOTS / f"{name}.yaml").read_text(encoding="utf-8")
    indented = "\n".join(f"    {line}" for line in robot.splitlines() if not line.startswith("#"))
    top = "where: {L_c: L/2}" if "L_c" in robot else ""
    found = drawn(tmp_path, f"robot:\n{indented}", top)
    joints = len(load_sheet(tmp_path / "sheet.yaml").problems[0].subject.variables)
    assert len([stroke for stroke in found.strokes if stroke.role in ("cap", "pin")]) >= joints
    named = [*written(found, "joint"), *written(found, "angle"), *written(found, "length")]
    assert sum(name[0] in "tdq" for name in named if isinstance(name, str)) >= joints - 1
    for stroke in found.strokes:
        assert all(abs(c) < 1e3 for place in stroke.places for c in place)


@pytest.mark.parametrize("name", ["stanford", "puma560", "anthropomorphic", "cylindrical", "scara"])
def test_links_of_an_arm_in_space_are_seen(tmp_path: Path, name: str) -> None:
    """No link is looked at end on."""
    robot = (ROBOTS / f"{name}.yaml").read_text(encoding="utf-8")
    indented = "\n".join(f"    {line}" for line in robot.splitlines() if not line.startswith("#"))
    found = drawn(tmp_path, f"robot:\n{indented}")
    whole = max(dist(a, b) for s in found.strokes for t in found.strokes for a in s.places for b in t.places)
    for stroke in found.strokes:
        if stroke.role in ("link", "rod"):
            assert sum(dist(a, b) for a, b in pairwise(stroke.places)) > 0.02 * whole


def test_triads_of_frames(tmp_path: Path) -> None:
    found = drawn(tmp_path, FRAMES)
    names = {*written(found, "x"), *written(found, "y"), *written(found, "z")}
    assert names == {f"{letter}{k}" for letter in "xyz" for k in range(3)}
    assert len([stroke for stroke in found.strokes if stroke.role == "way"]) == 2


def test_a_motion_is_drawn_step_by_step(tmp_path: Path) -> None:
    found = drawn(tmp_path, MOTION)
    named = {*written(found, "x"), *written(found, "y"), *written(found, "z")}
    on_the_axis = str(("x0", "x1"))  # about which it turns
    assert named == {on_the_axis, "y1", "z1", "x2", "y2", "z2"}
    assert [c.text.key for c in found.captions if isinstance(c.text, Phrase)] == ["rotate", "translate"]


def test_a_motor_is_a_block_diagram(tmp_path: Path) -> None:
    found = drawn(tmp_path, MOTOR)
    assert {"V_a", "I_a", "T_m", "T_d", "theta", "theta_dot", "V_b"} <= set(written(found, "signal"))
    assert written(found, "sign") == ["+", "+", "-", "-"]
    assert len([stroke for stroke in found.strokes if stroke.role == "box"]) == 7
    assert len(written(found, "block")) == 5


def test_the_picture_stands_on_the_page(tmp_path: Path) -> None:
    sheet = tmp_path / "arm.yaml"
    text = f"title: x\nproblems:\n- {PLANAR}\n  figure: true\n  find: dh-table\n"
    sheet.write_text(text, encoding="utf-8")
    build([sheet], ["md", "tex"], tmp_path / "out")
    assert "](arm/problem-1-figure.svg)\n\n*Figure 1: The arm" in (tmp_path / "out" / "arm.md").read_text(
        encoding="utf-8"
    )
    assert "arm/problem-1-figure.pdf" in (tmp_path / "out" / "arm.tex").read_text(encoding="utf-8")
    picture = (tmp_path / "out" / "arm" / "problem-1-figure.svg").read_text(encoding="utf-8")
    assert "<svg" in picture and "<text" not in picture  # letters are outlines
    assert (tmp_path / "out" / "arm" / "problem-1-figure.pdf").stat().st_size > 1000


def test_the_same_bytes_each_time(tmp_path: Path) -> None:
    found = drawn(tmp_path, FRAMES)
    (first,) = draw(found, tmp_path / "a", ("svg",))
    (second,) = draw(found, tmp_path / "b", ("svg",))
    assert first.read_bytes() == second.read_bytes()


def test_a_problem_sheet_has_it_too(tmp_path: Path) -> None:
    sheet = tmp_path / "arm.yaml"
    sheet.write_text(
        f"title: x\nproblems:\n- {MOTOR}\n  figure: true\n  find: transfer-function\n", encoding="utf-8"
    )
    document = assemble(load_sheet(sheet), solutions=False)
    assert list(document.plots()) == ["arm-problems/problem-1-figure"]


@pytest.mark.parametrize(
    ("subject", "kind"),
    [
        ("sensor: {encoder: absolute, bits: 8}", "resolution"),
        ("profile: {distance: 1, v_max: 1, a_max: 1}", "trapezoidal-profile"),
    ],
)
def test_what_is_not_drawn_is_said(tmp_path: Path, subject: str, kind: str) -> None:
    sheet = tmp_path / "sheet.yaml"
    sheet.write_text(f"title: x\nproblems:\n- {subject}\n  figure: true\n  find: {kind}\n", encoding="utf-8")
    with pytest.raises(SheetErrors) as caught:
        load_sheet(sheet)
    (said,) = caught.value.errors
    assert said.message.startswith("there is no drawing of a")
    assert said.place and said.place.line == 4
    assert all(name in said.hint for name in DRAWN)
