"""The robots of exercises/robots and the published poses of some of them."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

from ruamel.yaml import YAML

from derive.kinds.problem import Problem
from derive.mechanics.robot import Robot
from derive.sheet.reader import read
from derive.sheet.source import At
from derive.sheet.subject import read_subject
from derive.sheet.subjects.registry import Known, load

HERE = Path(__file__).parent
CATALOGUE = HERE.parents[1] / "exercises" / "robots"
ARMS = sorted(path.stem for path in CATALOGUE.glob("*.yaml"))
CASES = sorted(path.stem for path in (HERE / "cases").glob("*.yaml"))


def arm(name: str) -> Robot:
    """A robot of the catalogue."""
    at, known = At(read(CATALOGUE / f"{name}.yaml")), Known()
    built = load("robot").build(read_subject(at, "robot", known), at, known)
    assert isinstance(built, Robot)
    return built


@cache
def problem(name: str) -> Problem:
    """A problem about it, derived in once a session."""
    return Problem("robot", arm(name))


@cache
def case(name: str) -> dict[str, Any]:
    return dict(YAML(typ="safe").load((HERE / "cases" / f"{name}.yaml").read_text(encoding="utf-8")))


def points(name: str) -> list[tuple[dict[str, float], dict[str, Any]]]:
    """(values of all symbols, what is published there) of each pose."""
    found = case(name)
    return [({**found.get("values", {}), **pose["at"]}, pose) for pose in found["poses"]]


def last_pose(of: Problem) -> str:
    """T_n^0."""
    return f"T_{len(of.subject.links)}^0"


def tolerance(name: str) -> float:
    """How far a published pose may be off, in metres and in entries of a rotation."""
    return float(case(name).get("tolerance", 1e-9))
