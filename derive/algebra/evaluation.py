"""Normal forms in any domain of `fold`: what the generators of a ring are worth there."""

from __future__ import annotations

from fractions import Fraction
from typing import Generic, Protocol, TypeVar

from flint import fmpq, fmpq_mpoly

from derive.algebra.fold import Domain
from derive.algebra.generators import ITSELF, RADIAN, Opaque
from derive.algebra.rationals import as_fraction
from derive.algebra.ring import Ring

T = TypeVar("T")


class Quotient(Protocol):
    """A scalar by its parts; scalars are built above this."""

    ring: Ring
    numerator: fmpq_mpoly
    denominator: fmpq_mpoly | None


class Evaluation(Generic[T]):
    """The values of normal forms in one domain. Raises what the domain raises."""

    def __init__(self, domain: Domain[T]) -> None:
        self.domain = domain

    def quotient(self, value: Quotient) -> T:
        """The value of a scalar."""
        top = self.polynomial(value.numerator, value.ring)
        if value.denominator is None:
            return top
        return self.domain.quotient(top, self.polynomial(value.denominator, value.ring))

    def polynomial(self, polynomial: fmpq_mpoly, home: Ring) -> T:
        """The value of a polynomial of a ring; only generators that occur in it are asked for."""
        domain = self.domain
        known = {i: self.generator(home, i) for i, n in enumerate(polynomial.degrees()) if n > 0}
        terms = []
        for powers, k in polynomial.terms():
            factors = (domain.raised(known[i], int(n)) for i, n in enumerate(powers) if n)
            terms.append(domain.product([self.coefficient(k), *factors]))
        return domain.sum(terms) if terms else domain.number(Fraction(0))

    def coefficient(self, value: fmpq) -> T:
        """The value of a number as FLINT holds it."""
        return self.domain.number(as_fraction(value))

    def generator(self, home: Ring, place: int) -> T:
        """The value of the generator at a place: of a root, a sine, a cosine, a letter or a function."""
        domain, roots, angles = self.domain, len(home.roots), len(home.angles)
        if place < roots:
            root = home.roots[place]
            return domain.root(self.polynomial(home.polynomial(root.radicand), home), root.degree)
        if place < roots + 2 * angles:
            is_cosine, k = divmod(place - roots, angles)
            parts = home.angles[k].parts
            angle = domain.sum([domain.product([domain.number(Fraction(n)), self.atom(x)]) for x, n in parts])
            return domain.call("cos" if is_cosine else "sin", [angle])
        return self.atom(home.names[place])

    def atom(self, name: str) -> T:
        """The value of a letter or a function, or of an atom of an angle: one radian, `pi`, `w*t^2`."""
        domain = self.domain
        if domain.knows(name):
            return domain.symbol(name)
        if isinstance(name, Opaque):
            arguments = [self.quotient(argument) for argument in name.arguments]
            if name.function == ITSELF:
                return arguments[0]
            return (
                domain.power(*arguments) if name.function == "pow" else domain.call(name.function, arguments)
            )
        if name == RADIAN:
            return domain.number(Fraction(1))
        factors = (factor.partition("^") for factor in name.split("*"))
        return domain.product([domain.raised(domain.symbol(base), int(n or 1)) for base, _, n in factors])
