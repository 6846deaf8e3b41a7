"""The factors of a motion: what each is called, the matrix it stands for, and how it is introduced."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Literal

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.algebra.numbers.floats import number
from derive.algebra.roots_and_functions import root
from derive.derivation import Record, Step
from derive.errors import NotDerivable
from derive.expression import (
    ONE,
    ZERO,
    Approximate,
    Expr,
    Indexed,
    Matrix,
    Product,
    Quotient,
    Sum,
    Symbol,
    column,
    cos,
    free_symbols,
    multiply,
    sin,
    subtract,
    transpose,
)
from derive.kinds.problem import Problem
from derive.kinds.values_at import completed
from derive.mechanics.elementary import factor_name, homogeneous, rotation_matrix, skew, translation
from derive.mechanics.motion import Axis, Move
from derive.mechanics.poses import pose, rotation_part, unit_vector
from derive.mechanics.sequences import placings
from derive.names import free

IDENTITY = Symbol("I")
NO_ROW = Symbol("0")  # three zeros side by side
LETTERS: dict[int, tuple[str, str]] = {3: ("R", ""), 4: ("Rot", "Trans")}


@dataclass(frozen=True, slots=True)
class Factor:
    """One move as a factor of the product: its place in the motion (from 1), its name, its value, the
    axis as it is called."""

    index: int
    move: Move
    name: Indexed
    axis: Symbol
    value: ScalarMatrix


@dataclass(frozen=True, slots=True)
class Factors:
    """The factors of a motion in the order in which it is made; `size` is 3 for rotations, else 4."""

    size: Literal[3, 4]
    factors: tuple[Factor, ...]
    steps: tuple[Step, ...]
    definitions: dict[Expr, Expr] = field(default_factory=dict)

    @property
    def moves(self) -> tuple[Move, ...]:
        return tuple(factor.move for factor in self.factors)

    def named(self, indices: Sequence[int]) -> Expr:
        """The product of the factors with these indices (from 0), by their names."""
        names = tuple(self.factors[i].name for i in indices)
        return Product(names) if len(names) > 1 else names[0]

    def product(self, indices: Sequence[int]) -> ScalarMatrix:
        """The matrix of that product."""
        total = ScalarMatrix.identity(self.size)
        for i in indices:
            total = total @ self.factors[i].value
        return total

    def told(self, rule: str) -> tuple[str, ...]:
        """The names of the steps of this rule."""
        return tuple(step.name for step in self.steps if step.rule == rule)

    def placed(self) -> tuple[Placed, ...]:
        """How each factor is multiplied on, and the product so far."""
        return tuple(
            Placed(
                move=self.factors[p.index].move.kind,
                side=p.side,
                factor=self.factors[p.index].name,
                product=self.named(p.product),
            )
            for p in placings(self.moves)
        )


class Placed(Record):
    move: str  # "rotate", "translate"
    side: str
    factor: Expr
    product: Expr  # so far


def factors_of(
    moves: Sequence[Move], problem: Problem, size: Literal[3, 4], rounded: bool = False
) -> Factors:
    """The factors of moves with the steps that introduce them; `rounded` writes irrational numbers of
    written axes as decimals. Raises NotDerivable for an axis of zero length."""
    axes = _axis_symbols(moves, problem)
    factors = []
    for i, move in enumerate(moves, 1):
        value = _value(move, problem, size)
        factors.append(
            Factor(i, move, factor_name(move, axes[move.axis], LETTERS[size]), axes[move.axis], value)
        )
    writer = _Writer(problem, size, rounded)
    steps = [writer.axis(axis, name) for axis, name in axes.items() if not isinstance(axis, str)]
    done: set[Expr] = set()
    for factor in factors:
        if factor.name not in done:
            steps.extend(writer.steps(factor))
        done.add(factor.name)
    return Factors(size, tuple(factors), tuple(steps), writer.definitions(factors, axes))


def _value(move: Move, problem: Problem, size: int) -> ScalarMatrix:
    try:
        T = pose(move)
    except ZeroDivisionError as error:
        raise NotDerivable("an axis of zero length has no direction") from error
    return T if size == 4 else rotation_part(T)


def _axis_symbols(moves: Sequence[Move], problem: Problem) -> dict[Axis, Symbol]:
    """x, y, z by their names; written axes k, or k_1, k_2, ..., by another letter where k is taken."""
    written = list(dict.fromkeys(move.axis for move in moves if not isinstance(move.axis, str)))
    letter = free(problem.taken, *"kuwn", "k_r")
    found: dict[Axis, Symbol] = {"x": Symbol("x"), "y": Symbol("y"), "z": Symbol("z")}
    for i, axis in enumerate(written, 1):
        found[axis] = Symbol(letter if len(written) == 1 else f"{letter}_{i}")
    return found


@dataclass(frozen=True, slots=True)
class _Writer:
    problem: Problem
    size: int
    rounded: bool

    def axis(self, axis: tuple[Expr, Expr, Expr], name: Symbol) -> Step:
        """The unit vector along a written axis."""
        unit = self._vector(axis)
        parts = [normal(part) for part in axis]
        length = root(parts[0] * parts[0] + parts[1] * parts[1] + parts[2] * parts[2])
        middle = (
            () if length == 1 else (Product((Quotient(ONE, self.problem.readable(length)), column(axis))),)
        )
        return Step(name.name, (name, *middle, self._rounded(unit)), "unit-vector")

    def steps(self, factor: Factor) -> list[Step]:
        name = f"{'R' if self.size == 3 else 'A'}_{factor.index}"
        if isinstance(factor.move.axis, str):
            return [Step(name, (factor.name, self._elementary(factor)), "elementary")]
        written = self._rounded(self.problem.readable_matrix(factor.value))
        if factor.move.kind == "translate":
            return [Step(name, (factor.name, written), "elementary")]
        formula = rodrigues(factor.axis, factor.move.by)
        middle = (formula,) if self.size == 3 else (homogeneous_blocks(formula),)
        return [Step(name, (factor.name, *middle, written), "rodrigues")]

    def definitions(self, factors: Sequence[Factor], axes: dict[Axis, Symbol]) -> dict[Expr, Expr]:
        found: dict[Expr, Expr] = {NO_ROW: Matrix(((ZERO, ZERO, ZERO),))}
        for axis, name in axes.items():
            if not isinstance(axis, str):
                vector = self._vector(axis)
                found[name] = vector
                found[Indexed("S", (name,))] = skew((vector.rows[0][0], vector.rows[1][0], vector.rows[2][0]))
                found[IDENTITY] = self.problem.readable_matrix(ScalarMatrix.identity(3))
        for factor in factors:
            found[factor.name] = (
                self._elementary(factor)
                if isinstance(factor.move.axis, str)
                else self.problem.readable_matrix(factor.value)
            )
        return found

    def _elementary(self, factor: Factor) -> Matrix:
        axis = str(factor.move.axis)
        if factor.move.kind == "translate":
            return translation(axis, factor.move.by)
        R = rotation_matrix(axis, factor.move.by)
        return R if self.size == 3 else homogeneous(R)

    def _vector(self, axis: tuple[Expr, Expr, Expr]) -> Matrix:
        return self.problem.readable_matrix(ScalarMatrix.column(unit_vector(axis)))

    def _rounded(self, matrix: Matrix) -> Expr:
        return rounded_matrix(matrix, self.problem) if self.rounded else matrix


def rodrigues(axis: Symbol, angle: Expr) -> Expr:
    """cos I + sin S_k + (1 - cos) k k^T."""
    outer = Product((axis, transpose(axis)))
    return Sum(
        (
            multiply(cos(angle), IDENTITY),
            multiply(sin(angle), Indexed("S", (axis,))),
            multiply(subtract(ONE, cos(angle)), outer),
        )
    )


def homogeneous_blocks(R: Expr) -> Matrix:
    """A 4 by 4 matrix of blocks, no translation."""
    return Matrix(((R, ZERO), (NO_ROW, ONE)))


def value_of(expr: Expr, problem: Problem) -> float | None:
    """The number a tree without symbols stands for; None where symbols are left."""
    known = completed({}, problem.where)
    return number(expr, known) if free_symbols(expr) <= known.keys() else None


def rounded(entry: Expr, problem: Problem) -> Expr:
    """A number without symbols as a decimal, unless it is 0, 1 or -1; anything else as it is."""
    value = value_of(entry, problem)
    if value is None or normal(entry, problem.names).constant in (0, 1, -1):
        return entry
    return Approximate(value)


def rounded_matrix(matrix: Matrix, problem: Problem) -> Matrix:
    """Entry by entry."""
    return Matrix(tuple(tuple(rounded(entry, problem) for entry in row) for row in matrix.rows))
