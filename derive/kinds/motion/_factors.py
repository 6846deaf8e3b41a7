"""The factors of a motion: what each is called, the matrix it stands for, and how it is introduced."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.algebra.numbers.floats import completed, number
from derive.algebra.roots_and_functions import root
from derive.algebra.scalar import Scalar
from derive.derivation import Phrase, Step
from derive.errors import NotDerivable
from derive.expression import (
    MINUS_ONE,
    ONE,
    ZERO,
    Approximate,
    Expr,
    Indexed,
    Matrix,
    Number,
    Product,
    Quotient,
    Symbol,
    atan2,
    column,
    cos,
    free_symbols,
    multiply,
    sin,
    transpose,
)
from derive.kinds.chains import distinct
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.elementary import factor_name, homogeneous, rotation_matrix, skew, translation
from derive.mechanics.motion import Axis, Move
from derive.mechanics.poses import composed, pose, rotation_part, unit_vector
from derive.mechanics.sequences import Placing, in_product_order, placings
from derive.names import free

IDENTITY = Symbol("I")
PLAIN = (ZERO, ONE, MINUS_ONE)
NO_ROW = Symbol("0")  # three zeros side by side
LETTERS: dict[int, tuple[str, str]] = {3: ("R", ""), 4: ("Rot", "Trans")}


PLACED = {  # by the kind of move, and the side on which its factor is put
    ("rotate", "left"): "then-about-world", ("rotate", "right"): "then-about-current",
    ("translate", "left"): "then-along-world", ("translate", "right"): "then-along-current",
}  # fmt: skip


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
    """The factors of a motion in the order in which it is made; `size` is 3 for rotations, else 4. On the
    board stand the lines that introduce them."""

    size: Literal[3, 4]
    factors: tuple[Factor, ...]
    work: Work

    @property
    def moves(self) -> tuple[Move, ...]:
        return tuple(factor.move for factor in self.factors)

    def named(self, indices: Sequence[int]) -> Expr:
        """The product of the factors with these indices (from 0), by their names."""
        names = tuple(self.factors[i].name for i in indices)
        return Product(names) if len(names) > 1 else names[0]

    def placed(self) -> tuple[Phrase, ...]:
        """How each factor is multiplied on, and the product so far."""
        return tuple(map(self._placed, placings(self.moves)))

    def _placed(self, placing: Placing) -> Phrase:
        factor = self.factors[placing.index]
        if placing.side == "first":
            return Phrase("we-start", {"factor": factor.name})
        way = PLACED[factor.move.kind, placing.side]
        return Phrase(way, {"factor": factor.name, "product": self.named(placing.product)})


def factors_of(
    moves: Sequence[Move], problem: Problem, size: Literal[3, 4], rounded: bool = False
) -> Factors:
    """The factors of moves and the lines that introduce them; `rounded` writes irrational numbers of
    written axes as decimals. Raises NotDerivable for an axis of zero length."""
    axes = _axis_symbols(moves, problem)
    factors = []
    for i, move in enumerate(moves, 1):
        axis = axes[move.axis]
        name = factor_name(move, axis, LETTERS[size])
        factors.append(Factor(i, move, name, axis, _value(move, size)))
    work = Work(problem).knowing({NO_ROW: Matrix(((ZERO, ZERO, ZERO),))})
    work = work.showing(*_turned(moves, problem))
    for written, axis in axes.items():
        if not isinstance(written, str):
            work = _axis_line(work, axis, written, rounded)
    for factor in factors:
        if factor.name not in work.known:
            work = _factor_line(work, factor, size, rounded)
    return Factors(size, tuple(factors), work)


def _turned(moves: Sequence[Move], problem: Problem) -> Iterator[Step]:
    """The angle of a turn that is given by a quaternion, where it is the only move."""
    for move in moves if len(moves) == 1 else ():
        if move.quaternion is not None:
            w, *vector = move.quaternion
            length = problem.readable(root(sum((normal(part**2) for part in vector), Scalar.of(0))))
            name = Symbol(free(problem.taken, "theta", "alpha", "theta_q"))
            yield Step("turned", distinct((name, 2 * atan2(length, w), move.by)), "turned")


def _value(move: Move, size: int) -> ScalarMatrix:
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


def _axis_line(work: Work, name: Symbol, axis: tuple[Expr, Expr, Expr], rounded: bool) -> Work:
    """The unit vector along a written axis; and what the names of Rodrigues' formula stand for."""
    problem, S = work.problem, Indexed("S", (name,))
    unit = problem.readable_matrix(ScalarMatrix.column(unit_vector(axis)))
    length = root(sum((normal(part**2) for part in axis), Scalar.of(0)))
    middle = () if length == 1 else (_inverse(problem.readable(length)) * column(axis),)
    shown = rounded_matrix(unit, problem) if rounded else unit
    (x,), (y,), (z,) = unit.rows
    one = problem.readable_matrix(ScalarMatrix.identity(3))
    work = work.line(name, *middle, value=shown, rule="unit-vector")
    return work.knowing({name: unit, S: skew((x, y, z)), IDENTITY: one})


def _inverse(length: Expr) -> Expr:
    """1/length, a fraction turned over."""
    match length:
        case Product((Number(value), *rest)) if value > 0:
            return Number(1 / value) / multiply(*rest)
        case Quotient(top, bottom):
            return bottom / top
    return ONE / length


def _factor_line(work: Work, factor: Factor, size: int, rounded: bool) -> Work:
    """The matrix of a factor: as books have it about a coordinate axis, else by Rodrigues' formula."""
    move, label, problem = factor.move, f"{'R' if size == 3 else 'A'}_{factor.index}", work.problem
    formulas: tuple[Expr, ...] = ()
    if isinstance(move.axis, str):
        matrix = shown = _elementary(move.axis, move, size)
        plain = problem.readable_matrix(factor.value)
        if all(entry in PLAIN for row in plain.rows for entry in row):  # a quarter turn, or several
            matrix = shown = plain
    else:
        matrix = problem.readable_matrix(factor.value)
        shown = rounded_matrix(matrix, problem) if rounded else matrix
        if move.kind == "rotate":
            R = rodrigues(factor.axis, move.by)
            formulas = (R if size == 3 else homogeneous_blocks(R),)
    rule = "rodrigues" if formulas else "elementary"
    work = work.line(factor.name, *formulas, value=shown, rule=rule, label=label)
    return work.knowing({factor.name: matrix})


def _elementary(axis: str, move: Move, size: int) -> Matrix:
    if move.kind == "translate":
        return translation(axis, move.by)
    R = rotation_matrix(axis, move.by)
    return R if size == 3 else homogeneous(R)


def product_of(moves: Sequence[Move], size: int) -> ScalarMatrix:
    """R (3 by 3) or T (4 by 4) of moves about world and current axes."""
    T = composed(in_product_order(moves))
    return T if size == 4 else rotation_part(T)


def rodrigues(axis: Symbol, angle: Expr) -> Expr:
    """cos I + sin S_k + (1 - cos) k k^T."""
    outer = axis * transpose(axis)
    return (
        multiply(cos(angle), IDENTITY)
        + multiply(sin(angle), Indexed("S", (axis,)))
        + multiply(ONE - cos(angle), outer)
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
