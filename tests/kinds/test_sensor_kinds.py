"""Encoders, switched voltages and drives against figures anyone can work out, and textbook formulas."""

from __future__ import annotations

from math import degrees, pi, sqrt
from pathlib import Path
from typing import Any

import pytest
from scipy.optimize import minimize_scalar

from derive.algebra.formulas.grammar import parse
from derive.algebra.normal import normal
from derive.algebra.numbers.floats import number
from derive.build import assemble
from derive.derivation import Derivation
from derive.errors import SheetErrors
from derive.sheet.load import load_sheet


def ask(tmp_path: Path, subject: str, kind: str, *more: str) -> Derivation:
    lines = ["title: x", "problems:", f"- {subject}", f"  find: {kind}", *(f"  {line}" for line in more)]
    sheet = tmp_path / "sheet.yaml"
    sheet.write_text("\n".join(lines) + "\n", encoding="utf-8")
    ((_, question),) = assemble(load_sheet(sheet)).questions()
    assert question.derivation
    assert all(claim.holds for claim in question.derivation.claims)
    return question.derivation


def value(tree: Any, **point: float) -> float:
    return number(tree, point)


@pytest.mark.parametrize(
    ("sensor", "counts", "motor", "link"),
    [
        ("{encoder: incremental, lines: 500, edges: 4, gear: 20}", 2000, 0.18, 0.009),
        ("{encoder: incremental, lines: 360}", 360, None, 1),
        ("{encoder: absolute, bits: 12}", 4096, None, 360 / 4096),
        ("{encoder: absolute, bits: 17, gear: 100}", 131072, 360 / 131072, 3.6 / 131072),
    ],
)
def test_resolution(tmp_path: Path, sensor: str, counts: int, motor: float | None, link: float) -> None:
    found = ask(tmp_path, f"sensor: {sensor}", "resolution").results
    assert value(found["counts"]) == counts
    assert degrees(value(found["resolution"])) == pytest.approx(link)
    assert ("resolution_motor" in found) == (motor is not None)
    if motor is not None:
        assert degrees(value(found["resolution_motor"])) == pytest.approx(motor)


def test_symbolic_resolution(tmp_path: Path) -> None:
    lines = ask(tmp_path, "sensor: {encoder: incremental, lines: N, edges: k, gear: r}", "resolution")
    assert lines.results["resolution"] is not None


def test_names_that_clash_are_told(tmp_path: Path) -> None:
    found = ask(
        tmp_path, "sensor: {encoder: incremental, lines: n_l, edges: 4, gear: r}", "resolution"
    ).results
    assert normal(found["resolution"]) == normal(parse("2*pi/(4*n_l*r)"))
    bits = ask(tmp_path, "sensor: {encoder: absolute, bits: b, gear: r}", "resolution").results
    assert value(bits["resolution"], b=10, r=3) == pytest.approx(2 * pi / 1024 / 3)


def test_speed(tmp_path: Path) -> None:
    sensor = "sensor: {encoder: incremental, lines: 500, edges: 4, gear: 20}"
    found = ask(tmp_path, sensor, "speed", "counts: 120", "period: 10 ms").results
    assert degrees(value(found["omega"])) == pytest.approx(120 * 0.009 / 0.01)
    assert degrees(value(found["omega_motor"])) == pytest.approx(20 * 108)
    assert degrees(value(found["quantum"])) == pytest.approx(0.9)
    assert value(found["relative"]) == pytest.approx(1 / 120)


@pytest.mark.parametrize(
    ("sensor", "mean", "duty"),
    [
        ("{pwm: 12 V, duty: 40%}", 4.8, 0.4),
        ("{pwm: 12 V, duty: 0.25}", 3, 0.25),
        ("{pwm: 24 V, low: -24 V, mean: 6 V}", 6, 0.625),
        ("{pwm: 5 V, mean: 2 V}", 2, 0.4),
        ("{pwm: 12 V, duty: 0%}", 0, 0),
    ],
)
def test_mean_voltage(tmp_path: Path, sensor: str, mean: float, duty: float) -> None:
    found = ask(tmp_path, f"sensor: {sensor}", "mean-voltage").results
    assert (value(found["mean"]), value(found["duty"])) == pytest.approx((mean, duty))


def test_time_on(tmp_path: Path) -> None:
    found = ask(tmp_path, "sensor: {pwm: 12 V, duty: 40%, frequency: 20000 Hz}", "mean-voltage").results
    assert value(found["t_on"]) == pytest.approx(20e-6)


def test_reflected_inertia(tmp_path: Path) -> None:
    """Lynch and Park, section 8.9: J_m + J_l/r^2 at the motor; r^2 as much at the load."""
    found = ask(tmp_path, "drive: {rotor: J_m, load: J_l, gear: r}", "reflected-inertia").results
    assert normal(found["J_motor"]) == normal(parse("J_m + J_l/r^2"))
    assert normal(found["J_load"]) == normal(parse("r^2*J_m + J_l"))


def test_inertia_matching(tmp_path: Path) -> None:
    """The gear of the greatest acceleration is sqrt(J_l/J_m) (inertia matching)."""
    found = ask(tmp_path, "drive: {rotor: J_m, load: J_l}", "gear-ratio").results
    assert normal(found["G"]) ** 2 == normal(parse("J_l/J_m"))
    assert value(found["alpha"], J_m=2.0, J_l=8.0, tau_m=3.0) == pytest.approx(3 / (2 * sqrt(16)))


def test_gear_against_a_load_by_search(tmp_path: Path) -> None:
    drive = "drive: {rotor: 0.002, load: 0.6, torque: 0.5, load_torque: 4}"
    found = ask(tmp_path, drive, "gear-ratio").results
    best = minimize_scalar(
        lambda G: -(G * 0.5 - 4) / (G * G * 0.002 + 0.6), bounds=(1, 200), method="bounded"
    )
    assert value(found["G"]) == pytest.approx(best.x, rel=1e-4)
    assert value(found["alpha"]) == pytest.approx(-best.fun)


@pytest.mark.parametrize(
    ("subject", "kind", "said"),
    [
        ("sensor: {encoder: incremental, lines: 500, edges: 3}", "resolution", "1, 2 or 4 edges"),
        ("sensor: {encoder: incremental, lines: 0}", "resolution", "lines must be positive"),
        ("sensor: {encoder: incremental, lines: 1.5}", "resolution", "whole number"),
        ("sensor: {encoder: absolute, bits: 99}", "resolution", "no encoder has 99 bits"),
        ("sensor: {encoder: optical}", "resolution", "write {encoder: incremental"),
        ("sensor: {encoder: absolute, bits: 8}", "mean-voltage", "no switched voltage"),
        ("sensor: {pwm: 12 V, duty: 40%}", "resolution", "this is no encoder"),
        ("sensor: {pwm: 12 V, duty: 140%}", "mean-voltage", "between 0 and 1"),
        ("sensor: {pwm: 12 V}", "mean-voltage", "either the duty or the mean"),
        ("sensor: {pwm: 12 V, mean: 13 V}", "mean-voltage", "between the two voltages"),
        ("drive: {rotor: -1, load: 1}", "gear-ratio", "rotor must be positive"),
        ("drive: {rotor: 1, load: 1}", "reflected-inertia", "'gear' is missing"),
        ("drive: {rotor: 1 kg, load: 1}", "gear-ratio", "moment of inertia"),
    ],
)
def test_faults_are_told(tmp_path: Path, subject: str, kind: str, said: str) -> None:
    with pytest.raises(SheetErrors) as caught:
        ask(tmp_path, subject, kind)
    assert any(said in f"{error.message} {error.hint}" for error in caught.value.errors)
