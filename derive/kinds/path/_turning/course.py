"""What the ways of turning share: both orientations, the share of the way along the path, and its rates."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.algebra.numbers.floats import number, scalar_number
from derive.algebra.readable.operation_count import operations
from derive.algebra.scalar import Scalar
from derive.derivation import Phrase, Record, Step
from derive.expression import ZERO, Approximate, Call, Expr, Matrix, Number, Symbol, rebuild, walk
from derive.kinds.path._frenet import Bent
from derive.kinds.path._timing import T as MOMENT
from derive.kinds.path._timing import Timed
from derive.kinds.pose._numbers import is_short
from derive.kinds.problem import Problem
from derive.mechanics.paths import Oriented, Turned
from derive.mechanics.poses import pose, rotation_part
from derive.names import free

LONGEST = 8  # operations of an entry
PLACES, COUNT, NOTHING = 15, 10**4, 1e-12  # of numbers that are rounded


class Part(Record):
    """A sentence with the steps that follow it, answers or not."""

    said: Phrase
    lines: tuple[str, ...]
    answers: bool = False


@dataclass(frozen=True, slots=True)
class Way:
    """How a body turns: what is told, with its steps, in order; `known` says what names stand for, and the
    `results` are in these names. `called` says what each name on the page means to the checks."""

    parts: tuple[Part, ...]
    steps: tuple[Step, ...]
    known: Mapping[Expr, Expr]
    results: Mapping[str, Expr]
    page_names: Mapping[str, str | Expr]
    called: Mapping[str, Expr]

    def followed_by(self, other: Way | None) -> Way:
        """With what is told after it."""
        if other is None:
            return self
        return Way(
            (*self.parts, *other.parts),
            (*self.steps, *other.steps),
            {**self.known, **other.known},
            {**self.results, **other.results},
            {**self.page_names, **other.page_names},
            {**self.called, **other.called},
        )


@dataclass(frozen=True)
class Course:
    """A turn along a path; `time` says how it goes in time, where it does."""

    turned: Turned
    found: Bent
    time: Timed | None
    _taken: set[str] = field(default_factory=set)

    @property
    def problem(self) -> Problem:
        """That of the path."""
        return self.found.work.problem

    def name(self, *candidates: str) -> Symbol:
        """One that stands for nothing else here."""
        known = {name.name for name in self.found.work.known if isinstance(name, Symbol)}
        timed = {each.name for each in (*self.time.names, self.time.time)} if self.time else set()
        others = {MOMENT.name, self.found.along.s.name, *self._taken}
        name = free({*self.problem.taken, *known, *timed, *others}, *candidates)
        self._taken.add(name)
        return Symbol(name)

    @cached_property
    def rounded(self) -> bool:
        """Whether the orientations are told in rounded numbers: those of most angles fill lines."""
        first, last = (self._exactly(end) for end in (self.turned.start, self.turned.end))
        ends = [entry for R in (first, last) for row in self.problem.readable_matrix(R).rows for entry in row]
        if not all(map(_is_short, ends)) or _angles(ends) > 1:
            return True
        between = self.problem.readable_matrix(first.T @ last)
        return not all(_is_short(entry) for row in between.rows for entry in row)

    def rotation(self, end: Oriented) -> ScalarMatrix:
        """Its matrix (3 by 3)."""
        exact = self._exactly(end)
        return self.near(exact) if self.rounded else exact

    def near(self, value: ScalarMatrix) -> ScalarMatrix:
        """In rational numbers that are as good as floats."""
        return ScalarMatrix.of([[_near(scalar_number(entry, {})) for entry in row] for row in value.rows])

    def value(self, tree: Matrix) -> ScalarMatrix:
        """The normal form of numbers."""
        if not self.rounded:
            return normal_matrix(tree)
        return ScalarMatrix.of([[_near(number(entry, {})) for entry in row] for row in tree.rows])

    def _exactly(self, end: Oriented) -> ScalarMatrix:
        if end.matrix is not None:
            return normal_matrix(end.matrix, self.problem.names)
        T = ScalarMatrix.identity(4)
        for move in end.moves:
            step = pose(move, self.problem.names)
            T = step @ T if move.about == "world" else T @ step
        return rotation_part(T)

    @property
    def share(self) -> Expr:
        """Of the way along the path."""
        begun, way = self._way()
        return begun / way

    def shares(self, u: Symbol) -> tuple[Step, ...]:
        """The share, and with a law of time its rates."""
        names = (u, Symbol(f"{u.name}_dot"), Symbol(f"{u.name}_ddot"))
        _, way = self._way()
        dots = self.time.names[1:] if self.time else ()
        values = (self.share, *(dot / way for dot in dots))
        return tuple(
            Step(name.name, (name, value), "in-numbers") for name, value in zip(names, values, strict=False)
        )

    def _way(self) -> tuple[Expr, Expr]:
        """The parameter from where it begins, and all of that."""
        along = self.found.along
        low, high = along.between or (ZERO, ZERO)
        if low == ZERO:
            return along.s, high
        work = self.found.work
        return along.s - low, work.readable(work.scalar(high - low))

    def readable(self, value: ScalarMatrix) -> Matrix:
        """As a person writes it."""
        written = self.problem.readable_matrix(value)
        if not self.rounded:
            return written
        return Matrix(tuple(tuple(map(_rounded, row)) for row in written.rows))


def _is_short(entry: Expr) -> bool:
    return operations(entry) <= LONGEST and is_short(entry)


def _near(value: float) -> Scalar:
    return Scalar.of(Fraction(f"{value:.{PLACES}f}"))


def _rounded(tree: Expr) -> Expr:
    """With floats for numbers of many digits; nothing where rounding left next to nothing."""
    if isinstance(tree, Number):
        value = float(tree.value)
        long = max(abs(tree.value.numerator), tree.value.denominator) > COUNT
        return (Approximate(value) if abs(value) > NOTHING else ZERO) if long else tree
    return rebuild(tree, _rounded)


def _angles(entries: Iterable[Expr]) -> int:
    """How many fixed angles there are whose cosines are no roots."""
    calls = (node for entry in entries for node in walk(entry) if isinstance(node, Call))
    return len({call.arguments for call in calls if call.function in ("cos", "sin")})
