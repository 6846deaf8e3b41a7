"""A plan of nesting as a tree: the order of terms and factors on a blackboard, and their signs."""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from math import prod

from derive.algebra.rationals import Rational
from derive.algebra.readable.nesting import Flat, Plan, Split, Taken
from derive.algebra.readable.terms import Alphabet, Monomial, SortKey, terminates
from derive.expression import (
    Call,
    Expr,
    Number,
    Power,
    Product,
    Sum,
    factors_of,
    is_negative,
    multiply,
    negate,
    number,
    sqrt,
    terms_of,
    walk,
)

FEW = 8  # terms


@dataclass(frozen=True)
class Writing:
    """Writes plans over one alphabet, which has all its atoms by then."""

    alphabet: Alphabet
    places: dict[Monomial, SortKey] = field(default_factory=dict)

    def tree(self, plan: Plan) -> Expr:
        """The tree of a plan."""
        match plan:
            case Flat(terms):
                ordered = sorted(terms.items(), key=lambda item: self._term_key(item[0]))
                return _sum(
                    [term for monomial, k in ordered for term in terms_of(self._monomial(monomial, k))]
                )
            case Split(parts):
                keyed = sorted(parts, key=lambda part: min(map(self._term_key, part[0])))
                return _sum([term for _, inner in keyed for term in terms_of(self.tree(inner))])
            case Taken(coefficient, monomial, sums):
                return self._product(coefficient, monomial, sums)

    def _product(self, coefficient: Rational, monomial: Monomial, sums: tuple[tuple[Plan, int], ...]) -> Expr:
        """Number and symbols, then sums; sines and cosines before sums that hold some themselves."""
        factors: list[Expr] = []
        for plan, power in sums:
            expr = self.tree(plan)
            if _all_negative(expr):
                expr, coefficient = opposite(expr), coefficient * (-1) ** power
            if power == 1 and isinstance(expr, Product) and isinstance(expr.factors[0], Number):
                coefficient, expr = coefficient * expr.factors[0].value, multiply(*expr.factors[1:])
            factors.append(Power(expr, number(power)) if power > 1 else expr)
        trig = tuple(part for part in monomial if self.alphabet.is_trig(part[0]))
        if any(self._holds_function(plan) for plan, _ in sums):
            trig = ()
        front = tuple(part for part in monomial if part not in trig)
        parts = (self._monomial(front, coefficient), *factors, self._monomial(trig, 1))
        return multiply(*(factor for part in parts for factor in factors_of(part)))

    def _holds_function(self, plan: Plan) -> bool:
        """Whether there is a sine or a root somewhere inside."""
        match plan:
            case Flat(terms):
                return any(self.alphabet.is_function(atom) for monomial in terms for atom, _ in monomial)
            case Split(parts):
                return any(self._holds_function(inner) for _, inner in parts)
            case Taken(_, monomial, sums):
                here = any(self.alphabet.is_function(atom) for atom, _ in monomial)
                return here or any(self._holds_function(inner) for inner, _ in sums)

    def _monomial(self, monomial: Monomial, coefficient: Rational) -> Expr:
        alphabet = self.alphabet
        radicand = prod(alphabet.radicand(atom) for atom, _ in monomial)
        ordered = sorted(monomial, key=lambda part: alphabet.key(part[0]))
        factors = [alphabet.expression(*part) for part in ordered if alphabet.radicand(part[0]) == 1]
        decimal = alphabet.style.decimals and terminates(coefficient)
        roots = (sqrt(number(radicand)),) if radicand > 1 else ()  # sqrt(2) sqrt(3) is sqrt(6)
        if coefficient == -1 and len(factors) == 1 and isinstance(factors[0], Sum) and not roots:
            return opposite(factors[0])
        return multiply(Number(Fraction(coefficient), decimal), *roots, *factors)

    def _term_key(self, monomial: Monomial) -> SortKey:
        """Terms without sines and cosines first, then in the order of their angles."""
        if monomial not in self.places:
            self.places[monomial] = self._place(monomial)
        return self.places[monomial]

    def _place(self, monomial: Monomial) -> SortKey:
        ranks = self.ranks
        trig = sorted([ranks[atom][1] for atom, _ in monomial if ranks[atom][0]])
        others = sorted([(ranks[atom][1], -power) for atom, power in monomial if not ranks[atom][0]])
        return (bool(trig), not monomial, trig, others)

    @cached_property
    def ranks(self) -> tuple[tuple[bool, int], ...]:
        """Of each atom: whether it is a sine or cosine, and which it is in their order, by angles, or in that
        of the others."""
        key, is_trig = self.alphabet.key, self.alphabet.is_trig
        atoms = range(len(self.alphabet.atoms))
        order = sorted(atoms, key=lambda a: (is_trig(a), key(a)[1:] + key(a)[:1] if is_trig(a) else key(a)))
        rank = {atom: place for place, atom in enumerate(order)}
        return tuple((is_trig(atom), rank[atom]) for atom in atoms)


def _sum(terms: list[Expr]) -> Expr:
    """In this order, but a positive term first where there is one; in a short sum of letters all of them."""
    if 2 < len(terms) <= FEW and not any(isinstance(node, Call) for term in terms for node in walk(term)):
        terms = sorted(terms, key=is_negative)
    first = next((i for i, term in enumerate(terms) if not is_negative(term)), 0)
    ordered = [terms[first], *terms[:first], *terms[first + 1 :]] if terms else []
    return Sum(tuple(ordered)) if len(ordered) > 1 else ordered[0] if ordered else number(0)


def _all_negative(expr: Expr) -> bool:
    return all(map(is_negative, terms_of(expr)))


def opposite(expr: Expr) -> Expr:
    """-expr without a minus sign in front where there is another way: b - a, c (b - a)."""
    if isinstance(expr, Sum):
        return _sum(list(map(negate, expr.terms)))
    if isinstance(expr, Product) and not is_negative(expr):
        for place, factor in enumerate(expr.factors):
            if isinstance(factor, Sum) and any(map(is_negative, factor.terms)):
                return multiply(*expr.factors[:place], opposite(factor), *expr.factors[place + 1 :])
    return negate(expr)
