"""Every node of a tree in every shape, in each place of every other, as its LaTeX is read."""

from __future__ import annotations

import pytest

from derive.read_back import read_back
from derive.render.latex import latex
from derive.render.notation import Notation
from derive.render.printed import Printed, Said, says
from tests.render.shapes import LEAVES, SHAPES, nested

NOTATIONS = {"short": Notation(), "long, x first": Notation("xy", "long", 4)}
WITHOUT_VALUE = ("is not real", "too large", "negative number", "plain number")


@pytest.mark.parametrize("notation", NOTATIONS.values(), ids=NOTATIONS)
def test_what_is_printed_is_read_as_it_was(notation: Notation) -> None:
    count = 0
    for name, tree in nested():
        written = latex(tree, notation)
        said = Said(name, None, (Printed.inline(written, says(tree, written), notation),))
        reading = read_back([said])
        assert all(any(why in doubt for why in WITHOUT_VALUE) for doubt in reading.unread), reading.unread
        count += reading.read
    assert count > 0.97 * (len(LEAVES) + len(SHAPES)) * len(SHAPES)
