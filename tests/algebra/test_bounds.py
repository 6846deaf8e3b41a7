"""What no page could hold is refused in time."""

from __future__ import annotations

import resource
from pathlib import Path

import pytest

from derive.algebra import bounds
from derive.algebra.scalar import Scalar
from derive.build import build
from derive.errors import NotDerivable, SheetErrors

ARM = """\
title: t
problems:
- robot:
    links:
    - {theta: q1*, d: d_1, a: a_1, alpha: al1}
    - {theta: q2*, d: d_2, a: a_2, alpha: al2}
    - {theta: q3*, d: d_3, a: a_3, alpha: al3}
  find: forward-kinematics
"""


def twists(rows: int, kind: str) -> str:
    """An arm whose every pose has twice as many terms as the one before."""
    links = "".join(f"    - {{theta: q{i}*, d: 0, a: l{i}, alpha: 90 deg}}\n" for i in range(1, rows + 1))
    return f"title: t\nproblems:\n- robot:\n    links:\n{links}  find: {kind}\n"


def refused(sheet: Path, text: str) -> str:
    sheet.write_text(text)
    with pytest.raises(SheetErrors) as caught:
        build([sheet], ["md"], None)
    return str(caught.value.errors[0])


def test_thirty_twisted_rows_fill_no_memory(tmp_path: Path) -> None:
    """3.6 GB, before products were bounded as they are made."""
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    assert "too long: an expression of" in refused(tmp_path / "t.yaml", twists(30, "forward-kinematics"))
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 500_000  # kB


def test_work_is_counted_over_all_that_an_answer_rests_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(bounds, "MOST_WORK", 20_000)
    assert "million products" in refused(tmp_path / "t.yaml", twists(6, "jacobian"))
    assert "million products" in refused(tmp_path / "t.yaml", twists(6, "jacobian"))  # not less work again


def test_work_outside_an_answer_is_free(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(bounds, "MOST_WORK", 1)
    assert Scalar.symbol("x") * Scalar.symbol("y") == Scalar.symbol("y") * Scalar.symbol("x")


def test_a_product_out_of_all_proportion_is_refused() -> None:
    long = sum((Scalar.symbol(f"x{i}") for i in range(60)), Scalar.of(0))
    with pytest.raises(NotDerivable, match="too long"):
        _ = long**8


@pytest.mark.parametrize("bound", ["MOST_TERMS", "MOST_IN_ONE"])
def test_an_answer_longer_than_the_bound_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, bound: str
) -> None:
    monkeypatch.setattr(bounds, bound, 3)
    sheet = tmp_path / "sheet.yaml"
    sheet.write_text(ARM)
    with pytest.raises(SheetErrors) as caught:
        build([sheet], ["md"], None)
    assert "over 3 terms" in str(caught.value.errors[0])
