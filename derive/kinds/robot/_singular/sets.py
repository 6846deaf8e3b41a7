"""Each singular set analysed: the rank of the Jacobian, and at its values the matrix itself, what it no
longer moves and what it no longer reaches."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from derive.algebra.generators import Root
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.readable.writing import opposite
from derive.algebra.roots_and_functions import in_single_angles
from derive.algebra.solving.factors import TooLong
from derive.algebra.solving.row_reduction import column_space, null_space
from derive.algebra.solving.row_reduction import rank as rank_of
from derive.algebra.substitution import pinned_matrix, rationalised
from derive.errors import NotDerivable
from derive.expression import Expr, Matrix, Symbol, free_symbols
from derive.kinds.problem import Problem
from derive.kinds.robot._determinants import mostly_negative
from derive.kinds.robot._singular.geometry import Look, Seeing
from derive.kinds.robot._singular.values import decided, signed, values_of
from derive.mechanics.strata import Stratum
from derive.mechanics.zeros import Zero

LONGEST_VECTOR = 12  # terms; a longer direction tells nobody anything
MOST_SHOWN = 4  # choices of values with the Jacobian of each
MOST_CHECKED = 4  # choices at which a rank is looked at in numbers


@dataclass(frozen=True, slots=True)
class Block:
    """A part of the Jacobian that decides on its own: its name, its value (m by n), the joint variables of
    its columns, the row names of its velocities, the frame they are seen in (0: base), and the point; nothing
    of these last two where the matrix is given and its arm is not."""

    name: str
    J: ScalarMatrix
    variables: tuple[str, ...]
    rows: tuple[str, ...]
    frame: int = 0
    seeing: Seeing | None = None

    @property
    def all_variables(self) -> tuple[str, ...]:
        """Those of the whole arm."""
        return self.seeing.chain.variables if self.seeing else self.variables

    @property
    def seen(self) -> Seeing:
        """The arm. Raises TypeError where none is known."""
        if self.seeing is None:
            raise TypeError("no arm has this matrix")
        return self.seeing


@dataclass(frozen=True, slots=True)
class Case:
    """One choice of values in a set: how it looks, and the Jacobian there (None where it is too long to be
    worth writing) with its rank, null space, range and lost directions."""

    values: tuple[tuple[Expr, Expr], ...]
    zeros: tuple[Zero, ...]
    looks: tuple[Look, ...] = ()
    J: ScalarMatrix | None = None
    rank: int = 0
    null: tuple[ScalarMatrix, ...] = ()
    range: tuple[ScalarMatrix, ...] = ()
    lost: tuple[ScalarMatrix, ...] = ()

    @property
    def conditions(self) -> tuple[Expr, ...]:
        """What must not be negative for the values to be real."""
        return tuple(zero.condition for zero in self.zeros if zero.condition is not None)


@dataclass(frozen=True, slots=True)
class Analysed:
    """A set: its equations written out and the values that are `decided`; the rank of the whole Jacobian (at
    every point of it that lies in no set of lower rank, where `exact`, else at most that); and its choices of
    values, `sampled` some of them where there are too many. `inner`: inside another set."""

    block: Block
    equations: tuple[Expr, ...]
    decided: tuple[tuple[Expr, Expr], ...]
    rank: int
    exact: bool
    cases: tuple[Case, ...]
    sampled: tuple[tuple[Zero, ...], ...]
    inner: bool = False

    @property
    def places(self) -> tuple[tuple[Zero, ...], ...]:
        """Values at which the rank can be seen."""
        return tuple(case.zeros for case in self.cases) or self.sampled


def analysed(problem: Problem, block: Block, found: Stratum, inner: bool) -> Analysed | None:
    """A set with its choices of values; None where it turns out that none is real. Where two solutions of an
    equation differ only in a direction, the Jacobian of the first."""
    place = found.locus
    variables = block.all_variables
    values = values_of(place, variables, problem.readable)
    if not values and place.fixed and not place.left:
        return None
    known = decided(place, variables, problem.readable)
    settled = {zero.variable for zero in known}
    steps = [each for each in (*place.fixed, *place.left) if each.variable not in settled]
    steps.sort(key=lambda each: variables.index(each.variable))
    equations = tuple(_positive(problem.readable(each.factor)) for each in steps) if not signed(place) else ()
    told = not signed(place) and (inner or len(values) > MOST_SHOWN)
    once = any(map(_turns_with_others, values))
    cases: tuple[Case, ...] = ()
    for zeros in () if told else values:
        case = _case(block, zeros, shown=not inner)
        alike = once and any(each.looks == case.looks for each in cases)
        cases = (*cases, case if inner or alike else _with_spaces(block, case))
    pairs = tuple((Symbol(zero.variable), zero.value) for zero in known)
    return Analysed(block, equations, pairs, found.rank, found.exact, cases, values[:MOST_CHECKED], inner)


def _turns_with_others(zeros: Iterable[Zero]) -> bool:
    """Whether a value is a direction that is no fixed one."""
    return any(zero.rule in ("direction", "triangle") and free_symbols(zero.value) for zero in zeros)


def _positive(tree: Expr) -> Expr:
    """An equation tree with the sign that reads better."""
    return opposite(tree) if mostly_negative(tree) else tree


def _case(block: Block, zeros: tuple[Zero, ...], shown: bool) -> Case:
    values = tuple((Symbol(zero.variable), zero.value) for zero in zeros)
    return Case(values, zeros, block.seeing.looks(zeros) if shown and block.seeing else ())


def _with_spaces(block: Block, case: Case) -> Case:
    """With the Jacobian, where it has a short form."""
    try:
        return _spaces(block, case)
    except (TooLong, NotDerivable, ZeroDivisionError):
        return case


def _spaces(block: Block, case: Case) -> Case:
    J = at_zeros(block.J, case.zeros)
    null, lost = null_space(J, block.variables), null_space(J.T, block.variables)
    spanned = column_space(J, block.variables)
    return Case(
        case.values,
        case.zeros,
        case.looks,
        J,
        rank_of(J),
        *(basis if all(map(_short, basis)) else () for basis in (null, spanned, lost)),
    )


def at_zeros(J: ScalarMatrix, zeros: Iterable[Zero]) -> ScalarMatrix:
    """The matrix where these hold, one after the other."""
    for zero in zeros:
        J = pinned_matrix(J, zero.variable, zero.at).map(rationalised)
    return ScalarMatrix.of(J.rows)


def _short(column: ScalarMatrix) -> bool:
    return not rooted(column) and sum(len(entry.numerator) for entry in column.entries) <= LONGEST_VECTOR


def rooted(matrix: ScalarMatrix) -> bool:
    """Whether it holds fractions, or roots that depend on the joint angles."""
    roots = {root.name for root in matrix.ring.roots if _turns(root)}
    return any(entry.denominator is not None or roots & set(entry.generators()) for entry in matrix.entries)


def _turns(root: Root) -> bool:
    return any(name.startswith(("cos(", "sin(")) for powers, _ in root.radicand for name, _ in powers)


def written(problem: Problem, matrix: ScalarMatrix) -> Matrix:
    """A matrix that may hold roots of sums of angles."""
    return problem.readable_matrix(matrix.map(in_single_angles) if matrix.ring.roots else matrix)
