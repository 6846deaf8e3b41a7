"""What is checked of every derivation: no claim is left out or empty, laws are tried, all reads as it is."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.algebra.readable.form import Reading, readable
from derive.algebra.scalar import Scalar
from derive.build import derive_all
from derive.derivation import Step
from derive.errors import NotAsWritten, SheetErrors
from derive.expression import Approximate, Call, Expr, Matrix, Symbol, negate, number, symbols, transpose
from derive.kinds.checks import agreement, law, route
from derive.kinds.links import links
from derive.kinds.motion import rotation_matrix
from derive.sheet.load import load_sheet

A, B, C, X = symbols("A B C x")
ONE_TURN = "title: t\nproblems:\n- motion: [{rotate: z, by: phi}]\n  find: rotation-matrix\n"


def matrix(*rows: tuple[int, ...]) -> Matrix:
    return Matrix(tuple(tuple(map(number, row)) for row in rows))


def test_what_was_tried_on_nothing_does_not_hold() -> None:
    assert not law("symmetric", ()).holds
    assert not route("rank", (True, False)).holds
    three = law("symmetric", (True, True, True))
    assert three.holds
    assert three.tried == 3


def test_an_agreement_counts_its_points() -> None:
    assert agreement("same", ["x"], lambda at: at["x"], lambda at: at["x"], points=4).tried == 4
    assert agreement("same", [], lambda _: 1.0, lambda _: 1.0).tried == 1


@pytest.mark.parametrize(("order", "holds"), [((B, A), True), ((A, B), False)])
def test_a_law_is_tried_in_its_instance_where_matrices_do_not_commute(
    order: tuple[Expr, Expr], holds: bool
) -> None:
    left, right = order
    rule = Step("law", (transpose(A * B), transpose(left) * transpose(right)), "law")
    instance: dict[Expr, Expr] = {A: matrix((1, 2), (0, 1)), B: matrix((3, 0), (1, 2))}
    (claim,) = links([Step(rule.name, rule.chain, "law", instance=instance)], {})
    assert (claim.holds, claim.tried, claim.link) == (holds, 1, True)


@pytest.mark.parametrize(("sign", "holds"), [(1, True), (-1, False)])
def test_a_law_without_a_normal_form_is_tried_in_numbers(sign: int, holds: bool) -> None:
    both = Call("atan2", (sign * A * B, A * C))
    instance: dict[Expr, Expr] = {A: X * X + 1, B: X, C: number(2)}
    (claim,) = links([Step("law", (Call("atan2", (B, C)), both), "law", instance=instance)], {})
    assert (claim.holds, claim.tried) == (holds, 3)


def test_a_name_beside_its_own_definition_is_no_claim() -> None:
    known: dict[Expr, Expr] = {A: matrix((1, 2))}
    assert links([Step("A", (A, matrix((1, 2))))], known) == ()
    assert links([Step("B", (B, matrix((1, 2))))], known) == ()
    (claim,) = links([Step("A", (A, matrix((1, 3))))], known)
    assert not claim.holds


def test_steps_of_the_same_name_are_compared_each() -> None:
    right, wrong = Step("x", (X, A + 0 * A, A)), Step("x", (X, A + A, A))
    assert [claim.holds for claim in links([wrong, right], {X: A})] == [False, True]


@pytest.mark.parametrize(("sign", "holds"), [(1, True), (-1, False)])
def test_what_a_name_of_none_comes_to_is_compared_in_letters_of_the_sheet(sign: int, holds: bool) -> None:
    step = Step(
        "end", (Call("cos", (Symbol("theta_4"),)), A * A - B * B, sign * (A - B) * (A + B)), "in-numbers"
    )
    (claim,) = links([step], {}, frozenset({"A", "B"}))
    assert claim.holds == holds
    assert links([step], {}, frozenset({"A"})) == ()


@pytest.mark.parametrize(("rounded", "holds"), [(1.4142135623730951, True), (1.4142035, False)])
def test_a_rounded_number_is_what_stands_before_it(rounded: float, holds: bool) -> None:
    (claim,) = links([Step("x", (X, Call("sqrt", (A,)), Approximate(rounded)))], {A: number(2)})
    assert (claim.holds, claim.by) == (holds, "floating-point")


@pytest.mark.parametrize("names", [("orthogonal", "never-made"), ("never-made|neither",)])
def test_an_answer_that_claims_less_than_its_kind_declares_is_refused(
    names: tuple[str, ...], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    sheet = tmp_path / "sheet.yaml"
    sheet.write_text(ONE_TURN)
    monkeypatch.setattr(rotation_matrix, "CLAIMS", ("orthogonal", "never-made|right-handed"), raising=False)
    derive_all([load_sheet(sheet)], True, lambda _: None)
    monkeypatch.setattr(rotation_matrix, "CLAIMS", names)
    with pytest.raises(SheetErrors) as refused:
        derive_all([load_sheet(sheet)], True, lambda _: None)
    assert "the answer failed its own check: 'never-made" in refused.value.errors[0].message


def test_a_value_that_is_written_as_another_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    read = Reading.scalar
    monkeypatch.setattr(Reading, "scalar", lambda self, value: negate(read(self, value)))
    with pytest.raises(NotAsWritten):
        readable(Scalar.symbol("x"))
    sheet = tmp_path / "sheet.yaml"
    sheet.write_text(ONE_TURN)
    with pytest.raises(SheetErrors) as refused:
        derive_all([load_sheet(sheet)], True, lambda _: None)
    assert len(refused.value.errors) == 1
    assert "the answer failed its own check" in refused.value.errors[0].message


def test_a_sign_that_is_left_open_is_written_by_its_name() -> None:
    from derive.mechanics.vanishing import _sign_of

    assert readable(_sign_of("q2") * Scalar.symbol("a")) == Symbol("sign(q2)") * Symbol("a")
