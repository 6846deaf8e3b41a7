"""An inertia matrix as a sum of constants times matrices of the joint variables alone, with as few constants
as will do (Siciliano et al., section 7.2.2, of a matrix whose arm is not known)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import prod

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.multivariate import grouped
from derive.algebra.scalar import Scalar
from derive.algebra.solving.factors import primitive
from derive.algebra.solving.linear_dependence import dependencies
from derive.errors import NotDerivable
from derive.mechanics.dynamics import christoffel, coriolis_matrix, rate_column


@dataclass(frozen=True, slots=True, eq=False)
class Share:
    """A constant and the matrix (n by n) before which it stands."""

    value: Scalar
    D: ScalarMatrix

    def column(self, variables: Sequence[str]) -> ScalarMatrix:
        """What it does to the torques: D qddot + C qdot of its matrix (n by 1)."""
        rate = rate_column(variables)
        C = coriolis_matrix(christoffel(self.D, variables), rate)
        return self.D @ rate_column(variables, "ddot") + C @ rate


@dataclass(frozen=True, slots=True, eq=False)
class _Term:
    """A constant times a product of powers of what varies, at a place of the matrix."""

    place: tuple[int, int]
    constant: Scalar
    varying: Scalar


def shares(D: ScalarMatrix, variables: Sequence[str]) -> tuple[Share, ...]:
    """D as the sum of value times matrix; no value is a combination of the others with numbers.

    Raises NotDerivable where joint variables stand below a fraction.
    """
    terms = [*_terms(D, variables)]
    values = list({_unit(term.constant).key(): _unit(term.constant) for term in terms}.values())
    names = frozenset().union(*(value.letters() for value in values))
    made_of = dependencies([(value,) for value in _whole(values)], names)
    free = [k for k in range(len(values)) if k not in made_of]
    found = {k: [[Scalar.of(0)] * D.shape[1] for _ in D.rows] for k in free}
    for term in terms:
        k = next(k for k, value in enumerate(values) if value == _unit(term.constant))
        weight = term.constant / values[k]
        for other, share in (made_of[k] if k in made_of else {k: Scalar.of(1)}).items():
            i, j = term.place
            found[other][i][j] = found[other][i][j] + weight * share * term.varying
    return tuple(Share(values[k], ScalarMatrix.of(rows)) for k, rows in found.items())


def _terms(D: ScalarMatrix, variables: Sequence[str]) -> Iterator[_Term]:
    home = D.ring
    moving = [k for k, name in enumerate(home.names) if not home.letters(name).isdisjoint(variables)]
    powers_of = [Scalar(home, home.gen(home.names[k])) for k in moving]
    for i, row in enumerate(D.rows):
        for j, entry in enumerate(row):
            below = Scalar(home, home.one if entry.denominator is None else entry.denominator)
            if any(home.index[name] in moving for name in below.generators()):
                raise NotDerivable("the joint variables stand below a fraction here")
            for powers, part in sorted(grouped(entry.numerator, moving).items(), key=_degree):
                varying = prod((g**p for g, p in zip(powers_of, powers, strict=True)), start=Scalar.of(1))
                yield _Term((i, j), Scalar(home, part) / below, varying)


def _degree(term: tuple[tuple[int, ...], object]) -> int:
    """Constants come first."""
    return sum(term[0])


def _unit(value: Scalar) -> Scalar:
    """Without a number in front; a number alone is one."""
    if value.constant is not None:
        return Scalar.of(1)
    return primitive(value) if value.denominator is None else value


def _whole(values: Sequence[Scalar]) -> Iterator[Scalar]:
    """All of them times what stands below any."""
    below = (Scalar(each.ring, each.denominator) for each in values if each.denominator is not None)
    common = prod({each.key(): each for each in below}.values(), start=Scalar.of(1))
    return (value * common for value in values)
