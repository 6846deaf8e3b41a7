"""Mistakes in what the words say of an arm, planted where it is chosen: each is refused."""

from __future__ import annotations

from dataclasses import replace

import pytest

from derive.derivation import Derivation, Step
from derive.expression import ONE, Symbol
from derive.kinds.links import in_its_instance
from derive.kinds.robot._rows import dh_told
from derive.kinds.robot._rows.exponential_law import exponential_law
from derive.kinds.robot._turning import turning_law
from derive.kinds.robot._velocity.ellipsoid_laws import ellipsoid_laws
from derive.mechanics.motion import Axis
from derive.mechanics.robot import Convention, Link, Robot, ScrewRow
from tests.kinds.robot.test_singularities import TWO_R, arm
from tests.kinds.test_planted_motions import plant
from tests.mechanics.robots import problem

NEXT = {
    dh_told.X: dh_told.X_BEFORE, dh_told.Z: dh_told.Z_BEFORE, dh_told.O: dh_told.O_BEFORE,
    dh_told.X_BEFORE: dh_told.X, dh_told.Z_BEFORE: dh_told.Z, dh_told.O_BEFORE: dh_told.O,
}  # fmt: skip
CONVENTIONS: tuple[Convention, ...] = ("standard", "modified")


def screws() -> Robot:
    """Axes that meet, and axes that are parallel."""
    a, b, c = map(Symbol, "abc")
    axes: tuple[tuple[Axis, Symbol, Symbol], ...] = (("z", a, b), ("x", a, b), ("x", c, b))
    rows = (
        Link(ScrewRow(axis, (x, ONE, z), Symbol(f"q{i}")), "revolute", f"q{i}")
        for i, (axis, x, z) in enumerate(axes, 1)
    )
    return Robot("screws", "standard", tuple(rows))


def refused(found: Derivation) -> set[str]:
    return {claim.key for claim in found.claims if not claim.holds}


@pytest.mark.parametrize("convention", CONVENTIONS)
@pytest.mark.parametrize("part", ["start", "end", "axis"])
@pytest.mark.parametrize("k", range(4))
def test_a_parameter_measured_from_another_frame(
    convention: Convention, part: str, k: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    right = dh_told.MEASURED[convention]
    wrong = replace(right[k], **{part: NEXT[getattr(right[k], part)]})
    monkeypatch.setitem(dh_told.MEASURED, convention, (*right[:k], wrong, *right[k + 1 :]))
    assert "as-measured" in refused(problem(screws()).ask("dh-table", convention=convention))


@pytest.mark.parametrize("convention", CONVENTIONS)
def test_an_axis_of_another_joint(convention: Convention, monkeypatch: pytest.MonkeyPatch) -> None:
    right = dh_told.ASSIGNED[convention]
    wrong = replace(right, axis=NEXT[right.axis])
    assert not refused(problem(screws()).ask("dh-table", convention=convention))
    monkeypatch.setitem(dh_told.ASSIGNED, convention, wrong)
    assert "as-measured" in refused(problem(screws()).ask("dh-table", convention=convention))


@pytest.mark.parametrize("case", ["skew", "intersecting", "parallel", "coincident"])
def test_another_reason_for_a_frame(case: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(dh_told, "_case", lambda *_: case)
    assert "frames-told" in refused(problem(screws()).ask("dh-table"))


@pytest.mark.parametrize("convention", CONVENTIONS)
def test_moves_of_a_row_in_another_order(convention: Convention, monkeypatch: pytest.MonkeyPatch) -> None:
    right = dh_told.MEASURED[convention]
    monkeypatch.setitem(dh_told.MEASURED, convention, right[::-1])
    assert "as-measured" in refused(problem(arm(TWO_R)).ask("dh-table", convention="modified"))


@pytest.mark.parametrize(
    ("law", "right", "wrong"),
    [
        (lambda: turning_law(()), "along = column((x + r", "along = column((x - r"),
        (lambda: exponential_law((), True), "add(I, -R)", "add(I, R)"),
        (lambda: exponential_law((), False), "add(I, -R)", "add(R, -I)"),
        (lambda: ellipsoid_laws(False)[0], "Power(gram, number(-1))", "gram"),
    ],
)
def test_a_law_with_a_wrong_sign(law, right: str, wrong: str, monkeypatch: pytest.MonkeyPatch) -> None:
    found: Step = law()
    assert in_its_instance(found, {}).holds
    (function,) = (
        f for f in (turning_law, exponential_law, ellipsoid_laws) if f.__name__ in law.__code__.co_names
    )
    plant(monkeypatch, function, right, wrong)
    assert not in_its_instance(law(), {}).holds
