"""Where several polynomials in the joint variables vanish together, one joint variable after the other.

An equation is taken by its factors, and each factor by the sub-problem that solves it (see `zeros`). Two
values that are opposite directions, q = 0 and q = pi, are carried along as one with a sign in front, and
parted only where the sign decides. An equation whose value would stand inside a root is kept to the last:
its resultants with the others decide where they vanish on it too.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import product
from math import prod
from typing import Any

from derive.algebra.exact_values import Pair
from derive.algebra.generators import ONE_ALONE, Root
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.multivariate import grouped
from derive.algebra.ring import ring
from derive.algebra.scalar import Scalar, common_ring
from derive.algebra.solving.factors import TooLong, depends, effort, factored
from derive.algebra.solving.half_angles import half_angles, resultant
from derive.algebra.substitution import pinned
from derive.errors import NotDerivable
from derive.mechanics.budget import Budget
from derive.mechanics.sampling import vanishes_on
from derive.mechanics.zeros import Write, Zero, zeros

SIGN = "sign("
SIMPLE = ("sine", "cosine", "sum", "turn")
LONG = 40  # terms; the zeros of a longer factor are not looked for before others
SEVERAL = 3  # resultants with one equation
MOST_EFFORT = 120_000  # of factoring, one or two seconds
FIXED_EFFORT = 50


@dataclass(frozen=True, slots=True, eq=False)
class Fixed:
    """A factor that vanishes, by a value of one variable: `at`, with a sign in front of what two opposite
    values differ in; None where no value is known and the equation is left as it is."""

    variable: str
    factor: Scalar
    at: Pair | Scalar | None

    @property
    def sign(self) -> str:
        """The name of the sign."""
        return f"{SIGN}{self.variable})"


@dataclass(frozen=True, slots=True, eq=False)
class Locus:
    """Values put in one after the other, signs that were decided, and equations that are left, each of them
    with a variable that those after it do not hold."""

    fixed: tuple[Fixed, ...] = ()
    signs: tuple[tuple[str, int], ...] = ()
    left: tuple[Fixed, ...] = ()

    def put(self, value: Scalar, since: Locus | None = None) -> Scalar:
        """The numerator of the value there (`since`: of a value at an earlier locus)."""
        for each in self.fixed[len(since.fixed) if since else 0 :]:
            if each.at is not None:
                value = _numerator(pinned(value, each.variable, each.at))
        return with_signs(value, dict(self.signs)) if self.signs else value

    def put_matrix(self, J: ScalarMatrix, since: Locus | None = None) -> ScalarMatrix:
        """Row by row without fractions, which changes no rank."""
        for each in self.fixed[len(since.fixed) if since else 0 :]:
            if each.at is not None:
                J = _cleared(ScalarMatrix.of([pinned(e, each.variable, each.at) for e in r] for r in J.rows))
        return J.map(lambda entry: with_signs(entry, dict(self.signs))) if self.signs else J

    @property
    def equations(self) -> tuple[Scalar, ...]:
        """What vanishes there, with what is left."""
        return tuple(each.factor for each in (*self.fixed, *self.left))


@dataclass(slots=True)
class Vanishing:
    """A search; `open` says whether something was left aside, `kept` the numbers that were taken to be
    different from zero, `budget` what it may still cost."""

    variables: tuple[str, ...]
    turning: frozenset[str]
    write: Write
    open: bool = False
    kept: list[Scalar] = field(default_factory=list)
    budget: Budget = field(default_factory=lambda: Budget(MOST_EFFORT))
    memory: dict[Hashable, Any] = field(default_factory=dict)

    @property
    def again(self) -> Vanishing:
        """A new search in the same variables, from the same budget."""
        return Vanishing(self.variables, self.turning, self.write, budget=self.budget, memory=self.memory)

    def solve(self, equations: Sequence[Scalar], at: Locus) -> Iterator[Locus]:
        """Every locus within `at` where all of them vanish."""
        live = [equation for equation in equations if equation]
        if not live:
            yield at
            return
        try:
            lists = [self._factors(equation) for equation in live]
        except (TooLong, NotDerivable):
            self.open = True
            return
        if any(not factors for factors, _ in lists):
            for signs in self._deciding(live, lists):
                now = replace(at, signs=(*at.signs, *signs))
                yield from self.solve([with_signs(each, dict(signs)) for each in live], now)
            return
        best = self._easiest(lists)
        factors, units = lists[best]
        yield from self._where_units_vanish(units, live, at)
        rest = [equation for k, equation in enumerate(live) if k != best]
        for factor in factors:
            yield from self._along(factor, rest, at)

    # -- factors ----------------------------------------------------------------------------------

    def _factors(self, equation: Scalar) -> tuple[list[Scalar], list[Scalar]]:
        """(those with joint variables, those that hold signs only)."""
        key = ("factors", equation.key())
        if key not in self.memory:
            self.budget.spend(FIXED_EFFORT + effort(equation, self.variables))
            self.memory[key] = factored(equation, self.variables)
        found = self.memory[key]
        units = [found.constant] if signs_of(found.constant) else []
        if found.constant.constant is None and not signs_of(found.constant):
            self.kept.append(found.constant)
        return [factor for factor, _ in found.factors], units

    def _easiest(self, lists: list[tuple[list[Scalar], list[Scalar]]]) -> int:
        """Which equation to take first: one whose values can be put in, of few variables and few terms."""
        costs = [self._length(factors) for factors, _ in lists]
        order = sorted(range(len(lists)), key=lambda k: costs[k])
        ways: dict[int, int] = {}
        for k in order:
            ways[k] = max(map(self._way, lists[k][0]))
            if ways[k] == 0:
                return k
        return min(order, key=lambda k: (ways[k], costs[k]))

    def _length(self, factors: list[Scalar]) -> tuple[int, int]:
        held = [sum(depends(factor, (name,)) for name in self.variables) for factor in factors]
        return max(held), max(len(factor.numerator) for factor in factors)

    def _way(self, factor: Scalar) -> int:
        """0 for a value that can be put in, 1 for one that cannot, 2 for none."""
        if len(factor.numerator) > LONG:
            return 2
        solved = self._zeros(factor)
        if solved is None:
            return 2
        return 0 if not solved or self._plain(factor, solved[0]) else 1

    def _zeros(self, factor: Scalar) -> tuple[Zero, ...] | None:
        key = factor.key()
        if key not in self.memory:
            self.memory[key] = zeros(factor, self.variables, self.write)
        found: tuple[Zero, ...] | None = self.memory[key]
        return found

    def _plain(self, factor: Scalar, zero: Zero) -> bool:
        """Whether the value holds for whatever the others are, and can be put in."""
        if zero.rule in SIMPLE:
            return True
        return not any(factor.diff(name) for name in self.variables if name != zero.variable)

    def _where_units_vanish(self, units: list[Scalar], live: list[Scalar], at: Locus) -> Iterator[Locus]:
        for unit in units:
            for signs in vanishing_signs(unit):
                now = replace(at, signs=(*at.signs, *signs))
                yield from self.solve([with_signs(each, dict(signs)) for each in live], now)

    def _deciding(
        self, live: list[Scalar], lists: list[tuple[list[Scalar], list[Scalar]]]
    ) -> Iterator[tuple[tuple[str, int], ...]]:
        """Choices of signs for which an equation without joint variables holds."""
        first = next(k for k, (factors, _) in enumerate(lists) if not factors)
        yield from vanishing_signs(live[first])

    # -- along one factor -------------------------------------------------------------------------

    def _along(self, factor: Scalar, rest: list[Scalar], at: Locus) -> Iterator[Locus]:
        solved = self._zeros(factor)
        if solved is not None and not solved:  # it never vanishes
            return
        if signs_of(factor) and (solved is None or solved[0].rule not in SIMPLE):
            for signs in every_sign(signs_of(factor)):
                now, known = replace(at, signs=(*at.signs, *signs)), dict(signs)
                later = [with_signs(equation, known) for equation in (factor, *rest)]
                yield from self.solve(later, now)
            return
        if solved is None or not self._plain(factor, solved[0]):
            yield from self._left(factor, solved, rest, at)
            return
        fixed = Fixed(solved[0].variable, factor, _signed(solved))
        now = replace(at, fixed=(*at.fixed, fixed))
        try:
            later = [now.put(equation, at) for equation in rest]
        except NotDerivable:  # the variable stands inside a root that an earlier one brought
            self.open = True
            return
        yield from self.solve(later, now)

    def _left(
        self, factor: Scalar, solved: tuple[Zero, ...] | None, rest: list[Scalar], at: Locus
    ) -> Iterator[Locus]:
        """An equation that is kept; on it, where the others vanish too."""
        others = [equation for equation in rest if not divides(factor, equation, self.variables)]
        variable = solved[0].variable if solved else self._eliminated(factor)
        own = Fixed(variable, factor, None)
        if not others:
            yield replace(at, left=(own,))
            return
        known = self._without(own, others)
        if not known:
            self.open = True
            return
        for place in self.solve(known, at):
            if len(place.fixed) == len(at.fixed) and place.signs == at.signs:
                yield from self._together(own, others, place)
                continue
            kept = [each.factor for each in place.left]
            now = replace(place, left=())
            try:
                later = [now.put(equation, at) for equation in (factor, *rest)]
            except NotDerivable:
                self.open = True
                continue
            yield from self.solve([*later, *kept], now)

    def _without(self, own: Fixed, others: list[Scalar]) -> list[Scalar]:
        """What follows for the other variables: the equations free of it, and resultants of the rest."""
        free = [equation for equation in others if not equation.diff(own.variable)]
        bound = sorted((e for e in others if e.diff(own.variable)), key=lambda each: len(each.numerator))
        found = (resultant(own.factor, equation, own.variable) for equation in bound[:SEVERAL])
        return [*free, *(each for each in found if each)]

    def _together(self, own: Fixed, others: list[Scalar], place: Locus) -> Iterator[Locus]:
        """Two equations that are left, where all others vanish on both."""
        left = (own, *place.left)
        pairs = [(each.variable, each.factor) for each in left]
        seen = [flag for e in others for flag in vanishes_on(e, pairs, self.turning)]
        if seen and all(seen):
            yield replace(place, left=left)
        elif any(seen) or not seen:  # on some branches only; or a c + b s = 0 with a^2 + b^2 = 0
            self.open = True

    def _eliminated(self, factor: Scalar) -> str:
        return next(name for name in self.variables if factor.diff(name))


def divides(factor: Scalar, equation: Scalar, variables: Sequence[str]) -> bool:
    """Whether the equation is a multiple of the factor, as polynomials in half angles."""
    home = common_ring((factor, equation))
    halves = half_angles(home, variables)
    one, two = halves.of(factor.into(home).numerator), halves.of(equation.into(home).numerator)
    return bool(divmod(two.part, one.part)[1] == 0)


def _signed(solved: tuple[Zero, ...]) -> Pair | Scalar:
    """Both values as one, the sign before what they differ in."""
    if len(solved) == 1:
        return solved[0].at
    one, two = solved[0].at, solved[1].at
    if isinstance(one, Scalar) or isinstance(two, Scalar):
        raise TypeError("two values of a length")
    sign = _sign_of(solved[0].variable)
    c, s = ((a + b) / 2 + sign * ((a - b) / 2) for a, b in zip(one, two, strict=True))
    return c, s


def _sign_of(variable: str) -> Scalar:
    home = ring().with_root(Root(f"{SIGN}{variable})", ONE_ALONE))
    return Scalar(home, home.gen(f"{SIGN}{variable})"))


def signs_of(value: Scalar) -> tuple[str, ...]:
    """The signs that it holds."""
    return tuple(name for name in value.generators() if name.startswith(SIGN))


def every_sign(names: Sequence[str]) -> Iterator[tuple[tuple[str, int], ...]]:
    """Every choice of these signs, as pairs of a name and 1 or -1."""
    for choice in product((1, -1), repeat=len(names)):
        yield tuple(zip(names, choice, strict=True))


def vanishing_signs(value: Scalar) -> Iterator[tuple[tuple[str, int], ...]]:
    """The choices of signs for which it is zero."""
    names = signs_of(value)
    for signs in every_sign(names):
        if names and not with_signs(value, dict(signs)):
            yield signs


def with_signs(value: Scalar, signs: dict[str, int]) -> Scalar:
    """With signs decided."""
    home = value.ring
    places = {home.index[name]: sign for name, sign in signs.items() if name in home.index}
    if not places or value.denominator is not None:
        return value
    total = home.zero
    for powers, rest in grouped(value.numerator, places).items():
        total = total + rest * prod(map(pow, places.values(), powers))
    return Scalar(home, total)


def _numerator(value: Scalar) -> Scalar:
    return value if value.denominator is None else Scalar(value.ring, value.numerator)


def _cleared(J: ScalarMatrix) -> ScalarMatrix:
    rows = []
    for row in J.rows:
        below = [entry.denominator for entry in row if entry.denominator is not None]
        scale = Scalar(J.ring, J.ring.one)
        for each in below:
            denominator = Scalar(J.ring, each)
            scale = scale * denominator / Scalar(J.ring, scale.numerator.gcd(each))
        rows.append([entry * scale for entry in row])
    return ScalarMatrix.of(rows)
