"""Matrices of scalars, with the few operations mechanics needs. Shapes are (rows, columns)."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

from derive.algebra.bounds import multiplied
from derive.algebra.ring import Ring
from derive.algebra.scalar import Like, Scalar, common_ring


@dataclass(frozen=True, slots=True, eq=False)
class ScalarMatrix:
    """Rows of scalars of one ring. `@` multiplies; `==` compares entry by entry in normal form."""

    rows: tuple[tuple[Scalar, ...], ...]

    @staticmethod
    def of(rows: Iterable[Iterable[Like]]) -> ScalarMatrix:
        """The matrix of rows of entries of any rings, brought into one."""
        scalars = [[Scalar.of(entry) for entry in row] for row in rows]
        home = common_ring(entry for row in scalars for entry in row)
        if all(entry.ring is home for row in scalars for entry in row):
            return ScalarMatrix(tuple(map(tuple, scalars)))
        return ScalarMatrix(tuple(tuple(entry.into(home) for entry in row) for row in scalars))

    @staticmethod
    def identity(size: int) -> ScalarMatrix:
        """The identity matrix (size by size)."""
        return ScalarMatrix.of([[int(i == j) for j in range(size)] for i in range(size)])

    @staticmethod
    def zeros(rows: int, columns: int) -> ScalarMatrix:
        """The zero matrix (rows by columns)."""
        return ScalarMatrix.of([[0] * columns for _ in range(rows)])

    @staticmethod
    def column(entries: Iterable[Like]) -> ScalarMatrix:
        """A column vector (n by 1)."""
        return ScalarMatrix.of([entry] for entry in entries)

    @staticmethod
    def beside(parts: Sequence[ScalarMatrix]) -> ScalarMatrix:
        """Matrices of the same height side by side: (m by n), (m by k) give (m by n + k)."""
        return ScalarMatrix.of(
            [entry for part in parts for entry in part.rows[i]] for i in range(parts[0].shape[0])
        )

    @staticmethod
    def stacked(parts: Sequence[ScalarMatrix]) -> ScalarMatrix:
        """Matrices of the same width one above the other: (m by n), (k by n) give (m + k by n)."""
        return ScalarMatrix.of(row for part in parts for row in part.rows)

    @property
    def shape(self) -> tuple[int, int]:
        """(rows, columns)."""
        return len(self.rows), len(self.rows[0])

    @property
    def ring(self) -> Ring:
        """The ring of every entry."""
        return self.rows[0][0].ring

    @property
    def entries(self) -> tuple[Scalar, ...]:
        """Every entry, row by row: rows times columns of them."""
        return tuple(entry for row in self.rows for entry in row)

    @property
    def T(self) -> ScalarMatrix:
        """The transpose (n by m of an m by n matrix)."""
        return ScalarMatrix(tuple(zip(*self.rows, strict=True)))

    def __getitem__(self, place: tuple[int, int]) -> Scalar:
        return self.rows[place[0]][place[1]]

    def block(self, rows: slice, columns: slice) -> ScalarMatrix:
        """The rows and columns of two slices: `T.block(slice(3), slice(3))` is the rotation of a pose T."""
        return ScalarMatrix(tuple(row[columns] for row in self.rows[rows]))

    def columns(self, *which: int) -> ScalarMatrix:
        """The matrix of these columns, counted from 0, in this order."""
        return ScalarMatrix(tuple(tuple(row[j] for j in which) for row in self.rows))

    def into(self, home: Ring) -> ScalarMatrix:
        """The same matrix in a larger ring."""
        return self if self.ring is home else self.map(lambda entry: entry.into(home))

    def map(self, change: Callable[[Scalar], Scalar]) -> ScalarMatrix:
        """The matrix of changed entries, of the same shape; `change` must keep them in one ring."""
        return ScalarMatrix(tuple(tuple(map(change, row)) for row in self.rows))

    def __add__(self, other: ScalarMatrix) -> ScalarMatrix:
        home = self.ring.union(other.ring)
        pairs = zip(self.into(home).rows, other.into(home).rows, strict=True)
        return ScalarMatrix(tuple(tuple(map(Scalar.__add__, *rows)) for rows in pairs))

    def __neg__(self) -> ScalarMatrix:
        return self.map(lambda entry: -entry)

    def __sub__(self, other: ScalarMatrix) -> ScalarMatrix:
        return self + (-other)

    def scaled(self, by: Like) -> ScalarMatrix:
        """Every entry times a scalar."""
        home = self.ring.union(Scalar.of(by).ring)
        return self.into(home).map(lambda entry: entry * by)

    def __matmul__(self, other: ScalarMatrix) -> ScalarMatrix:
        home = self.ring.union(other.ring)
        left, right = self.into(home), other.into(home).T
        return ScalarMatrix(tuple(tuple(dot(row, col) for col in right.rows) for row in left.rows))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, ScalarMatrix):
            return NotImplemented
        return self.shape == other.shape and all(
            a == b for a, b in zip(self.entries, other.entries, strict=True)
        )

    def __hash__(self) -> int:
        raise TypeError("matrices are equal across rings and have no hash")

    def __bool__(self) -> bool:
        return any(self.entries)

    def diff(self, name: str) -> ScalarMatrix:
        """The partial derivative of every entry. Raises NotDerivable where there is no rule."""
        return ScalarMatrix.of([entry.diff(name) for entry in row] for row in self.rows)

    def substitute(self, values: Mapping[str, Scalar]) -> ScalarMatrix:
        """Every entry with symbols replaced; the names must not stand inside sines, cosines or roots."""
        return ScalarMatrix.of([entry.substitute(values) for entry in row] for row in self.rows)

    def cross(self, other: ScalarMatrix) -> ScalarMatrix:
        """The vector product of two columns (3 by 1), a column (3 by 1)."""
        home = self.ring.union(other.ring)
        (ax, ay, az), (bx, by, bz) = self.into(home).entries, other.into(home).entries
        return ScalarMatrix(
            ((dot((ay, -az), (bz, by)),), (dot((az, -ax), (bx, bz)),), (dot((ax, -ay), (by, bx)),))
        )

    def minor(self, i: int, j: int) -> ScalarMatrix:
        """The matrix without row i and column j, counted from 0; its determinant is the minor."""
        kept = (row for k, row in enumerate(self.rows) if k != i)
        return ScalarMatrix(tuple(row[:j] + row[j + 1 :] for row in kept))

    def det(self) -> Scalar:
        """The determinant of a square matrix by Laplace expansion over growing minors: no division, each
        minor once."""
        n = self.shape[0]
        minors: dict[tuple[int, ...], Scalar] = {(): Scalar(self.ring, self.ring.one)}
        for size in range(1, n + 1):
            row = self.rows[n - size]
            minors = {cols: _expand(row, cols, minors) for cols in combinations(range(n), size)}
        return minors[tuple(range(n))]

    def adjugate(self) -> ScalarMatrix:
        """The transposed matrix of cofactors (n by n): A adj(A) = det(A) times the identity."""
        n = self.shape[0]
        if n == 1:
            return ScalarMatrix.identity(1)
        return ScalarMatrix.of([self.minor(j, i).det() * (-1) ** (i + j) for j in range(n)] for i in range(n))

    def inverse(self) -> ScalarMatrix:
        """Adjugate over determinant (n by n). Raises ZeroDivisionError where that is identically zero."""
        det = self.det()
        return ScalarMatrix.of([entry / det for entry in row] for row in self.adjugate().rows)


def dot(left: Sequence[Scalar], right: Sequence[Scalar]) -> Scalar:
    """The sum of products of two rows of scalars of one ring, reduced once at the end."""
    home = left[0].ring
    pairs = [(a, b) for a, b in zip(left, right, strict=True) if a.numerator and b.numerator]
    if len(pairs) <= 1:
        return pairs[0][0] * pairs[0][1] if pairs else Scalar(home, home.zero)
    total = home.zero
    for a, b in pairs:
        if a.denominator is not None or b.denominator is not None:
            return sum((x * y for x, y in pairs), Scalar(home, home.zero))
        total = total + multiplied(a.numerator, b.numerator)
    return Scalar(home, home.reduce(total))


def _expand(
    row: Sequence[Scalar], columns: tuple[int, ...], minors: Mapping[tuple[int, ...], Scalar]
) -> Scalar:
    """One row of a Laplace expansion over the minors below it."""
    total = Scalar.of(0)
    for k, j in enumerate(columns):
        if row[j]:
            term = row[j] * minors[columns[:k] + columns[k + 1 :]]
            total = total - term if k % 2 else total + term
    return total
