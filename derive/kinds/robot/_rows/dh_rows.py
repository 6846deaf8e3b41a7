"""Rows of link parameters as an answer: their table, what stands before and after them, and the proof."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from dataclasses import replace as with_fields
from functools import reduce
from math import cos, sin
from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.algebra.numbers.arrays import arrays
from derive.algebra.numbers.floats import Point, number, numbers
from derive.derivation import Cell, Claim, Table, as_matrix
from derive.expression import MINUS_ONE, Expr, Indexed, Matrix, Symbol, free_symbols, replace
from derive.expression import number as tree
from derive.kinds.checks import route
from derive.kinds.fields import TREES
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import chain_of, oracle_of
from derive.kinds.work import Work
from derive.mechanics.dh import CONVENTIONS
from derive.mechanics.motion import Move
from derive.mechanics.oracle.poses import compose
from derive.mechanics.oracle.values import Array
from derive.mechanics.poses import composed
from derive.mechanics.robot import Convention, DHRow, JointType

COLUMNS = ("theta", "d", "a", "alpha")
IDENTITY = ScalarMatrix.identity(4)


@dataclass(frozen=True, slots=True)
class Rows:
    """Rows in a convention; each joint's variable (None of a fixed row) and type; the poses (4 by 4) of
    frame 0 in the base and of the end-effector in frame n."""

    convention: Convention
    rows: tuple[DHRow, ...]
    variables: tuple[str | None, ...]
    joints: tuple[JointType, ...]
    base: ScalarMatrix = IDENTITY
    tool: ScalarMatrix = IDENTITY

    def matrix(self, problem: Problem) -> Matrix:
        """theta, d, a, alpha of each row, the names of `where` replaced."""
        return Matrix(tuple(tuple(problem.final(entry) for entry in values(row)) for row in self.rows))

    @property
    def ends(self) -> dict[str, ScalarMatrix]:
        """T_base and T_tool (4 by 4), where they are no identity."""
        poses = {"T_base": self.base, "T_tool": self.tool}
        return {name: T for name, T in poses.items() if T != IDENTITY}

    def lines(self, work: Work) -> Work:
        """These poses as lines."""
        for name, T in self.ends.items():
            work = work.line(name, value=T, rule="motion")
        return work

    def table(self) -> Table:
        """Under theta_i, d_i, a_i, alpha_i (a_{i-1}, alpha_{i-1} where modified); joint variables starred."""
        before = self.convention == "modified"
        headings = [Indexed(name, (_index(before and name in ("a", "alpha")),)) for name in COLUMNS]
        lines = [
            (tree(i), *_starred(row, variable, joint))
            for i, (row, variable, joint) in enumerate(
                zip(self.rows, self.variables, self.joints, strict=True), 1
            )
        ]
        return Table((Symbol("i"), *headings), tuple(lines))

    def _counted(self) -> bool:
        """Whether the table has a_i and alpha_i, or those of the row before, as its convention does."""
        headings = (each for each in self.table().headings if isinstance(each, Indexed))
        before = {each.base for each in headings if each.lower != (Symbol("i"),)}
        return before == {"standard": set(), "modified": {"a", "alpha"}}[self.convention]

    def pose(self) -> ScalarMatrix:
        """T (4 by 4) of the end-effector by these rows."""
        made = [composed(CONVENTIONS[self.convention](row)) for row in self.rows]
        return self.base @ reduce(ScalarMatrix.__matmul__, made) @ self.tool

    def proved(self, work: Work) -> Work:
        """With the claims that the rows, between the ends on the board, make the arm that was given: by
        normal form, and in numbers."""
        problem, ends = work.problem, {name: normal_matrix(_printed(work, name)) for name in self.ends}
        base, tool = (ends.get(name, IDENTITY) for name in ("T_base", "T_tool"))
        T = with_fields(self, base=base, tool=tool).pose()
        exact, given = (
            normal_matrix(problem.readable_matrix(each), problem.names)
            for each in (T, chain_of(problem).T_tool)
        )
        work = work.law("pose", exact == given).law("columns", self._counted())
        return work.agrees(
            "arm-composed", problem.symbols, lambda at: self._typed(work, at)[-1], oracle_of(problem).tool
        )

    def _typed(self, work: Work, at: Point) -> list[Array]:
        """T_base, T_base A_1, ... and the pose of the end-effector in numbers, of everything as it is printed
        and by the entries that books have."""
        import numpy as np

        base, tool = (
            arrays(_printed(work, name), at) if name in self.ends else np.eye(4)
            for name in ("T_base", "T_tool")
        )
        found = [base]
        for row in self.matrix(work.problem).rows:
            found.append(found[-1] @ np.array(TYPED[self.convention](*(number(entry, at) for entry in row))))
        return [*found, found[-1] @ tool]

    def frames_seen(self, work: Work, base: tuple[Move, ...]) -> Work:
        """With the claim that the axes and origins that were found are those of the frames of these rows with
        all joints at zero; `base` is where the arm stands that they were found in."""
        home = dict.fromkeys((name for name in self.variables if name), 0.0)

        def rows(at: Point) -> Any:
            import numpy as np

            at = {**at, **home}
            stand = np.linalg.inv(compose(base, at))
            frames = [stand @ T for T in self._typed(work, at)[:-1]]
            return [[T[:3, 2], T[:3, 0], T[:3, 3]] for T in frames]

        def lines(at: Point) -> Any:
            told = {step.name: step.result for step in work.steps if step.chain}
            return [
                [numbers(told[f"{letter}_{i}"], {**at, **home}) for letter in "zxo"]
                for i in range(len(self.rows) + 1)
            ]

        return work.agrees("frames-seen", work.problem.symbols, lines, rows)

    def as_listed(self, table: Table) -> Claim:
        """That a table has these rows, counted from 1, each variable with its star, under headings with the
        indices that books give them."""
        lines = (each for k, line in enumerate(table.rows) for each in self._line(k, line))
        _, *headings = table.headings
        indices = [number(cell.lower[0], {"i": 2.0}) for cell in headings if isinstance(cell, Indexed)]
        return route(
            "table", (*lines, len(table.rows) == len(self.rows), indices == INDICES[self.convention])
        )

    def _line(self, k: int, line: tuple[Cell, ...]) -> Iterator[bool]:
        count, *cells = (cell for cell in line if isinstance(cell, TREES))
        name, joint = self.variables[k], self.joints[k]
        star: dict[Expr, Expr] = {Symbol(f"{name}*"): Symbol(f"{name}")}
        starred = [k for k, cell in enumerate(cells) if f"{name}*" in free_symbols(cell)]
        yield number(count, {}) == k + 1
        yield starred == ([] if name is None else [COLUMNS.index("d" if joint == "prismatic" else "theta")])
        yield tuple(replace(cell, star) for cell in cells) == values(self.rows[k])

    def each_pose(self, work: Work) -> Work:
        """With the claim that the rows as printed give the poses (4 by 4) of the links, by the entries that
        books print."""
        printed, typed = self.matrix(work.problem).rows, TYPED[self.convention]
        return work.agrees(
            "each-row",
            work.problem.symbols,
            lambda at: [typed(*(number(entry, at) for entry in row)) for row in printed],
            oracle_of(work.problem).local,
        )


def _printed(work: Work, name: str) -> Matrix:
    """The matrix in the line of this name."""
    return as_matrix(next(step.result for step in work.steps if step.name == name), name)


def _standard(theta: float, d: float, a: float, alpha: float) -> list[list[float]]:
    """T of frame i in frame i - 1 (Spong, Hutchinson, Vidyasagar, eq. 3.10, multiplied out)."""
    c, s, ca, sa = cos(theta), sin(theta), cos(alpha), sin(alpha)
    return [[c, -s * ca, s * sa, a * c], [s, c * ca, -c * sa, a * s], [0, sa, ca, d], [0, 0, 0, 1]]


def _modified(theta: float, d: float, a: float, alpha: float) -> list[list[float]]:
    """T of frame i in frame i - 1, a and alpha those of the axis before (Craig, eq. 3.6)."""
    c, s, ca, sa = cos(theta), sin(theta), cos(alpha), sin(alpha)
    return [[c, -s, 0, a], [s * ca, c * ca, -sa, -sa * d], [s * sa, c * sa, ca, ca * d], [0, 0, 0, 1]]


TYPED = {"standard": _standard, "modified": _modified}
INDICES = {"standard": [2, 2, 2, 2], "modified": [2, 2, 1, 1]}  # of theta, d, a, alpha in row 2


def values(row: DHRow) -> tuple[Expr, Expr, Expr, Expr]:
    return row.theta, row.d, row.a, row.alpha


def _index(before: bool) -> Expr:
    return Symbol("i") + MINUS_ONE if before else Symbol("i")


def _starred(row: DHRow, variable: str | None, joint: JointType) -> tuple[Expr, Expr, Expr, Expr]:
    """The row, its variable with a star where it is the joint's."""
    if variable is None:
        return values(row)
    star: dict[Expr, Expr] = {Symbol(variable): Symbol(f"{variable}*")}
    if joint == "prismatic":
        return row.theta, replace(row.d, star), row.a, row.alpha
    return replace(row.theta, star), row.d, row.a, row.alpha
