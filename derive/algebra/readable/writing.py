"""A plan of nesting as a tree: the order of terms and factors on a blackboard, and their signs."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property, reduce
from itertools import product
from math import prod

from derive.algebra.rationals import Rational
from derive.algebra.readable.nesting import Flat, Plan, Split, Taken
from derive.algebra.readable.order import Place, SortKey
from derive.algebra.readable.terms import Alphabet, Monomial, terminates, times
from derive.expression import (
    Call,
    Expr,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    add,
    factors_of,
    free_symbols,
    is_negative,
    multiply,
    negate,
    number,
    sqrt,
    terms_of,
    walk,
)

FEW = 8  # terms
SIMPLE = 50  # the greatest denominator that a root stands over


@dataclass(frozen=True)
class Writing:
    """Writes plans over one alphabet, which has all its atoms by then."""

    alphabet: Alphabet
    places: dict[Monomial, SortKey] = field(default_factory=dict)

    def tree(self, plan: Plan) -> Expr:
        """The tree of a plan."""
        match plan:
            case Flat() | Split():
                keyed = sorted(self._summands(plan), key=lambda summand: summand[0])
                return _sum([term for _, tree in keyed for term in terms_of(tree)])
            case Taken(coefficient, monomial, sums):
                return self._product(coefficient, monomial, sums)

    def _summands(self, plan: Plan) -> Iterator[tuple[SortKey, Expr]]:
        """The terms of a sum, however it was put together, each with the place of its first product."""
        match plan:
            case Flat(terms):
                for monomial, k in terms.items():
                    yield self._term_key(monomial), self._product(k, monomial)
            case Split(parts):
                for _, inner in parts:
                    yield from self._summands(inner)
            case Taken():
                yield min(map(self._term_key, _products(plan))), self.tree(plan)

    def _product(
        self, coefficient: Rational, monomial: Monomial, sums: tuple[tuple[Plan, int], ...] = ()
    ) -> Expr:
        """Number and roots of numbers in front, then letters, sums and functions in their order."""
        alphabet = self.alphabet
        letters = [part for part in monomial if alphabet.radicand(part[0]) == 1]
        factors = [(self._place_of_letter(atom), alphabet.expression(atom, power)) for atom, power in letters]
        for plan, power in sums:
            expr = self.tree(plan)
            if _all_negative(expr) or _mostly_negative(expr):
                expr, coefficient = opposite(expr), coefficient * (-1) ** power
            if power == 1 and isinstance(expr, Product) and isinstance(expr.factors[0], Number):
                coefficient, expr = coefficient * expr.factors[0].value, multiply(*expr.factors[1:])
            factors.append((self._place_of_sum(plan), Power(expr, number(power)) if power > 1 else expr))
        if any(alphabet.is_written_out(atom) for atom, _ in letters):
            factors = [(_behind(place), tree) for place, tree in factors]
        trees = [tree for _, tree in sorted(factors, key=lambda factor: factor[0])]
        radicand = prod(alphabet.radicand(atom) for atom, _ in monomial)
        roots = (sqrt(number(radicand)),) if radicand > 1 else ()  # sqrt(2) sqrt(3) is sqrt(6)
        if coefficient == -1 and len(trees) == 1 and isinstance(trees[0], Sum) and not roots:
            return opposite(trees[0])
        shown = Number(Fraction(coefficient), self._is_decimal(coefficient, bool(roots)))
        return multiply(shown, *roots, *(factor for tree in trees for factor in factors_of(tree)))

    def _is_decimal(self, coefficient: Rational, with_root: bool) -> bool:
        """Whether a number is written as a decimal; sqrt(3)/2 is no half-rounded 0.5 sqrt(3)."""
        simple = with_root and coefficient.denominator <= SIMPLE
        return self.alphabet.style.decimals and terminates(coefficient) and not simple

    def _place_of_letter(self, atom: int) -> SortKey:
        return (self.alphabet.key(atom)[0], 0, self.ranks[atom][0])

    def _place_of_sum(self, plan: Plan) -> SortKey:
        """Where a sum stands among factors: by what it holds, then by its first product."""
        monomials = tuple(_products(plan))
        places = {self._of_product(monomial) for monomial in monomials}
        weighs = places == {Place.SUM_OF_MASSES}
        place = Place.SUM_OF_MASSES if weighs else max(Place.SUM, *places)
        return (place, 1, min(map(self._term_key, monomials)))

    def _of_product(self, monomial: Monomial) -> Place:
        """The place of a sum of such products."""
        places = {self.alphabet.key(atom)[0] for atom, _ in monomial}
        if places & {Place.FUNCTION, Place.SUM_WITH_FUNCTIONS}:
            return Place.SUM_WITH_FUNCTIONS
        if places & {Place.RATE, Place.SUM_OF_RATES}:
            return Place.SUM_OF_RATES
        weights = {Place.MASS, Place.INERTIA, Place.SUM_OF_MASSES}
        return Place.SUM_OF_MASSES if places & weights else Place.SUM

    def _term_key(self, monomial: Monomial) -> SortKey:
        """Where a product stands in a sum."""
        if monomial not in self.places:
            self.places[monomial] = self._place(monomial)
        return self.places[monomial]

    def _place(self, monomial: Monomial) -> SortKey:
        alphabet = self.alphabet
        angles: set[int] = set()
        letters, kinds = [], []
        for atom, power in monomial:
            letter, angle = self.ranks[atom]
            if angle:
                angles.add(angle)
                kinds.append((angle, alphabet.atoms[atom].kind, power))
            else:
                letters.append((letter, -power))
        powers = dict(monomial) if self.falling else {}
        falling = [-powers.get(atom, 0) for atom in self.falling]
        ordered = (*sorted(angles), len(self.ranks) + 1)  # of two that begin alike the longer one is first
        return (bool(angles), not monomial, ordered, falling, sorted(letters), sorted(kinds))

    @cached_property
    def ranks(self) -> tuple[tuple[int, int], ...]:
        """Of each atom: which it is in the order of all, and which its angle is, from 1 on, in the order of
        angles; 0 where it has none."""
        alphabet, atoms = self.alphabet, range(len(self.alphabet.atoms))
        letters = {atom: place for place, atom in enumerate(sorted(atoms, key=alphabet.key))}
        turns = {atom: alphabet.angle_key(atom) for atom in atoms if alphabet.is_trig(atom)}
        angles = {key: place for place, key in enumerate(sorted(set(turns.values())), 1)}
        return tuple((letters[atom], angles[turns[atom]] if atom in turns else 0) for atom in atoms)

    @cached_property
    def falling(self) -> tuple[int, ...]:
        """The atoms by whose falling powers terms are ordered."""
        atoms = range(len(self.alphabet.atoms))
        return tuple(sorted(filter(self.alphabet.falls, atoms), key=self.alphabet.key))


def _products(plan: Plan) -> Iterator[Monomial]:
    """What a plan comes to when its sums are multiplied out; of a power of a sum the sum alone."""
    match plan:
        case Flat(terms):
            yield from terms
        case Split(parts):
            for terms, _ in parts:
                yield from terms
        case Taken(_, monomial, sums):
            inner = (tuple(_products(each)) for each, _ in sums)
            yield from (reduce(times, found, monomial) for found in product(*inner))


def _behind(place: SortKey) -> SortKey:
    """Functions behind everything else."""
    return (Place.WRITTEN_OUT, *place[1:]) if place[0] == Place.FUNCTION else place


def _sum(terms: list[Expr]) -> Expr:
    """In this order, but a positive term first where there is one; in a short sum of letters all of them."""
    if 2 < len(terms) <= FEW and not any(isinstance(node, Call) for term in terms for node in walk(term)):
        terms = sorted(terms, key=is_negative)
    return positive_first(terms)


def positive_first(terms: Sequence[Expr]) -> Expr:
    """A sum in this order, but a positive term first where there is one."""
    first = next((i for i, term in enumerate(terms) if not is_negative(term)), 0)
    return add(*terms[first : first + 1], *terms[:first], *terms[first + 1 :])


def _all_negative(expr: Expr) -> bool:
    return all(map(is_negative, terms_of(expr)))


def _mostly_negative(expr: Expr) -> bool:
    """Whether a sum of letters has more with a minus: -(4 l^2 - b^2) rather than (b^2 - 4 l^2), so that the
    sign is seen and a sum that comes again looks the same."""
    terms = terms_of(expr)
    if any(isinstance(node, Call) for node in walk(expr)) or not all(map(free_symbols, terms)):
        return False
    return sum(map(_coefficient, terms)) < 0


def _coefficient(term: Expr) -> Fraction:
    """The number in front of a term."""
    match term:
        case Product((Number(value), *_)):
            return value
        case Quotient(top, Number(value)):
            return _coefficient(top) / value
    return Fraction(1)


def opposite(expr: Expr) -> Expr:
    """-expr without a minus sign in front where there is another way: b - a, c (b - a)."""
    if isinstance(expr, Sum):
        return _sum(list(map(negate, expr.terms)))
    if isinstance(expr, Product) and not is_negative(expr):
        for place, factor in enumerate(expr.factors):
            if isinstance(factor, Sum) and any(map(is_negative, factor.terms)):
                return multiply(*expr.factors[:place], opposite(factor), *expr.factors[place + 1 :])
    return negate(expr)
