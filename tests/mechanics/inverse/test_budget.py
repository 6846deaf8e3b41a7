"""A search ends by what it has tried, never by the clock: a sheet is answered or refused everywhere."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from dataclasses import replace
from functools import partial
from pathlib import Path

import pytest

from derive.algebra.solving.factors import TooLong
from derive.errors import NotDerivable
from derive.kinds.robot._chain import chain_of
from derive.kinds.robot._inverse import open_chain
from derive.kinds.robot._inverse.given import goal_of
from derive.kinds.robot._inverse.refused import no_closed_form
from derive.mechanics.budget import Budget
from derive.mechanics.inverse.plan import Search
from derive.mechanics.inverse.search import MOST_TERMS
from derive.names import free
from tests.kinds.robot.arms import ARMS

PACKAGE = Path(__file__).parents[3] / "derive"


def search(name: str, budget: Budget) -> Search:
    arm = ARMS[name]
    chain, problem = chain_of(arm.problem()), arm.problem()
    goal = goal_of(arm.given, chain, problem)
    points = open_chain.sample_points(chain, goal, problem, 2)
    return Search(chain, goal, points, partial(free, problem.taken | set(goal.names)), budget)


def test_what_is_spent_is_the_same_each_time() -> None:
    counts = []
    for _ in range(2):
        budget = Budget(MOST_TERMS)
        assert search("UR5", budget).plan().complete
        counts.append(MOST_TERMS - budget.left)
    assert counts[0] == counts[1] < MOST_TERMS / 50


@pytest.mark.parametrize("name", ["UR5", "PUMA 560", "3R"])
def test_a_spent_budget_is_said_in_other_words(name: str) -> None:
    here = search(name, Budget(300))
    plan = here.plan()
    assert plan.stopped and not plan.complete
    said = no_closed_form(plan, here.goal, ARMS[name].problem())
    assert "no closed form" not in said
    assert "given up after" in said and "a closed form may exist" in said


def test_a_stopped_search_is_refused(monkeypatch) -> None:
    monkeypatch.setattr(open_chain, "Budget", lambda most: Budget(300))
    arm = ARMS["UR5, symbolic"]
    with pytest.raises(NotDerivable, match="given up after"):
        replace(arm).problem().ask("inverse-kinematics", given=arm.given)


def test_more_than_the_budget_is_not_spent() -> None:
    budget = Budget(10)
    budget.spend(10)
    with pytest.raises(TooLong):
        budget.spend(1)


def test_nothing_that_is_derived_looks_at_the_clock() -> None:
    """The spinner of a terminal does, and the live page, which says how long a build took."""
    clocks = re.compile(r"\b(monotonic|perf_counter|process_time)\b")
    looking = {path.name for path in PACKAGE.rglob("*.py") if clocks.search(path.read_text(encoding="utf-8"))}
    assert looking == {"messages.py", "following.py"}


COMMAND = "from derive.cli import main; main()"
SHEET = """\
title: Same everywhere
problems:
- {robot: robots/ur5.yaml, find: inverse-kinematics, given: pose}
- {robot: robots/puma560.yaml, find: inverse-kinematics, given: pose}
"""


def test_same_bytes_for_every_hash_seed(tmp_path) -> None:
    shutil.copytree(PACKAGE.parent / "exercises" / "robots", tmp_path / "robots")
    (tmp_path / "same.yaml").write_text(SHEET, encoding="utf-8")
    pages = set()
    for seed in ("0", "1", "4711"):
        run = subprocess.run(
            [sys.executable, "-c", COMMAND, "build", "same.yaml", "--format", "json,md", "--output", seed],
            cwd=tmp_path, env={**os.environ, "PYTHONHASHSEED": seed}, capture_output=True, check=False,
        )  # fmt: skip
        assert run.returncode == 0, run.stderr.decode()
        pages.add(tuple((tmp_path / seed / f"same.{end}").read_bytes() for end in ("json", "md")))
    assert len(pages) == 1
