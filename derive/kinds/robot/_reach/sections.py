"""The workspace of an arm that its first joint turns about a fixed axis, in section through that axis."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

from derive.algebra.numbers.floats import Point, numbers
from derive.algebra.scalar import Scalar
from derive.derivation import Claim, Derivation, Phrase, Plot, Result, Said, Step, Table
from derive.errors import NotDerivable
from derive.expression import ZERO, Approximate, Expr, Matrix, Symbol, number
from derive.figures.section_workspaces import carried, covered
from derive.kinds.checks import close, random_points, route
from derive.kinds.fields import Place
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import oracle_of
from derive.kinds.robot._lengths import unit_of_lengths
from derive.kinds.robot._point import Tracked
from derive.kinds.robot._reach.facts import Facts, InSection
from derive.kinds.robot._reach.in_numbers import InNumbers
from derive.kinds.robot._reach.ranged import ranges_of
from derive.kinds.robot._reach.section_checks import (
    SectionSeen,
    called_so,
    determinant_at,
    listed,
    moved_by,
    section_at,
    square_told,
)
from derive.kinds.robot._reach.section_drawn import in_its_part
from derive.kinds.robot._reach.shapes import Shape
from derive.kinds.robot._reach.spans import Span
from derive.kinds.robot._reach.swept import Sample, Swept
from derive.kinds.robot._reach.turning_about import TurningAbout
from derive.kinds.values_at import point_of
from derive.kinds.work import Work
from derive.mechanics.chain import Chain
from derive.mechanics.reach import turns_freely
from derive.mechanics.section import Section
from derive.names import free

REVOLVED = {  # whether there is a hole along the axis, and a void
    (False, False): "revolved",
    (True, False): "revolved-pierced",
    (False, True): "revolved-hollow",
    (True, True): "revolved-pierced-hollow",
}
BOUNDS = ("r_max", "r_min", "z_max", "z_min")
POINTS = 3
TOLERANCE = 1e-6


def in_floats(value: float) -> Expr:
    """A number as it was found; nothing is exactly that."""
    return Approximate(value) if value else ZERO


def orientations_in_space(problem: Problem, chain: Chain, point: Tracked, moving: Sequence[int]) -> Phrase:
    """Whether the joints that do not move the point turn the end-effector as one likes."""
    spare = tuple(i for i, _ in chain.moving if i not in moving and i <= point.last)
    if turns_freely(chain, moving, spare, False):
        return Phrase("both-the-same-by-one" if len(spare) == 1 else "both-the-same", {"spare": spare})
    return TurningAbout(problem, chain, point).told(Phrase("too-few-joints" if spare else "no-freedom-left"))


def seen_in_numbers(
    problem: Problem, chain: Chain, point: Tracked, rows: tuple[int, ...], at: Point
) -> SectionSeen:
    """The arm in numbers, with joints at zero that do not move the point."""
    shape = Shape("section", rows, Span(ZERO, ZERO), {}, Phrase("in-section"), Phrase("revolved"))
    return SectionSeen(InNumbers(problem, chain, point, shape, {**dict.fromkeys(chain.variables, 0.0), **at}))


def orientations_held(problem: Problem, chain: Chain, point: Tracked, said: Phrase) -> Claim:
    """Whether the end-effector turns about the point as it is said."""
    turning = TurningAbout(problem, chain, point)
    free_ = said.key in ("both-the-same", "both-the-same-by-one", "orientations-open")
    return route("orientations", (free_ == (turning.freedom(at) == 3) for at in turning.points))


@dataclass(frozen=True)
class InSectionOf:
    """A point of an arm, its section, and the values that its author gives."""

    problem: Problem
    chain: Chain
    point: Tracked
    found: Section
    place: Place

    def derivation(self) -> Derivation:
        """rho^2 and z as functions of the joints, where both cannot change on their own, and in numbers the
        ends of both and how often positions are reached. Raises NotDerivable where the first joint has a
        range."""
        if self.problem.subject.links[self.found.first - 1].range:
            raise NotDerivable(
                "the workspace of this arm is found where its first joint makes a whole turn; within a range "
                "of it it is not derived yet"
            )
        work = Work(self.problem, uses=(self.problem.ask("forward-kinematics"),))
        square = self.problem.readable(self.found.square)
        line = (self.rho_squared, square)
        work = work.showing(Step("rho2", line, "unsolved"))
        arm = self.problem, self.chain, self.point, self.found.first
        work = work.claim(route("section-told", square_told(*arm, line, self.rho)))
        work = work.line(self.z, value=self.found.height, label="z")
        formulas = {"rho2": self._final(self.found.square), "z": self._final(self.found.height)}
        determinant = self.found.determinant(self.chain)
        if determinant is not None:
            head = Symbol(free(self.problem.taken, "Delta", "delta"))
            work = work.line(head, value=determinant, label="det")
            formulas["det"] = self._final(determinant)
        work = work.claim(*self._formulas(formulas))
        return self._in_numbers(work, {**formulas})

    def _final(self, value: Scalar) -> Expr:
        return self.problem.final(self.problem.readable(value))

    @cached_property
    def rho(self) -> Symbol:
        return Symbol(free(self.problem.taken, "rho", "varrho", "r"))

    @property
    def rho_squared(self) -> Expr:
        return self.rho ** number(2)

    @cached_property
    def z(self) -> Symbol:
        return Symbol(free(self.problem.taken, "z", "h", "zeta"))

    @cached_property
    def swept(self) -> Swept | None:
        """In numbers; None where a length has no value, or a slide no end."""
        known = oracle_of(self.problem).at(point_of(dict(self.place), self.problem.where))
        try:
            return Swept.of(self.chain, self.found, self.point, known, self.problem.subject.ranges)
        except KeyError:
            return None

    @property
    def rows(self) -> tuple[int, ...]:
        return self.found.first, *self.found.others

    @property
    def is_curve(self) -> bool:
        return len(self.found.others) == 1

    def _in_numbers(self, work: Work, results: dict[str, Result]) -> Derivation:
        swept, samples, plots = self.swept, list[Sample](), tuple[Plot, ...]()
        told: dict[str, float] = {}
        if swept:
            told = {
                f"{letter}_{end}": swept.extreme(k, sign)
                for k, letter in enumerate("rz")
                for end, sign in (("max", 1), ("min", -1))
            }
            for name in BOUNDS:
                results[name] = end = in_floats(told[name])
                work = work.showing(Step(name, (self.names[name], end), "section-end"))
            samples = [] if self.is_curve else swept.samples()
            unit = unit_of_lengths(self.problem, dict(self.place).values())
            drawn = carried(*swept.place(*swept.outline), told, unit) if self.is_curve else None
            plots = (drawn or covered(swept.covering, told, unit),)
        if samples:
            results["regions"] = Matrix(tuple(tuple(map(Approximate, each.row)) for each in samples))
        description = self._called(told, samples)
        facts = Facts(
            kinds=Phrase("kinds"),
            orientations=orientations_in_space(self.problem, self.chain, self.point, self.rows),
            description=description,
            limits=self._limits(),
            plots=tuple(plot.name for plot in plots),
            numbers=(),
            page_names=dict(self.names.items()),
            section=InSection(
                said=self._said(),
                bounds=BOUNDS if told else (),
                boundary=None if self.is_curve else self._boundary(),
                table=self._table(samples),
                counts=self._counts(samples),
            ),
        )
        unit = unit_of_lengths(self.problem, dict(self.place).values())
        lengths = (self.rho, self.z, *self.names.values()) if unit else ()
        evaluated = {**told, "regions": [list(each.row) for each in samples]} if samples else told
        results["description"] = description
        work = work.claim(*self._claims(facts, told, plots))
        return work.answer(
            "workspace", results, facts, plots=plots, evaluated=evaluated, units=dict.fromkeys(lengths, unit)
        )

    # -- what is said -----------------------------------------------------------------------------

    @cached_property
    def names(self) -> dict[str, Symbol]:
        """What the ends are called on the page."""
        return {
            f"{letter}_{end}": Symbol(f"{name.name}_{end}")
            for letter, name in (("r", self.rho), ("z", self.z))
            for end in ("max", "min")
        }

    def _variables(self) -> tuple[Symbol, ...]:
        return tuple(Symbol(self.chain.joint(i).variable) for i in self.found.others)

    def _said(self) -> Phrase:
        about: dict[str, Said] = {
            "first": Symbol(self.chain.joint(self.found.first).variable),
            "others": self._variables(), "rho": self.rho, "z": self.z,
        }  # fmt: skip
        return Phrase("in-section-by-one" if self.is_curve else "in-section", about)

    def _boundary(self) -> Phrase:
        one, other = self._variables()
        about: dict[str, Said] = {
            "one": one,
            "other": other,
            "rho": self.rho,
            "z": self.z,
            "square": self.rho_squared,
        }
        return Phrase("section-boundary", about)

    def _limits(self) -> Phrase:
        told = ranges_of(self.problem, self.found.others)
        if not told:
            return Phrase("without-limits")
        return Phrase("within-limits-in-section", {"ranges": told})

    def _called(self, told: dict[str, float], samples: list[Sample]) -> Phrase:
        if self.is_curve:
            return Phrase("revolved-curve")
        pierced = bool(told) and told["r_min"] > 0
        return Phrase(REVOLVED[pierced, any(each.count == 0 for each in samples)])

    def _counts(self, samples: list[Sample]) -> Phrase | None:
        if not samples:
            return None
        void = any(each.count == 0 for each in samples)
        return Phrase("reached-so-often-and-void" if void else "reached-so-often")

    def _table(self, samples: list[Sample]) -> Table | None:
        if not samples:
            return None
        rows = tuple((Approximate(each.rho), Approximate(each.z), number(each.count)) for each in samples)
        return Table((self.rho, self.z, Phrase("configurations")), rows)

    # -- what holds it ----------------------------------------------------------------------------

    def _formulas(self, formulas: dict[str, Expr]) -> Iterator[Claim]:
        points = [dict(oracle_of(self.problem).at(at)) for at in random_points(
            self.problem.symbols, POINTS, self.problem.moving)]  # fmt: skip
        first = self.found.first
        pairs = (
            ([numbers(formulas[name], at) for name in ("rho2", "z")],
             section_at(self.problem, self.chain, self.point, first, at))
            for at in points
        )  # fmt: skip
        yield route("section-seen", (close(ours, theirs, TOLERANCE) for ours, theirs in pairs))
        if "det" in formulas:
            order = self.chain.variables
            columns = [order.index(self.chain.joint(i).variable) for i in self.rows]
            theirs = [determinant_at(self.problem, self.point, columns, at) for at in points]
            ours = [numbers(formulas["det"], at) for at in points]
            has_inside = any(abs(each) > TOLERANCE for each in theirs)  # the joints do more than trace a line
            same = (close(a, b, TOLERANCE) for a, b in zip(ours, theirs, strict=True))
            yield route("boundary-seen", (has_inside, *same))

    def _claims(self, facts: Facts, told: dict[str, float], plots: Sequence[Plot]) -> Iterator[Claim]:
        """Of what is said, and of the numbers as they stand in the table."""
        assert facts.section and facts.description
        about = facts.section.said.about
        yield route(
            "section-joints", moved_by(self.problem, self.chain, self.point, about["first"], about["others"])
        )
        yield orientations_held(self.problem, self.chain, self.point, facts.orientations)
        if not told:
            return
        known = dict(oracle_of(self.problem).at(point_of(dict(self.place), self.problem.where)))
        seen = seen_in_numbers(self.problem, self.chain, self.point, self.rows, known)
        yield route("section-ends", seen.extremes(told))
        if self.is_curve:
            return
        rows = listed(facts.section.table) if facts.section.table else []
        voids = [each for each in rows if not each.count]
        yield route("section-counts", seen.counts(rows))
        if rows:
            yield route("section-counts", seen.are_all(rows))
        if voids:
            yield route("section-void", map(seen.is_closed_in, voids))
        yield route("section-called", called_so(facts, told, bool(voids)))
        yield route("section-called", bool(voids) or not seen.has_void())
        yield route("section-drawn", (in_its_part(plot, each) for plot in plots for each in rows))
