"""Frames along the tree of their parents."""

from __future__ import annotations

import pytest

from derive.algebra.matrix import ScalarMatrix
from derive.errors import NotDerivable
from derive.expression import Symbol
from derive.mechanics.frame_tree import ancestry, local, relative, way
from derive.mechanics.frames import Frame, Frames
from derive.mechanics.motion import Motion, Move


def moved(number, parent):
    moves = (
        Move("rotate", "xyz"[number % 3], Symbol(f"q{number}")),
        Move("translate", "x", Symbol(f"a{number}")),
    )
    return Frame(number, parent, Motion(moves))


TREE = Frames((moved(1, 0), moved(2, 1), moved(3, 1), moved(4, 3)))


def test_ancestry():
    assert [frame.number for frame in ancestry(TREE, 4)] == [1, 3, 4]
    assert ancestry(TREE, 0) == ()
    with pytest.raises(NotDerivable, match="no frame 5"):
        ancestry(TREE, 5)


def test_way_meets_at_the_nearest_common_frame():
    path = way(TREE, 2, 4)
    assert ([f.number for f in path.up], [f.number for f in path.down], path.meeting) == ([2], [3, 4], 1)


@pytest.mark.parametrize(("source", "target"), [(2, 4), (4, 2), (0, 3), (3, 0), (4, 4)])
def test_there_and_back_is_the_identity(source, target):
    there, back = relative(TREE, source, target), relative(TREE, target, source)
    assert there @ back == ScalarMatrix.identity(4)


def test_relative_composes():
    assert relative(TREE, 2, 4) == relative(TREE, 1, 4) @ relative(TREE, 2, 1)
    assert relative(TREE, 2, 1) == local(TREE.frames[1])
