"""Terms nested as a person would: common factors out, products recognised, few operations.

A search over which atom to take out of which terms, by price: operations, and a little for each
pair of parentheses (more where a length is taken out of some terms only, which nobody writes).
What is found is a plan; `derive.algebra.writing` turns it into a tree.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from functools import reduce
from math import gcd, lcm
from typing import TypeAlias

from flint import Ordering, fmpq_mpoly_ctx

from derive.algebra.rationals import Rational, of_flint, over, to_flint
from derive.algebra.terms import Alphabet, Monomial, SortKey, Terms, divided, frozen, terminates

MOST_FACTORED = 40  # terms; above this no factorisation is tried
MOST_SEARCHED = 10  # terms; above this the most frequent atom is taken out and no other tried
BUDGET = 1500  # terms looked at in one search; what is left when it is spent is written flat
LONG = 30  # terms; a longer sum is nested only coarsely, for nobody reads it
PARENTHESES = {"trig": 0.25, "mass": 0.1, "other": 2.25}
LARGEST_PART = 4  # a sum with smaller parts of one than a quarter is better over a common denominator
OUT_OF_TURN = 0.4  # for taking out a later angle where an earlier one could be


@dataclass(frozen=True, slots=True)
class Flat:
    """Terms as they stand."""

    terms: Terms
    price: float


@dataclass(frozen=True, slots=True)
class Split:
    """The sum of two parts, each nested on its own."""

    parts: tuple[tuple[Terms, Plan], ...]
    price: float


@dataclass(frozen=True, slots=True)
class Taken:
    """coefficient * monomial * (sum)^power * ..."""

    coefficient: Rational
    monomial: Monomial
    sums: tuple[tuple[Plan, int], ...]
    price: float


Plan: TypeAlias = Flat | Split | Taken


def nested(terms: Terms, alphabet: Alphabet) -> Plan:
    """The cheapest way of writing the terms that a search of bounded length finds."""
    return Nesting(alphabet, BUDGET if len(terms) <= LONG else 0).plan(terms)


@dataclass(slots=True)
class Nesting:
    """One search; plans found are kept, for the same remainders come up again and again."""

    alphabet: Alphabet
    budget: int
    known: dict[frozenset[tuple[Monomial, Rational]], Plan] = field(default_factory=dict)

    def plan(self, terms: Terms) -> Plan:
        """The cheapest way found."""
        if len(terms) <= 1:
            return self._flat(terms)
        if len(terms) > MOST_SEARCHED:
            return self._greedy(terms)
        if self.budget <= 0:
            return self._plain(terms)
        key = frozen(terms)
        if key not in self.known:
            self.budget -= len(terms)
            self.known[key] = self._search(terms)
        return self.known[key]

    def _search(self, terms: Terms) -> Plan:
        content, common = _content(terms, self.alphabet), _common(terms)
        if common:
            return min(self._taken_out(terms, common, content), key=_price)
        candidates: list[Plan] = [self._flat(terms), *self._splits(terms)]
        if content != 1:
            candidates += self._taken_out(terms, (), content)
        elif 3 <= len(terms) <= MOST_FACTORED:
            candidates += self._factored(terms)
        return min(candidates, key=_price)

    def _greedy(self, terms: Terms) -> Plan:
        """For long sums: what is common taken out, then the most frequent atom, and so on."""
        common = _common(terms)
        if common:
            content = _content(terms, self.alphabet)
            return self._product(common, content, ((self.plan(_divided(terms, common, content)), 1),))
        factored = self._factored(terms) if self.budget > 0 and len(terms) <= MOST_FACTORED else []
        return min([*factored, *self._splits(terms)], key=_price, default=self._flat(terms))

    def _plain(self, terms: Terms) -> Plan:
        """What is common taken out, and no search."""
        common = _common(terms)
        if not common:
            return self._flat(terms)
        content = _content(terms, self.alphabet)
        return self._product(common, content, ((self._flat(_divided(terms, common, content)), 1),))

    # -- the ways of writing a sum ----------------------------------------------------------------

    def _flat(self, terms: Terms) -> Flat:
        awkward = sum(k.denominator > LARGEST_PART for k in terms.values()) if len(terms) > 1 else 0
        price = sum(_operations(m, k) for m, k in terms.items()) + max(len(terms) - 1, 0)
        return Flat(terms, price + awkward)

    def _taken_out(self, terms: Terms, common: Monomial, content: Rational) -> list[Plan]:
        """common * (...), with the greatest common number in front and with it left inside."""
        numbers = {content, 1} if common else {content}
        return [
            self._product(common, n, ((self.plan(_divided(terms, common, n)), 1),)) for n in sorted(numbers)
        ]

    def _splits(self, terms: Terms) -> list[Plan]:
        counts = Counter(atom for monomial in terms for atom, _ in monomial)
        key, is_trig = self.alphabet.key, self.alphabet.is_trig
        frequent = sorted(
            (atom for atom, n in counts.items() if n > 1), key=lambda atom: (-counts[atom], key(atom))
        )
        most = 1 if len(terms) > MOST_SEARCHED else 6 if len(terms) > 8 else len(frequent)
        turn = min((key(a)[1:] for a in frequent if is_trig(a)), default=())
        shared = self._shared_numbers(terms) if len(terms) <= MOST_SEARCHED else []
        return [*(self._split(terms, atom, turn) for atom in frequent[:most]), *shared]

    def _shared_numbers(self, terms: Terms) -> list[Plan]:
        """(x^2 + y^2)/2 - 1: terms with the same number, that number taken out."""
        counts = Counter(abs(k) for k in terms.values())
        plans: list[Plan] = []
        for k, n in counts.items():
            if k != 1 and 1 < n < len(terms):
                taken = {m: value for m, value in terms.items() if abs(value) == k}
                rest = {m: value for m, value in terms.items() if m not in taken}
                inner, other = self.plan(taken), self.plan(rest)
                plans.append(Split(((taken, inner), (rest, other)), inner.price + other.price + 1))
        return plans

    def _split(self, terms: Terms, atom: int, turn: SortKey) -> Plan:
        """atom * (...) + the rest."""
        taken = {m: k for m, k in terms.items() if any(a == atom for a, _ in m)}
        rest = {m: k for m, k in terms.items() if m not in taken}
        inner, other = self.plan(taken), self.plan(rest)
        late = self.alphabet.is_trig(atom) and self.alphabet.key(atom)[1:] > turn
        price = inner.price + other.price + 1 + self._parentheses(atom) + (OUT_OF_TURN if late else 0.0)
        return Split(((taken, inner), (rest, other)), price)

    def _factored(self, terms: Terms) -> list[Plan]:
        if len(terms) in (5, 7):  # no product of two sums, and no square, has so many terms
            return []
        factors = factors_of(terms)
        if len(factors) < 2 and all(power == 1 for _, power in factors):
            return []
        return [self._product((), 1, tuple((self.plan(f), power) for f, power in factors))]

    @staticmethod
    def _product(monomial: Monomial, coefficient: Rational, sums: tuple[tuple[Plan, int], ...]) -> Plan:
        factors = len(sums) if monomial or abs(coefficient.numerator) != 1 else len(sums) - 1
        inside = sum(plan.price + int(power > 1) + 0.25 for plan, power in sums)
        return Taken(coefficient, monomial, sums, _operations(monomial, coefficient) + factors + inside)

    def _parentheses(self, atom: int) -> float:
        kind = "trig" if self.alphabet.is_trig(atom) else "mass" if self.alphabet.is_mass(atom) else "other"
        return PARENTHESES[kind]


def _price(plan: Plan) -> float:
    return plan.price


def factors_of(terms: Terms) -> list[tuple[Terms, int]]:
    """The irreducible factors of terms without a common monomial or content, with their powers."""
    atoms = sorted({atom for monomial in terms for atom, _ in monomial})
    context = fmpq_mpoly_ctx.get(("x", len(atoms)), Ordering.lex)
    polynomial = context.from_dict(
        {
            tuple(powers.get(atom, 0) for atom in atoms): to_flint(k)
            for powers, k in ((dict(monomial), k) for monomial, k in terms.items())
        }
    )
    content, factors = polynomial.factor()
    found = [
        (
            {
                tuple((a, int(e)) for a, e in zip(atoms, powers, strict=True) if e): of_flint(k)
                for powers, k in factor.terms()
            },
            int(power),
        )
        for factor, power in factors
    ]
    scale = of_flint(content)
    first, power = found[0]
    if scale == 1:
        return found
    if power > 1 or abs(scale) != 1:
        return [(terms, 1)]
    return [({m: k * scale for m, k in first.items()}, 1), *found[1:]]


def _content(terms: Terms, alphabet: Alphabet) -> Rational:
    """The greatest common factor of the coefficients; decimals keep theirs."""
    values = list(terms.values())
    if alphabet.style.decimals and any(map(terminates, values)):
        return 1
    top = reduce(gcd, (abs(v.numerator) for v in values))
    bottom = reduce(lcm, (v.denominator for v in values))
    return over(top, bottom)


def _common(terms: Terms) -> Monomial:
    """The greatest monomial that divides every term."""
    monomials = [dict(m) for m in terms]
    shared = set(monomials[0]).intersection(*monomials[1:])
    return tuple((atom, min(m[atom] for m in monomials)) for atom in sorted(shared))


def _divided(terms: Terms, by: Monomial, content: Rational) -> Terms:
    powers = dict(by)
    return {divided(monomial, powers): over(k, content) for monomial, k in terms.items()}


def _operations(monomial: Monomial, coefficient: Rational) -> float:
    factors = len(monomial) + (abs(coefficient.numerator) != 1) - 1
    return max(factors, 0) + sum(power > 1 for _, power in monomial) + (coefficient.denominator > 1)
