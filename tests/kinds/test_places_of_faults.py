"""What cannot be derived is told at the option that asks for it, and not at `find`."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.commands import run

ARM = "robot: {links: [{theta: q1*, d: 0, a: l, alpha: 0}, {theta: q2*, d: 0, a: m, alpha: 0}]}"
LOOP = "system: {equations: [Y = X/s, X = U], input: U, output: Y}"


@pytest.mark.parametrize(
    ("subject", "find", "option", "place"),
    [
        (ARM, "inverse-velocity", "rows: [vz, vx]", "5:3"),
        (ARM, "velocity", "point: {frame: 0}", "5:11"),
        (ARM, "velocity", "point: {link: 3}", "5:11"),
        (ARM, "euler-angles", "angles: [phi, phi, psi]", "5:3"),
        ("function: {variables: [x], value: [x, x^2]}", "jacobian", "determinant: true", "5:3"),
        (LOOP, "closed-loop", "controller: {P: X}", "5:3"),
        ("motion: [{rotate: z, by: a}]", "euler-angles", "from: 1", "5:3"),
    ],
)
def test_a_fault_stands_at_its_option(folder: Path, subject: str, find: str, option: str, place: str) -> None:
    sheet = f"title: a\nproblems:\n- {subject}\n  find: {find}\n  {option}\n"
    (folder / "wrong.yaml").write_text(sheet, encoding="utf-8")
    done = run("wrong.yaml", "--format", "json")
    assert done.exit_code == 1
    assert done.stderr.startswith(f"wrong.yaml:{place}: "), done.stderr
