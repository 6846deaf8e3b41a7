"""Grübler's count against published examples, and what it cannot see."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.build import assemble
from derive.derivation import Derivation
from derive.errors import SheetErrors
from derive.render.document import Document
from derive.sheet.load import load_sheet
from derive.writing import render


def built(tmp_path: Path, mechanism: str) -> Document:
    sheet = tmp_path / "sheet.yaml"
    text = f"title: x\nproblems:\n- mechanism: {mechanism}\n  find: mobility\n"
    sheet.write_text(text, encoding="utf-8")
    return assemble(load_sheet(sheet))


def ask(tmp_path: Path, mechanism: str) -> Derivation:
    ((_, question),) = built(tmp_path, mechanism).questions()
    assert question.derivation
    assert all(claim.holds for claim in question.derivation.claims)
    return question.derivation


def dof(found: Derivation, name: str = "dof") -> int:
    return int(found.results[name].value)  # type: ignore[union-attr]


PUBLISHED = {
    # Lynch and Park, Modern Robotics, the examples of section 2.2
    "four-bar": ("{space: planar, bodies: 4, joints: [{revolute: 4}]}", 1),
    "slider-crank": ("{space: planar, bodies: 4, joints: [{revolute: 3}, {prismatic: 1}]}", 1),
    "five-bar": ("{space: planar, bodies: 5, joints: [{revolute: 5}]}", 2),
    "Stephenson": ("{space: planar, bodies: 6, joints: [{revolute: 7}]}", 1),
    "Watt": ("{space: planar, bodies: 6, joints: [{revolute: 7}]}", 1),
    "Watt with a pin for three bars": (
        "{space: planar, bodies: 6, joints: [{revolute: 5}, {revolute: 1, joining: 3}]}", 1),
    "overlapping joints": (
        "{space: planar, bodies: 8, joints: [{revolute: 6}, {revolute: 1, joining: 3}, {prismatic: 1}]}", 3),
    "four parallel bars": ("{space: planar, bodies: 5, joints: [{revolute: 6}]}", 0),
    "Delta": ("{space: spatial, bodies: 17, joints: [{revolute: 9}, {spherical: 12}]}", 15),
    "Stewart-Gough, UPS": (
        "{space: spatial, bodies: 14, joints: [{universal: 6}, {prismatic: 6}, {spherical: 6}]}", 6),
    "Stewart-Gough by its legs": ("{space: spatial, legs: [{chain: UPS, count: 6}]}", 6),
    # Siciliano et al. and others
    "planar serial arm": ("{space: planar, bodies: 4, joints: [{revolute: 3}]}", 3),
    "six-axis arm": ("{space: spatial, bodies: 7, joints: [{revolute: 6}]}", 6),
    "3-RRR, planar": ("{space: planar, bodies: 8, joints: [{revolute: 9}]}", 3),
    "spherical four-bar": ("{space: spherical, bodies: 4, joints: [{revolute: 4}]}", 1),
    "RSSR": ("{space: spatial, bodies: 4, joints: [{revolute: 2}, {spherical: 2}]}", 2),
    "RCCC": ("{space: spatial, bodies: 4, joints: [{revolute: 1}, {cylindrical: 3}]}", 1),
    "7R loop": ("{space: spatial, bodies: 7, joints: [{revolute: 7}]}", 1),
    "cam and follower": ("{space: planar, bodies: 3, joints: [{revolute: 2}, {constraints: 1}]}", 1),
    "3-RPS": ("{space: spatial, legs: [{chain: RPS, count: 3}]}", 3),
    "Hexaglide, PUS": ("{space: spatial, legs: [{chain: pus, count: 6}]}", 6),
}  # fmt: skip


@pytest.mark.parametrize("name", PUBLISHED)
def test_published_counts(tmp_path: Path, name: str) -> None:
    mechanism, expected = PUBLISHED[name]
    assert dof(ask(tmp_path, mechanism)) == expected


OVERCONSTRAINED = {
    "four-bar in space": (
        "{space: spatial, bodies: 4, joints: [{revolute: 4}]}", -2, {"planar": 1, "spherical": 1}),
    "Goldberg": ("{space: spatial, bodies: 5, joints: [{revolute: 5}]}", -1, {"planar": 2, "spherical": 2}),
    "Sarrus": ("{space: spatial, bodies: 6, joints: [{revolute: 6}]}", 0, {"planar": 3, "spherical": 3}),
    "slider-crank counted in space": (
        "{space: spatial, bodies: 4, joints: [{revolute: 3}, {prismatic: 1}]}", -2, {"planar": 1}),
}  # fmt: skip


@pytest.mark.parametrize("name", OVERCONSTRAINED)
def test_overconstrained_loops_are_named_as_such(tmp_path: Path, name: str) -> None:
    mechanism, expected, others = OVERCONSTRAINED[name]
    found = ask(tmp_path, mechanism)
    assert dof(found) == expected
    assert {space: int(count.value) for space, _, count in found.facts.others} == others
    page = render(built(tmp_path, mechanism), "md")
    assert "**Here the formula may fail**" in page


def test_known_moving_loops_are_named(tmp_path: Path) -> None:
    for bodies, name in ((4, "Bennett"), (5, "Goldberg"), (6, "Sarrus")):
        loop = f"{{space: spatial, bodies: {bodies}, joints: [{{revolute: {bodies}}}]}}"
        assert name in render(built(tmp_path, loop), "md")


def test_idle_rotations_are_named(tmp_path: Path) -> None:
    """Lynch and Park, section 2.2: six of the twelve freedoms of SPS legs are torsions."""
    found = ask(tmp_path, "{space: spatial, legs: [{chain: SPS, count: 6}]}")
    assert (dof(found), dof(found, "idle"), dof(found, "effective")) == (12, 6, 6)
    delta = "{space: spatial, bodies: 11, joints: [{revolute: 3}, {spherical: 12}], rods: 6}"
    found = ask(tmp_path, delta)
    assert (dof(found), dof(found, "idle"), dof(found, "effective")) == (9, 6, 3)
    assert "idle rotation" in render(built(tmp_path, delta.replace(", rods: 6", "")), "md")


def test_open_chains_are_exact(tmp_path: Path) -> None:
    page = render(built(tmp_path, "{space: spatial, bodies: 8, joints: [{revolute: 7}]}"), "md")
    assert "the formula is exact" in page
    assert "may fail" not in page


@pytest.mark.parametrize(
    ("mechanism", "said"),
    [
        ("{space: planar, bodies: 4, joints: [{spherical: 4}]}", "has no spherical joint"),
        ("{space: planar, bodies: 4, joints: [{revolut: 4}]}", "revolute"),
        ("{space: planar, bodies: 9, joints: [{revolute: 4}]}", "cannot hang together"),
        ("{space: planar, bodies: 4, joints: [{revolute: 4, prismatic: 1}]}", "both revolute and prismatic"),
        ("{space: planar, bodies: 4, joints: [{joining: 3}]}", "no sort of joint"),
        ("{space: planar, bodies: 4, joints: [{constraints: 5}]}", "at most 3 constraints"),
        ("{space: planar, joints: [{revolute: 4}]}", "'bodies' is missing"),
        ("{space: flat, bodies: 4, joints: [{revolute: 4}]}", "planar"),
        ("{space: planar, bodies: 4, joints: [{revolute: 0}]}", "at least 1"),
        ("{space: spatial, legs: [{chain: UXS, count: 6}]}", "has no joint X"),
        ("{space: spatial, bodies: 14, legs: [{chain: UPS, count: 6}]}", "follows from the legs"),
        ("{space: planar, legs: [{chain: RUR, count: 3}]}", "has no joint U"),
        ("{space: spatial, bodies: 3, joints: [{spherical: 3}], rods: 2}", "2 rods need 4 spherical joints"),
    ],
)
def test_faults_are_told(tmp_path: Path, mechanism: str, said: str) -> None:
    with pytest.raises(SheetErrors) as caught:
        built(tmp_path, mechanism)
    assert any(said in f"{error.message} {error.hint}" for error in caught.value.errors)


def test_no_figure_of_a_mechanism(tmp_path: Path) -> None:
    mechanism = "{space: planar, bodies: 4, joints: [{revolute: 4}]}\n  figure: true"
    with pytest.raises(SheetErrors, match="no drawing") as caught:
        built(tmp_path, mechanism)
    (fault,) = caught.value.errors
    assert fault.message == "there is no drawing of a mechanism"
    assert fault.place and fault.place.line == 4
