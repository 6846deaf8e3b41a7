"""Sums of what moves, rate by rate, as textbooks write energies, velocities and torques:
(m l^2 + I) theta1_dot^2 + 2 m l d c_2 theta1_dot d_dot; and sums of weights, function by function:
(m_1 + m_2) g l s_1 + m_2 g l s_12.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import combinations, product
from math import comb

from derive.algebra.rationals import Rational
from derive.algebra.readable import by_mass
from derive.algebra.readable.factoring import common, content, divided_by
from derive.algebra.readable.nesting import Nesting, Plan, Split, cheapest
from derive.algebra.readable.repeated_sums import lumped
from derive.algebra.readable.terms import Alphabet, Monomial, Terms, divided, frozen, put, times

BUDGET = 200  # terms looked at for a square or a product of sums
MOST_REBASED = 60  # terms; in longer sums no rates are added


def nested(terms: Terms, alphabet: Alphabet) -> Plan:
    """The terms collected by rates, else by functions where all of them weigh, else as cheaply as can be."""
    short = lumped(terms, alphabet)
    if any(alphabet.is_rate(atom) for monomial in short for atom, _ in monomial):
        return _collected(with_sums_of_rates(short, alphabet), alphabet, alphabet.is_rate)
    if any(alphabet.is_gravity(atom) for atom, _ in common(short)):
        return _collected(short, alphabet, alphabet.is_trig)
    return by_mass.nested(short, alphabet)


def _collected(terms: Terms, alphabet: Alphabet, kept: Callable[[int], bool]) -> Plan:
    """A sum over the products of what is kept, each with its coefficient, those with the same together; where
    no coefficient is a sum, what all terms share stands in front."""
    groups: dict[Monomial, Terms] = {}
    for monomial, k in terms.items():
        here = tuple(part for part in monomial if kept(part[0]))
        groups.setdefault(here, {})[divided(monomial, dict(here))] = k
    if groups.keys() <= {()}:
        return by_mass.nested(terms, alphabet)
    nesting = Nesting(alphabet, BUDGET)
    if all(len(inner) == 1 for inner in groups.values()) and (common(terms) or len(groups) < 2):
        return _over_common(terms, nesting)
    return _sum([_part(*pair, nesting) for pair in _alike(groups, alphabet)])


def _alike(groups: dict[Monomial, Terms], alphabet: Alphabet) -> Iterator[tuple[Terms, Terms]]:
    """(products, their coefficient): l c_2 (2 theta1_ddot + theta2_ddot) has two of the same."""
    found: dict[frozenset[tuple[Monomial, Rational]], Terms] = {}
    for here, inner in groups.items():
        number = content(inner, alphabet) * (1 if next(iter(inner.values())) > 0 else -1)
        found.setdefault(frozen(divided_by(inner, (), number)), {})[here] = number
    for coefficient, products in found.items():
        if any(monomial != () for monomial, _ in coefficient):
            yield products, dict(coefficient)
        else:
            yield from (({here: k}, dict(coefficient)) for here, k in products.items())


def _part(products: Terms, coefficient: Terms, nesting: Nesting) -> tuple[Terms, Plan]:
    """The terms of products with the same coefficient, and the plan that writes them behind it."""
    terms: Terms = {}
    for here, n in products.items():
        for monomial, k in coefficient.items():
            put(terms, times(monomial, here), k * n)
    if len(products) == 1:
        return terms, cheapest(_with_product(here, {m: k * n for m, k in coefficient.items()}, nesting))
    number = content(products, nesting.alphabet)
    front = by_mass.nested({monomial: k * number for monomial, k in coefficient.items()}, nesting.alphabet)
    return terms, by_mass.with_sum(nesting.flat(divided_by(products, (), number)), front, nesting)


def _with_product(here: Monomial, coefficient: Terms, nesting: Nesting) -> Iterator[Plan]:
    """(a/2 + b/2) x and (a + b) x/2."""
    if not here:
        yield nested(coefficient, nesting.alphabet)
        return
    for number in {1, content(coefficient, nesting.alphabet)}:
        plan = by_mass.nested(divided_by(coefficient, (), number), nesting.alphabet)
        yield by_mass.with_factor(here, plan, nesting, number)


def _sum(parts: Sequence[tuple[Terms, Plan]]) -> Plan:
    """The parts added."""
    if len(parts) == 1:
        return parts[0][1]
    price = sum(plan.price for _, plan in parts) + len(parts) - 1
    return Split(tuple(parts), price, max(plan.depth for _, plan in parts))


def _over_common(terms: Terms, nesting: Nesting) -> Plan:
    """shared (a + b), where a fraction may stay inside as well; a product or a square where it is one."""
    shared, number = common(terms), content(terms, nesting.alphabet)
    if len(terms) == 1:
        return nesting.flat(terms)
    plans: list[Plan] = [] if shared else [nesting.flat(terms)]
    for n in {number, 1} if shared and number.denominator > 1 else {number}:
        rest = divided_by(terms, shared, n)
        inner = cheapest([nesting.flat(rest), *nesting.factored(rest)])
        plans += [nesting.product(shared, n, ((inner, 1),))] if shared or n != 1 else nesting.factored(rest)
    return cheapest(plans)


def with_sums_of_rates(terms: Terms, alphabet: Alphabet) -> Terms:
    """The same in theta1_dot and theta1_dot + theta2_dot, where so there are fewer terms."""
    while len(terms) <= MOST_REBASED:
        rates = sorted({atom for m in terms for atom, _ in m if alphabet.is_rate(atom)}, key=alphabet.key)
        pairs = [
            (x, y) for x, y in combinations(rates, 2) if _added(x, y, alphabet) and _may_join(terms, x, y)
        ]
        found = [_joined(terms, x, y, sign, alphabet) for (x, y), sign in product(pairs, (1, -1))]
        best = min(found, key=len, default=terms)
        if len(best) >= len(terms):
            break
        terms = best
    return terms


def _may_join(terms: Terms, x: int, y: int) -> bool:
    """Whether a term that holds the one is like one that holds the other, as it must be for any to go out."""

    def beside(rate: int) -> set[Monomial]:
        held = (monomial for monomial in terms if any(atom == rate for atom, _ in monomial))
        return {tuple(part for part in monomial if part[0] not in (x, y)) for monomial in held}

    return not beside(x).isdisjoint(beside(y))


def _joined(terms: Terms, x: int, y: int, sign: int, alphabet: Alphabet) -> Terms:
    """With the sum u = x + sign * y in place of y."""
    whole = alphabet.lump(x, y, sign)
    found: Terms = {}
    for monomial, k in terms.items():
        power = dict(monomial).get(y, 0)
        rest = divided(monomial, {y: power})
        for times_u in range(power + 1):
            left = power - times_u
            powers = tuple((atom, n) for atom, n in ((whole, times_u), (x, left)) if n)
            put(found, times(rest, powers), k * sign**power * comb(power, times_u) * (-1) ** left)
    return found


def _added(x: int, y: int, alphabet: Alphabet) -> bool:
    """Whether two rates, or two accelerations, which do not hold each other, may be added."""
    p, q = alphabet.names(x), alphabet.names(y)
    return p.isdisjoint(q) and len({name.endswith("ddot") for name in p | q}) == 1
