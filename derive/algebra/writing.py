"""A plan of nesting as a tree: the order of terms and factors on a blackboard, and their signs."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import prod

from derive.algebra.nesting import Flat, Plan, Split, Taken
from derive.algebra.terms import Alphabet, Monomial, SortKey, terminates
from derive.expression import (
    Call,
    Expr,
    Number,
    Power,
    Product,
    Sum,
    is_negative,
    multiply,
    negate,
    number,
    sqrt,
    walk,
)


@dataclass(frozen=True, slots=True)
class Writing:
    """Writes plans over one alphabet."""

    alphabet: Alphabet

    def tree(self, plan: Plan) -> Expr:
        match plan:
            case Flat(terms):
                ordered = sorted(terms.items(), key=lambda item: self._term_key(item[0]))
                return _sum([self._monomial(monomial, k) for monomial, k in ordered])
            case Split(parts):
                keyed = sorted(parts, key=lambda part: min(map(self._term_key, part[0])))
                return _sum([term for _, inner in keyed for term in _terms(self.tree(inner))])
            case Taken(coefficient, monomial, sums):
                return self._product(coefficient, monomial, [(self.tree(p), power) for p, power in sums])

    def _product(self, coefficient: Fraction, monomial: Monomial, sums: list[tuple[Expr, int]]) -> Expr:
        """Number and symbols, then sums; sines and cosines before sums that hold some themselves."""
        factors: list[Expr] = []
        for expr, power in sums:
            if isinstance(expr, Sum) and all(map(is_negative, expr.terms)):
                expr, coefficient = Sum(tuple(map(negate, expr.terms))), coefficient * (-1) ** power
            factors.append(Power(expr, number(power)) if power > 1 else expr)
        trig = tuple(part for part in monomial if self.alphabet.is_trig(part[0]))
        if any(isinstance(node, Call) for expr in factors for node in walk(expr)):
            trig = ()
        front = tuple(part for part in monomial if part not in trig)
        parts = (self._monomial(front, coefficient), *factors, self._monomial(trig, Fraction(1)))
        return multiply(*(factor for part in parts for factor in _factors(part)))

    def _monomial(self, monomial: Monomial, coefficient: Fraction) -> Expr:
        alphabet = self.alphabet
        radicand = prod(alphabet.radicand(atom) for atom, _ in monomial)
        factors = [
            Power(alphabet.expression(atom), number(power)) if power > 1 else alphabet.expression(atom)
            for atom, power in sorted(monomial, key=lambda part: alphabet.key(part[0]))
            if alphabet.radicand(atom) == 1
        ]
        decimal = alphabet.style.decimals and terminates(coefficient)
        roots = (sqrt(number(radicand)),) if radicand > 1 else ()  # sqrt(2) sqrt(3) is sqrt(6)
        return multiply(Number(coefficient, decimal), *roots, *factors)

    def _term_key(self, monomial: Monomial) -> SortKey:
        """Terms without sines and cosines first, then in the order of their angles."""
        key, is_trig = self.alphabet.key, self.alphabet.is_trig
        trig = sorted(key(atom)[1:] + key(atom)[:1] for atom, _ in monomial if is_trig(atom))
        others = sorted((key(atom), -power) for atom, power in monomial if not is_trig(atom))
        return (bool(trig), not monomial, trig, others)


def _sum(terms: list[Expr]) -> Expr:
    """In this order, but a positive term first where there is one."""
    first = next((i for i, term in enumerate(terms) if not is_negative(term)), 0)
    ordered = [terms[first], *terms[:first], *terms[first + 1 :]] if terms else []
    return Sum(tuple(ordered)) if len(ordered) > 1 else ordered[0] if ordered else number(0)


def _terms(expr: Expr) -> tuple[Expr, ...]:
    return expr.terms if isinstance(expr, Sum) else (expr,)


def _factors(expr: Expr) -> tuple[Expr, ...]:
    return expr.factors if isinstance(expr, Product) else (expr,)
