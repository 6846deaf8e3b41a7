"""What no page could hold is refused in time."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.algebra.scalar import Scalar
from derive.build import build
from derive.errors import NotDerivable, SheetErrors


def test_a_product_out_of_all_proportion_is_refused() -> None:
    long = sum((Scalar.symbol(f"x{i}") for i in range(60)), Scalar.of(0))
    with pytest.raises(NotDerivable, match="too long"):
        _ = long**8


def test_an_arm_of_symbols_only_is_refused(tmp_path: Path) -> None:
    row = "    - {{theta: q{i}*, d: d_{i}, a: a_{i}, alpha: al{i}}}\n"
    links = "".join(row.format(i=i) for i in range(1, 12))
    sheet = tmp_path / "sheet.yaml"
    sheet.write_text(f"title: t\nproblems:\n- robot:\n    links:\n{links}  find: forward-kinematics\n")
    with pytest.raises(SheetErrors) as caught:
        build([sheet], ["md"], None)
    assert "too long" in str(caught.value.errors[0])
