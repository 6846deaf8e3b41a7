"""Where a matrix loses rank, set by set, and the rank on each set: with the sets inside it where the rank
is lower still.

A set is a `Locus`. On it the rank r is that of a pivot, a minor of size r that does not vanish there, all
minors of size r + 1 around it being zero. It is lower where every minor of size r vanishes. These are
M_IJ = k p_I q_J (p_I and q_J the Pluecker coordinates of the range and the row space), so it is where k is
zero, or all of p, or all of q; each is solved for, and each set found is looked at in the same way.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace

from derive.algebra.bounds import at_most
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.scalar import Scalar
from derive.algebra.solving.factors import Factored, TooLong, common_factor, factored
from derive.errors import NotDerivable, TooManyTerms
from derive.mechanics.budget import Budget
from derive.mechanics.chain import Chain
from derive.mechanics.minors import maximal_minors, minor_of
from derive.mechanics.sampling import vanishes_on
from derive.mechanics.vanishing import Locus, Vanishing, divides, with_signs
from derive.mechanics.zeros import Write

MOST_PRODUCTS = 400_000  # of terms, for all that follows the first sets
MOST_LOCI = 120
MOST_FOR_FACTORS = 1_500_000  # units of the work of an answer, for one set


@dataclass(frozen=True, slots=True, eq=False)
class Stratum:
    """A set and the rank there: at every point of it that lies in no smaller set, where `exact`; else at
    most that."""

    locus: Locus
    rank: int
    exact: bool


@dataclass(slots=True)
class Strata:
    """The search below given sets; `found` in the order met."""

    J: ScalarMatrix
    search: Vanishing
    budget: Budget = field(default_factory=lambda: Budget(MOST_PRODUCTS))
    found: list[Stratum] = field(default_factory=list)
    loci: int = MOST_LOCI

    def below(self, places: Sequence[Locus], full: int) -> tuple[Stratum, ...]:
        """The given sets, on which the rank is below `full`, and all sets of lower rank inside them."""
        for place in places:
            self._look(place, full)
        return tuple(self.inclusion.largest(list(_merged(self.found))))

    @property
    def inclusion(self) -> Inclusion:
        """Which of the sets lie in which."""
        return Inclusion(self.search)

    def _plainest(self, place: Locus) -> Locus:
        """The same set with its equations solved in the order of their simplicity: c_4 = 0 and s_3 = 0 rather
        than c_4 = 0 and c_34 = 0."""
        if place.signs or len(place.fixed) < 2:
            return place
        search = self.search.again
        again = list(search.solve(place.equations, Locus()))
        return again[0] if len(again) == 1 and not search.open else place

    def _look(self, place: Locus, above: int) -> bool:
        """Records a set and those inside it; whether nothing was left open."""
        self.loci -= 1
        if self.loci < 0:
            self.found.append(Stratum(place, above - 1, False))
            return False
        try:
            J = place.put_matrix(self.J)
            pivot = self._pivot(J, place, above)
            rank = len(pivot[0])
            inside, complete = self._inside(J, place, pivot)
        except (TooLong, NotDerivable, ZeroDivisionError):
            self.found.append(Stratum(place, above - 1, False))
            return False
        spot = len(self.found)
        for each in map(self._plainest, inside):
            if not any(self.inclusion.same(each, other.locus) for other in self.found):
                complete &= self._look(each, rank)
        if rank < above:
            self.found.insert(spot, Stratum(place, rank, complete))
        return complete

    # -- the rank ---------------------------------------------------------------------------------

    def _pivot(self, J: ScalarMatrix, place: Locus, above: int) -> tuple[tuple[int, ...], tuple[int, ...]]:
        """Rows and columns of a largest minor that does not vanish on the set."""
        rows: tuple[int, ...] = ()
        columns: tuple[int, ...] = ()
        while (more := self._bordered(J, place, rows, columns)) is not None:
            rows, columns = more
        return rows, columns

    def _bordered(
        self, J: ScalarMatrix, place: Locus, rows: tuple[int, ...], columns: tuple[int, ...]
    ) -> tuple[tuple[int, ...], tuple[int, ...]] | None:
        """One row and one column more, so that the minor is not zero; the shortest entry first."""
        m, n = J.shape
        corners = [(i, j) for i in range(m) for j in range(n) if i not in rows and j not in columns]
        for i, j in sorted(corners, key=lambda at: (len(J[at].numerator) or 10**6, at)):
            bigger = tuple(sorted((*rows, i))), tuple(sorted((*columns, j)))
            if self._nonzero(minor_of(J, *bigger, self.budget), place):
                return bigger
        return None

    def _nonzero(self, minor: Scalar, place: Locus) -> bool:
        if not minor or not place.left:
            return bool(minor)
        if divides(place.left[0].factor, minor, self.search.variables):
            return False
        pairs = [(each.variable, each.factor) for each in place.left]
        if len(pairs) == 1:
            return True
        seen = vanishes_on(minor, pairs, self.search.turning)
        if not seen:
            raise TooLong
        return not all(seen)

    # -- where it is lower ------------------------------------------------------------------------

    def _inside(
        self, J: ScalarMatrix, place: Locus, pivot: tuple[tuple[int, ...], tuple[int, ...]]
    ) -> tuple[list[Locus], bool]:
        """(sets inside this one that hold every point of lower rank, whether that is all)."""
        if not pivot[0]:
            return [], True
        search = self.search.again
        inside = [
            each for system in self._systems(J, place, pivot) for each in search.solve(system, _start(place))
        ]
        return inside, not search.open

    def _systems(
        self, J: ScalarMatrix, place: Locus, pivot: tuple[tuple[int, ...], tuple[int, ...]]
    ) -> Iterator[list[Scalar]]:
        rows, columns = pivot
        of_columns = {m.lines: m.value for m in maximal_minors(J.columns(*columns), self.budget)}
        lying = ScalarMatrix(tuple(J.rows[i] for i in rows)).T
        of_rows = {m.lines: m.value for m in maximal_minors(lying, self.budget)}
        several = [value for value in (*of_columns.values(), *of_rows.values()) if value]
        if place.left:
            yield [*(each.factor for each in place.left), *several]
            return
        split = self._split(of_columns, of_rows, rows, columns)
        if split is None:
            yield several
        else:
            k, p, q = split
            yield [k]
            yield p
            yield q

    def _split(
        self,
        of_columns: dict[tuple[int, ...], Scalar],
        of_rows: dict[tuple[int, ...], Scalar],
        rows: tuple[int, ...],
        columns: tuple[int, ...],
    ) -> tuple[Scalar, list[Scalar], list[Scalar]] | None:
        """k, p and q of M_IJ = k p_I q_J; None where the factors do not come apart."""
        p_all, q_all = list(of_columns.values()), list(of_rows.values())
        try:
            with at_most(MOST_FOR_FACTORS):
                _, p = common_factor(p_all, self.search.variables)
                _, q = common_factor(q_all, self.search.variables)
        except TooManyTerms:
            return None
        p_0, q_0 = p[list(of_columns).index(rows)], q[list(of_rows).index(columns)]
        k = of_columns[rows] / (p_0 * q_0)
        if k.denominator is not None:
            return None
        return k, [each for each in p if each], [each for each in q if each]


def _start(place: Locus) -> Locus:
    """The equation that was left takes part again."""
    return Locus(place.fixed, place.signs)


def _merged(found: Sequence[Stratum]) -> Iterator[Stratum]:
    """Sets that differ in one sign alone as one."""
    rest = list(found)
    while rest:
        first = rest.pop(0)
        for other in rest:
            sign = _one_sign(first, other)
            if sign:
                place = first.locus
                kept = tuple(pair for pair in place.signs if pair[0] != sign)
                rest[rest.index(other)] = replace(first, locus=replace(place, signs=kept))
                break
        else:
            yield first


def _one_sign(one: Stratum, other: Stratum) -> str:
    """The sign in which two sets of the same equations differ."""
    a, b = one.locus, other.locus
    differing = set(a.signs) ^ set(b.signs)
    alike = (one.rank, one.exact, len(a.equations)) == (other.rank, other.exact, len(b.equations))
    names = {name for name, _ in differing}
    if not alike or len(differing) != 2 or len(names) != 1 or len(a.left) != len(b.left):
        return ""
    same = all(p == q or p == -q for p, q in zip(a.equations, b.equations, strict=True))
    return names.pop() if same else ""


@dataclass(frozen=True, slots=True)
class Inclusion:
    """Which sets lie in which."""

    search: Vanishing

    def strictly(self, one: Locus, other: Locus) -> bool:
        """Whether the first is a proper part of the second."""
        return self.holds(one, other) and not self.holds(other, one)

    def same(self, one: Locus, other: Locus) -> bool:
        """Whether they are one set."""
        return self.holds(one, other) and self.holds(other, one)

    def holds(self, one: Locus, other: Locus) -> bool:
        """Whether every point of the first lies in the second: all that vanishes there vanishes here."""
        if not _signs_agree(one, other):
            return False
        try:
            return all(
                self._vanishes(one, one.put(with_signs(each, dict(other.signs)))) for each in other.equations
            )
        except NotDerivable:
            return False

    def _vanishes(self, one: Locus, value: Scalar) -> bool:
        if not value or not one.left:
            return not value
        if any(divides(each.factor, value, self.search.variables) for each in one.left):
            return True
        pairs = [(each.variable, each.factor) for each in one.left]
        seen = vanishes_on(value, pairs, self.search.turning) if len(pairs) > 1 else []
        return bool(seen) and all(seen)

    def largest(self, found: Sequence[Stratum]) -> Iterator[Stratum]:
        """Each set once, and none that lies in another of no higher rank."""
        for k, each in enumerate(found):
            if not any(
                j != k
                and other.rank <= each.rank
                and self.holds(each.locus, other.locus)
                and (j < k or not self.holds(other.locus, each.locus))
                for j, other in enumerate(found)
            ):
                yield each


def _signs_agree(one: Locus, other: Locus) -> bool:
    known = dict(one.signs)
    return all(known.get(name) == sign for name, sign in other.signs)


def searching(chain: Chain, write: Write) -> Vanishing:
    """For zeros in the joint variables of an arm."""
    turning = frozenset(joint.variable for _, joint in chain.moving if joint.type != "prismatic")
    return Vanishing(chain.variables, turning, write)


def of_determinant(det: Factored, search: Vanishing) -> tuple[Locus, ...]:
    """Factor by factor, the shortest first."""
    factors = sorted(det.factors, key=lambda pair: len(pair[0].numerator))
    return tuple(place for factor, _ in factors for place in search.solve([factor], Locus()))


def of_minors(values: Sequence[Scalar], search: Vanishing) -> tuple[Locus, ...]:
    """First their common factor, then the rest together."""
    factor, rest = common_factor([value for value in values if value], search.variables)
    shared = of_determinant(factored(factor, search.variables), search)
    return (*shared, *search.solve(rest, Locus()))
