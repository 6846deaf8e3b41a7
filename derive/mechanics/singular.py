"""The configurations in which a Jacobian loses rank.

Of a square one where a factor of its determinant vanishes; of any other where all its minors of full
size vanish together, which is solved one joint variable after the other.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import combinations

from derive.algebra.factors import Factored, common_factor, depends, factored
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.pinned import pinned
from derive.algebra.scalar import Scalar
from derive.errors import NotDerivable
from derive.expression import Expr
from derive.mechanics.zeros import Write, Zero, zeros

MOST_SETS = 24
MOST_MINORS = 60


@dataclass(frozen=True, slots=True, eq=False)
class SingularSet:
    """Equations that hold there, and the zeros that solve them (alternatives of one variable, or one for
    each of several variables); no zeros where no sub-problem fits."""

    equations: tuple[Scalar, ...]
    zeros: tuple[Zero, ...]

    @property
    def cases(self) -> tuple[tuple[Zero, ...], ...]:
        """Each solution: the zeros that hold together in it."""
        if len({zero.variable for zero in self.zeros}) > 1:
            return (self.zeros,)
        return tuple((zero,) for zero in self.zeros)


@dataclass(frozen=True, slots=True, eq=False)
class Minor:
    """A minor of full size and the rows or columns it is made of."""

    lines: tuple[int, ...]
    value: Scalar


def of_determinant(det: Factored, variables: tuple[str, ...], write: Write) -> tuple[SingularSet, ...]:
    """One set for each factor."""
    return tuple(
        SingularSet((factor,), zeros(factor, variables, write)) for factor, _ in _simplest_first(det)
    )


def _simplest_first(det: Factored) -> list[tuple[Scalar, int]]:
    return sorted(det.factors, key=lambda pair: len(pair[0].numerator))


def minors(J: ScalarMatrix) -> tuple[Minor, ...]:
    """All minors of full size: of columns where there are more of them than rows, else of rows."""
    wide = J.shape[0] < J.shape[1]
    lines = J if wide else J.T
    size, count = lines.shape
    return tuple(Minor(which, lines.columns(*which).det()) for which in combinations(range(count), size))


def of_minors(
    values: Sequence[Scalar], variables: tuple[str, ...], write: Write
) -> tuple[tuple[SingularSet, ...], bool]:
    """(where all of them vanish, whether that is all): first their common factor, then the rest together."""
    factor, rest = common_factor([value for value in values if value], variables)
    shared = of_determinant(factored(factor, variables), variables, write)
    known = frozenset((zero.variable, zero.value) for each in shared for zero in each.zeros)
    search = _Search(variables, write, known)
    search.run(tuple(rest), ())
    return (*shared, *(SingularSet((), found) for found in search.kept())), not search.open


@dataclass(slots=True)
class _Search:
    """Equations solved together, depth first; `known` are zeros that need not be found again, `found` the
    solutions, `open` whether one was left because no sub-problem fits."""

    variables: tuple[str, ...]
    write: Write
    known: frozenset[tuple[str, Expr]]
    found: list[tuple[Zero, ...]] = field(default_factory=list)
    open: bool = False

    def run(self, equations: tuple[Scalar, ...], known: tuple[Zero, ...]) -> None:
        live = [equation for equation in equations if equation]
        if any(_key(each) <= _key(known) for each in self.found):
            return
        if len(self.found) >= MOST_SETS:
            self.open = True
        elif not live:
            self.found.append(known)
        elif all(depends(equation, self.variables) for equation in live):
            self._branch(live, known)

    def _branch(self, live: list[Scalar], known: tuple[Zero, ...]) -> None:
        """By each factor of the equation with the simplest ones."""
        choices = [factored(equation, self.variables) for equation in live]
        best = min(choices, key=lambda each: max(len(f.numerator) for f, _ in each.factors))
        for factor, _ in best.factors:
            self._along(factor, live, known)

    def _along(self, factor: Scalar, live: list[Scalar], known: tuple[Zero, ...]) -> None:
        """What is left of the equations where a factor vanishes."""
        solved = [zero for zero in zeros(factor, self.variables, self.write) if zero.rule != "triangle"]
        self.open |= not solved
        for zero in (zero for zero in solved if (zero.variable, zero.value) not in self.known):
            try:
                later = tuple(_whole(pinned(equation, zero.variable, zero.at)) for equation in live)
                self.run(later, (*known, zero))
            except NotDerivable:  # the next variable stands inside a root that this one brought
                self.open = True

    def kept(self) -> Iterator[tuple[Zero, ...]]:
        """Each solution once, and none that is part of another."""
        keys = [_key(each) for each in self.found]
        for place, key in enumerate(keys):
            if not key or any(other < key for other in keys) or key in keys[:place]:
                continue
            yield tuple(sorted(self.found[place], key=lambda zero: self.variables.index(zero.variable)))


def _key(zeros: tuple[Zero, ...]) -> frozenset[tuple[str, Expr]]:
    return frozenset((zero.variable, zero.value) for zero in zeros)


def _whole(scalar: Scalar) -> Scalar:
    """The numerator of a fraction: it vanishes where the fraction does."""
    return Scalar(scalar.ring, scalar.numerator)
