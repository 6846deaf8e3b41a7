"""Which sub-problem solves the next joint variable: found in the equations, never by the name of the arm."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations, groupby
from typing import TypeAlias

from derive.algebra.angles import Form
from derive.algebra.ring import Ring
from derive.algebra.scalar import Scalar
from derive.mechanics.inverse.budget import Budget
from derive.mechanics.inverse.equation import Equation, Place, View
from derive.mechanics.inverse.knowledge import Knowledge
from derive.mechanics.inverse.sample import Samples
from derive.mechanics.inverse.slide import Slide, slide_of
from derive.mechanics.inverse.squares import Elbow, Part, Reach, elbow, reach, split, subsets
from derive.mechanics.inverse.trigonometric import OneEquation, Row, TwoEquations, pair_of, row_of

Found: TypeAlias = OneEquation | TwoEquations | Elbow | Reach | Slide
KINDS = ("direction", "difference", "determinant")
MOST_ROWS, MOST_ALONE = 16, 8  # of one angle, of which pairs are tried
UNLIKE = 6  # what it adds to the length of a pair that cosine and sine have different factors
KNOWN_JOINT = 3  # what a joint that is solved already adds to the length of an equation
FAMILIAR = 12  # what it takes away that the equation was used before
TURNED_VIEW = 2  # likewise each end from which an equation is seen that is not the base or the end-effector


@dataclass(frozen=True, slots=True)
class Considered:
    """An equation as right - left, and the joint variables in it."""

    equation: Equation
    value: Scalar
    joints: frozenset[str]


@dataclass(frozen=True, slots=True)
class Stage:
    """Equations in which joint variables are sought, every angle by itself."""

    equations: tuple[Considered, ...]
    samples: Samples
    joints: tuple[str, ...]
    base: int = 0

    @staticmethod
    def of(equations: Iterable[Equation], joints: Iterable[str], samples: Samples, base: int = 0) -> Stage:
        """Those that hold any of the joints."""
        joints = tuple(joints)
        names = {f"{f}({joint})": joint for joint in joints for f in ("cos", "sin")}
        names |= {joint: joint for joint in joints}
        found = []
        for equation in equations:
            value = equation.right - equation.left
            held = frozenset(names[name] for name in value.generators() if name in names)
            if held:
                found.append(Considered(equation, value, held))
        return Stage(tuple(found), samples, joints, base)

    def next(self, known: Knowledge, budget: Budget, used: Collection[Place] = ()) -> Found | None:
        """The sub-problem to solve now; None where no equation is left with one unknown. Equations that
        were used before are taken again where they serve.

        A pair of equations in one angle comes first, for it leaves no choice; then the length of a sliding
        joint; one equation in one angle; the elbow; last what is linear. Raises Spent.
        """
        looking = _Looking(self, known, used, budget)
        for seek in (looking.pair, looking.reach, looking.one, looking.elbow, looking.slide):
            found = seek()
            if found is not None:
                return found
        return None

    def rows(self, known: Knowledge, form: Form) -> list[Row]:
        """Every equation that holds this angle alone."""
        return _Looking(self, known, (), Budget()).rows_of(form)

    def slides(self, known: Knowledge, name: str) -> list[Slide]:
        """Every equation that holds this displacement alone."""
        return list(_Looking(self, known, (), Budget()).slides(name))

    def left(self, known: Knowledge, most: int = 6) -> list[Equation]:
        """The shortest equations that still hold unknown joints."""
        unknown = known.unknown_joints()
        held = [one for one in self.equations if one.joints & unknown]
        shortest = sorted(held, key=lambda one: (len(one.joints & unknown), len(one.value.numerator)))
        return [one.equation for one in shortest[:most]]


class _Looking:
    """One look at the equations of a stage."""

    def __init__(self, stage: Stage, known: Knowledge, used: Collection[Place], budget: Budget) -> None:
        self.stage, self.known, self.used, self.budget = stage, known, used, budget
        self.homes: dict[tuple[Form | None, Ring], Ring] = {}

    @cached_property
    def rows(self) -> list[tuple[Form, list[Row]]]:
        """Of every angle that is sought, the equations that hold it alone."""
        return [(form, self.rows_of(form)) for form in self.known.sought()]

    def rows_of(self, form: Form) -> list[Row]:
        """The equations that hold one angle alone, short ones first."""
        return sorted(self._rows(form), key=self._length)

    def pair(self) -> TwoEquations | None:
        pairs = (pair for form, rows in self.rows for pair in self._pairs(form, rows))
        return min(pairs, key=self._pair_length, default=None)

    def one(self) -> OneEquation | None:
        found = [OneEquation(form, rows[0]) for form, rows in self.rows if rows]
        return min(found, key=lambda one: self._length(one.row), default=None)

    def _pairs(self, form: Form, rows: Sequence[Row]) -> Iterator[TwoEquations]:
        """Cosine and sine each alone where there are such rows, else any two."""
        cosines, sines = ([row for row in rows if not side(row)] for side in (_sine, _cosine))
        found = [(one, two) for one in cosines[:MOST_ALONE] for two in sines[:MOST_ALONE]]
        for one, two in found or combinations(rows[:MOST_ROWS], 2):
            self.budget.spend(one.terms * two.terms)
            pair = pair_of(form, (one, two))
            if not self.stage.samples.vanishes(pair.determinant):
                yield pair

    def _pair_length(self, pair: TwoEquations) -> tuple[int, int]:
        """A plain direction comes before a difference of two, and Cramer's rule last."""
        length = self._length(pair.first) + self._length(pair.second)
        return KINDS.index(pair.kind), length + (0 if pair.shared else UNLIKE)

    def _rows(self, form: Form) -> Iterator[Row]:
        """The equations in one angle alone, each once."""
        unknown = self.known.unknown_generators(form) - {f"cos({form})", f"sin({form})"}
        for equation, value in self._differences(form):
            if not set(value.generators()) & unknown:
                row = row_of(value, form, equation)
                if row and self._counts(row):
                    yield row

    def _counts(self, row: Row) -> bool:
        """Whether the angle occurs in it at the poses the arm reaches."""
        return not self.stage.samples.vanishes(row.a, row.b)

    def _differences(self, form: Form) -> Iterator[tuple[Equation, Scalar]]:
        """right - left of the equations that may hold nothing unknown but this sum, in its basis."""
        unknown = self.known.unknown_joints()
        allowed = self.known.related(form)
        for one in self.stage.equations:
            held = one.joints & unknown
            if held and held <= allowed:
                yield one.equation, self._within(one.value, form)

    def reach(self) -> Reach | None:
        found = [
            here
            for parts, unknown in self._squares(None)
            for slide in self.known.slides
            if slide not in self.known.lengths and (here := reach(slide, parts, unknown))
            if any(set(part.unknown.generators()) & (unknown - {slide}) for part in parts)
        ]
        return min(found, key=lambda r: self._size(r.parts), default=None)

    def elbow(self) -> Elbow | None:
        found = [
            here
            for form, _ in self.rows
            for parts, unknown in self._squares(form)
            if (here := elbow(form, parts, unknown)) and self._counts(here.row)
        ]
        return min(found, key=lambda e: self._size(e.parts), default=None)

    def _squares(self, form: Form | None) -> Iterator[tuple[tuple[Part, ...], frozenset[str]]]:
        """Coordinates of one view, two or three, known on one side, and the names of what is unknown."""
        unknown = self.known.unknown_generators(form)
        position = (one for one in self.stage.equations if one.equation.is_position)
        for _, group in groupby(position, key=lambda one: one.equation.view):
            parts = [self._part(one, form, unknown) for one in group if not self._mixed(one, form, unknown)]
            for chosen in subsets(parts):
                self.budget.spend(sum(len(part.unknown.numerator) ** 2 for part in chosen))
                yield chosen, unknown

    def _mixed(self, one: Considered, form: Form | None, unknown: frozenset[str]) -> bool:
        """Whether the side of the known pose holds unknown joints too."""
        return bool(set(self._within(one.equation.left, form).generators()) & unknown)

    def _part(self, one: Considered, form: Form | None, unknown: frozenset[str]) -> Part:
        return split(one.equation, self._within(one.value, form), unknown)

    def _within(self, value: Scalar, form: Form | None) -> Scalar:
        """In the known angles and this one."""
        self.budget.spend(len(value.numerator))
        key = form, value.ring
        if key not in self.homes:
            self.homes[key] = self.known.home(form, value.ring)
        return value.into(self.homes[key])

    def slide(self) -> Slide | None:
        found = [
            here for name in self.known.slides if name not in self.known.lengths for here in self.slides(name)
        ]
        return min(found, key=lambda s: len(s.slope.numerator) + len(s.value.numerator), default=None)

    def slides(self, name: str) -> Iterator[Slide]:
        """The equations in one displacement alone."""
        unknown = self.known.unknown_generators(None) - {name}
        for one in self.stage.equations:
            value = self._within(one.value, None)
            if name in one.joints and not set(value.generators()) & unknown:
                here = slide_of(value, name, one.equation)
                if here and not self.stage.samples.vanishes(here.slope):
                    yield here

    def _length(self, row: Row) -> int:
        """Short equations first, and those that need no joint solved before."""
        again = FAMILIAR if row.equation.place in self.used else 0
        return row.terms + self._solved(row.a, row.b, row.c) + self._turned(row.equation.view) - again

    def _size(self, parts: Iterable[Part]) -> int:
        return sum(
            len(part.known.numerator) + self._solved(part.known) + self._turned(part.equation.view)
            for part in parts
        )

    def _turned(self, view: View) -> int:
        return TURNED_VIEW * ((view.first != self.stage.base) + (view.last is not None))

    def _solved(self, *values: Scalar) -> int:
        held = {name for value in values for name in value.generators()}
        forms = sum(1 for form in self.known.forms if held & {f"cos({form})", f"sin({form})"})
        return KNOWN_JOINT * (forms + len(held & self.known.lengths))


def equations_of(found: Found) -> tuple[Equation, ...]:
    """The equations a sub-problem rests on."""
    match found:
        case OneEquation(_, row):
            return (row.equation,)
        case TwoEquations(_, first, second):
            return (first.equation, second.equation)
        case Slide():
            return (found.equation,)
        case Elbow() | Reach():
            return tuple(part.equation for part in found.parts)


def _cosine(row: Row) -> Scalar:
    return row.a


def _sine(row: Row) -> Scalar:
    return row.b
