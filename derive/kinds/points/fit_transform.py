"""The rotation and translation that fit one set of points to another."""

from __future__ import annotations

from typing import Literal

from derive.derivation import Derivation
from derive.kinds.fields import OptionsModel
from derive.kinds.points import _rows, _svd
from derive.kinds.points._data import Facts as Facts
from derive.kinds.problem import Problem
from derive.mechanics.fitting import PointPairs

CLAIMED = {"R": "as-told", "p": "as-told", "rms": "as-told"}


class Options(OptionsModel):
    """How the transform is fitted."""

    method: Literal["svd", "rows"] = "svd"
    """svd: the best rotation; rows: each row of the transform by itself, which need be no rotation."""


def claims_of(pairs: PointPairs, options: Options) -> tuple[str, ...]:
    """The keys of what is claimed."""
    own = ("eigenvector|angle", "orthogonal-in-floats") if options.method == "svd" else ("left-over",)
    return (*own, "as-told", "verdicts")


def derive(pairs: PointPairs, options: Options, problem: Problem) -> Derivation:
    """Least squares (Arun, Huang and Blostein, IEEE PAMI 9, 1987; by rows as in the lecture notes).

    Raises NotDerivable where the points leave the rotation, or a row, open.
    """
    if options.method == "svd":
        return _svd.fitted(pairs, problem)
    return _rows.fitted(pairs, problem)


def measures(pairs: PointPairs) -> dict[str, str]:
    """Points, their means and what is left over are lengths."""
    return dict.fromkeys(("a_m", "b_m", "p", "rms"), "m")
