"""Transmissions against published numbers of teeth and a search for the best gear by SciPy."""

from __future__ import annotations

from pathlib import Path

import pytest
from scipy.optimize import minimize_scalar

from derive.errors import SheetErrors
from derive.sheet.load import load_sheet
from tests.kinds.test_sensor_kinds import ask, value


@pytest.mark.parametrize(
    ("stages", "ratio"),
    [
        ("{harmonic: [200, 202]}", -100),  # the strain wave gear of encyclopedias
        ("{planetary: [30, 78]}", 3.6),  # the power split of the Toyota Prius
        ("{teeth: [18, 54]}", -3),
        ("{teeth: [18, 54], internal: true}", 3),
        ("{radii: [2 cm, 50 mm]}", -2.5),
        ("{diameters: [4 cm, 100 mm]}", -2.5),
        ("{belt: [0.5, 1.5]}", 3),
        ("{belt: [0.5, 1.5], crossed: true}", -3),
        ("{ratio: 1/2}", 0.5),
        ("{teeth: [20, 60]}, {teeth: [15, 45]}, {ratio: 5}", 45),
        ("{harmonic: [160, 162]}, {radii: [1, 2]}", 160),
        ("{harmonic: [160, 162]}, {harmonic: [100, 101]}", 8000),
    ],
)
def test_ratios(tmp_path: Path, stages: str, ratio: float) -> None:
    found = ask(tmp_path, f"drive: {{stages: [{stages}]}}", "gear-train", "speed: 90 rad/s", "torque: tau_m")
    assert value(found.results["G"]) == pytest.approx(ratio)
    assert value(found.results["omega"]) == pytest.approx(90 / ratio)
    assert value(found.results["tau"], tau_m=2) == pytest.approx(2 * ratio)


def test_shafts_have_inertias_too(tmp_path: Path) -> None:
    stages = "[{teeth: [20, 60], inertia: J_1}, {belt: [2, 8], inertia: 0.5}]"
    found = ask(tmp_path, f"drive: {{rotor: J_m, load: J_l, stages: {stages}}}", "reflected-inertia").results
    at = {"J_m": 0.3, "J_1": 0.7, "J_l": 5.0}
    assert value(found["J_load"], **at) == pytest.approx(144 * 0.3 + 16 * 0.7 + 0.5 + 5)
    assert value(found["J_motor"], **at) == pytest.approx(0.3 + 0.7 / 9 + 0.5 / 144 + 5 / 144)


@pytest.mark.parametrize("load_torque", ["", ", load_torque: 3 N m"])
def test_the_load_of_a_best_gear(tmp_path: Path, load_torque: str) -> None:
    drive = f"drive: {{rotor: 0.1 kg m^2, gear: 12, torque: 5 N m{load_torque}}}"
    found = ask(tmp_path, drive, "load-inertia").results
    load, pull = value(found["J_l"]), 3 if load_torque else 0

    def less(gear: float) -> float:
        return -(gear * 5 - pull) / (gear**2 * 0.1 + load)

    best = minimize_scalar(less, bounds=(1, 100), method="bounded", options={"xatol": 1e-9})
    assert best.x == pytest.approx(12, rel=1e-5)
    assert -best.fun == pytest.approx(value(found["alpha"]))


@pytest.mark.parametrize(
    ("drive", "kind", "message"),
    [
        ("{stages: []}", "gear-train", ""),
        ("{stages: [{teeth: [20, 30.5]}]}", "gear-train", "a wheel has a whole number of teeth"),
        ("{stages: [{teeth: [20, -3]}]}", "gear-train", "the size of a wheel is positive"),
        ("{stages: [{teeth: [20]}]}", "gear-train", ""),
        ("{stages: [{}]}", "gear-train", "no wheels and no ratio"),
        ("{stages: [{teeth: [1, 2], ratio: 3}]}", "gear-train", "both teeth and ratio"),
        ("{stages: [{harmonic: [162, 160]}]}", "gear-train", "fewer teeth than its circular spline"),
        ("{stages: [{planetary: [30, 30]}]}", "gear-train", "fewer teeth than its ring"),
        ("{stages: [{teeth: [30, 20], internal: true}]}", "gear-train", "smaller than the ring"),
        ("{stages: [{ratio: 0}]}", "gear-train", "a ratio is not zero"),
        ("{stages: [{ratio: 2, crossed: true}]}", "gear-train", "only a belt is crossed"),
        ("{stages: [{belt: [1, 2], internal: true}]}", "gear-train", "only gears mesh inside"),
        ("{gear: 3, stages: [{ratio: 2}]}", "gear-train", "follows from its stages"),
        ("{gear: 3}", "gear-train", "'stages' is missing"),
        ("{stages: [{ratio: 2}]}", "reflected-inertia", "'rotor' is missing"),
        ("{rotor: J_m, load: J_l}", "load-inertia", "'gear' is missing"),
        ("{rotor: J_m, load: J_l, gear: 3}", "load-inertia", "'load' is not used"),
        ("{rotor: 1, gear: 2, torque: 1 N m, load_torque: 9 N m}", "load-inertia", "would not be positive"),
        ("{rotor: a, stages: [{ratio: 2, inertia: 1}]}", "load-inertia", "shafts have inertias"),
        ("{rotor: a, load: b, stages: [{ratio: 2, inertia: 1}]}", "gear-ratio", "shafts have inertias"),
    ],
)
def test_what_is_no_transmission(tmp_path: Path, drive: str, kind: str, message: str) -> None:
    with pytest.raises(SheetErrors) as caught:
        ask(tmp_path, f"drive: {drive}", kind)
    assert any(message in each.message for each in caught.value.errors)


def test_an_author_may_call_a_ratio_as_he_likes(tmp_path: Path) -> None:
    found = ask(tmp_path, "drive: {stages: [{ratio: G}, {radii: [r, omega]}]}", "gear-train").results
    assert value(found["G"], G=3, r=2, omega=5) == pytest.approx(-7.5)
    assert load_sheet(tmp_path / "sheet.yaml")
