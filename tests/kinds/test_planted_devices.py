"""Mistakes in the physics of motors, sensors, drives and mechanisms: a plain build refuses each.

A formula is put in the place of the right one where answers use it, as someone might mistype it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from derive.build import derive_all
from derive.control import response
from derive.control.motor import motor
from derive.control.scripts import programs
from derive.control.system import System
from derive.derivation import Step
from derive.errors import SheetErrors
from derive.expression import ONE, Expr, Symbol, negate, number
from derive.expression import replace as put_in
from derive.kinds.drive import gear_ratio
from derive.kinds.mechanism import mobility
from derive.kinds.sensor import _encoder, mean_voltage
from derive.kinds.system import (
    _routh_steps,
    _stability_told,
    closed_loop,
    model,
    stability,
    step_response,
    transfer_function,
)
from derive.kinds.work import Work
from derive.mechanics.mobility import Joints, Mechanism
from derive.sheet.load import load_sheet
from derive.sheet.subjects import motor as motors
from tests.kinds.test_planted_motions import plant

MOTOR = "motor: {control: armature, output: OUTPUT}"
VALUES = "evaluate: {J: 2, K_m: 10, R_a: 1, L_a: 1, b: 0.5, K_b: 0.1}"
PD = "controller: {PD: {K_p: 1, K_d: 1}}"
Plant = Callable[[pytest.MonkeyPatch], None]


def build(folder: Path, subject: str, find: str, *more: str, where: str = "{}") -> None:
    """Raises SheetErrors."""
    sheet = folder / "sheet.yaml"
    lines = [
        "title: x",
        f"where: {where}",
        "problems:",
        f"- {subject}",
        f"  find: {find}",
        *(f"  {line}" for line in more),
    ]
    sheet.write_text("\n".join(lines) + "\n", encoding="utf-8")
    derive_all([load_sheet(sheet)], True, lambda _: None)


def faults(folder: Path, *sheet: str, where: str = "{}") -> list[str]:
    with pytest.raises(SheetErrors) as caught:
        build(folder, *sheet, where=where)
    return [each.message for each in caught.value.errors]


def is_refused(folder: Path, *sheet: str, where: str = "{}") -> bool:
    return all("own check" in each for each in faults(folder, *sheet, where=where))


# -- motors -------------------------------------------------------------------------------------------

EQUATIONS = {
    "back EMF that drives on": {Symbol("V_b"): negate(Symbol("V_b"))},
    "disturbance that drives on": {Symbol("T_d"): negate(Symbol("T_d"))},
    "friction that drives on": {Symbol("b"): negate(Symbol("b"))},
    "twice the inductance": {Symbol("L_a"): 2 * Symbol("L_a")},
    "constants exchanged": {Symbol("K_m"): Symbol("K_b"), Symbol("K_b"): Symbol("K_m")},
}


@pytest.mark.parametrize(
    "find", ["transfer-function", "state-space", "closed-loop", "step-response", "stability"]
)
@pytest.mark.parametrize("output", ["angle", "speed"])
@pytest.mark.parametrize("mistake", EQUATIONS)
def test_motors(
    mistake: str, output: str, find: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def mistyped(control: Any, observed: Any) -> System:
        right = motor(control, observed)
        wrong = EQUATIONS[mistake]
        changed = [
            replace(e, left=put_in(e.left, wrong), right=put_in(e.right, wrong)) for e in right.equations
        ]
        if mistake == "back EMF that drives on":  # in the circuit alone
            changed[1] = right.equations[1]
        return replace(right, equations=tuple(changed))

    monkeypatch.setattr(motors, "motor", mistyped)
    more = [PD] if find == "closed-loop" else []
    assert is_refused(tmp_path, MOTOR.replace("OUTPUT", output), find, *more, VALUES)


# -- sensors and drives -------------------------------------------------------------------------------


def no_edges(patch: pytest.MonkeyPatch) -> None:
    """500 counts for 2000."""
    right = _encoder._counts

    def counts(work: Work, encoder: Any) -> Any:
        return right(work, replace(encoder, disc=replace(encoder.disc, edges=ONE)))

    patch.setattr(_encoder, "_counts", counts)


def three_bits_more(patch: pytest.MonkeyPatch) -> None:
    right = _encoder._counts

    def counts(work: Work, encoder: Any) -> Any:
        return right(work, replace(encoder, disc=replace(encoder.disc, bits=encoder.disc.bits + 3)))

    patch.setattr(_encoder, "_counts", counts)


def half_a_turn(patch: pytest.MonkeyPatch) -> None:
    patch.setattr(_encoder, "TURN", _encoder.TURN / 2)


def law_without_the_rest(patch: pytest.MonkeyPatch) -> None:
    """U_m = D U in the sentence, where the voltage is not zero for the rest."""
    right = Step

    def step(name: str, chain: tuple[Expr, ...], rule: str) -> Step:
        return right(name, (chain[0], Symbol("D") * Symbol("U")), rule)

    patch.setattr(mean_voltage, "Step", step)


def mean_without_the_rest(patch: pytest.MonkeyPatch) -> None:
    patch.setattr(mean_voltage, "_mean", lambda high, low, duty, bipolar: duty * high)


def gear_not_squared(patch: pytest.MonkeyPatch) -> None:
    """G J_m for G^2 J_m in the acceleration of the load."""

    def slope(G: Symbol, J_m: Expr, J_l: Expr, tau_m: Expr, tau_l: Expr | None) -> tuple[Expr, Expr, Expr]:
        whole = G * J_m + J_l
        return G * tau_m / whole, tau_m * J_l / whole**2, tau_m * J_l

    patch.setattr(gear_ratio, "slope_of", slope)


INCREMENTAL = "sensor: {encoder: incremental, lines: 500, edges: 4, gear: 20}"
SENSORS: dict[str, tuple[Plant, tuple[str, ...]]] = {
    "edges": (no_edges, (INCREMENTAL, "resolution")),
    "edges, for the speed": (no_edges, (INCREMENTAL, "speed", "counts: 120", "period: 10 ms")),
    "edges of symbols": (no_edges, ("sensor: {encoder: incremental, lines: N_l, edges: k}", "resolution")),
    "bits": (three_bits_more, ("sensor: {encoder: absolute, bits: 12}", "resolution")),
    "turn": (half_a_turn, (INCREMENTAL, "resolution")),
    "law": (law_without_the_rest, ("sensor: {pwm: U, low: -U, duty: D}", "mean-voltage")),
    "mean": (mean_without_the_rest, ("sensor: {pwm: 24 V, low: -24 V, duty: 40%}", "mean-voltage")),
    "gear": (gear_not_squared, ("drive: {rotor: J_m, load: J_l, torque: tau_m}", "gear-ratio")),
}


@pytest.mark.parametrize("name", SENSORS)
def test_sensors_and_drives(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    plant, sheet = SENSORS[name]
    build(tmp_path, *sheet)
    plant(monkeypatch)
    assert is_refused(tmp_path, *sheet)


def test_an_inertia_without_the_square_of_the_gear(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    right = Work.worked

    def worked(self: Work, name: str, formula: Expr, *more: Any, **others: Any) -> Work:
        wrong = Symbol("G") * Symbol("J_m") + Symbol("J_l") if name == "J_eff_l" else formula
        return right(self, name, wrong, *more, **others)

    monkeypatch.setattr(Work, "worked", worked)
    assert is_refused(tmp_path, "drive: {rotor: J_m, load: J_l, gear: G}", "reflected-inertia")


@pytest.mark.parametrize("duty", ["duty: D", "mean: 13"])
def test_a_duty_that_no_wave_has_is_told(duty: str, tmp_path: Path) -> None:
    """The sheet cannot see it where it stands under a name."""
    told = faults(tmp_path, f"sensor: {{pwm: U, {duty}}}", "mean-voltage", where="{D: 1.3, U: 12}")
    assert len(told) == 1
    assert "between 0 and 1" in told[0]


# -- mechanisms ---------------------------------------------------------------------------------------


def freedoms_for_constraints(patch: pytest.MonkeyPatch) -> None:
    patch.setattr(Joints, "total", property(lambda self: self.pairs * (3 - self.constraints)))


def k_for_k_less_one(patch: pytest.MonkeyPatch) -> None:
    patch.setattr(Joints, "pairs", property(lambda self: self.count * self.joining))


def frame_that_moves(patch: pytest.MonkeyPatch) -> None:
    patch.setattr(
        Mechanism, "dof", property(lambda self: 3 * self.bodies - sum(j.total for j in self.joints))
    )


def chain_cut_to_its_name(patch: pytest.MonkeyPatch) -> None:
    right = Work.line

    def line(self: Work, name: Any, *formulas: Expr, **more: Any) -> Work:
        made = right(self, name, *formulas, **more)
        last = made.steps[-1]
        return replace(made, steps=(*made.steps[:-1], replace(last, chain=last.chain[:1])))

    patch.setattr(Work, "line", line)


def other_formula(patch: pytest.MonkeyPatch) -> None:
    patch.setattr(mobility, "ONE", number(2))


MECHANISMS: tuple[Plant, ...] = (
    freedoms_for_constraints, k_for_k_less_one, frame_that_moves, chain_cut_to_its_name, other_formula,
)  # fmt: skip


@pytest.mark.parametrize("plant", MECHANISMS, ids=lambda plant: plant.__name__)
def test_mechanisms(plant: Plant, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    sheet = (
        "mechanism: {space: planar, bodies: 6, joints: [{revolute: 1, joining: 3}, {revolute: 5}]}",
        "mobility",
    )
    plant(monkeypatch)
    assert is_refused(tmp_path, *sheet)


# -- what is read off a response ----------------------------------------------------------------------

FIGURES: dict[str, dict[str, Any]] = {
    "overshoot of 100 %": {"overshoot": 100.0},
    "no overshoot": {"overshoot": 0.0, "peak_time": None},
    "rise time of 1.62 for 1.60": {"rises": lambda rises: (rises[0], rises[1] + 0.02)},
    "settled too early": {"settling_time": lambda time: 0.9 * time},
    "settled too late": {"settling_time": lambda time: 1.01 * time},
    "peak at another time": {"peak_time": lambda time: 1.01 * time},
    "another steady state": {"steady_state": lambda value: value * 1.001},
    "curve of a sample less": {"values": lambda values: (*values[1:], values[-1])},
}


@pytest.mark.parametrize("mistake", FIGURES)
def test_figures_of_a_step_response(mistake: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def measured(*polynomials: Any) -> response.StepResponse:
        found = response.step_response(*polynomials)
        wrong = {
            name: value(getattr(found, name)) if callable(value) else value
            for name, value in FIGURES[mistake].items()
        }
        return replace(found, **wrong)

    monkeypatch.setattr(step_response, "step_response", measured)
    assert is_refused(tmp_path, MOTOR.replace("OUTPUT", "angle"), "step-response", PD, VALUES)


def test_a_peak_that_is_not_the_highest(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A place of the curve beside it, with the value there."""
    right = response.highest

    def beside(curve: Any, *about: Any) -> Any:
        time, _ = right(curve, *about)
        return 1.05 * time, curve.at(1.05 * time)

    monkeypatch.setattr(response, "highest", beside)
    assert is_refused(tmp_path, MOTOR.replace("OUTPUT", "angle"), "step-response", PD, VALUES)


def test_a_wrong_exponential(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of the fastest mode, which nothing shows late in the response."""
    from derive.control.modes import Curve

    right = Curve.of_step

    def of_step(*polynomials: Any) -> Curve:
        curve = right(*polynomials)
        *modes, last = curve.modes
        return replace(curve, modes=(*modes, replace(last, factor=last.factor * 2)))

    monkeypatch.setattr(Curve, "of_step", staticmethod(of_step))
    assert is_refused(tmp_path, MOTOR.replace("OUTPUT", "angle"), "step-response", PD, VALUES)


# -- scripts ------------------------------------------------------------------------------------------


def settings_with(old: str, new: str) -> Plant:
    right = programs._settings

    def plant(patch: pytest.MonkeyPatch) -> None:
        patch.setattr(programs, "_settings", lambda *about: right(*about).replace(old, new))

    return plant


def connected_with(old: str, new: str) -> Plant:
    right = programs._connected

    def plant(patch: pytest.MonkeyPatch) -> None:
        patch.setattr(programs, "_connected", lambda *about: right(*about).replace(old, new))

    return plant


def stops(patch: pytest.MonkeyPatch) -> None:
    patch.setattr(model, "_round_above", lambda size: size / 2)


SCRIPTS: dict[str, Plant] = {
    "a step of 0": settings_with("'After', '1'", "'After', '0'"),
    "a step of 2": settings_with("'After', '1'", "'After', '2'"),
    "a step that waits": settings_with("'Time', '0'", "'Time', '1'"),
    "a disturbance that steps": settings_with("'After', '0'", "'After', '1'"),
    "an error that adds": settings_with("'+-'", "'++'"),
    "another gain": settings_with("'K_b'", "'2*K_b'"),
    "Python: an error that adds": connected_with('"-theta"', '"theta"'),
    "Python: a disturbance that drives": connected_with('"-T_d"', '"T_d"'),
    "Python: another inertia": connected_with("[J, b]", "[b, J]"),
    "it stops too early": stops,
}


@pytest.mark.parametrize("name", SCRIPTS)
def test_scripts(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    SCRIPTS[name](monkeypatch)
    assert is_refused(tmp_path, MOTOR.replace("OUTPUT", "angle"), "model", PD, VALUES)


# -- verdicts and lines -------------------------------------------------------------------------------


@pytest.mark.parametrize("said", ["stable", "oscillator", "integrator"])
@pytest.mark.parametrize(
    ("module", "find", "more"),
    [
        (_stability_told, "stability", ()),
        (closed_loop, "closed-loop", (VALUES,)),
        (step_response, "step-response", (VALUES,)),
    ],
)
def test_verdicts(
    module: Any, find: str, more: tuple[str, ...], said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The loop is unstable."""
    monkeypatch.setattr(module, "verdict", lambda _: said)
    values = "{J: 2, K_m: 10, R_a: 1, L_a: 1, b: 0.5, K_b: 0.1}"
    subject = MOTOR.replace("OUTPUT", "angle")
    assert is_refused(tmp_path, subject, find, "controller: {P: 100}", *more, where=values)


def test_a_law_of_routh_with_another_index(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    right = _routh_steps.law_step

    def law(array: Any) -> Step:
        step = right(array)
        return replace(step, chain=(step.chain[0], negate(step.chain[1])))

    monkeypatch.setattr(stability, "law_step", law)
    sheet = 'system: {equations: ["(s^3 + a*s^2 + b*s + c)*y = u"], input: u, output: y}'
    assert is_refused(tmp_path, sheet, "stability")


@pytest.mark.parametrize("polynomial", ["s^3 + a*s^2 + b*s + c", "s^2 + a*s + b"])
def test_a_law_of_routh_with_a_wrong_sign(
    polynomial: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    plant(monkeypatch, _routh_steps.law_step, "named(2, after) - named", "named(2, after) + named")
    sheet = f'system: {{equations: ["({polynomial})*y = u"], input: u, output: y}}'
    assert is_refused(tmp_path, sheet, "stability")


def test_an_equation_copied_with_a_wrong_sign(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    right = transfer_function._steps

    def steps(solved: Any) -> list[Step]:
        first, *rest = right(solved)
        return [replace(first, chain=(first.chain[0], negate(first.chain[1]))), *rest]

    monkeypatch.setattr(transfer_function, "_steps", steps)
    assert is_refused(tmp_path, MOTOR.replace("OUTPUT", "angle"), "transfer-function")


def test_the_disc_that_is_turned_counts_as_any_does() -> None:
    from derive.kinds.sensor._oracle import counts_of_a_line, readings

    assert [counts_of_a_line(edges) for edges in (1, 2, 4)] == [1, 2, 4]
    assert [readings(bits) for bits in (1, 3, 8, 12, 17)] == [2**1, 2**3, 2**8, 2**12, 2**17]


def test_a_fraction_that_is_not_that_of_its_delay(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As the step shows it: with the signs of N and D exchanged, a delay that looks ahead."""
    right = transfer_function.delay_steps

    def steps(system: System) -> list[Step]:
        made = [*right(system)]
        return [replace(each, chain=(ONE / each.chain[0],)) for each in made]

    monkeypatch.setattr(transfer_function, "delay_steps", steps)
    sheet = 'system: {equations: ["y = exp(-T*s)/(s + 1)*u"], input: u, output: y, delay: {pade: 2}}'
    assert is_refused(tmp_path, sheet, "transfer-function")


def test_conditions_of_the_second_column(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Then one of them is 0 > 0, which never holds."""
    column = property(lambda self: tuple(row.entries[1] for row in self.rows))
    monkeypatch.setattr(_routh_steps.Array, "column", column)
    assert is_refused(tmp_path, MOTOR.replace("OUTPUT", "angle"), "stability", "controller: P", VALUES)


def test_a_table_without_its_last_heading(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    right = _routh_steps.Array.table.fget

    def table(self: Any) -> Any:
        made = right(self)
        return replace(made, headings=made.headings[:-1])

    monkeypatch.setattr(_routh_steps.Array, "table", property(table))
    with pytest.raises(ValueError, match="a cell under each heading"):
        faults(tmp_path, MOTOR.replace("OUTPUT", "angle"), "stability", "controller: P", VALUES)


@pytest.mark.parametrize(
    ("right", "wrong"), [('"-" if sign < 0', '"-" if sign > 0'), ("'+' if sign > 0", "'+' if sign < 0")]
)
def test_signs_that_cancel_along_a_loop(
    right: str, wrong: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """All sums of a script turned: its output is as it was, the signals inside are not."""
    plant(monkeypatch, programs._connected if right[0] == '"' else programs._settings, right, wrong)
    sheet = 'system: {equations: ["m*s^2*X = F - b*s*X - k*X"], input: F, output: X}'
    where = "{m: 1, b: 2, k: 5}"
    assert is_refused(tmp_path, sheet, "model", "controller: {PI: {K_p: 1, K_i: 2}}", where=where)
