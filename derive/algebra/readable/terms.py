"""A polynomial as a person reads it: terms over symbols, roots, and sines and cosines of sums.

Unlike the normal form this is no unique representation; the readable forms are searched here.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import TypeAlias

from derive.algebra.angles import Form, is_fixed
from derive.algebra.bounds import A_TERM_READ, spend
from derive.algebra.generators import ITSELF, PI, RADIAN, Opaque
from derive.algebra.powers import MAX_DEGREE
from derive.algebra.rationals import Rational, decimal_places, lowest, of_flint
from derive.algebra.readable.order import (
    FALLING,
    JOINTS,
    MASSES,
    RATES,
    Place,
    SortKey,
    in_sum,
    natural,
    place_of,
)
from derive.algebra.ring import Ring
from derive.algebra.scalar import Scalar, angle_of
from derive.expression import Call, Degrees, Expr, Number, Power, Symbol, add, multiply, number

Monomial: TypeAlias = tuple[tuple[int, int], ...]  # (atom, power), sorted by atom
Terms: TypeAlias = dict[Monomial, Rational]


@dataclass(frozen=True, slots=True)
class Atom:
    """A symbol or root by name, the cosine or sine of a form, or a sum of symbols as a form."""

    kind: str  # "root", "symbol", "cos", "sin", "sum"
    what: str | Form


@dataclass(frozen=True, slots=True)
class Style:
    """How readable forms are written: numbers as decimals where the author typed decimals, fixed
    angles in degrees where the author did; angles in the `order` of the sheet, and `letters` where the
    author's equations give them one. What a page adds: units where the author typed any, angles that are
    found in degrees where any was typed so (`turned`), and decimals with as many significant digits as the
    `longest` that was typed."""

    decimals: bool = False
    degrees: bool = False
    order: tuple[str, ...] = ()
    letters: tuple[str, ...] = ()
    units: bool = False
    turned: bool = False
    longest: int = 0


@dataclass(slots=True)
class Alphabet:
    """The atoms of one reading, numbered as they are met, and their order on the page."""

    style: Style = Style()
    reader: Callable[[str], Expr] = Symbol  # of symbols, roots and functions by name
    atoms: list[Atom] = field(default_factory=list)
    numbers: dict[Atom, int] = field(default_factory=dict)
    keys: dict[int, SortKey] = field(default_factory=dict)
    trees: dict[tuple[int, int], Expr] = field(default_factory=dict)
    lumps: bool = False  # whether there are sums among the atoms

    def number(self, atom: Atom) -> int:
        """The number of an atom; one that is new gets the next."""
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
        """Whether an atom is a cosine or a sine."""
        return self.atoms[atom].kind in ("cos", "sin")

    def form(self, atom: int) -> Form:
        """The angle of a sine or cosine."""
        what = self.atoms[atom].what
        assert isinstance(what, Form)
        return what

    def lump(self, x: int, y: int, sign: int = 1) -> int:
        """The atom x + sign * y of two letters."""
        self.lumps = True
        return self.number(Atom("sum", self._linear(x) + self._linear(y).scaled(sign)))

    def _linear(self, atom: int) -> Form:
        what = self.atoms[atom].what
        return what if isinstance(what, Form) else Form.of({what: 1})

    def is_mass(self, atom: int) -> bool:
        """Whether an atom is a mass or a moment of inertia, or a sum of such."""
        found = self.atoms[atom]
        if found.kind == "sum":
            return all(MASSES.match(name) for name, _ in self._linear(atom).parts)
        return found.kind == "symbol" and bool(MASSES.match(str(found.what)))

    def names(self, atom: int) -> frozenset[str]:
        """The letters of a symbol or of a sum of symbols; none of another atom."""
        return (
            frozenset(name for name, _ in self._linear(atom).parts) if self.is_letter(atom) else frozenset()
        )

    def is_rate(self, atom: int) -> bool:
        """Whether an atom is a rate or an acceleration, or a sum of such."""
        names = self.names(atom)
        return bool(names) and all(map(RATES.search, names))

    def is_gravity(self, atom: int) -> bool:
        """Whether an atom is g."""
        return {place_of(name) for name in self.names(atom)} == {Place.GRAVITY}

    def is_letter(self, atom: int) -> bool:
        """Whether it is a symbol or a sum of symbols."""
        found = self.atoms[atom]
        return found.kind == "sum" or (found.kind == "symbol" and not isinstance(found.what, Opaque))

    def is_function(self, atom: int) -> bool:
        """Whether it is written as a function of something: a sine, a cosine, a root."""
        return not self.is_letter(atom)

    def extra(self, atom: int) -> float:
        """What an atom costs more than a letter does: a sum its operations and parentheses."""
        found = self.atoms[atom]
        return len(self._linear(atom).parts) - 0.75 if found.kind == "sum" else 0

    def radicand(self, atom: int) -> int:
        """n of the root of a number, sqrt(n); 1 for any other atom."""
        found = self.atoms[atom]
        if found.kind != "root":
            return 1
        inside = str(found.what)[5:-1]
        return int(inside) if inside.isdigit() else 1

    def key(self, atom: int) -> SortKey:
        """Where it stands among the factors of a product: (place, angle or letter, ...)."""
        if atom not in self.keys:
            self.keys[atom] = self._key(self.atoms[atom])
        return self.keys[atom]

    def _key(self, atom: Atom) -> SortKey:
        what = atom.what
        if atom.kind == "sum":
            return self._lump_key(self._linear(self.numbers[atom]))
        if isinstance(what, Form):
            return (Place.FUNCTION, *self.angle_key(self.numbers[atom]), atom.kind != "sin")
        if atom.kind == "root":
            return (Place.ROOT if what.startswith("sqrt(") else Place.NUMBER, what)
        if isinstance(what, Opaque):
            return (Place.ROOT, what)
        letters = self.style.letters
        if place_of(what) is Place.RATE:  # theta1_dot d_dot, in the order of the joints
            return (Place.RATE, len(letters), *self._rank(RATES.sub("", what)), what)
        return (place_of(what), letters.index(what) if what in letters else len(letters), natural(what))

    def _lump_key(self, form: Form) -> SortKey:
        names = [name for name, _ in form.parts]
        if all(map(MASSES.match, names)):
            place = Place.SUM_OF_MASSES
        else:
            place = Place.SUM_OF_RATES if any(map(RATES.search, names)) else Place.SUM
        return (place, min(map(natural, names)))

    def angle_key(self, atom: int) -> SortKey:
        """The order of the angle of a sine or cosine; fixed angles last."""
        form = self.form(atom)
        return (not form.moving.parts, tuple(sorted((self._rank(name), n) for name, n in form.parts)))

    def is_written_out(self, atom: int) -> bool:
        """Whether it is a sine or cosine without parentheses and no single letter either: cos phi."""
        if not self.is_trig(atom):
            return False
        (name, n), *others = self.form(atom).parts
        return not others and (is_fixed(name) or (n == 1 and not JOINTS.match(name)))

    def falls(self, atom: int) -> bool:
        """Whether the terms of a sum go by its falling powers."""
        return self.atoms[atom].what in FALLING

    def _rank(self, name: str) -> SortKey:
        """In the author's order; what is fixed in an angle comes last."""
        order = self.style.order
        place = order.index(name) if name in order else len(order) + is_fixed(name)
        return (place, natural(name))

    def expression(self, atom: int, power: int = 1) -> Expr:
        """The tree of a power of an atom; every time the same."""
        if (atom, power) not in self.trees:
            base = self._expression(self.atoms[atom])
            self.trees[atom, power] = raised(base, power) if power > 1 else base
        return self.trees[atom, power]

    def _expression(self, found: Atom) -> Expr:
        if isinstance(found.what, Form) and found.kind == "sum":
            parts = sorted(found.what.parts, key=lambda part: (part[1] < 0, in_sum(part[0])))
            return add(*(self._multiple(name, n) for name, n in parts))
        if isinstance(found.what, Form):
            return Call(found.kind, (self.angle(found.what),))
        return self.reader(found.what)

    def angle(self, form: Form) -> Expr:
        """The tree of a form; one with functions in it is made readable as a whole."""
        if any(isinstance(atom, Opaque) for atom, _ in form.parts):
            return self.reader(Opaque(str(form), ITSELF, (angle_of(form),)))
        parts = sorted(form.parts, key=lambda part: (part[1] < 0, self._rank(part[0])))
        return add(*(self._multiple(atom, n) for atom, n in parts))

    def _multiple(self, atom: str, n: Rational) -> Expr:
        if atom == PI and self.style.degrees:
            return Degrees(Fraction(180 * n))
        if atom == RADIAN:
            return Number(Fraction(n), self.style.decimals)
        factors = [_power_text(factor) for factor in atom.split("*")]
        return multiply(Number(Fraction(n)), *factors)


def terms_of(scalar: Scalar, alphabet: Alphabet) -> Terms:
    """The terms of a scalar's numerator over the atoms of an alphabet. Raises NotDerivable where reading them
    takes more work than an answer may."""
    spend(A_TERM_READ * len(scalar.numerator))
    home = scalar.ring
    used = [i for i, degree in enumerate(scalar.numerator.degrees()) if degree > 0]
    atoms = sorted((*_atom(home, i, alphabet), i) for i in used)
    found: Terms = {}
    for exponents, coefficient in scalar.numerator.terms():
        k, powers = of_flint(coefficient), []
        for atom, sign, i in atoms:
            if exponent := int(exponents[i]):
                powers.append((atom, exponent))
                k = -k if sign < 0 and exponent % 2 else k
        put(found, tuple(powers), k)
    return found


def _atom(home: Ring, i: int, alphabet: Alphabet) -> tuple[int, int]:
    """(atom, sign) of the i-th generator."""
    roots, angles = len(home.roots), len(home.angles)
    if i < roots:
        return alphabet.number(Atom("root", home.roots[i].name)), 1
    if i < roots + 2 * angles:
        kind, k = divmod(i - roots, angles)
        return alphabet.trig(("sin", "cos")[kind], home.angles[k])
    return alphabet.number(Atom("symbol", home.symbols[i - roots - 2 * angles])), 1


def times(left: Monomial, right: Monomial) -> Monomial:
    """The product of monomials."""
    powers = dict(left)
    for atom, power in right:
        powers[atom] = powers.get(atom, 0) + power
    return tuple(sorted(powers.items()))


def divided(monomial: Monomial, by: Mapping[int, int]) -> Monomial:
    """The quotient by a monomial that divides it, given as atom -> power."""
    return tuple([(atom, left) for atom, power in monomial if (left := power - by.get(atom, 0))])


def put(terms: Terms, monomial: Monomial, coefficient: Rational) -> None:
    """Add a term in place."""
    total = terms.get(monomial, 0) + coefficient
    if total:
        terms[monomial] = lowest(total)
    else:
        terms.pop(monomial, None)


def terminates(value: Rational) -> bool:
    """Whether it is better written as a decimal: where that ends, and after eight places at the latest or
    with fewer digits than the fraction has."""
    places = decimal_places(value)
    if value.denominator == 1 or places is None:
        return False
    return places <= 8 or places < len(f"{abs(value.numerator)}{value.denominator}")


def frozen(terms: Mapping[Monomial, Rational]) -> frozenset[tuple[Monomial, Rational]]:
    """Terms as a key."""
    return frozenset(terms.items())


def raised(base: Expr, power: int) -> Expr:
    """A power; of x^(1/3) it is x^(2/3)."""
    if not isinstance(base, Power):
        return Power(base, number(power))
    if isinstance(base.exponent, Number):
        whole = base.exponent.value.denominator <= MAX_DEGREE  # else it is no root, and has no powers either
        return Power(base.base, number(base.exponent.value * power)) if whole else Power(base, number(power))
    return Power(base.base, multiply(number(power), base.exponent))


def _power_text(factor: str) -> Expr:
    name, _, power = factor.partition("^")
    return Power(Symbol(name), number(power)) if power else Symbol(name)
