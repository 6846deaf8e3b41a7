"""The order of factors, and other sequences, against matrices multiplied in NumPy."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from derive.expression import number
from derive.mechanics.motion import Move
from derive.mechanics.sequences import equivalents, mode, order, placings

ANGLES = (0.3, 0.8, -1.1, 2.0)


def made(moves):
    R = np.eye(3)
    for move in moves:
        turn = Rotation.from_euler(move.axis, float(move.by.value)).as_matrix()
        R = turn @ R if move.about == "world" else R @ turn
    return R


def motions(length):
    for abouts in product(("world", "current"), repeat=length):
        yield tuple(
            Move("rotate", axis, number(str(by)), about)
            for axis, by, about in zip("xzyx", ANGLES, abouts, strict=False)
        )


@pytest.mark.parametrize("moves", [m for n in (1, 2, 3, 4) for m in motions(n)])
def test_the_product_in_order_is_the_motion(moves):
    R = np.eye(3)
    for index in order(moves):
        R = R @ Rotation.from_euler(moves[index].axis, float(moves[index].by.value)).as_matrix()
    assert np.allclose(R, made(moves))


@pytest.mark.parametrize("moves", [m for n in (2, 3, 4) for m in motions(n)])
def test_equivalent_sequences_end_in_the_same_place(moves):
    found = list(equivalents(moves))
    assert len(found) == 2 ** (len(moves) - 1) - 1
    assert len({each.moves for each in found}) == len(found)
    for each in found:
        assert np.allclose(made(each.moves), made(moves))
        assert each.mode in (mode(each.moves), "current", "world")


def test_sides():
    moves = next(motions(3))
    assert [placing.side for placing in placings(moves)] == ["first", "left", "left"]
    assert order(moves) == (2, 1, 0)


def test_many_moves_list_few_sequences():
    moves = tuple(Move("rotate", "xyz"[i % 3], number(i + 1)) for i in range(40))
    assert len(list(equivalents(moves))) == 7
