"""D turned round: its determinant, adjugate and inverse, in names and written out, for few joints."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.algebra.readable.form import readable, readable_matrix
from derive.algebra.scalar import Scalar
from derive.derivation import Derivation, Step
from derive.errors import NotDerivable
from derive.expression import Call, Expr, Matrix, Quotient, Symbol, replace
from derive.kinds.naming import entry_symbol
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import matrix_of, moment_names
from derive.kinds.robot._dynamics.rates import is_long

MOST_JOINTS = 3
MOST_REDUCED = 2  # joints; with more, fractions are not multiplied out
INERTIA = Symbol("D")
DET = Call("det", (INERTIA,))


@dataclass(frozen=True, slots=True)
class Turned:
    """`det` and `adjugate` in the names d_ij, and how to write such trees out: in full as a person would,
    or of a long arm by putting the entries of D where their names stand."""

    problem: Problem
    D: Matrix
    det: Expr
    adjugate: Matrix
    values: Mapping[Expr, Expr]
    long: bool

    def written(self, expr: Expr) -> Expr:
        """A tree in the names d_ij and others of `values`, with their values."""
        if self.long:
            return replace(expr, self.values)
        return self.problem.final(expr, self.values)

    def solved(self, expr: Expr, more: Mapping[Expr, Expr]) -> Expr:
        """The same with values for further names."""
        if self.long:
            return replace(expr, {**self.values, **more})
        return self.problem.final(expr, {**self.values, **more})

    @property
    def step(self) -> Step:
        """The determinant, in names and written out."""
        return Step("det", (DET, self.det, self.written(self.det)), "determinant")

    @property
    def inverse(self) -> Matrix:
        """D^-1 written out, every entry a fraction."""
        bottom = self.written(self.det)
        rows = (tuple(self.written(entry) for entry in row) for row in self.adjugate.rows)
        made = tuple(tuple(Quotient(entry, bottom) for entry in row) for row in rows)
        return Matrix(made) if self.long else self._short(Matrix(made))

    def _short(self, matrix: Matrix) -> Matrix:
        return self.problem.readable_matrix(normal_matrix(matrix, self.problem.names))


def turned(problem: Problem, motion: Derivation, what: str) -> Turned:
    """D of an arm with few joints. Raises NotDerivable for one with more, and where D has no inverse."""
    n = len(problem.subject.variables)
    if n > MOST_JOINTS:
        raise NotDerivable(f"{what} worked out for arms of at most {MOST_JOINTS} joints; this one has {n}")
    names = ScalarMatrix.of([[Scalar.symbol(entry_name(i, j)) for j in range(n)] for i in range(n)])
    D, inertia = matrix_of(motion, "D"), problem.ask("inertia-matrix")
    if not normal_matrix(D).det():
        raise NotDerivable("D is singular: some joint moves without moving a mass, give the links inertia")
    final: dict[Expr, Expr] = {Symbol(entry_name(i, j)): D.rows[i][j] for i in range(n) for j in range(n)}
    values = {**final, **moment_names(inertia)}
    long = n > MOST_REDUCED or is_long(problem)
    return Turned(problem, D, readable(names.det()), readable_matrix(names.adjugate()), values, long)


def entry_name(i: int, j: int) -> str:
    """d_12 for the entry of row 0 and column 1, and for its equal; indices from 0."""
    return entry_symbol("d", min(i, j) + 1, max(i, j) + 1).name
