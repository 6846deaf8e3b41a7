"""Inverse kinematics: every branch of every arm, put back through poses multiplied out in NumPy."""

from __future__ import annotations

import math
import random
from collections.abc import Mapping
from functools import cache
from typing import Any

import pytest

from derive.algebra.infix import text
from derive.algebra.numbers.compiled import Compiled, compiled
from derive.derivation import Derivation
from derive.expression import free_symbols
from derive.render.phrases import spoken
from tests.kinds.robot.arms import ARMS, Arm

POSES = 100


@cache
def solved(name: str) -> Derivation:
    arm = ARMS[name]
    return arm.problem().ask("inverse-kinematics", given=arm.given)


def configurations(arm: Arm, count: int, seed: int = 7) -> list[dict[str, float]]:
    """Random parameters, angles of a whole turn and displacements of either sign."""
    draw = random.Random(seed)
    names = sorted(arm.problem().symbols - set(arm.joints))
    found = []
    for _ in range(count):
        at = {name: draw.uniform(0.2, 1.5) for name in names}
        for name in arm.joints:
            if name in arm.slides:
                at[name] = draw.uniform(0.2, 1.5) * (1 if name in arm.positive else draw.choice((1, -1)))
            else:
                at[name] = draw.uniform(-math.pi, math.pi)
        found.append(at)
    return found


FUNCTIONS: dict[int, tuple[Any, Compiled]] = {}


def function(tree: Any) -> Compiled:
    """The tree as a function, made once (and the tree kept, so that its id stays its own)."""
    if id(tree) not in FUNCTIONS:
        FUNCTIONS[id(tree)] = tree, compiled(tree)
    return FUNCTIONS[id(tree)][1]


def values(branch: Any, arm: Arm, known: Mapping[str, float]) -> dict[str, float] | None:
    """A branch in numbers, as it is printed; None where it is not real."""
    here = dict(known)
    formulas = branch.short or branch.values
    try:
        for name in formulas:
            here[name] = function(formulas[name])(here)
    except ValueError:
        return None
    return {name: here[name] for name in arm.joints}


def same(arm: Arm, left: Mapping[str, float], right: Mapping[str, float]) -> bool:
    """Equal joint values, angles up to whole turns."""
    gaps = [
        left[n] - right[n] if n in arm.slides else math.remainder(left[n] - right[n], 2 * math.pi)
        for n in arm.joints
    ]
    return max(map(abs, gaps)) < 1e-6


@pytest.mark.parametrize("name", ARMS)
def test_every_claim_holds(name: str) -> None:
    assert [claim.key for claim in solved(name).claims if not claim.holds] == []


@pytest.mark.parametrize("name", ARMS)
def test_number_of_branches(name: str) -> None:
    branches = solved(name).results["solutions"]
    assert len(branches) == ARMS[name].solutions
    said = spoken("robot", "inverse-kinematics")
    assert len({said.when(branch.when) for branch in branches}) == len(branches)


@pytest.mark.parametrize("name", ARMS)
def test_branches_reach_random_poses(name: str) -> None:
    arm, found = ARMS[name], solved(name)
    for at in configurations(arm, POSES):
        T = arm.pose(at)
        known = {n: v for n, v in at.items() if n not in arm.joints} | arm.known(T)
        real = [v for b in found.results["solutions"] if (v := values(b, arm, known))]
        for each in real if not arm.partial else ():
            wanted, reached = arm.known(T), arm.known(arm.pose({**at, **each}))
            for key in wanted:
                gap = wanted[key] - reached[key]
                assert abs(math.remainder(gap, 2 * math.pi) if key == "phi" else gap) < 1e-9, (name, key)
        assert any(same(arm, each, at) for each in real), name


@pytest.mark.parametrize("name", [n for n, arm in ARMS.items() if arm.solutions > 1])
def test_branches_differ(name: str) -> None:
    arm, found = ARMS[name], solved(name)
    (at,) = configurations(arm, 1, seed=3)
    known = {n: v for n, v in at.items() if n not in arm.joints} | arm.known(arm.pose(at))
    real = [v for b in found.results["solutions"] if (v := values(b, arm, known))]
    assert all(not same(arm, a, b) for k, a in enumerate(real) for b in real[:k])


@pytest.mark.parametrize("name", ARMS)
def test_short_formulas_are_evaluated_in_order(name: str) -> None:
    """Every name rests on what is given and on names before it; no formula is long."""
    arm, results = ARMS[name], solved(name).results
    given = set(arm.known(arm.pose(configurations(arm, 1)[0]))) | arm.problem().symbols - set(arm.joints)
    for branch in results["solutions"]:
        assert tuple(branch.short) == results.get("order", ())
        known = set(given)
        for joint, value in branch.short.items():
            assert free_symbols(value) <= known, (name, joint)
            assert len(text(value)) < 250, (name, joint)
            known.add(joint)
        if not branch.short:
            assert all(free_symbols(value) <= given for value in branch.values.values())
