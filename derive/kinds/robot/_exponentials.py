"""The pose of a chain of screws as a product of exponentials, as steps."""

from __future__ import annotations

from collections.abc import Mapping
from functools import reduce
from typing import TYPE_CHECKING, Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.numeric import matrix_numbers, number
from derive.derivation import Claim, Step
from derive.expression import ZERO, Call, Expr, Indexed, Matrix, Product, Symbol, column, cross, multiply
from derive.expression import add as total
from derive.kinds.checks import agreement, law
from derive.kinds.naming import with_named_entries
from derive.kinds.problem import Problem
from derive.kinds.values_at import completed
from derive.mechanics.poses import composed
from derive.mechanics.robot import Robot
from derive.mechanics.screws import Screw, home_of, screws_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

M = Symbol("M")
NOTHING = Symbol("0")  # three zeros
SERIES = 60  # terms of the exponential series; far more than angles of a few radians need


class Exponentials:
    """A robot of screws written out up to row `last`; `whole` goes on to the end-effector."""

    def __init__(self, problem: Problem, robot: Robot, last: int, whole: bool) -> None:
        self.problem, self.robot, self.whole = problem, robot, whole
        self.screws = screws_of(robot)[:last]
        self.home = home_of(robot)
        self.base = composed(robot.base)
        self.name = Symbol(f"T_{last}^0")

    @property
    def pose(self) -> ScalarMatrix:
        """T (4 by 4) in normal form."""
        T = reduce(ScalarMatrix.__matmul__, (screw.exponential for screw in self.screws), self.base)
        return T @ self.home if self.whole else T

    def steps(self) -> tuple[Step, ...]:
        """The axes and their points, the twists, the home pose, the exponentials, and their product."""
        return (*self._axes(), *map(self._twist, self.screws), *self.ends(), *self.motions(), *self._product())

    def _axes(self) -> list[Step]:
        found = []
        for screw in self.screws:
            for name, value in ((_w(screw), screw.w), *(((_q(screw), screw.q),) if turns(screw) else ())):
                facts = {"joint": screw.i}
                found.append(Step(name.name, (name, self._written(value)), "screw-axis", facts))
        return found

    def _twist(self, screw: Screw) -> Step:
        name, w = Symbol(f"S_{screw.i}"), _w(screw)
        if not turns(screw):
            blocks = Matrix(((w,), (NOTHING,)))
        else:
            along = (multiply(screw.row.pitch, w),) if screw.h else ()
            blocks = Matrix(((total(cross(_q(screw), w), *along),), (w,)))
        return Step(name.name, (name, blocks, self._written(screw.S)), "twist", {"joint": screw.i})

    def ends(self) -> list[Step]:
        """T_base where there is one, and M."""
        base = [Step("T_base", (Symbol("T_base"), self._written(self.base)), "motion")] if self.robot.base else []
        home = [Step("M", (M, self._written(self.home)), "home")] if self.whole else []
        return [*base, *home]

    def motions(self) -> list[Step]:
        """T_1^0 = e^{[S_1] theta1} = ..., the motion of each joint."""
        found = []
        for screw in self.screws:
            name = Symbol(f"T_{screw.i}^{screw.i - 1}")
            chain = (exponential(screw), self._written(screw.exponential))
            if name != self.name or not self.whole:  # else the name is that of the whole
                chain = (name, *chain)
            found.append(Step(name.name if chain[0] == name else "e_1", chain, "exponential", {"i": screw.i}))
        return found

    def _product(self) -> tuple[Step, ...]:
        factors: list[Expr] = [Symbol("T_base")] if self.robot.base else []
        factors += [exponential(screw) for screw in self.screws]
        factors += [M] if self.whole else []
        if len(factors) < 2:
            return ()
        matrix, entries = with_named_entries(self._written(self.pose))
        facts = {"entries": [step.name for step in entries]}
        return Step(self.name.name, (self.name, Product(tuple(factors)), matrix), "compose", facts), *entries

    def definitions(self) -> dict[Expr, Expr]:
        """What the names in the steps stand for, the pose last."""
        found: dict[Expr, Expr] = {NOTHING: column((ZERO, ZERO, ZERO))}
        if self.robot.base:
            found[Symbol("T_base")] = self._written(self.base)
        for screw in self.screws:
            found |= {_w(screw): self._written(screw.w), _q(screw): self._written(screw.q)}
            found[Symbol(f"S_{screw.i}")] = self._written(screw.S)
            found[exponential(screw)] = self._written(screw.exponential)
            found[Symbol(f"T_{screw.i}^{screw.i - 1}")] = found[exponential(screw)]
        if self.whole:
            found[M] = self._written(self.home)
        found[self.name] = self._written(self.pose)
        return found

    def claims(self) -> list[Claim]:
        """Each matrix is the exponential: it solves dE/dq = [S] E, and agrees with the series."""
        found = []
        for screw in self.screws:
            E, name = screw.exponential, self.robot.links[screw.i - 1].variable or ""
            found.append(law(f"dE_{screw.i}/d{name} = [S_{screw.i}] E_{screw.i}", E.diff(name) == screw.bracket @ E))
            found.append(self._series(screw))
        return found

    def _series(self, screw: Screw) -> Claim:
        def at(point: Mapping[str, float]) -> Mapping[str, float]:
            return completed(point, self.problem.where)

        return agreement(
            f"e^[S_{screw.i}] agrees with the exponential series",
            self.problem.symbols,
            lambda point: matrix_numbers(screw.exponential, at(point)),
            lambda point: _series(matrix_numbers(screw.bracket, at(point)), number(screw.row.by, at(point))),
        )

    def facts(self) -> dict[str, Any]:
        """What the words need."""
        return {
            "by_screws": True,
            "turning": [screw.i for screw in self.screws if turns(screw)],
            "sliding": [screw.i for screw in self.screws if not turns(screw)],
            "helical": [screw.i for screw in self.screws if screw.h],
            "whole": self.whole,
            "base": bool(self.robot.base),
            "product": self.name.name if len(self.screws) + self.whole + bool(self.robot.base) > 1 else "",
        }

    def _written(self, value: ScalarMatrix) -> Matrix:
        return self.problem.readable_matrix(value)


def exponential(screw: Screw) -> Indexed:
    """e^{[S_1] theta1}."""
    return Indexed("e", (), (multiply(Call("bracket", (Symbol(f"S_{screw.i}"),)), screw.row.by),))


def turns(screw: Screw) -> bool:
    return not screw.row.slide


def _w(screw: Screw) -> Symbol:
    return Symbol(f"omega_{screw.i}")


def _q(screw: Screw) -> Symbol:
    return Symbol(f"q_{screw.i}")


def _series(bracket: Any, by: float) -> NDArray[Any]:
    """1 + X + X^2/2 + ... of X = [S] q."""
    import numpy as np

    X = np.array(bracket, dtype=float) * by
    term = result = np.eye(4)
    for k in range(1, SERIES):
        term = term @ X / k
        result = result + term
    return result
