"""Orientations along paths against those of SciPy: one axis, quaternions, three angles; and what is none."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation, Slerp

from derive.errors import SheetErrors
from tests.kinds.test_paths import asked

LINE = "{line: {from: [0, 0, 0], to: [1, 2, 2]}, timing: {law: LAW}, orientation: {TURN}}"
SHARES = {  # of the way at a time, and its rates
    "cubic, time: 2": lambda t: np.polynomial.Polynomial([0, 0, 3 / 4, -1 / 4])(t),
}
ENDS = ([20, -40, 65], [100, 70, -30])


def turned(by: str, convention: str = "ZYX") -> str:
    start, end = ([f"{angle} deg" for angle in angles] for angles in ENDS)
    text = f"from: [{', '.join(start)}], to: [{', '.join(end)}], by: {by}, convention: {convention}"
    return LINE.replace("TURN", text)


def rates(of: Any, t: float) -> tuple[Any, Any]:
    """The angular velocity and acceleration of a rotation over time, by differences."""

    def omega(at: float, h: float = 1e-4) -> Any:
        return (of(at + h) * of(at - h).inv()).as_rotvec() / (2 * h)

    return omega(t), (omega(t + 1e-3) - omega(t - 1e-3)) / 2e-3


@pytest.mark.parametrize("by", ["axis-angle", "slerp"])
def test_the_turn_of_scipy_between_two_orientations(by: str, tmp_path: Path) -> None:
    path = turned(by).replace("LAW", "cubic, time: 2")
    slerp = Slerp([0, 1], Rotation.from_euler("ZYX", ENDS, degrees=True))

    def of(t: float) -> Rotation:
        return slerp(SHARES["cubic, time: 2"](t))

    for t in (0.3, 1.1, 1.9):
        found = asked(path, tmp_path, f"  evaluate: {{t: {t}}}")["evaluated"]
        if by == "slerp":
            w, *v = found["q"]
            ours = Rotation.from_quat([*v, w]).as_matrix()
            assert np.linalg.norm(found["q"]) == pytest.approx(1)
        else:
            ours = found["R"]
            between = (of(0).inv() * of(2)).as_rotvec()
            assert np.allclose(np.array(found["axis"]) * found["angle"], between)
        assert np.allclose(ours, of(t).as_matrix())
        velocity, change = rates(of, t)
        assert np.allclose(found["omega"], velocity, atol=1e-6)
        assert np.allclose(found["alpha"], change, atol=1e-4)


@pytest.mark.parametrize("convention", ["ZYX", "ZYZ", "xyz"])
def test_each_angle_by_itself(convention: str, tmp_path: Path) -> None:
    path = turned("euler-angles", convention).replace("LAW", "cubic, time: 2")

    def angles(t: float) -> Any:
        share = SHARES["cubic, time: 2"](t)
        return np.radians((1 - share) * np.array(ENDS[0]) + share * np.array(ENDS[1]))

    def of(t: float) -> Rotation:
        return Rotation.from_euler(convention, angles(t))

    found = asked(path, tmp_path, "  evaluate: {t: 0.7}")["evaluated"]
    assert np.allclose(found["angles"], angles(0.7))
    assert np.allclose(found["R"], of(0.7).as_matrix())
    velocity, change = rates(of, 0.7)
    assert np.allclose(found["omega"], velocity, atol=1e-6)
    assert np.allclose(found["alpha"], change, atol=1e-4)


def test_half_a_turn_along_a_function(tmp_path: Path) -> None:
    """About the axis of the half turn, by the parameter alone, and with a range that does not begin at 0."""
    ends = "from: {motion: [{rotate: y, by: 30 deg}]}, to: {motion: [{rotate: [1, 0, 1], by: 180 deg}]}"
    path = f"{{function: [s, s^2], range: [1, 3], orientation: {{{ends}}}}}"
    found = asked(path, tmp_path, "  evaluate: {s: 1.5}")["evaluated"]
    first = Rotation.from_euler("y", 30, degrees=True)
    between = first.inv() * Rotation.from_rotvec(np.pi * np.array([1, 0, 1]) / np.sqrt(2))
    vector = np.array(found["axis"]) * found["angle"]
    assert np.allclose(Rotation.from_rotvec(vector).as_matrix(), between.as_matrix())
    assert np.allclose(found["R"], (first * Rotation.from_rotvec(vector / 4)).as_matrix())
    assert "omega" not in found


@pytest.mark.parametrize(
    ("turn", "said"),
    [
        ("from: [0, 0, 0], to: [0, 0, 0]", "nothing to turn"),
        ("from: [0, 0, 0], to: [0, 360 deg, 0]", "nothing to turn"),
        ("from: [0, 0, 0], to: [0, 0, 0], by: euler-angles", "nothing to turn"),
        ("from: {motion: [{rotate: x, by: 1}]}, to: [0, 0, 0], by: euler-angles", "its angles are not given"),
        ("from: [0, 0, psi], to: [0, 0, 0]", "'psi' in an orientation has no value"),
        ("from: {motion: [{translate: x, by: 1}]}, to: [0, 0, 0]", "a translation is no turn"),
        ("from: {matrix: [[1, 0, 0], [0, 1, 0], [0, 0, 2]]}, to: [0, 0, 1]", "not right-handed"),
        ("from: [0, 0, 0], to: [0, 0, 1], convention: ZZX", "two rotations in a row"),
        ("from: 3, to: [0, 0, 1]", "write three angles"),
        ("from: [0, 0, 0]", "to"),
    ],
)
def test_what_is_no_turn_is_said(turn: str, said: str, tmp_path: Path) -> None:
    with pytest.raises(SheetErrors) as caught:
        asked(LINE.replace("LAW", "cubic, time: 1").replace("TURN", turn), tmp_path)
    assert any(said in error.message + error.hint for error in caught.value.errors), caught.value.errors
