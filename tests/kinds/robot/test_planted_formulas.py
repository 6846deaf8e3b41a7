"""Mistakes in the formulas of an arm that the lines of an answer rest on: a plain build refuses each.

A formula is put in the place of the right one wherever the answers use it. Nothing but the oracle, which has
formulas of its own, can notice.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from derive.build import derive_all
from derive.errors import SheetErrors
from derive.expression import Expr, Symbol, number
from derive.mechanics import dh, dynamics, joint_loads, moments
from derive.mechanics.motion import Move
from derive.mechanics.robot import DHRow, ScrewRow
from derive.sheet.load import load_sheet

ORACLE = "derive.mechanics.oracle"
SPATIAL = """
problems:
- robot:
    convention: {convention}
    links:
    - {{theta: theta1*, d: d1, a: a1, alpha: 30 deg}}
    - {{theta: 0, d: d2*, a: a2, alpha: -90 deg}}
    - {{theta: theta3*, d: d3, a: a3, alpha: beta}}
  find: {kind}
"""
HELIX = """
problems:
- robot:
    links:
    - {{screw: {{axis: z, through: [a, 0, 0], pitch: h}}, variable: theta1*}}
    - {{screw: {{axis: x, through: [0, b, 0]}}, variable: theta2*}}
    home: [{{translate: x, by: L}}]
  find: {kind}
"""
HEAVY = """
problems:
- robot:
    links:
    - {{theta: theta1*, d: d1, a: 0, alpha: 90 deg, mass: m1, com: [0, 0, -L], inertia: {inertia}{more}}}
    - {{theta: theta2*, d: 0, a: a2, alpha: 0, mass: m2, com: [-a2/3, 0, 0], inertia: {inertia}}}
  find: {kind}
"""
KINEMATICS = ("forward-kinematics", "joint-axes", "jacobian", "velocity")
DYNAMICS = ("inertia-matrix", "dynamics", "newton-euler")
SOLIDS = (
    "{rod: r, axis: x}",
    "{sphere: r}",
    "{box: [a, b, c]}",
    "{cylinder: {radius: r, length: h}, axis: y}",
)


def turn(axis: Any, by: Expr) -> Move:
    return Move("rotate", axis, by)


def shift(axis: Any, by: Expr) -> Move:
    return Move("translate", axis, by)


def row(*order: str, **axes: str) -> Callable[[DHRow], tuple[Move, ...]]:
    """A row of these moves, where a parameter is by another axis than it should be, or has the wrong sign."""
    right = {"theta": "z", "d": "z", "a": "x", "alpha": "x"}

    def moves(given: DHRow) -> tuple[Move, ...]:
        made = []
        for name in order:
            axis, by = axes.get(name, right[name]), getattr(given, name)
            by = -by if axis.startswith("-") else by
            made.append((turn if name in ("theta", "alpha") else shift)(axis.removeprefix("-"), by))
        return tuple(made)

    return moves


STANDARD, MODIFIED = ("theta", "d", "a", "alpha"), ("alpha", "a", "theta", "d")
ROWS = {
    "twist about y": ("standard", row(*STANDARD, alpha="y")),
    "d with the wrong sign": ("standard", row(*STANDARD, d="-z")),
    "a along y": ("standard", row(*STANDARD, a="y")),
    "a with the wrong sign": ("standard", row(*STANDARD, a="-x")),
    "theta with the wrong sign": ("standard", row(*STANDARD, theta="-z")),
    "twist first": ("standard", row(*MODIFIED)),
    "modified, twist last": ("modified", row(*STANDARD)),
    "modified, twist with the wrong sign": ("modified", row(*MODIFIED, alpha="-x")),
    "modified, d with the wrong sign": ("modified", row(*MODIFIED, d="-z")),
    "modified, a along y": ("modified", row(*MODIFIED, a="y")),
}


def build(text: str, folder: Path) -> None:
    path = folder / "sheet.yaml"
    path.write_text("title: An arm\n" + text, encoding="utf-8")
    derive_all([load_sheet(path)], True, lambda _: None, lambda _: None)


def plant(patch: pytest.MonkeyPatch, right: Callable[..., Any], wrong: Callable[..., Any]) -> None:
    """The wrong function wherever the right one is used by its name, but in the oracle."""
    for name, module in sys.modules.copy().items():
        if name.startswith("derive.") and not name.startswith(ORACLE):
            for key, value in vars(module).copy().items():
                if value is right:
                    patch.setattr(module, key, wrong)


@pytest.mark.parametrize("kind", KINEMATICS)
@pytest.mark.parametrize("mistake", ROWS)
def test_a_row_is_the_matrix_of_the_books(
    mistake: str, kind: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    convention, wrong = ROWS[mistake]
    sheet = SPATIAL.format(convention=convention, kind=kind)
    build(sheet, tmp_path)
    monkeypatch.setitem(dh.CONVENTIONS, convention, wrong)
    with pytest.raises(SheetErrors):
        build(sheet, tmp_path)


@pytest.mark.parametrize("kind", ["forward-kinematics", "jacobian", "space-jacobian"])
def test_a_pitch_goes_with_the_turn(kind: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    sheet, right = HELIX.format(kind=kind), dh.screw

    def backwards(given: ScrewRow) -> tuple[Move, ...]:
        return right(ScrewRow(given.axis, given.through, given.by, -given.pitch, given.slide))

    build(sheet, tmp_path)
    plant(monkeypatch, right, backwards)
    with pytest.raises(SheetErrors):
        build(sheet, tmp_path)


@pytest.mark.parametrize("kind", DYNAMICS)
@pytest.mark.parametrize("solid", SOLIDS)
@pytest.mark.parametrize("wrong", ["1/3", "2/3", "1/6"])
def test_moments_are_those_of_the_solid(
    wrong: str, solid: str, kind: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    sheet, right = HEAVY.format(inertia=solid, more="", kind=kind), moments._times

    def times(fraction: str, *factors: Expr) -> Expr:
        return right(wrong if "/" in fraction else fraction, *factors)

    build(sheet, tmp_path)
    monkeypatch.setattr(moments, "_times", times)
    with pytest.raises(SheetErrors):
        build(sheet, tmp_path)


@pytest.mark.parametrize("kind", DYNAMICS)
def test_parallel_axes(kind: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    sheet, right = HEAVY.format(inertia="[I, 2*I, 3*I], about: origin", more="", kind=kind), moments.steiner
    build(sheet, tmp_path)
    plant(monkeypatch, right, lambda body: tuple(-part for part in right(body)))
    with pytest.raises(SheetErrors):
        build(sheet, tmp_path)


@pytest.mark.parametrize("kind", DYNAMICS)
def test_a_rotor_is_felt_by_the_square_of_the_ratio(
    kind: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    sheet = HEAVY.format(inertia="point", more=", motor: {inertia: J, ratio: G}", kind=kind)
    build(sheet, tmp_path)
    monkeypatch.setattr(joint_loads, "_square", lambda ratio: ratio)
    with pytest.raises(SheetErrors):
        build(sheet, tmp_path)


@pytest.mark.parametrize("kind", ["gravity", "dynamics", "newton-euler", "energy"])
def test_things_fall_down(kind: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    sheet = HEAVY.format(inertia="point", more="", kind=kind)
    build(sheet, tmp_path)
    zero = number("0")
    plant(monkeypatch, dynamics.gravity_of, lambda robot: robot.gravity or (zero, zero, Symbol("g")))
    with pytest.raises(SheetErrors):
        build(sheet, tmp_path)


@pytest.mark.parametrize("kind", ["dynamics", "newton-euler", "forward-dynamics", "regressor"])
@pytest.mark.parametrize("sort", ["viscous: b", "coulomb: c"])
def test_friction_is_against_the_motion(
    sort: str, kind: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    sheet = HEAVY.format(inertia="{sphere: r}", more=f", friction: {{{sort}}}", kind=kind)
    right = joint_loads.resistance
    build(sheet, tmp_path)
    plant(monkeypatch, right, lambda *of: tuple(-term for term in right(*of)))
    with pytest.raises(SheetErrors):
        build(sheet, tmp_path)
