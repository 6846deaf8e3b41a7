"""Mistakes in what answers and claims could have in common, or on the way out of the house: the audit, which
has nothing in common with them, contradicts each. No claim is asked here, and no figure drawn, which is held
to its subject too: the audit is alone."""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

import derive.build
from derive.audit.engine import Audited, Contradicted, Outcome, audit
from derive.auditing import answers
from derive.derivation import Derivation
from derive.expression import ZERO, Expr, Number, Symbol, negate, rebuild
from derive.kinds.problem import Problem
from derive.mechanics import dh, dynamics, joint_loads, moments
from derive.mechanics.motion import Move
from derive.mechanics.robot import DHRow
from derive.sheet.load import load_sheet
from derive.sheet.model import Question
from derive.writing import render

ARM = """
title: An arm
problems:
- figure: false
  robot:
    links:
    - {theta: theta1*, d: d1, a: a1, alpha: 90 deg, mass: m1, com: [x1, y1, z1],
       inertia: {cylinder: {radius: r, length: h}, axis: y}, motor: {inertia: J_m, ratio: G}}
    - {theta: theta2*, d: d2, a: a2, alpha: 30 deg, mass: m2, com: center, inertia: {rod: a2, axis: x}}
    - {theta: 40 deg, d: d3*, a: 0, alpha: 0, mass: m3, com: [0, 0, x3], inertia: {box: [a, b, c]}}
  find: KIND
"""
MODIFIED = ARM.replace("  robot:\n", "  robot:\n    convention: modified\n").replace(
    "com: center", "com: [0, 0, 0]"
)
SPHERE = ARM.replace("{rod: a2, axis: x}", "{sphere: r}").replace("{box: [a, b, c]}", "point")
STANDARD, MOMENTS = dh.standard, moments.given_moments


@pytest.fixture(autouse=True)
def no_claims(monkeypatch: pytest.MonkeyPatch) -> None:
    def unasked(question: Question, working: Problem) -> Derivation:
        return working.answer(question.find, question.options)

    monkeypatch.setattr(derive.build, "answered", unasked)


@pytest.fixture
def audited(tmp_path: Path) -> Callable[..., Outcome]:
    """What the audit says of a question."""

    def outcome(kind: str, text: str = ARM) -> Outcome:
        path = tmp_path / "arm.yaml"
        path.write_text(text.replace("KIND", kind), encoding="utf-8")
        sheet = load_sheet(path)
        ((_, asked),) = answers(sheet, render(derive.build.assemble(sheet), "json"))
        return audit(asked)

    return outcome


def everywhere(right: Any, planted: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """A function of ours in every module that has taken it."""
    for module in [module for name, module in sys.modules.items() if name.startswith("derive.")]:
        for name, value in list(vars(module).items()):
            if value is right:
                assert not module.__name__.startswith("derive.audit")
                monkeypatch.setattr(module, name, planted)


def turned(k: int, **fields: Any) -> Callable[[DHRow], tuple[Move, ...]]:
    """The standard convention with one of its four motions otherwise."""

    def planted(row: DHRow) -> tuple[Move, ...]:
        made = list(STANDARD(row))
        made[k] = replace(made[k], **{name: change(made[k]) for name, change in fields.items()})
        return tuple(made)

    return planted


@pytest.mark.parametrize("kind", ["forward-kinematics", "joint-axes", "jacobian", "dynamics"])
@pytest.mark.parametrize(
    "planted",
    [
        turned(3, axis=lambda move: "y"),
        turned(1, by=lambda move: negate(move.by)),
        turned(2, axis=lambda move: "y"),
        turned(0, by=lambda move: negate(move.by)),
    ],
)
def test_another_standard_convention(
    kind: str, planted: Any, audited: Callable[..., Outcome], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(dh.CONVENTIONS, "standard", planted)
    assert isinstance(audited(kind), Contradicted)


def test_another_modified_convention(
    audited: Callable[..., Outcome], monkeypatch: pytest.MonkeyPatch
) -> None:
    assert isinstance(audited("forward-kinematics", MODIFIED), Audited)
    monkeypatch.setitem(dh.CONVENTIONS, "modified", STANDARD)
    assert isinstance(audited("forward-kinematics", MODIFIED), Contradicted)


def thirds(body: Any) -> Any:
    """The moments about the end for those about the middle, two thirds for two fifths."""

    def wrong(tree: Expr) -> Expr:
        others = {Fraction(1, 12): Fraction(1, 3), Fraction(2, 5): Fraction(2, 3)}
        if isinstance(tree, Number) and tree.value in others:
            return Number(others[tree.value])
        return rebuild(tree, wrong)

    return tuple(map(wrong, MOMENTS(body)))


def once(motor: Any) -> Expr:
    """G J for G^2 J."""
    return ZERO if motor is None else motor.ratio * motor.inertia


def upwards(robot: Any) -> tuple[Expr, Expr, Expr]:
    return ZERO, ZERO, Symbol("g")


@pytest.mark.parametrize(
    ("kind", "text", "right", "planted"),
    [
        ("inertia-matrix", ARM, MOMENTS, thirds),
        ("inertia-matrix", SPHERE, MOMENTS, thirds),
        ("energy", ARM, MOMENTS, thirds),
        ("inertia-matrix", ARM, joint_loads.reflected, once),
        ("energy", ARM, joint_loads.reflected, once),
        ("gravity", ARM, dynamics.gravity_of, upwards),
        ("dynamics", ARM, dynamics.gravity_of, upwards),
    ],
)
def test_wrong_dynamics(
    kind: str,
    text: str,
    right: Any,
    planted: Any,
    audited: Callable[..., Outcome],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    assert isinstance(audited(kind, text), Audited)  # and every module is loaded
    everywhere(right, planted, monkeypatch)
    assert isinstance(audited(kind, text), Contradicted)
