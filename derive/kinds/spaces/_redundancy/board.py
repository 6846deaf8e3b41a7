"""A board whose lines have two values: by exact arithmetic, as they are written, and by NumPy.

Numbers that are not short are written as decimals, all lines together: then the matrices a question begins
with are rounded to fifteen places, and what follows is computed from these.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Any, TypeAlias

from derive.algebra.infix import text
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.numbers.arrays import arrays
from derive.algebra.numbers.floats import Point, matrix_numbers, scalar_number
from derive.algebra.rationals import significant_digits
from derive.algebra.scalar import Scalar
from derive.algebra.solving.factors import common_factor
from derive.algebra.solving.row_reduction import eliminated
from derive.errors import NotDerivable
from derive.expression import (
    ONE,
    ZERO,
    Approximate,
    Call,
    Expr,
    Matrix,
    Number,
    Product,
    Symbol,
    free_symbols,
    rebuild,
    walk,
)
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.names import free

PLACES = 15
NOTHING = 1e-11  # what rounding leaves of a zero
SMALL = 1e-9  # a singular value that is none, beside the largest
SHORT, DIGITS, COUNT = 16, 4, 999  # of one number: letters, digits of a decimal, parts of a fraction
LONGEST = 2500  # letters of a matrix
TOO_LONG = "the formulas are too long to be written; give more values under evaluate"


class Seen(dict[Expr, Any]):
    """What names stand for at a point, by NumPy."""

    def __init__(self, point: Point) -> None:
        super().__init__()
        self.point = point

    def of(self, tree: Expr) -> Any:
        """A matrix the author typed, in numbers."""
        return arrays(tree, self.point)


Again: TypeAlias = Callable[[Seen], Any]


@dataclass(frozen=True)
class Board:
    """`values` are exact, `again` finds each name by NumPy in terms of those before it. Numbers are
    `rounded`, or written as `decimals` that end."""

    work: Work
    rounded: bool = False
    decimals: bool = False
    values: Mapping[Expr, ScalarMatrix] = field(default_factory=dict)
    again: Mapping[Expr, Again] = field(default_factory=dict)
    results: Mapping[Expr, Matrix] = field(default_factory=dict)
    fractions: Mapping[Expr, tuple[ScalarMatrix, Scalar | None]] = field(default_factory=dict)
    told: tuple[tuple[Expr, Expr], ...] = ()  # what is said in sentences, behind a name for it

    @property
    def problem(self) -> Problem:
        return self.work.problem

    def __getitem__(self, name: Expr) -> ScalarMatrix:
        return self.values[name]

    def line(
        self,
        name: Expr,
        *formulas: Expr,
        value: ScalarMatrix,
        again: Again,
        label: str,
        rule: str = "",
        entries: tuple[Symbol, ...] = (),
        over: Scalar | None = None,
    ) -> Board:
        """A line more, the value `over` a scalar that is written in front; `again` is it by NumPy, `entries`
        are what those of a long column are called."""
        whole, below = self._cancelled(value, over) if over is not None else (value, None)
        written = result = self.written(whole)
        shown: Expr = written.rows[0][0] if value.shape == (1, 1) else written
        if below is not None:
            value = whole.map(lambda entry: entry / below)
            shown, result = self._over(written, below, value)
        work = self.work.line(
            name,
            *formulas,
            value=shown,
            label=label,
            rule="in-numbers" if self.rounded else rule,
            entries={(k, 0): each for k, each in enumerate(entries)},
        )
        named = zip(entries, (row[0] for row in written.rows), strict=False)
        work = work.knowing(dict[Expr, Expr](named))
        if below is not None and isinstance(name, Symbol):
            work = work.knowing({name: result})
        return replace(
            self,
            work=work,
            values={**self.values, name: value},
            again={**self.again, name: again},
            results={**self.results, name: result},
            fractions={**self.fractions, name: (whole, below)},
        )

    def _cancelled(self, value: ScalarMatrix, over: Scalar) -> tuple[ScalarMatrix, Scalar | None]:
        """Without what all share; the whole matrix where nothing but a number is left below."""
        m, n = value.shape
        if over.constant is None:
            _, (over, *rest) = common_factor([over, *value.entries], self.problem.style.order)
            value = ScalarMatrix.of(rest[i * n : (i + 1) * n] for i in range(m))
        if over.constant is None:
            return value, over
        return ScalarMatrix.of([entry / over for entry in row] for row in value.rows), None

    def _over(self, written: Matrix, below: Scalar, value: ScalarMatrix) -> tuple[Expr, Matrix]:
        """With the scalar in front of the matrix, and in each of its entries that it does not divide."""
        scalar = self.problem.readable(below)
        plain = self.written(value.map(lambda entry: Scalar.of(0) if entry.denominator else entry))
        rows = (zip(*pair, strict=True) for pair in zip(plain.rows, written.rows, strict=True))
        result = Matrix(tuple(tuple(_divided(whole, top, scalar) for whole, top in row) for row in rows))
        one = written.shape == (1, 1)
        return result.rows[0][0] if one else Product((ONE / scalar, written)), result

    def begin(self, name: Expr, value: ScalarMatrix, again: Again, label: str, rule: str) -> Board:
        """A line of what the question gives."""
        return self.line(name, value=self.near(value), again=again, label=label, rule=rule)

    def near(self, value: ScalarMatrix) -> ScalarMatrix:
        """The matrix to work with: with rational numbers where all is rounded."""
        return ScalarMatrix.of(map(map_rational, value.rows)) if self.rounded else value

    def meanings(self, point: Point) -> dict[Expr, Any]:
        """Every name at a point; a matrix of one entry is a number."""
        import numpy as np

        found = Seen(point)
        for name, again in self.again.items():
            found[name] = again(found)
        return {name: float(np.squeeze(each)) if np.size(each) == 1 else each for name, each in found.items()}

    def written(self, value: ScalarMatrix) -> Matrix:
        """As it stands on the page. Raises NotDerivable where it would fill one."""
        plain = self.problem.readable_matrix(value)
        if not self.rounded and sum(len(text(each)) for row in plain.rows for each in row) > LONGEST:
            raise NotDerivable(TOO_LONG)
        change = _rounded if self.rounded else _ending if self.decimals else None
        return Matrix(tuple(tuple(map(change, row)) for row in plain.rows)) if change else plain

    def knowing(self, name: Symbol, value: ScalarMatrix, again: Again) -> Board:
        """With a name that stands in lines and has none of its own."""
        work = self.work.knowing({name: self.written(value)})
        return replace(
            self,
            work=work,
            values={**self.values, name: value},
            again={**self.again, name: again},
        )

    def saying(self, value: Fraction, again: Again) -> tuple[Board, Expr]:
        """With a number that stands in a sentence, as it is written there."""
        name, written = (
            Symbol(f"told {len(self.told)}"),
            self.written(ScalarMatrix.column([value])).rows[0][0],
        )
        return replace(self, told=(*self.told, (name, written)), again={**self.again, name: again}), written

    def counts(self, entry: Scalar) -> bool:
        """Whether it is more than rounding leaves of a zero."""
        if not self.rounded or entry.constant is None:
            return bool(entry)
        return abs(scalar_number(entry, {})) > NOTHING

    def long(self) -> bool:
        """Whether a number on it is one that nobody writes out."""
        return any(map(self._is_long, self._entries()))

    def _entries(self) -> Iterator[Expr]:
        for value in self.values.values():
            for row in self.written(value).rows:
                yield from row

    def _is_long(self, entry: Expr) -> bool:
        if free_symbols(entry):
            return False
        if not isinstance(entry, Number):
            return len(text(entry)) > SHORT
        if self.decimals:
            digits = significant_digits(entry.value)
            return digits is None or digits > DIGITS
        return max(abs(entry.value.numerator), entry.value.denominator) > COUNT

    def pivot_rows(self, value: ScalarMatrix) -> tuple[int, ...]:
        """Independent rows, as many as there are, the first ones. Raises TooLong."""
        if not self.rounded or any(entry.letters() for entry in value.entries):
            return eliminated(value.T).pivots
        import numpy as np

        rows = np.array(matrix_numbers(value, {}))
        least, kept = SMALL * max(1.0, np.abs(rows).max()), list[int]()
        for k in range(len(rows)):
            if np.linalg.matrix_rank(rows[[*kept, k]], tol=least) > len(kept):
                kept.append(k)
        return tuple(kept)


def map_rational(row: tuple[Scalar, ...]) -> list[Scalar]:
    """Numbers rounded; what has symbols stays."""
    return [_rational(entry) for entry in row]


def _rational(entry: Scalar) -> Scalar:
    try:
        return Scalar.of(Fraction(f"{scalar_number(entry, {}):.{PLACES}f}"))
    except KeyError:  # symbols are left
        return entry


def _rounded(expr: Expr) -> Expr:
    if isinstance(expr, Number):
        value = float(expr.value)
        whole = round(value)
        if abs(value - whole) < NOTHING:
            return Number(Fraction(whole))
        digits = significant_digits(expr.value)
        short = digits is not None and digits <= DIGITS
        return Number(expr.value, decimal=True) if short else Approximate(value)
    return rebuild(expr, _rounded)


def _ending(expr: Expr) -> Expr:
    """A fraction that ends as a decimal, where the author writes decimals."""
    if isinstance(expr, Number) and significant_digits(expr.value) is not None:
        return replace(expr, decimal=True)
    return rebuild(expr, _ending)


def in_functions(value: Matrix) -> bool:
    """Whether a sine, or another function that is no root, is left among numbers alone."""
    return not free_symbols(value) and any(
        isinstance(node, Call) and node.function != "sqrt" for node in walk(value)
    )


def typed_decimals(*trees: Expr) -> bool:
    """Whether a decimal is typed in any of them."""
    return any(isinstance(node, Number) and node.decimal for tree in trees for node in walk(tree))


def one(size: int) -> ScalarMatrix:
    return ScalarMatrix.identity(size)


def diagonal(entries: tuple[Scalar, ...]) -> ScalarMatrix:
    """A diagonal matrix."""
    return ScalarMatrix.of(
        [entry if i == j else 0 for j, entry in enumerate(entries)] for i in range(len(entries))
    )


def names_of(problem: Problem, *wanted: str) -> tuple[Symbol, ...]:
    """Names that mean nothing else on the sheet."""
    return tuple(Symbol(free(problem.taken, name, f"{name}_0")) for name in wanted)


def _divided(whole: Expr, top: Expr, scalar: Expr) -> Expr:
    """An entry over the scalar; `whole` is what it comes to where that divides it, else zero."""
    return whole if whole != ZERO or top == ZERO else top / scalar
