"""Long sums a mass at a time, m_1 (...) + m_2 (...) + I_1 (...), as textbooks write them."""

from __future__ import annotations

from collections import defaultdict
from functools import reduce

from derive.algebra.rationals import Rational
from derive.algebra.readable.angle_sums import contracted
from derive.algebra.readable.factoring import common, content, divided_by
from derive.algebra.readable.nesting import MOST_SEARCHED, Flat, Nesting, Plan, Split, Taken, cheapest
from derive.algebra.readable.repeated_sums import lumped
from derive.algebra.readable.terms import Alphabet, Monomial, Terms, divided, frozen, times

BUDGET = 800  # terms looked at in one search
BUDGET_BY_MASSES = 400  # the same for all that the masses multiply
LONG = 30  # terms; a longer sum is nested only coarsely, for nobody reads it
MOST_BY_MASSES = 60  # terms; above this they are not sorted by masses


def nested(terms: Terms, alphabet: Alphabet) -> Plan:
    """The cheapest way of writing the terms that searches of bounded length find; in a short sum of several
    masses each stands once, whatever that costs."""
    searched = Nesting(alphabet, BUDGET if len(terms) <= LONG else 0).plan(terms)
    if len(terms) > MOST_BY_MASSES:
        return searched
    by_masses = _by_masses(terms, Nesting(alphabet, BUDGET_BY_MASSES))
    if len(terms) > MOST_SEARCHED:
        return cheapest([searched, *by_masses])
    several = max(map(len, by_mass(terms, alphabet).values()), default=0) > 1
    return cheapest(by_masses if by_masses and several else [searched])


def _by_masses(terms: Terms, nesting: Nesting) -> list[Plan]:
    """What all terms share in front, but for masses, and the sum of the masses' parts."""
    shared = tuple(part for part in common(terms) if not nesting.alphabet.is_mass(part[0]))
    number = content(terms, nesting.alphabet)
    number = number if number.denominator == 1 else 1
    groups = by_mass(divided_by(terms, shared, number), nesting.alphabet)
    if len(groups) < 2:
        return []
    whole = _sum(groups, nesting)
    return [nesting.product(shared, number, ((whole, 1),)) if shared or number != 1 else whole]


def by_mass(terms: Terms, alphabet: Alphabet) -> dict[int, Terms]:
    """What each mass multiplies, masses of the same factor added; empty where not every term has just one."""
    groups: dict[int, Terms] = {}
    for monomial, k in terms.items():
        masses = [(atom, power) for atom, power in monomial if alphabet.is_mass(atom)]
        if len(masses) != 1 or masses[0][1] > 1:
            return {}
        ((mass, _),) = masses
        groups.setdefault(mass, {})[divided(monomial, {mass: 1})] = k
    return _alike_added(groups, alphabet)


def _alike_added(groups: dict[int, Terms], alphabet: Alphabet) -> dict[int, Terms]:
    """I_1 a + I_2 a as (I_1 + I_2) a; m_1 + m_2 alone needs no parentheses."""
    alike: dict[frozenset[tuple[Monomial, Rational]], list[int]] = defaultdict(list)
    for mass, inner in groups.items():
        alike[frozen(inner)].append(mass)
    found: dict[int, Terms] = {}
    for masses in alike.values():
        inner = groups[masses[0]]
        together = [reduce(alphabet.lump, masses)] if any(inner) else masses
        found |= dict.fromkeys(together, inner)
    return found


def _sum(groups: dict[int, Terms], nesting: Nesting) -> Plan:
    parts = tuple(_part(mass, inner, nesting) for mass, inner in groups.items())
    price = sum(plan.price for _, plan in parts) + len(parts) - 1
    return Split(parts, price, max(plan.depth for _, plan in parts))


def _part(mass: int, inner: Terms, nesting: Nesting) -> tuple[Terms, Plan]:
    """A mass times what it multiplies, and the plan of that."""
    here = ((mass, 1),)
    terms = {times(monomial, here): k for monomial, k in inner.items()}
    plan = nesting.plan(lumped(contracted(inner, nesting.alphabet), nesting.alphabet))
    return terms, with_factor(here, plan, nesting)


def with_factor(here: Monomial, plan: Plan, nesting: Nesting, number: Rational = 1) -> Plan:
    """The plan of a sum as that of number * product * sum."""
    match plan:
        case _ if not here and number == 1:
            return plan
        case Flat(alone) if len(alone) == 1:
            return nesting.flat({times(monomial, here): k * number for monomial, k in alone.items()})
        case Taken(coefficient, monomial, sums):
            return nesting.product(times(monomial, here), coefficient * number, sums)
        case _:
            return nesting.product(here, number, ((plan, 1),))


def with_sum(inner: Plan, plan: Plan, nesting: Nesting) -> Plan:
    """The plan of something as that of it times a sum."""
    match plan:
        case Flat(alone) if len(alone) == 1:
            ((monomial, coefficient),) = alone.items()
            return nesting.product(monomial, coefficient, ((inner, 1),))
        case Taken(coefficient, monomial, sums):
            return nesting.product(monomial, coefficient, (*sums, (inner, 1)))
        case _:
            return nesting.product((), 1, ((plan, 1), (inner, 1)))
