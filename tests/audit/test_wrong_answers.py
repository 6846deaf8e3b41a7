"""Answers that were right and are turned wrong, one leaf of the JSON at a time: SymPy passes none of them."""

from __future__ import annotations

import random
from collections.abc import Iterator
from copy import deepcopy
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from derive.audit.asked import Asked
from derive.audit.engine import Audited, Contradicted, audit
from derive.kinds.registry import kinds_of
from derive.render.questions import example_of
from tests.audit.test_audited_examples import SUBJECTS, asked

MOST = 3  # leaves of one answer
OTHERS = {
    "stable": "unstable",
    "unstable": "stable",
    "yes": "no",
    "none": "1",
    "x": "y",
    "y": "z",
    "z": "x",
    "trapezoidal": "triangular",
    "triangular": "trapezoidal",
    "saddle point": "local maximum",
    "local minimum": "local maximum",
    "local maximum": "local minimum",
    "world": "current",
    "global maximum": "global minimum",
    "global minimum": "global maximum",
    "current": "world",
}
Path_ = tuple[Any, ...]


def leaves(value: Any, path: Path_ = ()) -> Iterator[tuple[Path_, Any]]:
    """Every text and number in nested lists and objects, with the way to it; about which axes a first move is
    makes no difference, so that those words are left out."""
    if isinstance(value, list | dict):
        pairs = value.items() if isinstance(value, dict) else enumerate(value)
        for key, part in pairs:
            if key != "about":
                yield from leaves(part, (*path, key))
    else:
        yield path, value


def turned(value: Any) -> Any:
    """Another value of the same sort."""
    if isinstance(value, bool):
        return not value
    if isinstance(value, int | float):
        return value * 1.01 + 0.003
    if value in OTHERS:
        return OTHERS[value]
    if value is None or value == "0":
        return "1"
    for sign, other in ((" > ", " < "), (" < ", " > "), (" <= ", " >= ")):
        if sign in value:
            return value.replace(sign, other, 1)
    return f"({value}) + 1/97"


def with_leaf(answer: Asked, path: Path_) -> Asked:
    """The answer with the leaf at the end of a way turned; the first step says in which field."""
    field, *steps, last = path
    told = deepcopy(dict(getattr(answer, field)))
    part: Any = told
    for step in steps:
        part = part[step]
    part[last] = turned(part[last])
    return replace(answer, **{field: told})


MODULES = sorted(
    {m for s in SUBJECTS if s != "robot" for m in kinds_of(s).values()} - {"derive.kinds.system.model"}
)


@pytest.mark.parametrize("module", MODULES)
def test_no_leaf_is_turned_unseen(module: str, tmp_path: Path) -> None:
    answer = next(asked(example_of(module), tmp_path))
    told = {"results": answer.results, "evaluated": answer.evaluated}
    every = list(leaves({name: dict(part) for name, part in told.items()}))
    random.seed(1)
    if (
        "mechanism" in module
    ):  # how a linkage looks is said in words; kinds hold these, the audit reads formulas
        every = [(path, value) for path, value in every if path[-1] != "when"]
    for path, value in random.sample(every, min(MOST, len(every))):
        outcome = audit(with_leaf(answer, path))
        assert not isinstance(outcome, Audited), (path, value, turned(value))


PLANTED = {
    "the back electromotive force has the other sign": (
        "motor: {control: armature, output: speed}\n  find: transfer-function",
        {"G": "K_m/((J*s + b)*(R_a + L_a*s) - K_b*K_m)"},
    ),
    "a universal joint has three freedoms": (
        "mechanism: {space: spatial, legs: [{chain: UPS, count: 6}]}\n  find: mobility",
        {"dof": "12"},
    ),
    "an encoder counts four edges of two": (
        "sensor: {encoder: incremental, lines: 500, edges: 2}\n  find: resolution",
        {"counts": "2000", "resolution": "pi/1000"},
    ),
    "omega is read out of S with the other sign": (
        "motion: [{rotate: z, by: phi}]\n  find: velocity",
        {"omega": ["0", "0", "-phi_dot"]},
    ),
    "the overshoot of another damping": (
        'system: {equations: ["(s^2 + s + 1)*y = u"], input: u, output: y}\n  find: step-response\n'
        "  evaluate: true",
        {"overshoot": "16.4"},
    ),
    "sin for sin^2 in an acceleration": (
        "lagrange:\n    coordinates: [x, theta]\n    bodies:\n    - {mass: m_c, position: [x, 0]}\n"
        "    - {mass: m_p, position: [x + l*sin(theta), -l*cos(theta)]}\n  find: equations-of-motion\n"
        "  solve: true",
        {
            "accelerations": [
                "m_p*sin(theta)*(l*theta_dot**2 + g*cos(theta))/(m_c + m_p*sin(theta))",
                "-(m_p*l*theta_dot**2*cos(theta) + g*(m_c + m_p))*sin(theta)/(l*(m_c + m_p*sin(theta)**2))",
            ]
        },
    ),
    "a point is forgotten": (
        "function: {variables: [x, y], value: x^3 + y^3 - 3*x*y}\n  find: stationary-points",
        {"solutions": [{"x": "0", "y": "0", "f": "0", "when": "saddle point"}]},
    ),
    "two roots, and the longer blends": (
        "profile: {from: 0, to: 1, time: 3, acceleration: 1}\n  find: lspb-trajectory",
        {"t_b": "(3 + sqrt(5))/2"},
    ),
}


@pytest.mark.parametrize(
    ("language", "right", "wrong"),
    [
        ("matlab", "'Inputs', '+-'", "'Inputs', '++'"),
        ("matlab", "'After', '1'", "'After', '0'"),
        ("matlab", "K_m = 10", "K_m = 11"),
        ("matlab", "'theta/1', 'e/2'", "'theta_dot/1', 'e/2'"),
        ("python", '"-theta"', '"theta"'),
        ("python", "[J, b]", "[b, J]"),
        ("python", "K_m*K_b*s", "K_m*K_b"),
        ("python", 'inputs=["r", "T_d"]', 'inputs=["T_d", "r"]'),
    ],
)
def test_mistakes_in_a_script_are_contradicted(language: str, right: str, wrong: str, tmp_path: Path) -> None:
    (answer,) = asked(example_of("derive.kinds.system.model"), tmp_path)
    script = str(answer.results[language])
    assert right in script
    results = {**answer.results, language: script.replace(right, wrong, 1)}
    assert isinstance(audit(replace(answer, results=results)), Contradicted)


@pytest.mark.parametrize("mistake", PLANTED)
def test_mistakes_of_the_house_are_contradicted(mistake: str, tmp_path: Path) -> None:
    sheet, wrong = PLANTED[mistake]
    (answer,) = asked(f"title: A mistake\nproblems:\n- {sheet}\n", tmp_path)
    assert isinstance(audit(answer), Audited)
    outcome = audit(replace(answer, results={**answer.results, **wrong}))
    assert isinstance(outcome, Contradicted), outcome
