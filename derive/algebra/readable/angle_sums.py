"""Sums of angles and squares recognised: c_1 c_2 - s_1 s_2 = c_12, and k - k c^2 = k s^2."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from itertools import combinations

from derive.algebra.angles import Form
from derive.algebra.readable.terms import Alphabet, Monomial, Terms, divided, put, times

# Above this many terms the search for pairs costs more than a reader gains.
MOST_TERMS = 60


def contracted(terms: Terms, alphabet: Alphabet) -> Terms:
    """Equal terms, fewer: addition theorems and 1 - c^2 = s^2 applied where they save a term."""
    terms = dict(terms)
    if len(terms) > MOST_TERMS:
        return terms
    while _sum_of_angles(terms, alphabet) or _square_of_sine(terms, alphabet):
        pass
    return terms


def _sum_of_angles(terms: Terms, alphabet: Alphabet) -> bool:
    """One round of addition theorems in place; whether any applied."""
    changed = False
    for rest, a, b, products in _products(terms, alphabet):
        for (x, y), (kind, form_sign, sign) in _THEOREMS.items():
            first, second = products.get(x), products.get(y)
            if first is None or second is None:
                continue
            k = terms.get(first)
            if k is None or terms.get(second) != sign * k:
                continue
            atom, flip = alphabet.trig(kind, a + b.scaled(form_sign))
            del terms[first], terms[second]
            put(terms, times(rest, ((atom, 1),)), k * flip)
            changed = True
    return changed


# (product, other product): which function of a + b or a - b they make, and with which sign
# of the other product. Each key names the functions of a and of b.
_THEOREMS = {
    ("cc", "ss"): ("cos", 1, -1),
    ("ss", "cc"): ("cos", -1, 1),
    ("sc", "cs"): ("sin", 1, 1),
    ("sc", "cs-"): ("sin", -1, -1),
}


def _products(terms: Terms, alphabet: Alphabet) -> Iterator[tuple[Monomial, Form, Form, dict[str, Monomial]]]:
    """(rest, angle a, angle b, the terms rest * f(a) g(b) by "fg"), where there are two or more."""
    buckets: dict[tuple[Monomial, int, int], dict[str, Monomial]] = defaultdict(dict)
    cosine = {atom: alphabet.trig("cos", alphabet.form(atom))[0] for atom in _trig_atoms(terms, alphabet)}
    for monomial in terms:
        trig = [atom for atom, _ in monomial if atom in cosine]
        for first, second in combinations(trig, 2):
            a, b = cosine[first], cosine[second]
            if a != b:
                rest = divided(monomial, {first: 1, second: 1})
                names = alphabet.atoms[first].kind[0], alphabet.atoms[second].kind[0]
                name, key = ("".join(names), (rest, a, b)) if a < b else (names[1] + names[0], (rest, b, a))
                buckets[key][name] = monomial
    for (rest, a, b), products in buckets.items():
        if len(products) > 1:
            if "cs" in products:
                products["cs-"] = products["cs"]
            yield rest, alphabet.form(a), alphabet.form(b), products


def _trig_atoms(terms: Terms, alphabet: Alphabet) -> list[int]:
    """The sines and cosines, as they are met."""
    atoms = dict.fromkeys(atom for monomial in terms for atom, _ in monomial)
    return [atom for atom in atoms if alphabet.is_trig(atom)]


def _square_of_sine(terms: Terms, alphabet: Alphabet) -> bool:
    """k c^n - k c^(n-2) = -k s^2 c^(n-2), in place; whether any applied."""
    changed = False
    for monomial in sorted(terms, key=lambda m: -sum(power for _, power in m)):
        for atom, power in monomial:
            if power < 2 or alphabet.atoms[atom].kind != "cos" or monomial not in terms:
                continue
            lower = divided(monomial, {atom: 2})
            if terms.get(lower) == -terms[monomial]:
                k = terms.pop(lower)
                del terms[monomial]
                put(terms, times(lower, ((alphabet.trig("sin", alphabet.form(atom))[0], 2),)), k)
                changed = True
    return changed
