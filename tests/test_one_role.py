"""A letter has one role on a sheet: what is given as a number is no matrix on another of its pages, and no
cosine looks like a Christoffel symbol."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from derive.build import assemble, working_on
from derive.derivation import Derivation
from derive.expression import Call, Matrix, Symbol, walk
from derive.render.coordinates import speaks_of_q
from derive.render.document import Document
from derive.render.layout import Link
from derive.render.notation import Notation
from derive.render.printed import Printed
from derive.render.trig import SHORT, short_index
from derive.sheet.load import load_sheet
from tests.sheets import SHEETS

SHAPES = {"lagrange": {"r"}}  # a radius, where the positions of other problems are r: p stands beside it


def answers(document: Document) -> Iterator[Derivation]:
    for _, question in document.questions():
        yield from (worked.derivation for worked in question.order)


def matrices(document: Document) -> set[str]:
    """The names at the head of a line that ends in a matrix."""
    steps = (step for answer in answers(document) for step in answer.all_steps())
    chains = (step.chain for step in steps if step.chain and isinstance(step.chain[-1], Matrix))
    return {chain[0].name for chain in chains if isinstance(chain[0], Symbol)}


@pytest.mark.parametrize("path", SHEETS, ids=lambda path: path.stem)
def test_what_is_given_as_a_number_is_no_matrix(path: Path) -> None:
    sheet = load_sheet(path)
    given = frozenset[str]().union(*(working_on(problem).taken for problem in sheet.problems))
    assert given & matrices(assemble(sheet)) <= SHAPES.get(path.stem, set())


THREE = """title: Three links
problems:
- robot:
    links:
    - {{theta: theta1*, d: 0, a: a1, alpha: 0, mass: m1, com: [0, 0, 0], inertia: point}}
    - {{theta: theta2*, d: 0, a: a2, alpha: 0, mass: m2, com: [0, 0, 0], inertia: point}}
    - {{theta: theta3*, d: 0, a: a3, alpha: 0, mass: m3, com: [0, 0, 0], inertia: point}}
  questions: [{{find: forward-kinematics}}{more}]
"""


@pytest.mark.parametrize(("more", "short"), [("", "123"), (", {find: christoffel}", "")])
def test_a_cosine_is_not_called_as_a_symbol(tmp_path: Path, more: str, short: str) -> None:
    path = tmp_path / "three.yaml"
    path.write_text(THREE.format(more=more), encoding="utf-8")
    document = assemble(load_sheet(path))
    trees = (tree for answer in answers(document) for step in answer.all_steps() for tree in step.chain)
    calls = {
        node for tree in trees for node in walk(tree) if isinstance(node, Call) and node.function in SHORT
    }
    notation = document.problems[0].notation
    indices = {short_index(call.arguments[0], notation) for call in calls}
    assert {"1", "12"} <= indices
    assert {index for index in indices if len(index) == 3} == {short} - {""}


@pytest.mark.parametrize(("typed", "vector"), [("q_dot", True), ("q_i", True), ("q_1 q_i q", False)])
def test_points_called_q_are_no_joint_variables(typed: str, vector: bool) -> None:
    """Where q_1 is the point of a screw axis, q_i is any such point and q one of them."""
    links = (Link("=", name, Symbol(name)) for name in typed.split())
    printed = [Printed.inline(link.latex, (link,), Notation()) for link in links]
    assert speaks_of_q(printed) == vector
