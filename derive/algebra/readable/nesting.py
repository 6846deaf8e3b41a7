"""Terms nested as a person would: common factors out, products recognised, few operations.

A search over which atom to take out of which terms, by price: operations, and a little for each
pair of parentheses (more where a length is taken out of some terms only, which nobody writes).
What is found is a plan; `derive.algebra.readable.writing` turns it into a tree.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from itertools import chain
from math import inf
from typing import TypeAlias

from derive.algebra.rationals import Rational
from derive.algebra.readable.factoring import common, content, divided_by, factors_of, is_irreducible
from derive.algebra.readable.order import SortKey
from derive.algebra.readable.terms import Alphabet, Monomial, Terms, frozen

MOST_FACTORED = 40  # terms; above this no factorisation is tried
MOST_SEARCHED = 10  # terms; above this the most frequent atom is taken out and no other tried
PARENTHESES = {"trig": 0.25, "mass": 0.1, "other": 2.25}
LARGEST_PART = 4  # a sum with smaller parts of one than a quarter is better over a common denominator
DEEPEST = 2  # parentheses in parentheses that a reader follows
TOO_DEEP = 2.5  # for each pair further out
OUT_OF_TURN = 0.4  # for taking out a later angle where an earlier one could be


@dataclass(frozen=True, slots=True)
class Flat:
    """Terms as they stand."""

    terms: Terms
    price: float
    depth: int = 0  # how deep parentheses stand in each other


@dataclass(frozen=True, slots=True)
class Split:
    """The sum of parts, each nested on its own."""

    parts: tuple[tuple[Terms, Plan], ...]
    price: float
    depth: int = 0


@dataclass(frozen=True, slots=True)
class Taken:
    """coefficient * monomial * (sum)^power * ..."""

    coefficient: Rational
    monomial: Monomial
    sums: tuple[tuple[Plan, int], ...]
    price: float
    depth: int = 0


Plan: TypeAlias = Flat | Split | Taken


def cheapest(plans: Iterable[Plan]) -> Plan:
    """The first of the lowest price."""
    return min(plans, key=lambda plan: plan.price)


@dataclass(slots=True)
class Nesting:
    """One search. `budget` is how many terms it may look at; what is left when it is spent is written
    flat. Plans found are kept, for the same remainders come up again and again."""

    alphabet: Alphabet
    budget: int
    known: dict[frozenset[tuple[Monomial, Rational]], Plan] = field(default_factory=dict)
    costs: dict[Monomial, tuple[int, float]] = field(default_factory=dict)

    def plan(self, terms: Terms) -> Plan:
        """The cheapest way found."""
        if len(terms) <= 1:
            return self.flat(terms)
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
        shared, number = common(terms), content(terms, self.alphabet)
        if shared:
            return cheapest(self._taken_out(terms, shared, number))
        best: Plan = self.flat(terms)
        for part, aside in self._parts(terms):
            best = self._split(terms, part, aside, best.price) or best
        others = self._taken_out(terms, (), number) if number != 1 else self.factored(terms)
        return cheapest((best, *others))

    def _greedy(self, terms: Terms) -> Plan:
        """For long sums: what is common taken out, then the most frequent atom, and so on."""
        shared = common(terms)
        if shared:
            return self._over_common(terms, shared, self.plan)
        factored = self.factored(terms) if self.budget > 0 and len(terms) <= MOST_FACTORED else []
        part, aside = next(self._parts(terms), (Terms(), 0.0))
        split = self._split(terms, part, aside, inf)
        return cheapest([*factored, split or self.flat(terms)])

    def _plain(self, terms: Terms) -> Plan:
        """What is common taken out, and no search."""
        shared = common(terms)
        return self._over_common(terms, shared, self.flat) if shared else self.flat(terms)

    # -- the ways of writing a sum ----------------------------------------------------------------

    def flat(self, terms: Terms) -> Flat:
        """As it stands."""
        awkward = sum(k.denominator > LARGEST_PART for k in terms.values()) if len(terms) > 1 else 0
        price = sum(self._operations(m, k) for m, k in terms.items()) + max(len(terms) - 1, 0)
        return Flat(terms, price + awkward, int(self.alphabet.lumps and any(map(self._lumped, terms))))

    def product(self, monomial: Monomial, coefficient: Rational, sums: tuple[tuple[Plan, int], ...]) -> Plan:
        """coefficient * monomial * the sums, each to its power."""
        factors = len(sums) if monomial or abs(coefficient.numerator) != 1 else len(sums) - 1
        inside = sum(plan.price + int(power > 1) + 0.25 for plan, power in sums)
        depth = 1 + max(plan.depth for plan, _ in sums)
        price = self._operations(monomial, coefficient) + factors + inside + TOO_DEEP * (depth > DEEPEST)
        return Taken(coefficient, monomial, sums, price, depth)

    def _over_common(self, terms: Terms, shared: Monomial, way: Callable[[Terms], Plan]) -> Plan:
        number = content(terms, self.alphabet)
        return self.product(shared, number, ((way(divided_by(terms, shared, number)), 1),))

    def _taken_out(self, terms: Terms, shared: Monomial, number: Rational) -> list[Plan]:
        """shared * (...), with the greatest common number in front; a fraction may stay inside as well."""
        numbers = {number, 1} if shared and number.denominator > 1 else {number}
        return [
            self.product(shared, n, ((self.plan(divided_by(terms, shared, n)), 1),)) for n in sorted(numbers)
        ]

    def factored(self, terms: Terms) -> list[Plan]:
        """As a product of sums, or as a power of one, where it is one."""
        if len(terms) in (2, 5, 7) or is_irreducible(terms):
            return []  # no product of two sums, and no square, has so many terms
        scale, factors = factors_of(terms)
        if len(factors) < 2 and all(power == 1 for _, power in factors):
            return []
        return [self.product((), scale, tuple((self.plan(f), power) for f, power in factors))]

    def _split(self, terms: Terms, taken: Terms, aside: float, most: float) -> Plan | None:
        """Some of the terms, nested, and the rest; None where that cannot cost less than `most`."""
        rest = {m: k for m, k in terms.items() if m not in taken}
        least = aside + len(rest)  # each further term is an addition at least
        if not taken or len(taken) + least >= most:
            return None
        inner = self.plan(taken)
        if inner.price + least >= most:
            return None
        other = self.plan(rest)
        price = inner.price + other.price + 1 + aside
        depth = max(inner.depth, other.depth)
        return Split(((taken, inner), (rest, other)), price, depth) if price < most else None

    # -- which terms to take together -------------------------------------------------------------

    def _parts(self, terms: Terms) -> Iterator[tuple[Terms, float]]:
        """(terms, price of the parentheses): those with the same atom, most frequent first; those with the
        same number."""
        atoms = {monomial: [atom for atom, _ in monomial] for monomial in terms}
        counts = Counter(chain.from_iterable(atoms.values()))
        key, is_trig = self.alphabet.key, self.alphabet.is_trig
        several = [atom for atom, n in counts.items() if n > 1]
        frequent = sorted(several, key=lambda atom: (-counts[atom], key(atom)))
        turn = min((self.alphabet.angle_key(a) for a in frequent if is_trig(a)), default=())
        for atom in frequent[:6] if len(terms) > 8 else frequent:
            taken = {m: k for m, k in terms.items() if atom in atoms[m]}
            yield taken, self._parentheses(atom, turn)
        yield from self._same_numbers(terms)

    def _same_numbers(self, terms: Terms) -> Iterator[tuple[Terms, float]]:
        """(x^2 + y^2)/2 - 1: terms with the same number."""
        alike: dict[Rational, Terms] = {}
        for monomial, k in terms.items():
            alike.setdefault(max(k, -k), {})[monomial] = k
        for number, taken in alike.items():
            if number != 1 and 1 < len(taken) < len(terms):
                yield taken, self._aside(taken, number)

    def _aside(self, taken: Terms, number: Rational) -> float:
        """What it costs to take a number out of some terms only: more where a length goes with it, as in
        a + 2 b (b + c), and where it is a whole number and the terms have masses."""
        atoms = {atom for monomial in taken for atom, _ in monomial}
        if number.denominator == 1 and any(map(self.alphabet.is_mass, atoms)):
            return PARENTHESES["other"]
        return max((self._parentheses(atom) for atom, _ in common(taken)), default=0.0)

    # -- prices -----------------------------------------------------------------------------------

    def _operations(self, monomial: Monomial, coefficient: Rational) -> float:
        """Multiplications, powers and a quotient; sums that stand for one letter, and their parentheses."""
        if monomial not in self.costs:
            powers = sum([power > 1 for _, power in monomial])
            lumps = sum([self.alphabet.extra(atom) for atom, _ in monomial])
            self.costs[monomial] = len(monomial), powers + lumps
        letters, more = self.costs[monomial]
        if coefficient in (1, -1):
            return max(letters - 1, 0) + more
        factors = letters - (coefficient.numerator in (1, -1))
        return max(factors, 0) + more + (coefficient.denominator > 1)

    def _lumped(self, monomial: Monomial) -> bool:
        """Whether a sum that stands for one letter is in it."""
        return any(self.alphabet.extra(atom) for atom, _ in monomial)

    def _parentheses(self, atom: int, turn: SortKey = ()) -> float:
        if self.alphabet.is_trig(atom):
            late = bool(turn) and self.alphabet.angle_key(atom) > turn
            return PARENTHESES["trig"] + (OUT_OF_TURN if late else 0.0)
        return PARENTHESES["mass" if self.alphabet.is_mass(atom) else "other"]
