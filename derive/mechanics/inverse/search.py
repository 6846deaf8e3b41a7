"""Which sub-problem solves the next joint variable: found in the equations, never by the name of the arm."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations, groupby

from derive.algebra.angles import Form
from derive.algebra.numbers.floats import Point, scalar_number
from derive.algebra.rationals import as_fraction
from derive.algebra.ring import Ring
from derive.algebra.scalar import Scalar
from derive.mechanics.budget import Budget
from derive.mechanics.inverse import subproblems
from derive.mechanics.inverse.known import Knowledge
from derive.mechanics.inverse.paul import Between, Equation, Place
from derive.mechanics.inverse.subproblems import (
    Coordinate,
    Elbow,
    OneEquation,
    Reach,
    Slide,
    SubProblem,
    TrigEquation,
    TwoEquations,
)

# Terms that a search may try: a UR5 takes 44,000, six joints with every length and twist a letter 3 million.
MOST_TERMS = 5_000_000
NEARLY_ZERO = 1e-9
METHODS = ("direction", "difference", "determinant")
MOST_ROWS, MOST_ALONE = 16, 8  # of one angle, of which pairs are tried
UNLIKE = 6  # what it adds to the length of a pair that cosine and sine have different factors
KNOWN_JOINT = 3  # what a joint that is solved already adds to the length of an equation
FAMILIAR = 12  # what it takes away that the equation was used before
TURNED = 2  # what each frame adds that an equation is written in and that is not the base or the end-effector


@dataclass(frozen=True, slots=True)
class Difference:
    """An equation as right - left, and the joint variables in it."""

    equation: Equation
    value: Scalar
    joints: frozenset[str]


@dataclass(frozen=True, slots=True)
class Stage:
    """Equations in which joint variables are sought, every angle by itself; `points` are poses the arm
    reaches: values of every name. What is known is known in frame `base`, None that of the end-effector."""

    equations: tuple[Difference, ...]
    points: tuple[Point, ...]
    joints: tuple[str, ...]
    base: int | None = 0

    @staticmethod
    def of(
        equations: Iterable[Equation], joints: Iterable[str], points: tuple[Point, ...], base: int | None = 0
    ) -> Stage:
        """Those that hold any of the joints."""
        joints = tuple(joints)
        names = {f"{f}({joint})": joint for joint in joints for f in ("cos", "sin")}
        names |= {joint: joint for joint in joints}
        found = []
        for equation in equations:
            value = equation.right - equation.left
            held = frozenset(names[name] for name in value.generators() if name in names)
            if held:
                found.append(Difference(equation, value, held))
        return Stage(tuple(found), points, joints, base)

    def next(self, known: Knowledge, budget: Budget, used: Collection[Place] = ()) -> SubProblem | None:
        """The sub-problem to solve now; None where no equation is left with one unknown. Equations that
        were used before are taken again where they serve.

        A pair of equations in one angle comes first, for it leaves no choice; then the length of a sliding
        joint; one equation in one angle; the elbow, and distances between joints; last what is linear. Raises
        TooLong where the budget is spent.
        """
        candidates = _Candidates(self, known, used, budget)
        kinds = (
            candidates.pair, candidates.reach, candidates.one, candidates.elbow, candidates.across,
            candidates.slide,
        )  # fmt: skip
        return next((found for seek in kinds if (found := seek()) is not None), None)

    def rows(self, known: Knowledge, form: Form) -> list[TrigEquation]:
        """Every equation that holds this angle alone."""
        return _Candidates(self, known, (), Budget(MOST_TERMS)).rows_of(form)

    def slides(self, known: Knowledge, name: str) -> list[Slide]:
        """Every equation that holds this displacement alone."""
        return list(_Candidates(self, known, (), Budget(MOST_TERMS)).slides(name))

    def left(self, known: Knowledge, most: int = 6) -> list[Equation]:
        """The shortest equations that still hold unknown joints."""
        unknown = known.unknown_joints()
        held = [one for one in self.equations if one.joints & unknown]
        shortest = sorted(held, key=lambda one: (len(one.joints & unknown), len(one.value.numerator)))
        return [one.equation for one in shortest[:most]]

    def vanishes(self, *values: Scalar) -> bool:
        """Whether all of these are zero at every pose, though their polynomials may not be."""
        return all(abs(scalar_number(v, point)) < NEARLY_ZERO for v in values for point in self.points)


class _Candidates:
    """The sub-problems that the equations of a stage offer by what is known."""

    def __init__(self, stage: Stage, known: Knowledge, used: Collection[Place], budget: Budget) -> None:
        self.stage, self.known, self.used, self.budget = stage, known, used, budget
        self.homes: dict[tuple[Form | None, Ring], Ring] = {}

    # -- equations in one angle -------------------------------------------------------------------

    def pair(self) -> TwoEquations | None:
        pairs = (pair for form, rows in self.rows for pair in self._pairs(form, rows))
        return min(pairs, key=self._pair_length, default=None)

    def one(self) -> OneEquation | None:
        found = [OneEquation(form, rows[0]) for form, rows in self.rows if rows]
        return min(found, key=lambda one: self._length(one.row), default=None)

    @cached_property
    def rows(self) -> list[tuple[Form, list[TrigEquation]]]:
        """Of every angle that is sought, the equations that hold it alone."""
        return [(form, self.rows_of(form)) for form in self.known.sought()]

    def rows_of(self, form: Form) -> list[TrigEquation]:
        """The equations that hold one angle alone, short ones first, then what knows no bare opposite."""
        return sorted(self._rows(form), key=lambda row: (self._length(row), _is_opposite(row.equation.left)))

    def _pairs(self, form: Form, rows: Sequence[TrigEquation]) -> Iterator[TwoEquations]:
        """Cosine and sine each alone where there are such rows, else any two."""
        cosines, sines = [row for row in rows if not row.b], [row for row in rows if not row.a]
        found = [(one, two) for one in cosines[:MOST_ALONE] for two in sines[:MOST_ALONE]]
        for one, two in found or combinations(rows[:MOST_ROWS], 2):
            self.budget.spend(one.terms * two.terms)
            pair = subproblems.two_equations(form, one, two)
            if not self.stage.vanishes(pair.determinant):
                yield pair

    def _pair_length(self, pair: TwoEquations) -> tuple[int, int]:
        """A plain direction comes before a difference of two, and Cramer's rule last."""
        length = self._length(pair.first) + self._length(pair.second)
        return METHODS.index(pair.method), length + (0 if pair.shared else UNLIKE)

    def _rows(self, form: Form) -> Iterator[TrigEquation]:
        """The equations in one angle alone, where it occurs at the poses the arm reaches."""
        unknown = self.known.unknown_generators(form) - {f"cos({form})", f"sin({form})"}
        missing, allowed = self.known.unknown_joints(), self.known.related(form)
        for one in self.stage.equations:
            held = one.joints & missing
            if not held or not held <= allowed:
                continue
            value = self._within(one.value, form)
            if not set(value.generators()) & unknown:
                row = subproblems.trig_equation(value, form, one.equation)
                if row and self._counts(row):
                    yield row

    def _counts(self, row: TrigEquation) -> bool:
        return not self.stage.vanishes(row.a, row.b)

    # -- sums of squares --------------------------------------------------------------------------

    def reach(self) -> Reach | None:
        """Of a displacement that no equation has alone: a square leaves its sign open."""
        names = [name for name in self._open_slides() if next(self.slides(name), None) is None]
        found = [
            here
            for chosen, unknown in (self._coordinates(None) if names else ())
            for name in names
            if (here := subproblems.reach(name, chosen, unknown))
            if any(set(each.unknown.generators()) & (unknown - {name}) for each in chosen)
        ]
        return min(found, key=self._size, default=None)

    def elbow(self) -> Elbow | None:
        found = [
            here
            for form, _ in self.rows
            for chosen, unknown in self._coordinates(form)
            if (here := subproblems.elbow(form, chosen, unknown)) and self._counts(here.row)
        ]
        return min(found, key=self._size, default=None)

    def _coordinates(self, form: Form | None) -> Iterator[tuple[tuple[Coordinate, ...], frozenset[str]]]:
        """Coordinates in one frame, two or three, known on one side, and the names of what is unknown."""
        unknown = self.known.unknown_generators(form)
        position = (one for one in self.stage.equations if one.equation.is_position)
        for _, group in groupby(position, key=lambda one: one.equation.between):
            parts = [
                subproblems.split(one.equation, self._within(one.value, form), unknown)
                for one in group
                if not set(self._within(one.equation.left, form).generators()) & unknown
            ]
            for chosen in subproblems.subsets(parts):
                self.budget.spend(sum(len(part.unknown.numerator) ** 2 for part in chosen))
                yield chosen, unknown

    def across(self) -> Elbow | None:
        position = [one for one in self.stage.equations if one.equation.is_position]
        groups = [list(group) for _, group in groupby(position, key=lambda one: one.equation.between)]
        found = [
            here for form, _ in self.rows for group in groups if len(group) == 3
            if (here := self._across(form, group)) and self._counts(here.row)
        ]  # fmt: skip
        return min(found, key=self._size, default=None)

    def _across(self, form: Form, group: Sequence[Difference]) -> Elbow | None:
        unknown = self.known.unknown_generators(form)
        sides = [
            (one.equation, self._within(one.equation.left, form), self._within(one.equation.right, form))
            for one in group
        ]
        self.budget.spend(sum(len(side.numerator) ** 2 for _, left, right in sides for side in (left, right)))
        return subproblems.across(form, sides, unknown)

    # -- displacements ----------------------------------------------------------------------------

    def slide(self) -> Slide | None:
        found = [here for name in self._open_slides() for here in self.slides(name)]
        return min(found, key=_slide_length, default=None)

    def slides(self, name: str) -> Iterator[Slide]:
        """The equations in one displacement alone."""
        unknown = self.known.unknown_generators(None) - {name}
        for one in self.stage.equations:
            value = self._within(one.value, None)
            if name in one.joints and not set(value.generators()) & unknown:
                here = subproblems.slide(value, name, one.equation)
                if here and not self.stage.vanishes(here.slope):
                    yield here

    def _open_slides(self) -> list[str]:
        return [name for name in self.known.slides if name not in self.known.lengths]

    # -- what is preferred ------------------------------------------------------------------------

    def _within(self, value: Scalar, form: Form | None) -> Scalar:
        """In the known angles and this one."""
        self.budget.spend(len(value.numerator))
        key = form, value.ring
        if key not in self.homes:
            self.homes[key] = self.known.home(form, value.ring)
        return value.into(self.homes[key])

    def _length(self, row: TrigEquation) -> int:
        """Short equations first, and those that need no joint solved before."""
        again = FAMILIAR if row.equation.place in self.used else 0
        return row.terms + self._solved(row.a, row.b, row.c) + self._turned(row.equation.between) - again

    def _size(self, found: Elbow | Reach) -> int:
        return sum(
            len(part.known.numerator) + self._solved(part.known) + self._turned(part.equation.between)
            for part in found.coordinates
        )

    def _turned(self, between: Between) -> int:
        return TURNED * ((between.first != self.stage.base) + (between.last is not None))

    def _solved(self, *values: Scalar) -> int:
        held = {name for value in values for name in value.generators()}
        forms = sum(1 for form in self.known.forms if held & {f"cos({form})", f"sin({form})"})
        return KNOWN_JOINT * (forms + len(held & self.known.lengths))


def _slide_length(found: Slide) -> tuple[int, bool]:
    """Short ones first; of those as short, what needs no division."""
    return len(found.slope.numerator) + len(found.value.numerator), found.slope.constant is None


def _is_opposite(value: Scalar) -> bool:
    """Whether it is one term with a minus in front."""
    return len(value.numerator) == 1 and as_fraction(value.numerator.leading_coefficient()) < 0
