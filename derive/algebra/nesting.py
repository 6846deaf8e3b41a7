"""Terms nested as a person would: common factors out, products recognised, few operations.

A search over which atom to take out of which terms, by price: operations, and a little for each
pair of parentheses (more where a length is taken out of some terms only, which nobody writes).
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from fractions import Fraction
from functools import reduce
from math import gcd, lcm

from flint import Ordering, fmpq, fmpq_mpoly_ctx

from derive.algebra.scalar import as_fraction
from derive.algebra.terms import Alphabet, Monomial, SortKey, Terms, frozen, times
from derive.expression import (
    ONE,
    Expr,
    Number,
    Power,
    Product,
    Sum,
    is_negative,
    multiply,
    negate,
    number,
)

MOST_FACTORED = 40  # terms; above this no factorisation is tried
MOST_SEARCHED = 14  # terms; above this the most frequent atom is taken out and no other tried
PARENTHESES = {"trig": 0.25, "mass": 0.1, "other": 2.25}
LARGEST_PART = 4  # a sum with smaller parts of one than a quarter is better over a common denominator
OUT_OF_TURN = 0.4  # for taking out a later angle where an earlier one could be


@dataclass(frozen=True, slots=True)
class Form:
    """A nested form and its price."""

    price: float
    expr: Expr


@dataclass(slots=True)
class Nesting:
    """One search; forms found are kept, for the same remainders come up again and again."""

    alphabet: Alphabet
    known: dict[frozenset[tuple[Monomial, Fraction]], Form] = field(default_factory=dict)

    def form(self, terms: Terms) -> Form:
        """The cheapest form found."""
        key = frozen(terms)
        if key not in self.known:
            self.known[key] = self._search(terms)
        return self.known[key]

    def _search(self, terms: Terms) -> Form:
        if len(terms) <= 1:
            return self._flat(terms)
        content, common = _content(terms, self.alphabet), _common(terms)
        if common:
            return min(self._taken_out(terms, common, content), key=lambda form: form.price)
        candidates = [self._flat(terms), *self._splits(terms)]
        if content != 1:
            candidates += self._taken_out(terms, (), content)
        elif 3 <= len(terms) <= MOST_FACTORED:
            candidates += self._factored(terms)
        return min(candidates, key=lambda form: form.price)

    def _taken_out(self, terms: Terms, common: Monomial, content: Fraction) -> list[Form]:
        """common * (...), with the greatest common number in front and with it left inside."""
        numbers = {content, Fraction(1)} if common else {content}
        return [
            self._product([(common, number)], [(self.form(_divided(terms, common, number)), 1)])
            for number in sorted(numbers)
        ]

    # -- the three ways of writing a sum ----------------------------------------------------------

    def _flat(self, terms: Terms) -> Form:
        parts = [(self._term_key(m), self._monomial(m, k), _operations(m, k)) for m, k in terms.items()]
        ordered = sorted(parts, key=lambda part: part[0])
        expr = _sum([part[1] for part in ordered])
        awkward = sum(k.denominator > LARGEST_PART for k in terms.values()) if len(terms) > 1 else 0
        return Form(sum(part[2] for part in parts) + max(len(parts) - 1, 0) + awkward, expr)

    def _splits(self, terms: Terms) -> list[Form]:
        counts = Counter(atom for monomial in terms for atom, _ in monomial)
        frequent = sorted(
            (atom for atom, n in counts.items() if n > 1),
            key=lambda atom: (-counts[atom], self.alphabet.key(atom)),
        )
        most = 1 if len(terms) > MOST_SEARCHED else 6 if len(terms) > 8 else len(frequent)
        first = min((self.alphabet.key(a)[1:] for a in frequent if self.alphabet.is_trig(a)), default=())
        return [self._split(terms, atom, first) for atom in frequent[:most]]

    def _split(self, terms: Terms, atom: int, turn: SortKey) -> Form:
        """atom * (...) + the rest."""
        taken = {m: k for m, k in terms.items() if any(a == atom for a, _ in m)}
        rest = {m: k for m, k in terms.items() if m not in taken}
        inner, other = self.form(taken), self.form(rest)
        expr = _sum(self._in_order([(taken, inner.expr), (rest, other.expr)]))
        late = OUT_OF_TURN if self.alphabet.is_trig(atom) and self.alphabet.key(atom)[1:] > turn else 0.0
        return Form(inner.price + other.price + 1 + self._parentheses(atom) + late, expr)

    def _factored(self, terms: Terms) -> list[Form]:
        factors = factors_of(terms)
        if len(factors) < 2 and all(power == 1 for _, power in factors):
            return []
        return [self._product([((), Fraction(1))], [(self.form(f), power) for f, power in factors])]

    # -- parts ------------------------------------------------------------------------------------

    def _product(self, monomials: list[tuple[Monomial, Fraction]], sums: list[tuple[Form, int]]) -> Form:
        ((monomial, coefficient),) = monomials
        price = _operations(monomial, coefficient)
        factors: list[Expr] = []
        for form, power in sums:
            expr = form.expr
            if isinstance(expr, Sum) and all(map(is_negative, expr.terms)):
                expr, coefficient = Sum(tuple(map(negate, expr.terms))), -coefficient
            factors.append(Power(expr, number(power)) if power > 1 else expr)
            price += form.price + int(power > 1) + 0.25
        head = self._monomial(monomial, coefficient)
        heads = [] if head == ONE else [head]
        price += len(heads) + len(factors) - 1
        flat = [part for expr in (*heads, *factors) for part in _factors(expr)]
        return Form(price, multiply(*flat))

    def _monomial(self, monomial: Monomial, coefficient: Fraction) -> Expr:
        ordered = sorted(monomial, key=lambda part: self.alphabet.key(part[0]))
        factors = [
            Power(self.alphabet.expression(atom), number(power))
            if power > 1
            else self.alphabet.expression(atom)
            for atom, power in ordered
        ]
        return multiply(written(coefficient, self.alphabet.style.decimals), *factors)

    def _term_key(self, monomial: Monomial) -> SortKey:
        """Terms without sines and cosines first, then in the order of their angles."""
        key, is_trig = self.alphabet.key, self.alphabet.is_trig
        trig = sorted(key(atom)[1:] + key(atom)[:1] for atom, _ in monomial if is_trig(atom))
        others = sorted((key(atom), -power) for atom, power in monomial if not is_trig(atom))
        return (bool(trig), not monomial, trig, others)

    def _in_order(self, parts: list[tuple[Terms, Expr]]) -> list[Expr]:
        keyed = sorted(parts, key=lambda part: min(map(self._term_key, part[0])))
        return [term for _, expr in keyed for term in (expr.terms if isinstance(expr, Sum) else (expr,))]

    def _parentheses(self, atom: int) -> float:
        kind = "trig" if self.alphabet.is_trig(atom) else "mass" if self.alphabet.is_mass(atom) else "other"
        return PARENTHESES[kind]


def factors_of(terms: Terms) -> list[tuple[Terms, int]]:
    """The irreducible factors of terms without a common monomial or content, with their powers."""
    atoms = sorted({atom for monomial in terms for atom, _ in monomial})
    context = fmpq_mpoly_ctx.get([f"x{atom}" for atom in atoms], Ordering.lex)
    polynomial = context.from_dict(
        {
            tuple(dict(monomial).get(atom, 0) for atom in atoms): fmpq(k.numerator, k.denominator)
            for monomial, k in terms.items()
        }
    )
    content, factors = polynomial.factor()
    found = [
        (
            {
                tuple((a, int(e)) for a, e in zip(atoms, powers, strict=True) if e): as_fraction(k)
                for powers, k in factor.terms()
            },
            int(power),
        )
        for factor, power in factors
    ]
    scale = as_fraction(content)
    first, power = found[0]
    if scale == 1:
        return found
    if power > 1 or abs(scale) != 1:
        return [(terms, 1)]
    return [({m: k * scale for m, k in first.items()}, 1), *found[1:]]


def written(value: Fraction, decimals: bool) -> Number:
    """A number as this sheet writes it."""
    return Number(value, decimals and terminates(value))


def terminates(value: Fraction) -> bool:
    """Whether it is a decimal fraction of at most six places."""
    return value.denominator > 1 and (value * 10**6).denominator == 1


def _content(terms: Terms, alphabet: Alphabet) -> Fraction:
    """The greatest common factor of the coefficients; decimals keep theirs."""
    values = list(terms.values())
    if alphabet.style.decimals and any(map(terminates, values)):
        return Fraction(1)
    top = reduce(gcd, (abs(v.numerator) for v in values))
    bottom = reduce(lcm, (v.denominator for v in values))
    return Fraction(top, bottom)


def _common(terms: Terms) -> Monomial:
    """The greatest monomial that divides every term."""
    monomials = [dict(m) for m in terms]
    shared = set(monomials[0]).intersection(*monomials[1:])
    return tuple((atom, min(m[atom] for m in monomials)) for atom in sorted(shared))


def _divided(terms: Terms, by: Monomial, content: Fraction) -> Terms:
    inverse = [(atom, -power) for atom, power in by]
    return {times(monomial, inverse): k / content for monomial, k in terms.items()}


def _operations(monomial: Monomial, coefficient: Fraction) -> float:
    factors = len(monomial) + (abs(coefficient.numerator) != 1) - 1
    return max(factors, 0) + sum(power > 1 for _, power in monomial) + (coefficient.denominator > 1)


def _sum(terms: list[Expr]) -> Expr:
    """In this order, but a positive term first where there is one."""
    first = next((i for i, term in enumerate(terms) if not is_negative(term)), 0)
    ordered = [terms[first], *terms[:first], *terms[first + 1 :]] if terms else []
    return Sum(tuple(ordered)) if len(ordered) > 1 else ordered[0] if ordered else number(0)


def _factors(expr: Expr) -> tuple[Expr, ...]:
    return expr.factors if isinstance(expr, Product) else (expr,)
