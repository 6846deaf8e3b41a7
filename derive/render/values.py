"""Values as a page says them: with their unit, as decimals where decimals or units were typed, and short.

What a derivation holds is exact. A number that is too long for the page is rounded there, and then stands
behind a sign that says so.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from math import degrees, inf
from typing import TypeAlias

from derive.algebra.formulas.dimensions import Unlike, dimension_of_formula
from derive.algebra.formulas.quantities import rational
from derive.algebra.formulas.units import dimension_of, unit_of
from derive.algebra.normal import normal
from derive.algebra.numbers.floats import number
from derive.algebra.rationals import decimal_places, significant_digits
from derive.algebra.readable.terms import Style
from derive.derivation import Phrase
from derive.errors import FormulaError, NotAsWritten, NotDerivable
from derive.expression import (
    ONE,
    PI,
    ZERO,
    Approximate,
    Call,
    Degrees,
    Derivative,
    Expr,
    Indexed,
    Matrix,
    Measured,
    Number,
    Power,
    Product,
    Quotient,
    Relation,
    Symbol,
    free_symbols,
    multiply,
    rebuild,
    walk,
)
from derive.render.common_factor import factored, is_factored
from derive.render.measures import hold_as_said

SPARE = 2  # digits more than a sheet asks for, before an exact number is rounded
LONG = 10**7  # a fraction with more is rounded where no decimals were typed either
STRUCTURAL = 60  # the largest denominator of a law, m L^2/12
WHOLE = 1e-9  # degrees
BEFORE_THE_POINT = 4  # digits: thousands are read as whole numbers are
ONE_DEGREE = Degrees(Fraction(1))

Chain: TypeAlias = tuple[Expr, ...]


@dataclass(frozen=True, slots=True)
class Values:
    """How the values of one derivation are said: `units` of its names, the `style` of its sheet, and how many
    `digits` are asked for."""

    units: Mapping[Expr | Phrase, str] = field(default_factory=dict)
    style: Style = Style()
    digits: int = 3

    def shown(self, chain: Chain) -> Chain:
        """The chain with what it ends in as it is said, in what its name measures."""
        if len(chain) < 2:
            return chain
        said = self._said(chain)
        hold_as_said(chain, said, self.units)
        return said

    def _said(self, chain: Chain) -> Chain:
        unit = self._unit(chain)
        *before, last = map(self._plain, chain)
        whole = last if unit else factored(last)
        if not any(map(is_factored, before)) or whole in before:
            before, last = [factored(tree) for tree in before], whole
        if free_symbols(last) or not _is_value(last):
            turned = unit and unit.startswith("deg") and PI in walk(last) and not self._of_angles(last)
            return _distinct((*before, self._turned(last) if turned else last))
        exact, rounded = self.value(last, unit)
        vectors = (_exact(tree, unit, False) if _is_vector(tree) else tree for tree in before)
        return _distinct((*vectors, *exact, *rounded))

    def relation(self, relation: Relation) -> Relation:
        """An equation that says the value of a name, with its unit, unless it has to be rounded."""
        if relation.sign != "=" or isinstance(relation.left, Relation) or relation.left not in self.units:
            return relation
        *_, last = self.shown((relation.left, relation.right))
        rounded = any(isinstance(node, Approximate) for node in walk(last))
        return relation if rounded else replace(relation, right=last)

    def cell(self, tree: Expr) -> Expr:
        """A number in a table, where no sign can say that it is rounded."""
        return self._number(self._plain(tree))

    def degrees(self, tree: Expr) -> float:
        """How many degrees an angle has."""
        return degrees(number(tree, {}))

    def value(self, tree: Expr, unit: str | None) -> tuple[Chain, Chain]:
        """A value exactly, where it is to be said so, and rounded, where it has to be."""
        if isinstance(tree, Measured):
            return ((tree,), ())
        angle = unit is not None and unit.startswith(("deg", "rad")) and _turns(tree, unit)
        if isinstance(tree, Matrix):
            entries = self._entries(tree)
            return ((_measured(entries, unit, angle),), ())
        if unit and unit.startswith("rad") and PI in walk(tree) and not angle and not _has_root(tree):
            return ((_measured(tree, unit, angle),), ())
        if angle and not isinstance(tree, Degrees) and not _is_simple(tree):
            return ((), (_measured(self._degrees(tree), unit, True),))
        fraction = rational(tree) if self._decimal() and not isinstance(tree, Number) else None
        if fraction is not None:
            return ((_exact(tree, unit, angle), _measured(self._number(Number(fraction)), unit, angle)), ())
        said = self._number(tree) if self._decimal() else tree
        if unit is None or _is_simple(said) or isinstance(said, Number | Degrees | Approximate):
            return ((_measured(said, unit, angle),), ())
        return ((_exact(said, unit, angle),), (_measured(self._decimals(said), unit, angle),))

    # -- numbers ----------------------------------------------------------------------------------

    def _plain(self, tree: Expr) -> Expr:
        """No factor or divisor 1, and no number that is too long; a tree without them stays the one it is.
        Where one number is rounded, those beside it have no more digits."""
        nodes = [*walk(tree)]
        if any(map(self._is_rounded, nodes)):
            return self._mended(tree, max(self.digits, self.style.longest))
        ugly = any(map(_is_bare, nodes)) or any(
            self._is_clumsy(n.value) for n in nodes if isinstance(n, Number)
        )
        return self._mended(tree, self._most) if ugly else tree

    def _mended(self, tree: Expr, most: int) -> Expr:
        match tree:
            case Quotient(top, Number(value=value)) if value == 1:
                return self._mended(top, most)
            case Product(factors) if ONE in factors:
                return self._mended(multiply(*factors), most)
            case Degrees(value) if _digits(value) > most:
                return Product((Approximate(float(value)), ONE_DEGREE))
            case Number(value, decimal) if decimal or self._is_clumsy(value):
                if value.denominator == 1 or (self._decimal() and _digits(value) <= most):
                    return replace(tree, decimal=True)
                return Approximate(float(value))
        return rebuild(tree, lambda part: self._mended(part, most))

    def _number(self, tree: Expr) -> Expr:
        """A fraction as a decimal, rounded where it does not end."""
        if isinstance(tree, Number) and not tree.decimal and tree.value.denominator != 1:
            exact = not self._is_long(tree.value)
            return Number(tree.value, True) if exact else Approximate(float(tree.value))
        return tree

    def _decimals(self, tree: Expr) -> Expr:
        return Approximate(number(tree, {}))

    def _degrees(self, tree: Expr) -> Expr:
        size = self.degrees(tree)
        if abs(size - round(size)) < WHOLE:
            return Degrees(Fraction(round(size)))
        exact = _degrees_of_turn(tree)
        if exact is not None and _digits(exact) <= self._most:
            return Degrees(exact)
        return Product((Approximate(size), ONE_DEGREE))

    def _turned(self, tree: Expr) -> Expr:
        """A formula in symbols, its numbers of half turns in degrees."""
        if not free_symbols(tree):
            return self._degrees(tree) if PI in walk(tree) else tree
        if not isinstance(tree, Product):
            return rebuild(tree, self._turned)
        plain = [factor for factor in tree.factors if not free_symbols(factor)]
        if not any(PI in walk(factor) for factor in plain):
            return rebuild(tree, self._turned)
        rest = (factor for factor in tree.factors if free_symbols(factor))
        return Product((self._degrees(Product(tuple(plain))), *rest))

    def _of_angles(self, tree: Expr) -> bool:
        """Whether one of its names is an angle already, so that pi is a number beside it: 2 pi d/T^2."""
        units = (self.units.get(Symbol(name), "") for name in free_symbols(tree))
        return any(unit.startswith("deg") for unit in units)

    def _entries(self, matrix: Matrix) -> Matrix:
        """Numbers of a matrix in one style: decimals where all of them are plain."""
        entries = [entry for row in matrix.rows for entry in row]
        if not self._decimal() or not all(isinstance(entry, Number | Approximate) for entry in entries):
            return matrix
        return Matrix(tuple(tuple(map(self._number, row)) for row in matrix.rows))

    def _decimal(self) -> bool:
        """Whether values are said as decimals."""
        return self.style.decimals or self.style.units or bool(self.units)

    def _is_long(self, value: Fraction) -> bool:
        return self._decimal() and value.denominator != 1 and _digits(value) > self._most

    @property
    def _most(self) -> int:
        """How many digits an exact number may have."""
        return max(self.digits + SPARE, self.style.longest)

    def _is_rounded(self, node: Expr) -> bool:
        """Whether it is a number that is said to the digits of the sheet."""
        match node:
            case Degrees(value):
                return _digits(value) > self._most
            case Number(value, decimal):
                return (decimal or self._is_clumsy(value)) and _digits(value) > self._most
        return False

    def _is_clumsy(self, value: Fraction) -> bool:
        """A fraction that nobody reads."""
        if value.denominator == 1:
            return False
        decimals = self._decimal() and value.denominator > STRUCTURAL
        return decimals or max(abs(value.numerator), value.denominator) > LONG

    # -- units ------------------------------------------------------------------------------------

    def _unit(self, chain: Chain) -> str | None:
        """That of what a chain is about; None where it is not known."""
        if not self.units:
            return None
        if chain[0] in self.units:
            return self.units[chain[0]]
        if isinstance(chain[0], Matrix):
            return _common(self.units.get(entry) for row in chain[0].rows for entry in row)
        known = {
            name.name: dimension_of(unit) for name, unit in self.units.items() if isinstance(name, Symbol)
        }
        for part in chain[:-1]:
            if free_symbols(part) and not isinstance(part, Matrix):
                try:
                    return unit_of(dimension_of_formula(part, known))
                except Unlike as error:
                    if self.style.units and _has_bare_data(part):
                        continue
                    raise NotAsWritten(f"{part!r}: {error}") from error
                except NotDerivable:
                    continue
        return None


def _has_bare_data(expr: Expr) -> bool:
    """Whether decimals stand in a formula, which may be data without their units: 0.1 of d_2 = 0.1 m."""
    return any(isinstance(node, Number) and node.decimal and not node.unit for node in walk(expr))


def _is_bare(node: Expr) -> bool:
    """Whether a one is written in it that says nothing."""
    match node:
        case Quotient(_, Number(value=value)):
            return value == 1
        case Product(factors):
            return ONE in factors
    return False


def _digits(value: Fraction) -> float:
    """How many a decimal number has; of a whole one none that counts, and of others no more than some before
    the point."""
    found, places = significant_digits(value), decimal_places(value)
    return (
        0
        if places == 0
        else inf
        if found is None or places is None
        else min(found, places + BEFORE_THE_POINT)
    )


def _degrees_of_turn(tree: Expr) -> Fraction | None:
    """An angle that is a fraction of a turn, in degrees; None of any other."""
    try:
        turn = normal(Quotient(tree, PI)).constant
    except (FormulaError, NotDerivable):
        return None
    return None if turn is None else Fraction(turn) * 180


def _common(units: Iterable[str | None]) -> str | None:
    """The unit of all entries of a vector."""
    found = {*units}
    return found.pop() if len(found) == 1 else None


def in_unit(tree: Expr, unit: str) -> Expr:
    """With its unit, unless it has one; zero divided by a unit is zero degrees."""
    tree = Degrees(Fraction(0)) if tree == ZERO and unit.startswith("/") else tree
    return Measured(tree, unit) if unit and not isinstance(tree, Measured) else tree


def _measured(tree: Expr, unit: str | None, angle: bool) -> Expr:
    """With its unit; an angle in degrees has its own, and is divided by the rest."""
    entries = {entry for row in tree.rows for entry in row} if isinstance(tree, Matrix) else {tree}
    if entries == {ZERO}:
        return tree
    return in_unit(tree, (unit or "").removeprefix("deg").removeprefix("rad" if angle else ""))


def _is_vector(tree: Expr) -> bool:
    """Whether it is a matrix of numbers, maybe with a factor."""
    whole = tree.factors[-1] if isinstance(tree, Product) else tree
    return isinstance(whole, Matrix) and not free_symbols(tree)


def _exact(tree: Expr, unit: str | None, angle: bool) -> Expr:
    """What a decimal follows, with its unit: none where its numbers have theirs, or it is an angle."""
    own = any(isinstance(node, Measured | Degrees) for node in walk(tree))
    turned = unit is not None and (unit == "rad" or unit.startswith("deg") or angle)
    return tree if own or not unit or turned else in_unit(tree, unit)


def _turns(tree: Expr, unit: str) -> bool:
    """Whether it is said in degrees: it is written so, or is to be."""
    return unit.startswith("deg") or any(isinstance(node, Degrees) for node in walk(tree))


def _has_root(tree: Expr) -> bool:
    """Whether nobody sees at once how large it is."""
    return any(isinstance(node, Call | Power) for node in walk(tree))


def _is_simple(tree: Expr) -> bool:
    """Whether it is a number of degrees, or zero."""
    match tree:
        case Product((Approximate(), Degrees())):
            return True
    return tree == ZERO


def _is_value(tree: Expr) -> bool:
    """Whether it is worked out: a number, or numbers and roots; of a matrix every entry."""
    if isinstance(tree, Matrix):
        return all(map(_is_value, (entry for row in tree.rows for entry in row)))
    return not any(isinstance(node, Matrix | Indexed | Derivative) for node in walk(tree))


def _distinct(chain: Chain) -> Chain:
    """Without a link that says what the one before it does."""
    kept: list[Expr] = []
    for tree in chain:
        if kept and kept[-1] in (tree, tree.value if isinstance(tree, Measured) else tree):
            kept.pop()
        kept.append(tree)
    return tuple(kept)
