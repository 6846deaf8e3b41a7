"""What no page could hold is refused in time."""

from __future__ import annotations

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
