"""A chain of screws has the dynamics of the same arm given by rows."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.build import assemble
from derive.derivation import Derivation
from derive.errors import SheetErrors
from derive.sheet.load import load_sheet
from tests.kinds.published import same

BODY = "mass: m, inertia: [I_x, I_y, I_z]"
ROWS = f"""
    - {{theta: theta1*, d: 0, a: L, alpha: 0, com: [-L/2, 0, 0], {BODY}}}
    - {{theta: theta2*, d: 0, a: L, alpha: 0, com: [-L/2, 0, 0], {BODY}}}
"""
SCREWS = f"""
    - {{screw: {{axis: z}}, variable: theta1*, com: [L/2, 0, 0], {BODY}}}
    - {{screw: {{axis: z, through: [L, 0, 0]}}, variable: theta2*, com: [3*L/2, 0, 0], {BODY}}}
    home: [{{translate: x, by: 2*L}}]
"""
HELIX = f"""
    - {{screw: {{axis: z, pitch: h}}, variable: theta1*, com: [L/2, 0, 0], {BODY}}}
"""


def asked(folder: Path, links: str, *questions: str) -> list[Derivation]:
    sheet = folder / "arm.yaml"
    text = (
        f"title: t\nproblems:\n- robot:\n    gravity: [0, -g, 0]\n    links:{links.rstrip()}\n  questions:\n"
    )
    sheet.write_text(
        text + "".join(f"  - {{find: {question}}}\n" for question in questions), encoding="utf-8"
    )
    return [q.derivation for _, q in assemble(load_sheet(sheet)).questions() if q.derivation]


def test_the_same_dynamics(tmp_path: Path) -> None:
    rows = asked(tmp_path, ROWS, "inertia-matrix", "gravity", "dynamics")
    screws = asked(tmp_path, SCREWS, "inertia-matrix", "gravity", "dynamics")
    for name, k in (("D", 0), ("g", 1), ("tau", 2)):
        assert same(rows[k].results[name], screws[k].results[name]), name


def test_a_helix_has_kinematics_only(tmp_path: Path) -> None:
    (found,) = asked(tmp_path, HELIX, "jacobian")
    assert all(claim.holds for claim in found.claims)
    with pytest.raises(SheetErrors) as caught:
        asked(tmp_path, HELIX, "inertia-matrix")
    assert "helical" in caught.value.errors[0].message


def test_a_screw_has_no_center(tmp_path: Path) -> None:
    with pytest.raises(SheetErrors) as caught:
        asked(tmp_path, SCREWS.replace("com: [L/2, 0, 0]", "com: center"), "inertia-matrix")
    assert "no center" in caught.value.errors[0].message
