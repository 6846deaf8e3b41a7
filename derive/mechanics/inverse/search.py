"""Which sub-problem solves the next joint variable: found in the equations, never by the name of the arm."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations, groupby
from typing import TypeAlias

from derive.algebra.angles import Form
from derive.algebra.scalar import Scalar
from derive.mechanics.inverse.equation import Equation
from derive.mechanics.inverse.knowledge import Knowledge
from derive.mechanics.inverse.sample import Samples
from derive.mechanics.inverse.slide import Slide, slide_of
from derive.mechanics.inverse.squares import Elbow, Part, Reach, elbow, reach, split, subsets
from derive.mechanics.inverse.trigonometric import OneEquation, Row, TwoEquations, pair_of, row_of, simplest

Found: TypeAlias = OneEquation | TwoEquations | Elbow | Reach | Slide
MOST_ROWS = 10  # of one angle, of which pairs are tried
KNOWN_JOINT = 3  # what a joint that is solved already adds to the length of an equation


@dataclass(frozen=True, slots=True)
class Stage:
    """Equations in which joint variables are sought, in the order in which a person would look at them."""

    equations: tuple[Equation, ...]
    samples: Samples

    def next(self, known: Knowledge, in_time: Callable[[], None]) -> Found | None:
        """The sub-problem to solve now; None where no equation is left with one unknown.

        A pair of equations in one angle comes first, for it leaves no choice; then the length of a sliding
        joint; one equation in one angle; the elbow; last what is linear.
        """
        looking = _Looking(self, known)
        for seek in (looking.pair, looking.reach, looking.one, looking.elbow, looking.slide):
            in_time()
            found = seek()
            if found is not None:
                return found
        return None

    def left(self, known: Knowledge, most: int = 3) -> list[Equation]:
        """The shortest equations that still hold unknown joints."""
        unknown = known.unknown_joints()
        held = [e for e in self.equations if any((e.left - e.right).diff(name) for name in unknown)]
        return sorted(held, key=lambda e: len(e.left.numerator) + len(e.right.numerator))[:most]


@dataclass(slots=True)
class _Looking:
    """One look at the equations of a stage."""

    stage: Stage
    known: Knowledge

    def __post_init__(self) -> None:
        self.rows: list[tuple[Form, list[Row]]] = [
            (form, sorted(self._rows(form), key=self._length)) for form in self.known.sought()
        ]

    def pair(self) -> TwoEquations | None:
        found = [pair for form, rows in self.rows if (pair := simplest(self._pairs(form, rows)))]
        return simplest(found)

    def one(self) -> OneEquation | None:
        found = [OneEquation(form, rows[0]) for form, rows in self.rows if rows]
        return min(found, key=lambda one: self._length(one.row), default=None)

    def _pairs(self, form: Form, rows: Sequence[Row]) -> Iterator[TwoEquations]:
        for one, two in combinations(rows[:MOST_ROWS], 2):
            pair = pair_of(form, (one, two))
            if not self.stage.samples.vanishes(pair.determinant):
                yield pair

    def _rows(self, form: Form) -> Iterator[Row]:
        """The equations in one angle alone, each once."""
        unknown = self.known.unknown_generators(form) - {f"cos({form})", f"sin({form})"}
        for equation, value in self._differences(form):
            if not set(value.generators()) & unknown:
                row = row_of(value, form, equation)
                if row and not self.stage.samples.vanishes(row.a, row.b):
                    yield row

    def _differences(self, form: Form | None) -> Iterator[tuple[Equation, Scalar]]:
        """right - left of the equations that may hold nothing unknown but this sum, in its basis."""
        run = self.known.run_of(form) if form else None
        for equation in self.stage.equations:
            value = equation.right - equation.left
            held = {name for name in self.known.unknown_joints() if value.diff(name)}
            if run and held and all(run.of_atom(name) or not name for name in held):
                yield equation, value.into(self.known.home(form, value.ring))

    def reach(self) -> Reach | None:
        found = [
            here
            for parts, unknown in self._squares(None)
            for slide in self.known.slides
            if slide not in self.known.lengths and (here := reach(slide, parts, unknown))
        ]
        return min(found, key=lambda r: self._size(r.parts), default=None)

    def elbow(self) -> Elbow | None:
        found = [
            here
            for form, _ in self.rows
            for parts, unknown in self._squares(form)
            if (here := elbow(form, parts, unknown)) and not self.stage.samples.vanishes(here.row.a, here.row.b)
        ]
        return min(found, key=lambda e: self._size(e.parts), default=None)

    def _squares(self, form: Form | None) -> Iterator[tuple[tuple[Part, ...], frozenset[str]]]:
        """Coordinates of one view, two or three, known on one side, and the names of what is unknown."""
        unknown = self.known.unknown_generators(form)
        position = (equation for equation in self.stage.equations if equation.is_position)
        for _, group in groupby(position, key=lambda equation: equation.view):
            parts = [self._part(equation, form, unknown) for equation in group]
            for chosen in subsets(parts):
                yield chosen, unknown

    def _part(self, equation: Equation, form: Form | None, unknown: frozenset[str]) -> Part:
        value = equation.right - equation.left
        return split(equation, value.into(self.known.home(form, value.ring)), unknown)

    def slide(self) -> Slide | None:
        found = [
            here
            for name in self.known.slides
            if name not in self.known.lengths
            for here in self._slides(name)
        ]
        return min(found, key=lambda s: len(s.slope.numerator) + len(s.value.numerator), default=None)

    def _slides(self, name: str) -> Iterator[Slide]:
        unknown = self.known.unknown_generators(None) - {name}
        for equation in self.stage.equations:
            value = equation.right - equation.left
            value = value.into(self.known.home(None, value.ring))
            if not set(value.generators()) & unknown:
                here = slide_of(value, name, equation)
                if here and not self.stage.samples.vanishes(here.slope):
                    yield here

    def _length(self, row: Row) -> int:
        """Short equations first, and those that need no joint solved before."""
        return row.terms + self._solved(row.a, row.b, row.c)

    def _size(self, parts: Iterable[Part]) -> int:
        return sum(len(part.known.numerator) + self._solved(part.known) for part in parts)

    def _solved(self, *values: Scalar) -> int:
        held = {name for value in values for name in value.generators()}
        forms = {f"cos({form})" for form in self.known.forms} | {f"sin({form})" for form in self.known.forms}
        return KNOWN_JOINT * len(held & (forms | self.known.lengths))
