"""What is known while an arm is solved: sums of angles about parallel axes."""

from __future__ import annotations

from derive.algebra.angles import Form
from derive.mechanics.chain import chain
from derive.mechanics.inverse.known import Knowledge, singles
from tests.kinds.robot.arms import ARMS


def known(name: str) -> Knowledge:
    arm = chain(ARMS[name].robot)
    return Knowledge.of(arm, arm.variables)


def form(*names: str) -> Form:
    return Form.of(dict.fromkeys(names, 1))


def test_runs_of_parallel_axes() -> None:
    runs = [[atom for atom, _ in run.parts] for run in known("UR5").runs]
    assert runs == [["theta1"], ["theta2", "theta3", "theta4"], ["theta5"], ["theta6"]]


def test_antiparallel_axes_count_backwards() -> None:
    (run,) = known("SCARA").runs
    assert dict(run.parts) == {"theta1": 1, "theta2": 1, "theta4": -1}


def test_what_follows_from_sums() -> None:
    here = known("3R").after(form("theta1", "theta2", "theta3")).after(form("theta2"))
    assert here.knows(form("theta1", "theta3"))
    assert not here.knows_joint("theta1")
    assert not here.complete
    assert here.after(form("theta1")).complete


def test_sums_that_differ_by_a_known_one_are_sought_once() -> None:
    here = known("3R").after(form("theta1", "theta2", "theta3"))
    assert list(here.sought()) == [form("theta1"), form("theta2"), form("theta3")]


def test_displacements() -> None:
    here = known("cylindrical")
    assert here.slides == ("d2", "d3")
    assert not here.after(form("theta1")).after("d2").complete
    assert here.after(form("theta1")).after("d2").after("d3").complete


def test_single_angles() -> None:
    names = [str(each) for each in singles(chain(ARMS["3R"].robot)).angles]
    assert names == ["theta1", "theta2", "theta3"]
