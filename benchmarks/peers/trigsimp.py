"""SymPy with the textbook's formulas, every entry expanded and given to `trigsimp`."""

from __future__ import annotations

from collections.abc import Sequence

import sympy

from benchmarks.cases import Asked
from benchmarks.peers import formulas
from benchmarks.peers.textbook import check, given

__all__ = ("check", "derive", "given")


def derive(given: formulas.Given, asked: Sequence[Asked]) -> formulas.Answer:
    return formulas.derive(given, asked, lambda entry: sympy.trigsimp(sympy.expand(entry)))
