"""Lengths of links as seen along parallel axes, whichever way their rows are written."""

from __future__ import annotations

import pytest

from derive.algebra.infix import text
from derive.algebra.readable.form import readable
from derive.mechanics.chain import chain
from derive.mechanics.poses import position_part
from derive.mechanics.reach import planar_arm, swung_arm
from tests.mechanics.robots import robot, row


def lengths(arm) -> list[str]:
    return [text(readable(each)) for each in arm.lengths]


def reach(arm, kind):
    found = chain(arm)
    return kind(found, position_part(found.T_tool), len(found.T_local))


def test_an_arm_in_the_plane() -> None:
    arm = robot(row("q1*", "0", "l1", "0"), row("q2*", "0.2", "l2", "0"), row("q3*", "0", "l3", "180 deg"))
    assert lengths(reach(arm, planar_arm)) == ["l1", "l2", "l3"]


def test_a_link_with_an_offset_is_as_long_as_its_diagonal() -> None:
    arm = robot(row("q1*", "0", "3", "0"), row("30 deg", "0", "4", "0"), row("q2*", "0", "1", "0"))
    first, last = reach(arm, planar_arm).lengths
    assert (first * first).constant is None or float((first * first).constant) == pytest.approx(
        9 + 16 + 12 * 3**0.5
    )
    assert last == 1


def test_sliding_joints_have_no_fixed_lengths() -> None:
    assert reach(robot(row("q1*", "0", "l1", "90 deg"), row("0", "d2*", "0", "0")), planar_arm) is None


def test_the_anthropomorphic_arm_with_offsets() -> None:
    arm = robot(row("q1*", "d1", "a1", "90 deg"), row("q2*", "0", "a2", "0"), row("q3*", "d3", "a3", "0"))
    found = reach(arm, swung_arm)
    assert lengths(found) == ["a2", "a3"]
    assert (text(readable(found.offset)), text(readable(found.side))) == ("a1", "d3")
    assert [text(readable(entry)) for entry in found.center.entries] == ["0", "0", "d1"]
