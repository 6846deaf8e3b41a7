"""The pose of a chain of screws as a product of exponentials, as steps."""

from __future__ import annotations

from collections.abc import Mapping
from functools import reduce
from typing import TYPE_CHECKING, Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import derivative, normal
from derive.algebra.numbers.floats import matrix_numbers, number
from derive.derivation import Claim, Record, Step
from derive.expression import (
    ZERO,
    Call,
    Expr,
    Indexed,
    Matrix,
    Product,
    Symbol,
    column,
    cross,
    free_symbols,
    multiply,
)
from derive.expression import add as total
from derive.kinds.checks import agreement, law
from derive.kinds.naming import with_named_entries
from derive.kinds.problem import Problem
from derive.kinds.values_at import completed
from derive.mechanics.poses import composed
from derive.mechanics.robot import Robot
from derive.mechanics.screws import Screw, home_of, screws_of
from derive.names import free

if TYPE_CHECKING:
    from numpy.typing import NDArray

LETTERS = {"omega": ("omega", "w", "n"), "q": ("q", "p", "c"), "S": ("S", "xi"), "M": ("M", "T_home")}
NOTHING = Symbol("0")  # three zeros
SERIES = 60  # terms of the exponential series; far more than angles of a few radians need


class ScrewsTold(Record):
    coupled: bool
    home: str  # a step
    direction: str  # the name of an axis
    point: str  # that of a point on one
    turn: tuple[Expr, Expr]  # the law of a twist
    slide: tuple[Expr, Expr]
    turning: tuple[int, ...]
    sliding: tuple[int, ...]
    helical: tuple[int, ...]
    whole: bool  # up to the end-effector
    base: bool
    product: str  # a step


class Exponentials:
    """A robot of screws written out up to row `last`; `whole` goes on to the end-effector. `frames` calls the
    motion of joint i also T_i^{i-1}: the base frame, fixed to link i at zero, is its frame i."""

    def __init__(
        self,
        problem: Problem,
        robot: Robot,
        last: int,
        whole: bool,
        frames: bool = True,
        name: Symbol | None = None,
    ) -> None:
        self.problem, self.robot, self.whole, self.frames = problem, robot, whole, frames
        self.screws = screws_of(robot)[:last]
        self.home = home_of(robot)
        self.base = composed(robot.base)
        self.name = name or Symbol(f"T_{last}^0")
        beginnings = {name.rstrip("0123456789").rstrip("_") for name in problem.taken}
        self.letters = {letter: free(beginnings, *names) for letter, names in LETTERS.items()}
        self.M = Symbol(self.letters["M"])

    @property
    def pose(self) -> ScalarMatrix:
        """T (4 by 4) in normal form."""
        T = reduce(ScalarMatrix.__matmul__, (screw.exponential for screw in self.screws), self.base)
        return T @ self.home if self.whole else T

    def steps(self) -> tuple[Step, ...]:
        """The axes and their points, the twists, the home pose, the exponentials, and their product."""
        return (
            *self._axes(),
            *map(self._twist, self.screws),
            *self.ends(),
            *self.motions(),
            *self._product(),
        )

    def _axes(self) -> list[Step]:
        found = []
        for screw in self.screws:
            for name, value in (
                (self._w(screw), screw.w),
                *(((self._q(screw), screw.q),) if turns(screw) else ()),
            ):
                found.append(Step(name.name, (name, self._written(value)), "screw-axis"))
        return found

    def _twist(self, screw: Screw) -> Step:
        name, w = self._S(screw), self._w(screw)
        if not turns(screw):
            blocks = Matrix(((w,), (NOTHING,)))
        else:
            along = (multiply(screw.row.pitch, w),) if screw.h else ()
            blocks = Matrix(((total(cross(self._q(screw), w), *along),), (w,)))
        return Step(name.name, (name, blocks, self._written(screw.S)), "twist")

    def ends(self) -> list[Step]:
        """T_base where there is one, and M."""
        base = (
            [Step("T_base", (Symbol("T_base"), self._written(self.base)), "motion")]
            if self.robot.base
            else []
        )
        home = [Step(self.M.name, (self.M, self._written(self.home)), "home")] if self.whole else []
        return [*base, *home]

    def motions(self) -> list[Step]:
        """T_1^0 = e^{[S_1] theta1} = ..., the motion of each joint."""
        found = []
        for screw in self.screws:
            chain: tuple[Expr, ...] = (self.exponential(screw), self._written(screw.exponential))
            name = Symbol(f"T_{screw.i}^{screw.i - 1}")
            if not self.frames or (self.whole and name == self.name):
                name = Symbol(f"E_{screw.i}")
            found.append(Step(name.name, (name, *chain), "exponential"))
        return found

    def _product(self) -> tuple[Step, ...]:
        factors: list[Expr] = [Symbol("T_base")] if self.robot.base else []
        factors += [self.exponential(screw) for screw in self.screws]
        factors += [self.M] if self.whole else []
        if len(factors) < 2:
            return ()
        matrix, entries = with_named_entries(self._written(self.pose))
        return Step(self.name.name, (self.name, Product(tuple(factors)), matrix), "compose"), *entries

    def definitions(self) -> dict[Expr, Expr]:
        """What the names in the steps stand for, the pose last."""
        found: dict[Expr, Expr] = {NOTHING: column((ZERO, ZERO, ZERO))}
        if self.robot.base:
            found[Symbol("T_base")] = self._written(self.base)
        for screw in self.screws:
            found |= {self._w(screw): self._written(screw.w), self._q(screw): self._written(screw.q)}
            found[self._S(screw)] = self._written(screw.S)
            found[self.exponential(screw)] = self._written(screw.exponential)
            if self.frames:
                found[Symbol(f"T_{screw.i}^{screw.i - 1}")] = found[self.exponential(screw)]
            else:
                found[Symbol(f"E_{screw.i}")] = found[self.exponential(screw)]
        if self.whole:
            found[self.M] = self._written(self.home)
        found |= {Symbol(step.name): step.result for step in self._product()[1:]}
        found[self.name] = self._written(self.pose)
        return found

    def claims(self) -> list[Claim]:
        """Each matrix is the exponential: it solves dE/dq = [S] E, and agrees with the series."""
        found = []
        for screw in self.screws:
            E, by = screw.exponential, screw.row.by
            for name in sorted(free_symbols(by) & set(self.problem.subject.variables)):
                rate = derivative(normal(by), name)
                size = "" if rate == 1 else "-" if rate == -1 else f"dphi_{screw.i}/d{name} "
                holds = E.diff(name) == (screw.bracket @ E).scaled(rate)
                found.append(law("derivative", holds, i=screw.i, name=name, size=size))
            found.append(self._series(screw))
        return found

    def _series(self, screw: Screw) -> Claim:
        def at(point: Mapping[str, float]) -> Mapping[str, float]:
            return completed(point, self.problem.where)

        return agreement(
            "exponential-series",
            self.problem.symbols,
            lambda point: matrix_numbers(screw.exponential, at(point)),
            lambda point: _series(matrix_numbers(screw.bracket, at(point)), number(screw.row.by, at(point))),
            i=screw.i,
        )

    def told(self) -> ScrewsTold:
        return ScrewsTold(
            coupled=self.problem.subject.coupled,
            home=self.M.name,
            direction=f"{self.letters['omega']}_i",
            point=f"{self.letters['q']}_i",
            turn=self._law(),
            slide=self._law(slide=True),
            turning=tuple(screw.i for screw in self.screws if turns(screw)),
            sliding=tuple(screw.i for screw in self.screws if not turns(screw)),
            helical=tuple(screw.i for screw in self.screws if screw.h),
            whole=self.whole,
            base=bool(self.robot.base),
            product=self.name.name if self._product() else "",
        )

    def exponential(self, screw: Screw) -> Indexed:
        """e^{[S_1] theta1}."""
        return Indexed("e", (), (multiply(Call("bracket", (self._S(screw),)), screw.row.by),))

    def _w(self, screw: Screw) -> Symbol:
        return Symbol(f"{self.letters['omega']}_{screw.i}")

    def _q(self, screw: Screw) -> Symbol:
        return Symbol(f"{self.letters['q']}_{screw.i}")

    def _S(self, screw: Screw) -> Symbol:
        return Symbol(f"{self.letters['S']}_{screw.i}")

    def _law(self, slide: bool = False) -> tuple[Expr, Expr]:
        """S_i = (q_i x omega_i, omega_i), or (omega_i, 0) of a slide."""
        S, w, q = (Symbol(f"{self.letters[letter]}_i") for letter in ("S", "omega", "q"))
        if slide:
            return S, Matrix(((w,), (ZERO,)))
        along = (multiply(Symbol("h_i"), w),) if any(screw.h for screw in self.screws) else ()
        return S, Matrix(((total(cross(q, w), *along),), (w,)))

    def _written(self, value: ScalarMatrix) -> Matrix:
        return self.problem.readable_matrix(value)


def turns(screw: Screw) -> bool:
    return not screw.row.slide


def _series(bracket: Any, by: float) -> NDArray[Any]:
    """1 + X + X^2/2 + ... of X = [S] q."""
    import numpy as np

    X = np.array(bracket, dtype=float) * by
    term = result = np.eye(4)
    for k in range(1, SERIES):
        term = term @ X / k
        result = result + term
    return result
