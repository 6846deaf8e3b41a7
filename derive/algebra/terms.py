"""A polynomial as a person reads it: terms over symbols, roots, and sines and cosines of sums.

Unlike the normal form this is no unique representation; the readable forms are searched here.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from functools import lru_cache
from typing import TypeAlias

from derive.algebra.angles import PI, RADIAN, Form
from derive.algebra.scalar import Scalar, as_fraction
from derive.expression import (
    Call,
    Degrees,
    Expr,
    Number,
    Power,
    Symbol,
    add,
    multiply,
    number,
)

Monomial: TypeAlias = tuple[tuple[int, int], ...]  # (atom, power), sorted by atom
Terms: TypeAlias = dict[Monomial, Fraction]
SortKey: TypeAlias = tuple[object, ...]

MASSES = re.compile(r"^([mM]|[IJ])($|_|\d|[xyz])")  # masses, then moments of inertia, stand first


@dataclass(frozen=True, slots=True)
class Atom:
    """A symbol or root by name, or the cosine or sine of a form."""

    kind: str  # "root", "symbol", "cos", "sin"
    what: str | Form


@dataclass(frozen=True, slots=True)
class Style:
    """How readable forms are written: numbers as decimals where the author typed decimals, fixed
    angles in degrees where the author did, names in the author's order."""

    decimals: bool = False
    degrees: bool = False
    order: tuple[str, ...] = ()


@dataclass(slots=True)
class Alphabet:
    """The atoms of one reading, numbered as they are met, and their order on the page."""

    style: Style = Style()
    reader: Callable[[str], Expr] = Symbol  # of generators named by what they stand for: "sqrt(3)"
    atoms: list[Atom] = field(default_factory=list)
    numbers: dict[Atom, int] = field(default_factory=dict)
    keys: dict[int, SortKey] = field(default_factory=dict)

    def number(self, atom: Atom) -> int:
        if atom not in self.numbers:
            self.numbers[atom] = len(self.atoms)
            self.atoms.append(atom)
        return self.numbers[atom]

    def trig(self, kind: str, form: Form) -> tuple[int, int]:
        """(atom, sign) of the cosine or sine of a form, its first coefficient made positive."""
        first = min(form.parts, key=lambda part: self._rank(part[0]))
        if first[1] > 0:
            return self.number(Atom(kind, form)), 1
        return self.number(Atom(kind, form.scaled(-1))), 1 if kind == "cos" else -1

    def is_trig(self, atom: int) -> bool:
        return self.atoms[atom].kind in ("cos", "sin")

    def is_mass(self, atom: int) -> bool:
        found = self.atoms[atom]
        return found.kind == "symbol" and bool(MASSES.match(str(found.what)))

    def radicand(self, atom: int) -> int:
        """n of the root of a number, sqrt(n); 1 for any other atom."""
        found = self.atoms[atom]
        inside = str(found.what)[5:-1] if found.kind == "root" else ""
        return int(inside) if inside.isdigit() else 1

    def key(self, atom: int) -> SortKey:
        """Roots of numbers, masses, other symbols, cosines, sines; each kind in reading order."""
        if atom not in self.keys:
            self.keys[atom] = self._key(self.atoms[atom])
        return self.keys[atom]

    def _key(self, atom: Atom) -> SortKey:
        if isinstance(atom.what, Form):
            ranks = tuple(sorted(self._rank(name) for name, _ in atom.what.parts))
            return (3 if atom.kind == "cos" else 4, ranks)
        if atom.kind == "root":
            return (0, atom.what)
        weight = MASSES.match(atom.what)
        rank = 1.0 if weight and weight[1] in "mM" else 1.5 if weight else 2.0
        return (rank, _natural(atom.what))

    def _rank(self, name: str) -> SortKey:
        order = self.style.order
        return (order.index(name) if name in order else len(order), _natural(name))

    def expression(self, atom: int) -> Expr:
        found = self.atoms[atom]
        if isinstance(found.what, Form):
            return Call(found.kind, (self.angle(found.what),))
        return self.reader(found.what) if "(" in found.what else Symbol(found.what)

    def angle(self, form: Form) -> Expr:
        parts = sorted(form.parts, key=lambda part: (part[1] < 0, self._rank(part[0])))
        return add(*(self._multiple(atom, n) for atom, n in parts))

    def _multiple(self, atom: str, n: Fraction) -> Expr:
        if atom == PI and self.style.degrees:
            return Degrees(180 * n)
        if atom == RADIAN:
            return Number(n, self.style.decimals)
        factors = [_power_text(factor) for factor in atom.split("*")]
        return multiply(Number(n), *factors)


def terms_of(scalar: Scalar, alphabet: Alphabet) -> Terms:
    """The numerator's terms."""
    home = scalar.ring
    roots = [(alphabet.number(Atom("root", root.name)), 1) for root in home.roots]
    pairs = [alphabet.trig(kind, form) for kind in ("sin", "cos") for form in home.angles]
    symbols = [(alphabet.number(Atom("symbol", name)), 1) for name in home.symbols]
    found: Terms = {}
    for exponents, coefficient in scalar.numerator.terms():
        k, powers = as_fraction(coefficient), []
        for (atom, sign), exponent in zip((*roots, *pairs, *symbols), exponents, strict=True):
            if exponent:
                powers.append((atom, int(exponent)))
                k *= sign ** int(exponent)
        put(found, tuple(sorted(powers)), k)
    return found


def times(left: Monomial, right: Iterable[tuple[int, int]]) -> Monomial:
    """The product of monomials; negative powers divide."""
    powers = dict(left)
    for atom, power in right:
        powers[atom] = powers.get(atom, 0) + power
    return tuple(sorted((atom, power) for atom, power in powers.items() if power))


def put(terms: Terms, monomial: Monomial, coefficient: Fraction) -> None:
    """Add a term in place."""
    total = terms.get(monomial, Fraction(0)) + coefficient
    if total:
        terms[monomial] = total
    else:
        terms.pop(monomial, None)


def terminates(value: Fraction) -> bool:
    """Whether it is a decimal fraction of at most eight places."""
    return value.denominator > 1 and (value * 10**8).denominator == 1


def frozen(terms: Mapping[Monomial, Fraction]) -> frozenset[tuple[Monomial, Fraction]]:
    """Terms as a key."""
    return frozenset(terms.items())


@lru_cache(maxsize=4096)
def _natural(name: str) -> SortKey:
    """a2 before a10, L before L_c, without regard to case."""
    parts = re.findall(r"\d+|[^\W\d_]+", name)
    return tuple((1, int(p), "") if p.isdigit() else (0, 0, p.lower()) for p in parts) + ((0, 0, name),)


def _power_text(factor: str) -> Expr:
    name, _, power = factor.partition("^")
    return Power(Symbol(name), number(power)) if power else Symbol(name)
