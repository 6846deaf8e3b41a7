"""The steps by which three angles are read off a rotation matrix, and the branches they lead to."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from dataclasses import replace as replace_fields
from functools import cached_property
from itertools import permutations, product

from derive.algebra.normal import normal, normal_matrix
from derive.algebra.numbers.floats import number
from derive.algebra.readable.form import readable_matrix
from derive.algebra.scalar import Scalar
from derive.derivation import Branch, Claim, Phrase, Step
from derive.expression import (
    MINUS_ONE,
    ZERO,
    Call,
    Degrees,
    Expr,
    Matrix,
    Power,
    Product,
    Relation,
    Sum,
    Symbol,
    add,
    cos,
    free_symbols,
    multiply,
    rebuild,
    replace,
    sin,
    walk,
)
from derive.expression import number as exact_number
from derive.kinds.chains import distinct
from derive.kinds.checks import law
from derive.kinds.pose._euler_facts import Case, Entries, Equation, Facts, Regular
from derive.kinds.pose._given import Given
from derive.kinds.pose._numbers import NEARLY, fixed_angle, known_angle, shortened, turns_of
from derive.kinds.problem import Problem
from derive.mechanics.elementary import factor_name, rotation_matrix
from derive.mechanics.euler import SIGNS, Direction, Euler, Sign, Singular


def factors_of(euler: Euler) -> dict[Expr, Expr]:
    """R_{z,phi}, ... as they stand in the product, and what they are."""
    return {
        factor_name(move, Symbol(str(move.axis)), ("R", "")): rotation_matrix(str(move.axis), move.by)
        for move in euler.factors
    }


@dataclass(frozen=True)
class Comparison:
    """Of a given rotation with that of three angles, entry by entry."""

    euler: Euler
    given: Given

    @property
    def problem(self) -> Problem:
        return self.given.problem

    @cached_property
    def written(self) -> Matrix:
        """The matrix of the sequence in its angles, which stand in their order in every product."""
        return readable_matrix(self.euler.matrix, replace_fields(self.problem.style, order=self.euler.names))

    @cached_property
    def cases(self) -> tuple[Sign, ...]:
        """The singular cases that can occur; (1, -1) where it depends on the symbols."""
        middle = self.given.R[self.euler.middle.row, self.euler.middle.col] * self.euler.middle.sign
        if not self.regular:
            return tuple(sign for sign in SIGNS if middle == sign)
        return () if middle.constant is not None or self.given.numeric else SIGNS

    @cached_property
    def regular(self) -> bool:
        """Whether the angles are determined somewhere."""
        pair = (self.euler.first.sine, self.euler.first.cosine)
        return any(self.given.R[entry.row, entry.col] != 0 for entry in pair)

    @cached_property
    def singular_cases(self) -> tuple[Singular, ...]:
        return tuple(self.euler.singular(sign) for sign in self.cases)

    # -- steps ------------------------------------------------------------------------------------

    def steps(self) -> Iterator[Step]:
        """The angles where they are determined, then what the singular cases determine."""
        if self.regular:
            for sign in SIGNS:
                label = "plus" if sign > 0 else "minus"
                for name, value in self.euler.regular(sign).items():
                    yield Step(f"{name}_{label}", self._chain(Symbol(name), value), "regular")
        for k, case in enumerate(self.singular_cases, 1):
            matrix = self.singular_matrix(case)
            yield Step(f"R_singular_{k}", (self.given.rotation, matrix), "singular")
            determined, angle = self.determined(case), case.direction.angle()
            chain = (determined, angle) if self.regular else self._chain(determined, angle)
            yield Step(f"determined_{k}", chain, "singular")

    def determined(self, case: Singular) -> Expr:
        """The sum or difference of the outer angles that a singular case determines."""
        first, _, last = map(Symbol, self.euler.outer)
        if case.signs[0] < 0:
            return last + -first
        return first + (last if case.signs[1] > 0 else -last)

    def singular_matrix(self, case: Singular) -> Matrix:
        """The matrix of a singular case by the sine and cosine of what it determines."""
        angle = self.determined(case)
        parts = [(normal(part), part) for part in (sin(angle), cos(angle))]
        known = [(s, t) for value, tree in parts for s, t in ((value, tree), (-value, -tree))]

        def written(entry: Scalar) -> Expr:
            return next((tree for value, tree in known if value == entry), self.problem.readable(entry))

        return Matrix(tuple(tuple(map(written, row)) for row in case.matrix.rows))

    def _chain(self, name: Expr, value: Expr) -> tuple[Expr, ...]:
        """The formula; where the entries are short also these put in, and the angle."""
        if not self.puts_in or self.same:  # an angle is not told by its own sine
            return (name, value)
        filled = self._filled(value)
        if not (self.given.numeric or self.given.shows(filled)):
            return (name, value)
        return distinct((name, value, filled, known_angle(filled, self.problem)))

    @property
    def puts_in(self) -> bool:
        """Whether the entries are put into the formulas on the page."""
        return self.given.numeric or (self.given.short and not self.given.named)

    def _filled(self, value: Expr) -> Expr:
        """A formula with the entries put in, the arguments of functions made short where they are numbers."""
        filled = replace(value, self.given.entries)
        return _short(filled, self.problem) if self.puts_in else _tidied(filled)

    # -- results ----------------------------------------------------------------------------------

    def solutions(self) -> tuple[Branch, ...]:
        """The two regular solutions, then the singular ones."""
        regular = tuple(self._regular(sign) for sign in SIGNS) if self.regular else ()
        return (*regular, *map(self._singular, self.singular_cases))

    def _regular(self, sign: Sign) -> Branch:
        values = {name: self._value(value) for name, value in self.euler.regular(sign).items()}
        g = (sin if self.euler.even else cos)(Symbol(self.euler.outer[1]))
        return Branch(values, (Relation(g, ">" if sign > 0 else "<", ZERO),))

    def _singular(self, case: Singular) -> Branch:
        _, middle, last = self.euler.outer
        values = {name: self._value(value) for name, value in self.euler.singular_angles(case).items()}
        values[middle] = self.middle_value(case)
        there = Relation(Symbol(middle), "=", Degrees(180 * turns_of(case.middle)))
        only = self.determined(case)
        return Branch(values, (Phrase("free", {"at": there, "free": Symbol(last), "only": only}),))

    def middle_value(self, case: Singular) -> Expr:
        return fixed_angle(turns_of(case.middle), self.problem)

    def _value(self, value: Expr) -> Expr:
        filled = self._filled(value)
        if not self.puts_in:
            return filled
        terms = filled.terms if isinstance(filled, Sum) else (filled,)
        known = (known_angle(term, self.problem) for term in terms)
        return add(*(term for term in known if term not in (ZERO, -ZERO)))

    @cached_property
    def chosen(self) -> tuple[Equation, ...]:
        """The angles of a singular rotation of numbers, where the last of them is chosen zero."""
        if not self.given.numeric or self.regular:
            return ()
        (case,) = self.singular_cases
        first, middle, last = self.euler.outer
        angles = self.euler.singular_angles(case)
        value = self._value(replace(angles[first], {Symbol(last): ZERO}))
        turns = turns_of(value)
        if abs(number(value, {}) - math.pi * turns) < NEARLY:
            value = fixed_angle(turns, self.problem)
        found = (value, self.middle_value(case), ZERO)
        return tuple(zip(map(Symbol, (first, middle, last)), found, strict=True))

    @cached_property
    def same(self) -> tuple[Equation, ...]:
        """The three symbols of the given rotation that stand in it as the angles do, or their opposites."""
        symbols = frozenset().union(*map(free_symbols, self.given.entries.values()))
        if len(symbols) != len(self.euler.names) or not self.regular:
            return ()
        for order in permutations(map(Symbol, sorted(symbols))):
            for signs in product(SIGNS, repeat=len(order)):
                turned = tuple(_signed(sign, angle) for sign, angle in zip(signs, order, strict=True))
                same = tuple(zip(map(Symbol, self.euler.names), turned, strict=True))
                if normal_matrix(self.written, {**dict(same)}) == self.given.R:
                    return same
        return ()

    # -- claims and facts -------------------------------------------------------------------------

    def laws(self) -> Iterator[Claim]:
        """The singular matrices, by putting the angle into the matrix of the sequence."""
        middle = Symbol(self.euler.outer[1])
        for case in self.singular_cases:
            again = normal_matrix(self.written, {middle: case.middle})
            shown = normal_matrix(self.singular_matrix(case))
            there = Relation(middle, "=", Degrees(180 * turns_of(case.middle)))
            yield law("singular-matrix", again == shown, at=there)

    def facts(self) -> Facts:
        """What the words read."""
        euler = self.euler
        centre = Symbol(euler.outer[1])
        g = (sin if euler.even else cos)(centre)
        return Facts(
            rotation=self.given.rotation,
            order=Phrase("about-current" if euler.convention.about == "current" else "about-world"),
            first=Symbol(euler.outer[0]),
            middle=centre,
            last=Symbol(euler.outer[2]),
            entries=self._entries(g) if self.regular else None,
            g=g,
            branches=tuple(
                Regular(sign=sign, steps=tuple(f"{name}_{label}" for name in euler.names))
                for sign, label in ((1, "plus"), (-1, "minus"))
                if self.regular
            ),
            cases=tuple(self._case(k, case) for k, case in enumerate(self.singular_cases, 1)),
            free=self._free(),
            chosen=self.chosen,
            turns=self._left_in_angles(),
            same=self.same,
            met=True,
            angle_results=euler.names,
            numbers=("solutions",) if self.given.numeric else None,
            style=self.problem.style,
            short_names=euler.names,
        )

    def _left_in_angles(self) -> tuple[Symbol, ...]:
        """The names that stand in angles which are no arctangents any more: these may go round any often."""
        found = [step.result for step in self.steps() if step.rule == "regular"]
        names = [free_symbols(each) for each in found if not any(isinstance(n, Call) for n in walk(each))]
        return tuple(map(Symbol, sorted(frozenset().union(*names))))

    def _free(self) -> Phrase | None:
        first, _, last = map(Symbol, self.euler.outer)
        key = (None, "in-this-case", "in-each-case")[len(self.singular_cases)]
        return Phrase(key, {"first": first, "last": last}) if key else None

    def _entries(self, g: Expr) -> Entries:
        """Those that hold the middle angle alone, and one of the others beside it."""
        euler, function = self.euler, cos if self.euler.even else sin
        centre = function(Symbol(euler.outer[1]))
        return Entries(
            middle=(euler.middle.name, _signed(euler.middle.sign, centre)),
            pairs=tuple(
                _relations(direction, Symbol(name), g)
                for direction, name in ((euler.first, euler.outer[0]), (euler.last, euler.outer[2]))
            ),
            size=euler.g,
        )

    def _case(self, k: int, case: Singular) -> Case:
        left = self.determined(case)
        sine, cosine = case.direction.sine, case.direction.cosine
        return Case(
            matrix=f"R_singular_{k}",
            determined=f"determined_{k}",
            sum=left,
            middle=(Symbol(self.euler.outer[1]), Degrees(180 * turns_of(case.middle))),
            entry=(self.euler.middle.name, exact_number(case.entry)),
            relations=(
                (sine.name, _signed(sine.sign, sin(left))),
                (cosine.name, _signed(cosine.sign, cos(left))),
            ),
        )


def _relations(direction: Direction, angle: Symbol, g: Expr) -> tuple[Equation, Equation]:
    """r_21 = s_phi c_theta and r_11 = c_phi c_theta."""
    return (
        (direction.sine.name, _signed(direction.sine.sign, multiply(sin(angle), g))),
        (direction.cosine.name, _signed(direction.cosine.sign, multiply(cos(angle), g))),
    )


def _signed(sign: Sign, expr: Expr) -> Expr:
    return expr if sign > 0 else -expr


def _short(expr: Expr, problem: Problem) -> Expr:
    """Arguments of atan2 as short as they can be written."""
    match expr:
        case Product((first, inner)) if first == MINUS_ONE:
            return -_short(inner, problem)
        case Call("atan2", (y, x)):
            return Call("atan2", (shortened(y, problem), shortened(x, problem)))
        case Sum(terms):
            return add(*(_short(term, problem) for term in terms))
    return expr if expr != -ZERO else ZERO


def _tidied(expr: Expr) -> Expr:
    """Zeros left out of sums, double signs resolved: what is left when entries were put in."""
    match expr:
        case Product((first, inner)) if first == MINUS_ONE:
            return -_tidied(inner)
        case Power(base, _) if base == ZERO:
            return ZERO
        case Sum(terms):
            return add(*map(_tidied, terms))
    return rebuild(expr, _tidied)
