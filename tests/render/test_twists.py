"""Twists as in Lynch and Park, Modern Robotics, with the angular velocity first: V = (omega, v) (eq. 3.70),
[Ad_T] = [R 0; [p]R R] (definition 3.20), S = (omega, -omega x q) (section 3.3.2), tau = J^T F with
F = (m, f) (section 5.2). The JSON has the linear half first in every style."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from derive.algebra.numbers import floats
from derive.build import assemble
from derive.derivation import Derivation
from derive.expression import Expr, Matrix, Product
from derive.render import twists
from derive.render.document import Document
from derive.render.page import render_markdown
from derive.sheet.load import load_sheet
from derive.writing import render

SHEET = """title: Twists
notation: {style: STYLE}
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: a1, alpha: 90 deg}
    - {theta: theta2*, d: 0, a: a2, alpha: 0}
  questions:
  - {find: jacobian}
  - {find: statics, rows: [vx, vy, vz, wx, wy, wz], force: [1, 2, 3, 4, 5, 6]}
  - {find: space-jacobian}
  - {find: space-jacobian, in: body}
  - {find: product-of-exponentials}
- frames:
  - {matrix: [[0, -1, 0, 1], [1, 0, 0, -1], [0, 0, 1, 2], [0, 0, 0, 1]]}
  find: change-of-frame
  twist: [1, 2, 3, 4, 5, 6]
  from: 1
  to: 0
"""
AT = {"theta1": 0.3, "theta2": -0.7, "a1": 1.1, "a2": 0.6}
Array = NDArray[np.float64]


def made(folder: Path, style: str) -> Document:
    path = folder / f"{style}.yaml"
    path.write_text(SHEET.replace("STYLE", style), encoding="utf-8")
    return assemble(load_sheet(path))


@pytest.fixture(scope="module")
def lynch(tmp_path_factory: pytest.TempPathFactory) -> Document:
    return made(tmp_path_factory.mktemp("twists"), "lynch")


def answer(document: Document, find: str, number: int = 0) -> Derivation:
    return [q.derivation for _, q in document.questions() if q.find == find and q.derivation][number]


def printed(answer: Derivation, rule: str) -> list[tuple[Expr, ...]]:
    """The lines of a rule, as this style prints them."""
    return [twists.line(step.rule, step.chain, answer) for step in answer.all_steps() if step.rule == rule]


def array(tree: Expr) -> Array:
    assert isinstance(tree, Matrix)
    return np.array([[floats.number(entry, AT) for entry in row] for row in tree.rows])


def cross(x: float, y: float, z: float) -> Array:
    return np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])


def test_a_jacobian_has_the_angular_rows_first(lynch: Document) -> None:
    found = answer(lynch, "jacobian")
    (chain,) = printed(found, "jacobian-columns")
    plain = found.results["J"]
    assert isinstance(plain, Matrix)
    assert np.allclose(array(chain[-1]), np.roll(array(plain), 3, axis=0))


def test_the_adjoint_is_that_of_the_book(lynch: Document) -> None:
    (chain,) = printed(answer(lynch, "change-of-frame"), "change-of-frame")
    product = next(
        link for link in chain if isinstance(link, Product) and isinstance(link.factors[1], Matrix)
    )
    adjoint, before = map(array, product.factors)
    R, p = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]]), cross(1, -1, 2)
    assert np.allclose(adjoint, np.block([[R, np.zeros((3, 3))], [p @ R, R]]))
    assert before.ravel().tolist() == [4, 5, 6, 1, 2, 3]
    assert np.allclose(array(chain[-1]), adjoint @ before)


def test_screws_and_jacobians_in_space_and_in_the_body(lynch: Document) -> None:
    chains = printed(answer(lynch, "product-of-exponentials"), "twist")
    for chain, (w, q) in zip(chains, (((0, 0, 1), (0, 0, 0)), ((0, -1, 0), (1.1, 0, 0))), strict=True):
        assert np.allclose(array(chain[-1]).ravel(), [*w, *-np.cross(w, q)])
    (space,) = printed(answer(lynch, "space-jacobian"), "twists")
    assert np.allclose(array(space[-1])[:3, 0], [0, 0, 1])
    (body,) = printed(answer(lynch, "space-jacobian", 1), "adjoint")
    blocks = next(link for link in body if isinstance(link, Product)).factors[0]
    assert isinstance(blocks, Matrix) and str(blocks.rows[0][1]) != str(blocks.rows[1][0])
    assert np.allclose(array(body[-1])[:3, 1], [0, 0, 1])  # the last joint turns about z of the tool


def test_a_wrench_begins_with_its_moment(lynch: Document) -> None:
    found = answer(lynch, "statics")
    (chain,) = printed(found, "virtual-work")
    product = next(
        link for link in chain if isinstance(link, Product) and isinstance(link.factors[1], Matrix)
    )
    transposed, wrench = map(array, product.factors)
    tau = found.results["tau"]
    assert isinstance(tau, Matrix)
    assert wrench.ravel().tolist() == [4, 5, 6, 1, 2, 3]
    assert np.allclose(transposed @ wrench, array(tau))


def test_the_page_says_so_and_the_results_stay(lynch: Document, tmp_path: Path) -> None:
    page = render_markdown(lynch)
    assert "with the angular part on top" in page and "with the linear part on top" not in page
    assert r"S_i = (\omega_i, q_i \times \omega_i)^T" in page
    assert "the coordinates $4$, $5$, $6$, $1$, $2$, $3$" in page
    assert r"e^{[S_1] \theta_1}" in page
    spong = made(tmp_path, "spong")
    ours, theirs = (json.loads(render(each, "json"))["problems"] for each in (lynch, spong))
    pairs = zip(ours, theirs, strict=True)
    assert all(
        [q["results"] for q in a["questions"]] == [q["results"] for q in b["questions"]] for a, b in pairs
    )
