"""The array of Routh entry by entry, as a person fills it in."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from derive.algebra.normal import normal
from derive.algebra.numbers.floats import number as value_of
from derive.algebra.readable.form import readable
from derive.algebra.readable.operation_count import operations
from derive.algebra.readable.terms import Style
from derive.algebra.readable.writing import opposite
from derive.algebra.scalar import Scalar
from derive.algebra.solving.polynomials import known_sign
from derive.control.rational import Polynomial, written
from derive.control.routh import Row, leading
from derive.derivation import Phrase, Step, Table
from derive.expression import (
    ONE,
    ZERO,
    Derivative,
    Expr,
    Indexed,
    Matrix,
    Number,
    Product,
    Quotient,
    Sum,
    Symbol,
    is_negative,
    multiply,
    number,
    replace,
    walk,
)
from derive.kinds.chains import distinct
from derive.kinds.system._stability_facts import Around

S = Symbol("s")
IN_TABLE = 6  # operations an entry of the table has at most; a longer one is named


@dataclass(frozen=True, slots=True)
class Array:
    """A polynomial (highest power first) with its rows. `letter` names the entries, `epsilon` the small
    number, `auxiliary` the polynomials of rows of zeros."""

    polynomial: Polynomial
    rows: tuple[Row, ...]
    trees: tuple[tuple[Expr, ...], ...]  # the entries as they are written
    style: Style
    letter: str
    epsilon: str
    auxiliary: str

    @property
    def column(self) -> tuple[Scalar, ...]:
        """The first column where epsilon goes to zero, up to positive factors."""
        return tuple(leading(row.entries[0], self.epsilon) for row in self.rows)

    @property
    def mended(self) -> tuple[str, ...]:
        """Where the rows are from that had to be mended: "derivative", "epsilon"."""
        return tuple(row.origin for row in self.rows if row.origin in ("derivative", "epsilon"))

    def name(self, i: int, j: int) -> Symbol | Indexed:
        """r_ij, counted from 1."""
        if max(i, j) < 10:
            return Symbol(f"{self.letter}_{i}{j}")
        return Indexed(self.letter, (number(i), number(j)))

    def polynomial_name(self, i: int) -> Symbol:
        """The polynomial of the row above the i-th, which is zero."""
        return Symbol(f"{self.auxiliary}_{i - 1}")

    def value(self, i: int, j: int) -> Expr:
        """An entry as it is shortest: by its formula with the values put in, or multiplied out."""
        return self.trees[i - 1][j - 1]

    @property
    def matrix(self) -> Matrix:
        """Every entry, zeros where a row has ended."""
        return Matrix(self.trees)

    @property
    def definitions(self) -> dict[Expr, Expr]:
        """What the names of entries and of auxiliary polynomials stand for."""
        places = [(i, j) for i, row in enumerate(self.rows, 1) for j in range(1, len(row.entries) + 1)]
        found: dict[Expr, Expr] = {self.name(i, j): self.value(i, j) for i, j in places}
        for i, row in enumerate(self.rows, 1):
            if row.origin == "derivative":
                found[self.polynomial_name(i)] = written(self.rows[i - 2].polynomial, self.style)
        return found

    @property
    def table(self) -> Table:
        """As it is written down: short entries as they are, long ones by name."""
        width = len(self.rows[0].entries)
        heads = [Indexed(self.letter, (Symbol("i"), number(j))) for j in range(1, width + 1)]
        rows = tuple((str(i), _power(row.power), *self._cells(i, row)) for i, row in enumerate(self.rows, 1))
        return Table((Symbol("i"), "", *heads), rows)

    def _cells(self, i: int, row: Row) -> Iterator[Expr | str]:
        for j in range(1, len(row.entries) + 1):
            value = self.value(i, j)
            if j > row.power // 2 + 1:
                yield ""
            else:
                yield value if operations(value) <= IN_TABLE else self.name(i, j)


def law_step(array: Array) -> Step:
    """How an entry follows from the two rows above it, tried on an array of numbers."""
    i, j = Symbol("i"), Symbol("j")

    def named(up: int, column: Expr) -> Indexed:
        row = i - number(up) if up else i
        return Indexed(array.letter, (row, column))

    pivot, after = named(1, ONE), j + ONE
    law = (pivot * named(2, after) - named(2, ONE) * named(1, after)) / pivot
    names = dict.fromkeys(
        node for side in (named(0, j), law) for node in walk(side) if isinstance(node, Indexed)
    )
    return Step("law", (named(0, j), law), "law", instance=_at(names, IN_NUMBERS, 3))


IN_NUMBERS = tuple(tuple(map(number, row)) for row in ((5, 3, 0), (2, 8, 0), (-17, 0, 0)))


def _at(names: Iterable[Indexed], trees: Sequence[Sequence[Expr]], i: int) -> dict[Expr, Expr]:
    """The entries that the names of the law are in row i of an array, for its first column."""
    place: dict[Expr, Expr] = {Symbol("i"): number(i), Symbol("j"): ONE}
    instance: dict[Expr, Expr] = {}
    for name in names:
        row, column = (round(value_of(replace(index, place), {})) for index in name.lower)
        entries = trees[row - 1]
        instance[name] = entries[column - 1] if column <= len(entries) else ZERO
    return instance


def entry_steps(array: Array) -> Iterator[Step]:
    """A step for each entry that is computed, and those of the rows that are zero."""
    for i, row in enumerate(array.rows, 1):
        if i > 2 and row.origin != "derivative":
            yield from _computed(array, i, row)
        if row.origin == "derivative":
            yield from _auxiliary(array, i, row)


def _computed(array: Array, i: int, row: Row) -> Iterator[Step]:
    for j in range(1, row.power // 2 + 2):
        name, formula, value = array.name(i, j), _formula(array, i, j), array.value(i, j)
        worked = _worked(array, i, j, formula)
        if j == 1 and row.origin == "epsilon":
            small = Phrase("small-number", {"epsilon": Symbol(array.epsilon)})
            said = Around(before=Phrase("next-vanishes"), after=small)
            yield Step(f"zero_{i}", (*worked, ZERO), "epsilon", said, spare=worked[1:])
            continue
        chain = distinct((name, *worked, value))
        yield Step(f"entry_{i}_{j}", chain, "entry", Around(), spare=(*worked[1:], value))


def _worked(array: Array, i: int, j: int, formula: Expr) -> tuple[Expr, ...]:
    """The formula in names, then with values where that says more."""
    filled = _filled(array, i, j)
    return (formula,) if filled is None else (formula, filled)


def _filled(array: Array, i: int, j: int) -> Expr | None:
    """The formula with values; None where that says no more."""
    return put_in(array.trees, i - 1, j - 1)


def trees_of(rows: Sequence[Row], style: Style) -> tuple[tuple[Expr, ...], ...]:
    """Every entry as it is written."""
    done: list[tuple[Expr, ...]] = []
    for i, row in enumerate(rows):
        found = [_tree(entry, style) for entry in row.entries]
        if i > 1 and row.origin != "derivative":
            pivot = done[i - 1][0]
            found = [_shorter(_over(tree, pivot), put_in(done, i, j)) for j, tree in enumerate(found)]
        done.append(tuple(found))
    return tuple(done)


def _over(tree: Expr, pivot: Expr) -> Expr:
    """A fraction over the opposite of its pivot, over the pivot, whose sign the next lines ask for."""
    match tree:
        case Quotient(top, bottom) if pivot != ZERO and known_sign(normal(bottom) / normal(pivot)) == -1:
            return opposite(top) / opposite(bottom)
    return tree


def _shorter(tree: Expr, filled: Expr | None) -> Expr:
    long = operations(tree) > IN_TABLE
    return filled if long and filled is not None and operations(filled) < operations(tree) else tree


def put_in(trees: Sequence[Sequence[Expr]], i: int, j: int) -> Expr | None:
    """The formula of an entry, counted from 0, with values; None where it is another entry as it stands, or
    would have fractions in fractions."""
    above, below = trees[i - 2], trees[i - 1]
    if j + 1 >= len(below) or below[j + 1] == ZERO:
        return None
    parts = (below[0], above[j + 1], above[0], below[j + 1])
    if any(isinstance(node, Quotient) for part in parts for node in walk(part)):
        return None
    inside = _times(parts[0], parts[1]) - _times(parts[2], parts[3])
    return inside if parts[0] == ONE else inside / parts[0]


def _formula(array: Array, i: int, j: int) -> Expr:
    """The law of the array in names of entries; where the last term is zero, what is left."""
    width = len(array.rows[0].entries)
    below = array.rows[i - 2].entries
    if j >= width:
        return ZERO
    if not below[j]:
        return array.name(i - 2, j + 1)
    pivot = array.name(i - 1, 1)
    return (pivot * array.name(i - 2, j + 1) - array.name(i - 2, 1) * array.name(i - 1, j + 1)) / pivot


def _auxiliary(array: Array, i: int, row: Row) -> Iterator[Step]:
    """The polynomial of the row above a row of zeros, and its derivative, which fills it."""
    name = array.polynomial_name(i)
    above = written(array.rows[i - 2].polynomial, array.style)
    roots = Phrase("root-at-the-origin" if len(_powers(array.rows[i - 2])) == 1 else "symmetric-roots")
    said = Around(before=Phrase("row-vanishes", {"row": i}), after=roots)
    yield Step(f"auxiliary_{i}", (name, above), "auxiliary", said)
    slope = written(row.polynomial, array.style)
    yield Step(
        f"derivative_{i}", (Derivative(name, S), slope), "derivative", Around(after=Phrase("fills-the-row"))
    )


def _powers(row: Row) -> list[int]:
    """Of the terms its polynomial has."""
    return [place for place, entry in enumerate(row.polynomial) if entry]


def _times(left: Expr, right: Expr) -> Expr:
    """A product of values, numbers first, sums last."""
    if left == right and left != ONE:
        return left**2
    parts = (
        each.factors if isinstance(each, Product) and not is_negative(each) else (each,)
        for each in (left, right)
    )
    factors = [factor for part in parts for factor in part]
    return multiply(
        *sorted(factors, key=lambda factor: (not isinstance(factor, Number), isinstance(factor, Sum)))
    )


def _tree(value: Scalar | int, style: Style) -> Expr:
    return readable(Scalar.of(value), style) if value else ZERO


def _power(power: int) -> Expr:
    return ONE if power == 0 else multiply(S) if power == 1 else S ** number(power)
