"""Mistakes that were once printed under "Verified", planted again: each is refused now."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from derive.derivation import Derivation, Step
from derive.expression import ONE, ZERO, Expr, Matrix, Symbol
from derive.kinds.problem import Problem
from derive.kinds.robot import manipulability, singularities, state_space, workspace
from derive.kinds.robot._dynamics import matrix_laws
from derive.kinds.robot._inverse import one_equation, two_link
from derive.kinds.robot._rows import exponentials
from derive.kinds.robot._singular import saying, ways
from derive.mechanics import iteration, newton_euler
from derive.mechanics.motion import Motion, Move
from derive.mechanics.robot import Link, Robot, ScrewRow
from tests.kinds.planting import turned
from tests.kinds.robot.arms import ARMS
from tests.kinds.robot.test_singularities import ELBOW, TWO_R, arm
from tests.kinds.test_planted_motions import plant
from tests.mechanics.robots import body, problem, robot, row
from tests.mechanics.test_two_derivations import ARMS as HEAVY


def refused(found: Derivation) -> set[str]:
    return {claim.key for claim in found.claims if not claim.holds}


def test_elbows_exchanged(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(two_link, "ELBOWS", {"elbow-down": -1, "elbow-up": 1})
    assert "elbow-seen" in refused(problem(arm(TWO_R)).ask("inverse-kinematics", given=("x", "y")))


def test_a_branch_with_the_condition_of_another(monkeypatch: pytest.MonkeyPatch) -> None:
    right = one_equation.of_sign
    monkeypatch.setattr(one_equation, "of_sign", lambda tree, sign: right(tree, -sign))
    one = ARMS["3R"]
    assert "when-holds" in refused(one.problem().ask("inverse-kinematics", given=one.given))


@pytest.mark.parametrize("table", ["LOOKS", "BENT"])
def test_stretched_for_folded(monkeypatch: pytest.MonkeyPatch, table: str) -> None:
    words = getattr(saying, table)
    turned = {**words, "stretched": words["folded"], "folded": words["stretched"]}
    monkeypatch.setattr(saying, table, turned)
    assert refused(problem(arm(TWO_R)).ask("singularities")) & {"looks", "looks-in-words"}


def test_a_singular_set_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    right = singularities._analysed
    monkeypatch.setattr(singularities, "_analysed", lambda *given: right(*given)[:1])
    assert "all-found" in refused(problem(arm(ELBOW)).ask("singularities"))


@pytest.mark.parametrize("wrong", ["center", "det"])
def test_a_wrong_sign_at_a_wrist(monkeypatch: pytest.MonkeyPatch, wrong: str) -> None:
    """In one line, as it is printed: the links have nothing beside it that it could be compared with."""
    right = ways.Step

    def made(name: str, chain: tuple[Expr, ...], *others: Any) -> Step:
        last = turned(chain[-1]) if name == wrong else None
        return right(name, chain if last is None else (*chain[:-1], last), *others)

    monkeypatch.setattr(ways, "Step", made)
    seen = {"center": "center-seen", "det": "determinant-seen"}
    assert seen[wrong] in refused(ARMS["PUMA 560"].problem().ask("singularities"))


def test_half_the_best_step(monkeypatch: pytest.MonkeyPatch) -> None:
    right = iteration._descent

    def halved(*given: Any) -> Any:
        change, verdict = right(*given)
        return (None if change is None else change / 2), verdict

    monkeypatch.setattr(iteration, "_descent", halved)
    rows = [(f"q{k}*", "0", "1", "0") for k in (1, 2)]
    start = {"q1": 0.1, "q2": 1.0}
    found = problem(arm(rows)).ask(
        "numerical-inverse-kinematics", target=[1.2, 0.8], start=start, method="gradient"
    )
    assert "steps-repeated" in refused(found)


@pytest.mark.parametrize("line", ["x", "f"])
@pytest.mark.parametrize("wrong", range(4))
def test_a_wrong_sign_in_the_printed_state(line: str, wrong: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """In one entry of one line, while the results stay right."""

    def written(name: str, chain: Any, rule: str) -> Step:
        head, vector = chain
        rows = [(-entry if (name, i) == (line, wrong) else entry,) for i, (entry,) in enumerate(vector.rows)]
        return Step(name, (head, Matrix(tuple(rows))), rule)

    moments = "0, 0, 0, 0, 0, 0"
    heavy = robot(*(row(f"q{k}*", "0", "1", "0", body(f"m{k}", "0, 0, 0", moments)) for k in (1, 2)))
    monkeypatch.setattr(state_space, "Step", written)
    assert "accelerations" in refused(problem(heavy).ask("state-space"))


SWEEP, ROW = newton_euler.NewtonEuler.sweep, newton_euler._row
SWEPT = {
    "a lever that leaves the link": (newton_euler._minus, "u[2] -", "u[1] -"),
    "a lever from tip to base": (ROW, "_minus(_vector(p), out)", "_minus(out, _vector(p))"),
    "a lever of the frame before": (ROW, "_turned(R.T, _minus", "_turned(R, _minus"),
    "a force with the wrong lever": (SWEEP, "_cross(row.arm, force)", "_cross(force, row.arm)"),
    "a force handed down the wrong way": (SWEEP, "_turned(row.R, force)", "_turned(row.R.T, force)"),
    "no moment of the body": (SWEEP, "_plus(moment, N, ", "_plus(moment, "),
    "a moment about the com": (SWEEP, "N, force, moment, tau", "N, force, N, tau"),
}


@pytest.mark.parametrize("arm", ["2R, uniform links", "anthropomorphic"])
@pytest.mark.parametrize("mistake", SWEPT)
def test_a_vector_of_the_recursion(mistake: str, arm: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """By the loads and the motion of the links, whether or not the joint forces notice."""
    assert not refused(problem(HEAVY[arm]).ask("newton-euler"))
    plant(monkeypatch, *SWEPT[mistake])
    assert "names" in refused(problem(HEAVY[arm]).ask("newton-euler"))


def test_a_moment_turned_the_wrong_way(monkeypatch: pytest.MonkeyPatch) -> None:
    """R^T I R for R I R^T in the law of kinetic energy."""
    plant(monkeypatch, matrix_laws.energy_law, "R * I * transpose(R)", "transpose(R) * I * R")
    assert "links" in refused(problem(HEAVY["2R, uniform links"]).ask("energy"))


@pytest.mark.parametrize(
    ("right", "wrong"), [("disc", "annulus"), ("annulus", "disc"), ("hollow-cylinder", "annulus")]
)
def test_a_region_called_as_another(right: str, wrong: str, monkeypatch: pytest.MonkeyPatch) -> None:
    same = "1" if right == "disc" else "2"
    rows = [("q1*", "0", "1", "0"), ("q2*", "0", same, "0")]
    rows += [("0", "q3*", "0", "0")] if right == "hollow-cylinder" else []
    told = workspace.region_told
    assert told_region(rows) == right and not refused(problem(arm(rows)).ask("workspace"))
    monkeypatch.setattr(workspace, "region_told", lambda *given: replace(told(*given), key=wrong))
    assert refused(problem(arm(rows)).ask("workspace")) == {"called"}


def told_region(rows: list[tuple[str, str, str, str]]) -> str:
    return problem(arm(rows)).ask("workspace").told(workspace.Facts).description.key


def test_a_measure_of_another_place(monkeypatch: pytest.MonkeyPatch) -> None:
    plant(monkeypatch, manipulability._at_point, "or Approximate(size)", "or Approximate(size * size)")
    asked = {"rows": ("vx", "vy"), "evaluate": {"q1": 0.3, "q2": 1.0}}
    found = problem(arm([("q1*", "0", "1", "0"), ("q2*", "0", "2", "0")])).ask("manipulability", **asked)
    assert "singular-values" in refused(found)


def test_a_law_of_twists_of_one_screw_through_the_origin(monkeypatch: pytest.MonkeyPatch) -> None:
    """q x omega is zero there, and no value tells it from omega x q."""
    plant(monkeypatch, exponentials.Exponentials._twist, "cross(q, w)", "cross(w, q)")
    screw = ScrewRow("z", (ZERO,) * 3, Symbol("q1"))
    one = Robot("", "standard", (Link(screw, "revolute", "q1"),), home=Motion((Move("translate", "x", ONE),)))
    assert "twist-of-any-screw" in refused(Problem("robot", one).ask("product-of-exponentials"))
