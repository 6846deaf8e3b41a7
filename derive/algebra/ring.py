"""The ring of the normal form: polynomials over the rationals, modulo what sines and roots obey.

Generators are the parameters and prismatic variables, a pair (c, s) for each independent angle
with s^2 = 1 - c^2, and a root r for each square root with r^2 = radicand (r^3 for a cube root).
Reduced by these relations a polynomial is unique, so two expressions are equal exactly when their reduced
polynomials are. The polynomials are FLINT's sparse ones (python-flint, `fmpq_mpoly`).

A fixed angle, 25 deg, has a pair of its own however many there are, and angles that move are independent
where their moving parts are: theta1 + 25 deg beside theta1 is the sum of theta1 and 25 deg. What else holds
between fixed angles, and between them and roots, `derive.algebra.fixed_angles.zero_recognition` knows.

The order of generators is lexicographic with roots first (nested ones outermost first), then
sines, cosines and symbols: the leading terms of the relations are then r^2 and s^2, and reduction
is one division each.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache, cached_property, lru_cache

from flint import Ordering, fmpq_mpoly, fmpq_mpoly_ctx

from derive.algebra.angles import Form, first_quarter, fixed_parts, multiples, require_few
from derive.algebra.bounds import spend
from derive.algebra.generators import PI, Opaque, Root, letters_of
from derive.algebra.multivariate import grouped, without
from derive.algebra.rationals import Rational, as_fraction, to_flint

Pair = tuple[fmpq_mpoly, fmpq_mpoly]
EXACT = {Form(()): (1, 0), Form.of({PI: Fraction(1, 2)}): (0, 1)}  # cosine and sine of 0 and 90 degrees


@dataclass(frozen=True)
class Ring:
    """The generators; rings with the same ones are the same object (see `ring`)."""

    roots: tuple[Root, ...]
    angles: tuple[Form, ...]
    symbols: tuple[str, ...]

    def __hash__(self) -> int:
        return id(self)

    def __eq__(self, other: object) -> bool:
        return self is other

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Every generator by name, in the order of the context."""
        return (
            *(root.name for root in self.roots),
            *(f"sin({form})" for form in self.angles),
            *(f"cos({form})" for form in self.angles),
            *self.symbols,
        )

    @cached_property
    def context(self) -> fmpq_mpoly_ctx:
        """FLINT's context of these generators, in lexicographic order."""
        return fmpq_mpoly_ctx.get(self.names, Ordering.lex)

    @cached_property
    def index(self) -> dict[str, int]:
        """The place of each generator in the exponents of a term."""
        return {name: i for i, name in enumerate(self.names)}

    @cached_property
    def opaque(self) -> tuple[str, ...]:
        """The symbols that stand for functions left as they are: `exp(x)`."""
        return tuple(name for name in self.symbols if isinstance(name, Opaque))

    @cached_property
    def layered(self) -> bool:
        """Whether there are functions of functions: exp(x), the sine of sin(x)."""
        atoms = (atom for form in self.angles for atom, _ in form.parts)
        return bool(self.opaque) or any(isinstance(atom, Opaque) for atom in atoms)

    def letters(self, generator: str) -> frozenset[str]:
        """The names a generator rests on, `pi` apart."""
        return _letters(self, generator)

    @cached_property
    def zero(self) -> fmpq_mpoly:
        """The polynomial 0."""
        return self.constant(0)

    @cached_property
    def one(self) -> fmpq_mpoly:
        """The polynomial 1."""
        return self.constant(1)

    def constant(self, value: Rational) -> fmpq_mpoly:
        """A number as a polynomial."""
        return self.context.constant(to_flint(value))

    def gen(self, name: str) -> fmpq_mpoly:
        """A generator as a polynomial. Raises KeyError where the ring has none of this name."""
        return self.context.gen(self.index[name])

    def pair(self, k: int) -> Pair:
        """(cosine, sine) of the k-th angle of the ring, as polynomials."""
        c, s = self.pair_index(k)
        return self.context.gen(c), self.context.gen(s)

    def pair_index(self, k: int) -> tuple[int, int]:
        """The places of that cosine and sine among the generators."""
        return len(self.roots) + len(self.angles) + k, len(self.roots) + k

    @cached_property
    def relations(self) -> tuple[tuple[int, int, fmpq_mpoly], ...]:
        """(index of the leading generator, its power, relation), outermost first."""
        found = [
            (i, root.degree, self.gen(root.name) ** root.degree - self.polynomial(root.radicand))
            for i, root in enumerate(self.roots)
        ]
        for k in range(len(self.angles)):
            c, s = self.pair(k)
            found.append((len(self.roots) + k, 2, s * s + c * c - 1))
        return tuple(found)

    def polynomial(self, terms: Iterable[tuple[tuple[tuple[str, int], ...], Rational]]) -> fmpq_mpoly:
        """The polynomial of terms, each given by its powers of named generators and its coefficient."""
        entries = {}
        for powers, coefficient in terms:
            exponents = [0] * len(self.names)
            for name, power in powers:
                exponents[self.index[name]] = power
            entries[tuple(exponents)] = to_flint(coefficient)
        return self.context.from_dict(entries)

    def terms(self, polynomial: fmpq_mpoly) -> tuple[tuple[tuple[tuple[str, int], ...], Fraction], ...]:
        """The terms of a polynomial, each as its powers of named generators and its coefficient, sorted: the
        opposite of `polynomial`, and the same for equal polynomials of any ring."""
        return tuple(
            sorted(
                (
                    tuple((n, int(e)) for n, e in zip(self.names, exponents, strict=True) if e),
                    as_fraction(coefficient),
                )
                for exponents, coefficient in polynomial.terms()
            )
        )

    def reduce(self, polynomial: fmpq_mpoly) -> fmpq_mpoly:
        """The unique representative modulo the relations: no root to the power of its degree or above, and no
        sine above the first."""
        if not polynomial:
            return polynomial
        degrees = polynomial.degrees()
        for i, least, relation in self.relations:
            if degrees[i] >= least:
                polynomial = divmod(polynomial, relation)[1]
                degrees = polynomial.degrees()
        return polynomial

    def grouped(self, polynomial: fmpq_mpoly, names: Iterable[str]) -> dict[tuple[int, ...], fmpq_mpoly]:
        """What stands before each combination of powers of these generators, as it is met; a name that is no
        generator has the power 0."""
        names = tuple(names)
        own = [name for name in names if name in self.index]
        found = grouped(polynomial, [self.index[name] for name in own])
        if len(own) == len(names):
            return found
        by_name = ((dict(zip(own, powers, strict=True)), part) for powers, part in found.items())
        return {tuple(powers.get(name, 0) for name in names): part for powers, part in by_name}

    def without(self, polynomial: fmpq_mpoly, names: Iterable[str]) -> fmpq_mpoly:
        """The terms that hold none of these generators; others are in none."""
        return without(polynomial, [self.index[name] for name in names if name in self.index])

    def trig(self, form: Form) -> Pair | None:
        """(cosine, sine) of a form that is an integer combination of the angles; else None."""
        return _trig(self, form)

    def with_symbols(self, names: Iterable[str]) -> Ring:
        """The ring with these symbols too."""
        new = [name for name in dict.fromkeys(names) if name not in self.index]
        return ring(self.roots, self.angles, (*self.symbols, *new)) if new else self

    def with_root(self, root: Root) -> Ring:
        """The ring with a root too. Outermost first: a later root may have earlier ones in its radicand."""
        known = any(root.name == own.name for own in self.roots)
        return self if known else ring((root, *self.roots), self.angles, self.symbols)

    def with_angle(self, form: Form) -> Ring:
        """A ring in which the form's sine and cosine are polynomials. Raises NotDerivable where these would
        fill pages."""
        times = multiples(form, self.angles)
        if times is None:
            return ring(self.roots, (*self.angles, form), self.symbols)
        require_few(form, times)
        if any(n.denominator != 1 for n in times):
            pairs = zip(self.angles, times, strict=True)
            finer = tuple(angle.scaled(Fraction(1, n.denominator)) for angle, n in pairs)
            return _with_roots_of(self, ring((), finer, self.symbols)).with_angle(form)
        needed = (first_quarter(part)[2] for part in fixed_parts(form, self.angles, times))
        new = [angle for angle in needed if angle not in self.angles and angle not in EXACT]
        return ring(self.roots, (*self.angles, *new), self.symbols)

    def union(self, other: Ring) -> Ring:
        """A ring that holds the elements of both; the generators of this one come first."""
        if self is other or not other.names:
            return self
        return _union(self, other)


@cache
def ring(roots: tuple[Root, ...] = (), angles: tuple[Form, ...] = (), symbols: tuple[str, ...] = ()) -> Ring:
    """The ring with these generators; always the same object, so that `is` compares rings."""
    return Ring(roots, angles, symbols)


@lru_cache(maxsize=4096)
def _letters(home: Ring, generator: str) -> frozenset[str]:
    place = home.index[generator]
    if place < len(home.roots):
        inner = (name for powers, _ in home.roots[place].radicand for name, _ in powers)
        return frozenset().union(*(home.letters(name) for name in inner))
    k = place - len(home.roots)
    if k < 2 * len(home.angles):
        return home.angles[k % len(home.angles)].letters
    return letters_of(generator)


@lru_cache(maxsize=4096)
def _trig(home: Ring, form: Form) -> Pair | None:
    if form in home.angles:
        return home.pair(home.angles.index(form))
    times = multiples(form, home.angles)
    if times is None or any(n.denominator != 1 for n in times):
        return None
    require_few(form, times)
    cosine, sine = home.one, home.zero
    pairs = [(home.pair(k), n) for k, n in enumerate(times)]
    for part in fixed_parts(form, home.angles, times):
        pair = _fixed_pair(part, home)
        if pair is None:
            return None
        pairs.append((pair, Fraction(1)))
    for (c, s), n in pairs:
        s = s if n > 0 else -s
        for _ in range(abs(int(n))):  # one addition theorem a turn
            cosine, sine = cosine * c - sine * s, sine * c + cosine * s
    return home.reduce(cosine), home.reduce(sine)


def _fixed_pair(form: Form, home: Ring) -> Pair | None:
    """(cosine, sine) of a multiple of pi or of a form without pi; None where the ring has no pair for it."""
    cosine_sign, sine_sign, angle = first_quarter(form)
    if angle in EXACT:
        c, s = map(home.constant, EXACT[angle])
    elif angle in home.angles:
        c, s = home.pair(home.angles.index(angle))
    else:
        return None
    return cosine_sign * c, sine_sign * s


@lru_cache(maxsize=1024)
def _union(left: Ring, right: Ring) -> Ring:
    both = left.with_symbols(right.symbols)
    for form in right.angles:
        if both.trig(form) is None:
            both = both.with_angle(form)
    return _with_roots_of(right, both)


def _with_roots_of(source: Ring, target: Ring) -> Ring:
    """The target with the roots of the source, their radicands in its own generators."""
    for root in reversed(source.roots):
        inside = carry(source.polynomial(root.radicand), source, target)
        target = target.with_root(replace(root, radicand=target.terms(inside)))
    return target


@lru_cache(maxsize=1024)
def images(source: Ring, target: Ring) -> tuple[fmpq_mpoly, ...] | None:
    """Where the generators of `source` go in `target`; None where each keeps its name."""
    if all(name in target.index for name in source.names):
        return None
    pairs = [target.trig(form) for form in source.angles]
    if None in pairs:
        raise ValueError(f"{target.angles} cannot express {source.angles}")
    return (
        *(target.gen(root.name) if root.name in target.index else target.zero for root in source.roots),
        *(pair[1] for pair in pairs if pair),
        *(pair[0] for pair in pairs if pair),
        *(target.gen(name) for name in source.symbols),
    )


def carry(polynomial: fmpq_mpoly, source: Ring, target: Ring) -> fmpq_mpoly:
    """The same element in a larger ring. Raises ValueError where that cannot hold it."""
    if source is target:
        return polynomial
    if not polynomial:
        return target.zero
    if len(polynomial) == 1:  # a symbol or a number: FLINT takes longer to project it
        return _carried_term(polynomial, source, target)
    moved = images(source, target)
    if moved is None:
        return polynomial.project_to_context(target.context)
    composed = polynomial.compose(*moved, ctx=target.context)
    spend(len(composed))
    return target.reduce(composed)


def _carried_term(polynomial: fmpq_mpoly, source: Ring, target: Ring) -> fmpq_mpoly:
    ((exponents, coefficient),) = polynomial.terms()
    found = target.context.constant(coefficient)
    moved = images(source, target)
    for i, power in enumerate(exponents):
        if power:
            found = found * (moved[i] if moved else target.gen(source.names[i])) ** int(power)
    return found if moved is None else target.reduce(found)
