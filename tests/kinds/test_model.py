"""The scripts of a model, run and parsed by the programs they are written for."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path
from shutil import which
from typing import Any

import pytest

from derive.control.motor import motor
from derive.derivation import Derivation
from derive.errors import NotDerivable
from derive.kinds.problem import Problem

POINT = {"J": "2", "K_m": "10", "R_a": "1", "L_a": "1", "b": "0.5", "K_b": "0.1"}
PD = {"PD": {"K_p": "0.1", "K_d": "0.15"}}
PID = {"PID": {"K_p": "0.12", "K_i": "0.01", "K_d": "0.15"}}
octave = pytest.mark.skipif(which("octave-cli") is None, reason="Octave is not installed")


def model(controller: Any = PD, output: Any = "angle", **options: Any) -> Derivation:
    problem = Problem("motor", motor("armature", output))
    return problem.ask("model", **{"controller": controller, "evaluate": POINT, **options})


def run_python(found: Derivation, folder: Path) -> dict[str, float]:
    """What the Python script prints, as numbers."""
    script = folder / "model.py"
    script.write_text(found.files["model.py"], encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "-W", "error", script.name], cwd=folder, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return {
        name: float(value)
        for name, value in re.findall(r"^(.+): (\S+)$", done.stdout.replace("):", "): "), re.M)
    }


def run_octave(code: str) -> str:
    done = subprocess.run(["octave-cli", "--eval", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.parametrize("controller", [PD, PID, {"P": {"K_p": "0.05"}}])
def test_the_python_script_finds_the_derived_response(controller: Any, tmp_path: Path) -> None:
    found = run_python(model(controller), tmp_path)
    problem = Problem("motor", motor("armature", "angle"))
    derived = problem.ask("step-response", controller=controller, evaluate=POINT).evaluated
    assert found["RiseTime"] == pytest.approx(derived["rise_time"], rel=0.02)
    assert found["SettlingTime"] == pytest.approx(derived["settling_time"], rel=0.02)
    assert found["Overshoot"] == pytest.approx(derived["overshoot"], abs=0.3)


def test_without_a_controller_the_input_steps(tmp_path: Path) -> None:
    found = run_python(model(None, "speed"), tmp_path)
    assert found["SteadyStateValue"] == pytest.approx(20 / 3)


def test_every_claim_holds_and_decimals_stay() -> None:
    found = model()
    assert all(claim.holds for claim in found.claims)
    assert {"blocks", "filtered-loop", "script", "simulation"} <= {claim.key for claim in found.claims}
    assert "K_d = 0.15;" in found.files["model.m"]
    assert found.results == {"matlab": found.files["model.m"], "python": found.files["model.py"]}


def test_a_name_without_value_is_named() -> None:
    with pytest.raises(NotDerivable, match="K_p"):
        model("P")


@octave
def test_octave_parses_the_matlab_script(tmp_path: Path) -> None:
    (tmp_path / "model.m").write_text(model(PID).files["model.m"], encoding="utf-8")
    run_octave(f"__parse_file__('{tmp_path / 'model.m'}')")


@octave
def test_octave_finds_the_same_response(tmp_path: Path) -> None:
    try:
        run_octave("pkg load control")
    except AssertionError:
        pytest.skip("the control package of Octave is not installed")
    before, _, _ = model().files["model.m"].partition("%% Block diagram")
    (tmp_path / "part.m").write_text(before, encoding="utf-8")
    largest = run_octave(f"pkg load control; run('{tmp_path / 'part.m'}'); disp(max(y))")
    derived = Problem("motor", motor("armature", "angle")).ask("step-response", controller=PD, evaluate=POINT)
    assert float(largest) == pytest.approx(1 + derived.evaluated["overshoot"] / 100, abs=0.003)
