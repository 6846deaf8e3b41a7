"""No label of a figure lies on another or on a line: arms of the catalogue and by lot, frames, motions."""

from __future__ import annotations

import random
from itertools import combinations
from pathlib import Path

import pytest

from derive.derivation import Drawing
from derive.kinds.figures import figure_of
from derive.kinds.problem import Problem
from derive.render.document import FIGURE
from derive.render.drawing.placing import Lines
from derive.render.drawing.style import AREAS, TEXT_HIGH, TEXT_WIDE
from derive.render.drawing.subjects import Laid, laid_out
from derive.render.notation import Notation
from derive.render.phrases import in_figure
from derive.sheet.load import load_sheet

EXERCISES = Path(__file__).parents[2] / "exercises"
ARMS = sorted(path.stem for path in (EXERCISES / "robots").glob("*.yaml"))
LIGHT = 0.4  # points that a line may be wide beyond what is drawn


def laid(sheet: Path) -> list[tuple[Drawing, Laid]]:
    found = []
    for given in load_sheet(sheet).problems:
        wish = given.figure if not isinstance(given.figure, bool | Path | None) else None
        problem = Problem(given.subject_name, given.subject, given.where)
        drawing = figure_of(problem, wish) if wish else figure_of(problem)
        said = in_figure(given.subject_name, FIGURE, Notation()).figure(drawing)
        assert isinstance(said, Drawing)
        found.append((said, laid_out(said)))
    return found


def faults(drawing: Drawing, found: Laid) -> list[str]:
    """Labels upon labels and upon lines, and what is larger than a page allows."""
    texts = [str(caption.text) for caption in drawing.captions]
    boxes = [box.grown(-0.05) for box in found.boxes]
    wrong = [
        f"{a} on {b}" for (a, p), (b, q) in combinations(zip(texts, boxes, strict=True), 2) if p.meets(q)
    ]
    lines = Lines()
    for stroke in drawing.strokes:
        places = [(x * found.scale, y * found.scale) for x, y in stroke.places]
        lines.add((*places, places[0]) if stroke.role in AREAS else places, LIGHT)
    wrong += [f"{text} on a line" for text, box in zip(texts, boxes, strict=True) if lines.cross(box)]
    wide, high = found.whole.right - found.whole.left, found.whole.high - found.whole.low
    return wrong + ["too large"] * (wide > 0.8 * TEXT_WIDE or high > 0.42 * TEXT_HIGH)


@pytest.mark.parametrize("name", ARMS)
def test_arms_of_the_catalogue(tmp_path: Path, name: str) -> None:
    robot = (EXERCISES / "robots" / f"{name}.yaml").read_text(encoding="utf-8")
    (tmp_path / "arm.yaml").write_text(robot, encoding="utf-8")
    sheet = tmp_path / "sheet.yaml"
    top = "where: {L_c: L/2}\n" if "L_c" in robot else ""
    sheet.write_text(
        f"title: x\n{top}problems:\n- robot: arm.yaml\n  find: forward-kinematics\n", encoding="utf-8"
    )
    assert [faults(*each) for each in laid(sheet)] == [[]]


def row(draw: random.Random, joint: int) -> str:
    slides = draw.random() < 0.2
    d = f"d{joint}*" if slides else draw.choice(("0", "0", f"d{joint}", "0.088 m", "0.3 m"))
    a = "0" if slides else draw.choice(("0", f"a{joint}", "0.0825 m", "0.45 m", "1 m"))
    theta = draw.choice(("0", "90 deg")) if slides else f"theta{joint}*"
    return f"    - {{theta: {theta}, d: {d}, a: {a}, alpha: {draw.choice((0, 90, -90, 90, -90, 180))} deg}}"


@pytest.mark.parametrize("seed", range(30))
def test_arms_drawn_by_lot(tmp_path: Path, seed: int) -> None:
    draw = random.Random(seed)
    rows = "\n".join(row(draw, joint) for joint in range(1, draw.randint(2, 7) + 1))
    sheet = tmp_path / "sheet.yaml"
    sheet.write_text(
        f"title: x\nproblems:\n- robot:\n    links:\n{rows}\n  find: forward-kinematics\n", encoding="utf-8"
    )
    assert [faults(*each) for each in laid(sheet)] == [[]], rows


def test_frames_and_motions_of_week_2() -> None:
    assert [faults(*each) for each in laid(EXERCISES / "week2.yaml")] == [[]] * 6


MASSES = """\
title: x
problems:
- lagrange:
    coordinates: [x, theta1, theta2]
    bodies:
    - {mass: M, position: [x, 0]}
    - {mass: m1, position: [x + l1*sin(theta1), -l1*cos(theta1)]}
    - mass: m2
      position: [x + l1*sin(theta1) + l2*sin(theta1 + theta2), -l1*cos(theta1) - l2*cos(theta1 + theta2)]
    forces: {x: F}
  find: equations-of-motion
- lagrange:
    coordinates: [s, phi]
    bodies: [{mass: m, position: [s*cos(alpha), -s*sin(alpha)], inertia: m*r^2/2, angle: phi}]
    constraints: s = r*phi
  find: equations-of-motion
- mechanism: {space: spatial, legs: [{chain: UPS, count: 6}]}
  find: mobility
- lagrange:
    coordinates: [theta, phi]
    bodies: [{mass: m, position: [l*sin(theta)*cos(phi), l*sin(theta)*sin(phi), -l*cos(theta)]}]
  find: equations-of-motion
"""


def test_masses_on_rods_a_wheel_and_a_platform_on_legs(tmp_path: Path) -> None:
    sheet = tmp_path / "sheet.yaml"
    sheet.write_text(MASSES, encoding="utf-8")
    plane, wheel, legs, space = laid(sheet)
    assert [faults(*each) for each in (plane, wheel, legs, space)] == [[]] * 4
    names = [
        {str(getattr(c.text, "name", c.text)) for c in drawing.captions} for drawing, _ in (plane, space)
    ]
    assert names[0] >= {"M", "m1", "m2", "l1", "l2", "theta1", "theta2", "F", "g"}
    assert names[1] >= {"m", "l", "theta", "phi", "g"}
