"""Random systems of blocks against python-control, which knows them as blocks only: transfer functions, state
space, stability, closed loops, and the figures of step responses."""

from __future__ import annotations

import json
import random
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import control
import numpy
import pytest

from derive.algebra.numbers.floats import number
from derive.build import working_on
from derive.derivation import Derivation
from derive.sheet.load import load_sheet
from derive.verify import answered

SEEDS = range(10)
POINTS = (0.3 + 0.7j, -0.4 + 1.9j, 2.1 - 0.3j)
GAINS = {"P": "K_p", "I": "K_i", "D": "K_d"}
SLOWEST = -0.02  # real part of a pole up to which a simulation of python-control says how a response ends


@dataclass(frozen=True)
class Part:
    """signal = num/den * (sum of signs * inputs)."""

    signal: str
    num: tuple[float, ...]
    den: tuple[float, ...]
    inputs: tuple[tuple[str, int], ...]


def parts_of(draw: random.Random) -> tuple[Part, ...]:
    """A chain of blocks from u to the last signal, with loops back and forth."""
    count, found = draw.randint(1, 4), []
    names = [f"x{k}" for k in range(1, count + 1)]
    for k, name in enumerate(names):
        order = draw.randint(1, 2)
        den = (1.0, *(draw.choice((0.5, 1.0, 2.0, 3.0, 4.25)) for _ in range(order)))
        num = tuple(draw.choice((-1.0, 0.5, 1.0, 2.0)) for _ in range(draw.randint(1, order)))
        before = "u" if k == 0 else names[k - 1]
        more = [
            (other, draw.choice((1, -1, -1))) for other in names if other != before and draw.random() < 0.3
        ]
        found.append(Part(name, num, den, ((before, draw.choice((1, 1, -1))), *more)))
    return tuple(found)


def typed(coefficients: Sequence[float]) -> str:
    degree = len(coefficients) - 1
    return "(" + " + ".join(f"({k:g})*s^{degree - place}" for place, k in enumerate(coefficients)) + ")"


def equation(draw: random.Random, part: Part) -> str:
    """As a quotient, or multiplied out."""
    inputs = " ".join(f"{'+' if sign > 0 else '-'} {name}" for name, sign in part.inputs).removeprefix("+ ")
    num, den = typed(part.num), typed(part.den)
    return draw.choice((f"{part.signal} = {num}/{den}*({inputs})", f"{den}*{part.signal} = {num}*({inputs})"))


def asked(
    equations: list[str], output: str, questions: list[dict[str, Any]], folder: Path
) -> list[Derivation]:
    """What is derived; an answer that is refused fails the test."""
    system = {"equations": equations, "input": "u", "output": output}
    sheet = folder / "sheet.yaml"
    problem = {"system": system, "questions": questions}
    sheet.write_text(json.dumps({"title": "Random", "problems": [problem]}), encoding="utf-8")
    (found,) = load_sheet(sheet).problems
    working = working_on(found)
    return [answered(question, working) for question in found.questions]


def connected(parts: Sequence[Part]) -> control.StateSpace:
    """The same blocks, wired by their names."""
    blocks = []
    for part in parts:
        blocks.append(control.tf(part.num, part.den, inputs=f"e_{part.signal}", outputs=part.signal))
        signs = ["-" * (sign < 0) + name for name, sign in part.inputs]
        blocks.append(control.summing_junction(signs, f"e_{part.signal}"))
    return control.ss(control.interconnect(blocks, inputs=["u"], outputs=[parts[-1].signal]))


def by_polynomials(evaluated: dict[str, Any], s: complex) -> complex:
    return complex(numpy.polyval(evaluated["num"], s) / numpy.polyval(evaluated["den"], s))


@pytest.mark.parametrize("seed", SEEDS)
def test_a_system_of_blocks(seed: int, tmp_path: Path) -> None:
    draw = random.Random(seed)
    parts = parts_of(draw)
    theirs = connected(parts)
    equations = [equation(draw, part) for part in draw.sample(parts, len(parts))]
    family = draw.choice(("P", "PI", "PD", "PID"))
    gains = {letter: draw.choice((0.5, 1.0, 2.0, 5.0)) for letter in family}
    controller = {family: {GAINS[letter]: gain for letter, gain in gains.items()}}
    questions: list[dict[str, Any]] = [
        {"find": "transfer-function", "evaluate": "true"},
        {"find": "state-space", "evaluate": "true"},
        {"find": "stability"},
        {"find": "closed-loop", "controller": controller, "evaluate": "true"},
    ]
    transfer, space, stability, closed = asked(equations, parts[-1].signal, questions, tmp_path)
    A, B, C, D = (
        numpy.array([[number(entry, {}) for entry in row] for row in space.results[name].rows])
        for name in "ABCD"
    )
    for s in POINTS:
        G = complex(theirs(s))
        K = gains.get("P", 0.0) + gains.get("I", 0.0) / s + gains.get("D", 0.0) * s
        assert by_polynomials(transfer.evaluated["G"], s) == pytest.approx(G, rel=1e-6)
        states = C @ numpy.linalg.solve(s * numpy.eye(len(A)) - A, B) + D
        assert complex(states[0, 0]) == pytest.approx(G, rel=1e-6)
        assert by_polynomials(closed.evaluated["T"], s) == pytest.approx(K * G / (1 + K * G), rel=1e-6)
    unstable = sum(pole.real > 1e-9 for pole in theirs.poles())  # those that cancel in G among them
    assert number(stability.results["unstable_poles"], {}) == unstable


@pytest.mark.parametrize("seed", SEEDS)
def test_a_step_response(seed: int, tmp_path: Path) -> None:
    draw = random.Random(f"step {seed}")
    theirs = None
    while theirs is None or theirs.poles().real.max() > SLOWEST or abs(theirs.dcgain()) < 1e-6:
        parts = parts_of(draw)
        theirs = connected(parts)
    equations = [equation(draw, part) for part in parts]
    (found,) = asked(equations, parts[-1].signal, [{"find": "step-response", "evaluate": "true"}], tmp_path)
    ours = {name: float(number(value, {})) for name, value in found.results.items()}
    times = numpy.linspace(0, max(20.0, 3 * ours["settling_time"]), 20_001)
    _, y = control.step_response(theirs, times)
    share, step = numpy.squeeze(y) / theirs.dcgain(), times[1]
    assert ours["steady_state"] == pytest.approx(float(theirs.dcgain()), rel=2e-3)
    rise = times[numpy.argmax(share >= 0.9)] - times[numpy.argmax(share >= 0.1)]
    settled = times[numpy.flatnonzero(abs(share - 1) > 0.02)[-1]] + step
    assert ours["rise_time"] == pytest.approx(rise, abs=3 * step, rel=2e-3)
    assert ours["settling_time"] == pytest.approx(settled, abs=3 * step, rel=2e-3)
    assert ours["overshoot"] == pytest.approx(max(0.0, 100 * (share.max() - 1)), abs=0.06)


@pytest.mark.parametrize("seed", range(6))
def test_a_polynomial_and_its_roots(seed: int, tmp_path: Path) -> None:
    """The rows of Routh count the roots that numpy finds to the right."""
    draw = random.Random(f"routh {seed}")
    coefficients = [1.0, *(draw.choice((1.0, 2.0, 3.0, 5.0, 8.0, 0.5)) for _ in range(draw.randint(2, 6)))]
    (found,) = asked([f"{typed(coefficients)}*y = u"], "y", [{"find": "stability"}], tmp_path)
    right = sum(root.real > 1e-7 for root in numpy.roots(coefficients))
    assert number(found.results["unstable_poles"], {}) == right
