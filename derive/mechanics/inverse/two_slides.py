"""Two displacements with a turn between them: a distance holds the square of both, a height both as they are.

A joint that turns changes neither how far a point is from its axis nor how high along it. Where one joint
slides before it and one after it, both displacements stand in either: the height put into the square of the
distance leaves an equation of the second degree in one of them, where a line meets a hyperboloid.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import reduce
from itertools import combinations, groupby, permutations
from operator import add

from derive.algebra.rationals import as_fraction
from derive.algebra.scalar import Scalar
from derive.mechanics.inverse import subproblems
from derive.mechanics.inverse.known import Knowledge
from derive.mechanics.inverse.paul import Equation
from derive.mechanics.inverse.pieper import goal_names
from derive.mechanics.inverse.search import Stage
from derive.mechanics.inverse.subproblems import Quadratic, Slide

Pair = tuple[str, str]
Distance = tuple[tuple[Equation, ...], Scalar]


def two_slides(stage: Stage, known: Knowledge) -> tuple[Quadratic, Slide] | None:
    """The shortest such equation, and the height that gives the other displacement."""
    still = [name for name in known.slides if name not in known.lengths]
    found = [each for pair in permutations(still, 2) for each in _found(stage, known, pair)]
    best = min(found, key=_size, default=None)
    return (best, best.height) if best else None


def _size(found: Quadratic) -> int:
    return sum(len(part.numerator) for part in found.coefficients)


def _found(stage: Stage, known: Knowledge, pair: Pair) -> Iterator[Quadratic]:
    unknown, changing = known.unknown_generators(None), _changing(stage, known)
    heights = [*_heights(stage, known, pair, unknown)]
    for coordinates, square in _distances(stage, known, pair, unknown) if heights else ():
        for height in heights:
            coefficients = _put_in(square, height, pair[0], changing)
            if coefficients and not stage.vanishes(*coefficients[:2]):
                yield Quadratic(pair[0], height, coordinates, coefficients)


def _changing(stage: Stage, known: Knowledge) -> frozenset[str]:
    """The names of what is known by now, and of what is given."""
    trig = {f"{function}({form})" for form in known.forms for function in ("cos", "sin")}
    return goal_names(stage) | known.lengths | trig


def _heights(stage: Stage, known: Knowledge, pair: Pair, unknown: frozenset[str]) -> Iterator[Slide]:
    """Equations that hold both displacements and no angle, linear in each."""
    first, second = pair
    for one in stage.equations:
        value = one.value.into(known.home(None, one.value.ring))
        if _open(value, unknown) == {first, second}:
            height = subproblems.slide(value, second, one.equation)
            if height and first not in height.slope.generators() and not stage.vanishes(height.slope):
                yield height


def _distances(stage: Stage, known: Knowledge, pair: Pair, unknown: frozenset[str]) -> Iterator[Distance]:
    """The squares of two or three coordinates in one frame, one side less the other, where no angle is left
    of those that they hold."""
    positions = [one for one in stage.equations if one.equation.is_position]
    for _, group in groupby(positions, key=lambda one: one.equation.between):
        together = list(group)
        for chosen in (each for size in (2, 3) for each in combinations(together, size)):
            home = known.home(None, chosen[0].value.ring)
            sides = [(one.equation.right.into(home), one.equation.left.into(home)) for one in chosen]
            square = reduce(add, (right * right - left * left for right, left in sides))
            angles = any(_open(right - left, unknown) - set(pair) for right, left in sides)
            if angles and _open(square, unknown) == set(pair):
                yield tuple(one.equation for one in chosen), square


def _open(value: Scalar, unknown: frozenset[str]) -> set[str]:
    return set(value.generators()) & unknown


def _put_in(
    square: Scalar, height: Slide, name: str, changing: frozenset[str]
) -> tuple[Scalar, Scalar, Scalar] | None:
    """The coefficients of the second power, the first and none of a displacement, once the height has given
    the other; None where the first of them rests on more than lengths and twists."""
    total = square.substitute({height.unknown: height.value / height.slope})
    home, found = total.ring, total.ring.grouped(total.numerator, (name,))
    three = [found.get((n,), home.zero) for n in (2, 1, 0)]
    if not found.keys() <= {(2,), (1,), (0,)} or not (three[0] or three[1]):
        return None
    common = reduce(lambda a, b: a.gcd(b), three)
    first = Scalar(home, next(filter(None, three)))
    common = -common if as_fraction(first.numerator.leading_coefficient()) < 0 else common
    one, two, rest = (Scalar(home, divmod(each, common)[0]) for each in three)
    return None if set(one.generators()) & changing else (one, two, rest)
