"""The pose that a question is about, as the folder of its subject says it in a module `_pose.py`; and its
rotation entry by entry, under the names r_11, r_12, ..."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from importlib import import_module
from itertools import product
from typing import TYPE_CHECKING, Any

from pydantic import Field

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.numbers.floats import Point
from derive.algebra.readable.operation_count import operations
from derive.algebra.scalar import Scalar
from derive.derivation import Derivation
from derive.errors import NotDerivable
from derive.expression import Expr, Symbol, add, free_symbols, number
from derive.kinds.fields import Evaluation, OptionsModel
from derive.kinds.pose._numbers import over
from derive.kinds.problem import Problem
from derive.mechanics.motion import Move
from derive.mechanics.oracle import elementary
from derive.mechanics.poses import rotation_part

if TYPE_CHECKING:
    from numpy.typing import NDArray

LONGEST_ENTRY = 8  # operations above which an entry is left by its name
LONGEST_VALUE = 25  # likewise for what is made of the entries


class PoseOptions(OptionsModel):
    """Of which frames the rotation is wanted, where the subject has several."""

    source: int | None = Field(default=None, alias="from", ge=0)  # the last one if left out
    """The frame that is turned; the last one if left out."""
    target: int = Field(default=0, alias="to", ge=0)
    """The frame that it is seen from."""
    evaluate: Evaluation = None


@dataclass(frozen=True)
class Given:
    """A pose: its name and that of its rotation, T (4 by 4) with the names of `where` kept, what it rests
    on, and the same in NumPy (4 by 4) at a point by another route."""

    problem: Problem
    name: Symbol
    rotation: Symbol
    T: ScalarMatrix
    uses: tuple[Derivation, ...]
    oracle: Callable[[Point], NDArray[Any]]
    place: Callable[[Point], Point] = dict  # of a point: where its names are those of a rotation
    every: bool = False  # every turn is asked for, not only the one by 0 to pi
    named: bool = False  # the entries are names, so that it is any rotation

    @cached_property
    def R(self) -> ScalarMatrix:
        """The rotation (3 by 3), names of `where` replaced."""
        return self.problem.exact(rotation_part(self.T))

    @cached_property
    def entries(self) -> dict[Expr, Expr]:
        """r_11, r_12, ... and what they are."""
        written = self.problem.readable_matrix(self.R).rows
        return {Symbol(f"r_{i + 1}{j + 1}"): written[i][j] for i, j in product(range(3), range(3))}

    @property
    def numeric(self) -> bool:
        """Whether every entry is a number."""
        return not any(map(free_symbols, self.entries.values()))

    @property
    def short(self) -> bool:
        """Whether entries may be written out where their names stand."""
        return all(operations(entry) <= LONGEST_ENTRY for entry in self.entries.values())

    def shows(self, value: Expr) -> bool:
        """Whether what is made of the entries may be written out."""
        return self.short and operations(value) <= LONGEST_VALUE

    def value(self, name: str) -> Scalar:
        """The entry of a name, `r_32`."""
        return self.R[int(name[2]) - 1, int(name[3]) - 1]

    @property
    def lacking(self) -> tuple[Scalar, Scalar, Scalar]:
        """The antisymmetric part of R as a vector, r_32 - r_23, ...: 2 sin(angle) times the axis."""
        R = self.R
        return R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]

    def half_turn(self) -> tuple[ScalarMatrix, tuple[Expr, ...]]:
        """Of a rotation by half a turn (R + 1)/2, which is k k^T, and k."""
        outer = (self.R + ScalarMatrix.identity(3)).scaled(Scalar.of(1) / 2)
        j = next(j for j in range(3) if outer[j, j] != 0)
        return outer, tuple(over(outer[i, j], outer[j, j], self.problem) for i in range(3))

    def turns(self, point: Point) -> NDArray[Any]:
        """R (3 by 3) at a point by the other route."""
        return self.oracle(point)[:3, :3]


def of_any_rotation(given: Given) -> Given:
    """The same names, of a rotation in which no two entries are alike, for formulas in names."""
    turn = Move("rotate", (number(1), number(2), number(-2)), number("11/10"))
    return replace(given, oracle=lambda _: elementary(turn, {}))


def given_pose(options: PoseOptions, problem: Problem, rotation_only: bool = True) -> Given:
    """The pose of the problem's subject. Raises NotDerivable where `from` and `to` make no sense."""
    if problem.name != "frames" and (options.source is not None or options.target):
        raise NotDerivable("'from' and 'to' choose among frames; this problem has none", "from")
    given: Given = import_module(f"derive.kinds.{problem.name}._pose").given(options, problem, rotation_only)
    return given


def diagonal() -> Expr:
    """The trace of R, in the names of its entries."""
    return add(*(Symbol(f"r_{i}{i}") for i in (1, 2, 3)))


def lacking() -> tuple[Expr, Expr, Expr]:
    """The same in the names of the entries."""
    pairs = (("r_32", "r_23"), ("r_13", "r_31"), ("r_21", "r_12"))
    one, two, three = (Symbol(plus) - Symbol(minus) for plus, minus in pairs)
    return one, two, three
