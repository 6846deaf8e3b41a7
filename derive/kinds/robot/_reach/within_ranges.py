"""The workspace of an arm in a plane with ranges of its joints that leave no simple shape: how near and how
far it reaches, in numbers, and the region as a figure."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import pairwise

from derive.algebra.numbers.floats import number
from derive.derivation import Claim, Derivation, Phrase, Plot, Result, Said, Step
from derive.expression import ONE, ZERO, Degrees, Symbol
from derive.expression import number as number_tree
from derive.figures.limited_workspaces import from_along
from derive.figures.polar_workspaces import filled, swept
from derive.kinds.checks import route
from derive.kinds.fields import Place
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import oracle_of
from derive.kinds.robot._lengths import unit_of_lengths
from derive.kinds.robot._point import Tracked
from derive.kinds.robot._reach.facts import Facts, InPlane
from derive.kinds.robot._reach.in_numbers import Limits
from derive.kinds.robot._reach.ranged import ranges_of
from derive.kinds.robot._reach.regions import refuse_repeated
from derive.kinds.robot._reach.section_checks import SectionSeen, moved_by, square_told
from derive.kinds.robot._reach.section_drawn import fills
from derive.kinds.robot._reach.sections import in_floats, seen_in_numbers
from derive.kinds.robot._reach.swept import Swept
from derive.kinds.values_at import point_of
from derive.kinds.work import Work
from derive.mechanics.chain import Chain
from derive.mechanics.lines import dot
from derive.mechanics.reach import turns_freely
from derive.mechanics.section import Section, section

MOST = 3  # joints after the first
NEAR, EVIDENT, WHOLE = 1e-6, 1e-3, math.tau - 1e-9
R, R_MAX, R_MIN = Symbol("r"), Symbol("r_max"), Symbol("r_min")
NAMES = {"r_max": R_MAX, "r_min": R_MIN}
CALLED = {  # whether it is a part only, and whether there is a hole
    (False, False): "disc",
    (False, True): "annulus",
    (True, False): "part-of-disc",
    (True, True): "part-of-annulus",
}


def within_ranges(problem: Problem, found: Chain, point: Tracked, place: Place) -> Derivation | None:
    """What is reached; None where the arm does not move in a plane about a first axis, or some length or
    range has no value. Raises NotDerivable where a joint only repeats another."""
    seen = section(found, point.position, point.last, MOST)
    if seen is None or any(seen.height.diff(name) for name in found.variables):
        return None
    refuse_repeated(seen, found)
    w = found.axis(seen.first)
    for i in seen.others:
        along = found.axis(i)
        flat = w.cross(along) if found.joint(i).type == "revolute" else None
        if any(flat.entries) if flat is not None else dot(w, along):
            return None
    known = oracle_of(problem).at(point_of(dict(place), problem.where))
    try:
        arm = Swept.of(found, seen, point, known, problem.subject.ranges)
        own = problem.subject.ranges.get(found.joint(seen.first).variable)
        turn = (number(own[0], known), number(own[1], known)) if own else None
    except KeyError:
        return None
    if turn and turn[1] - turn[0] >= WHOLE:
        turn = None
    return WithinRanges(problem, found, point, place, seen, arm, turn).derivation()


@dataclass(frozen=True)
class WithinRanges:
    """An arm in a plane with values for its lengths and ranges; between which angles the first joint turns
    (None: wherever)."""

    problem: Problem
    chain: Chain
    point: Tracked
    place: Place
    section: Section
    arm: Swept
    turn: Limits | None

    def derivation(self) -> Derivation:
        told = {"r_max": self.arm.extreme(0, 1), "r_min": self.arm.extreme(0, -1)}
        square = self.problem.readable(self.section.square)
        line = (R ** number_tree(2), square)
        steps = [Step("rho2", line, "unsolved")]
        steps += [Step(name, (NAMES[name], in_floats(told[name])), "section-end") for name in NAMES]
        work = Work(self.problem, uses=(self.problem.ask("forward-kinematics"),)).showing(*steps)
        arm = self.problem, self.chain, self.point, self.section.first
        work = work.claim(route("section-told", square_told(*arm, line, R)))
        plots = tuple(self._plots(told))
        description = Phrase(CALLED[self.turn is not None, told["r_min"] > 0])
        results: dict[str, Result] = {"rho2": self.problem.final(square)}
        results |= {name: in_floats(value) for name, value in told.items()}
        results["description"] = description
        unit = unit_of_lengths(self.problem, dict(self.place).values())
        facts = Facts(
            kinds=Phrase("kinds-in-a-plane"),
            orientations=self._orientations(),
            description=description,
            limits=Phrase("within-limits-in-section", {"ranges": ranges_of(self.problem, self.rows)}),
            plots=tuple(plot.name for plot in plots),
            numbers=(),
            plane=InPlane(said=self._said()),
        )
        work = work.claim(*self._claims(facts, told))
        for plot in plots:
            places = self._seen.arm.scattered
            (curve,) = plot.regions.values()
            work = work.claim(route("section-drawn", fills(curve, places[:, 0], places[:, 1])))
        units = dict.fromkeys((R, R_MAX, R_MIN), unit) if unit else {}
        return work.answer("workspace", results, facts, plots=plots, evaluated=told, units=units)

    @property
    def rows(self) -> tuple[int, ...]:
        return self.section.first, *self.section.others

    def _said(self) -> Phrase:
        first, *others = (Symbol(self.chain.joint(i).variable) for i in self.rows)
        about: dict[str, Said] = {"first": first, "others": tuple(others), "r": R}
        return Phrase("in-a-plane-within", about)

    def _orientations(self) -> Phrase:
        spare = tuple(i for i, _ in self.chain.moving if i not in self.rows and i <= self.point.last)
        loose = [i for i in spare if not self.problem.subject.links[i - 1].range]
        if turns_freely(self.chain, self.rows, loose, True):
            return Phrase("both-the-same-by-one" if len(spare) == 1 else "both-the-same", {"spare": spare})
        turn = self._turn()
        if turn is None or turn > WHOLE - EVIDENT:
            return Phrase("orientations-open")
        return Phrase("too-little-turn", {"turn": Degrees(Fraction(f"{math.degrees(turn):.6g}"))})

    def _turn(self) -> float | None:
        """Through which angle the joints turn the end-effector in all; None where one has no range, or turns
        about another axis than the first."""
        first, ranges, widths = self.chain.axis(self.rows[0]), self.problem.subject.ranges, [0.0]
        for i, joint in self.chain.moving:
            if joint.type != "revolute":
                continue
            if any(first.cross(self.chain.axis(i)).entries) or joint.variable not in ranges:
                return None
            low, high = (number(end, self._seen.arm.at) for end in ranges[joint.variable])
            widths.append(high - low)
        return sum(widths)

    def _turned(self, told: Said) -> Iterator[bool]:
        """Whether the end-effector turns so far in all, joint by joint from end to end, by the poses."""
        import numpy as np

        oracle, ranges, at = oracle_of(self.problem), self.problem.subject.ranges, self._seen.arm.at
        whole = 0.0
        for name in self.chain.variables:
            low, high = (number(end, at) for end in ranges.get(name, (ZERO, ONE)))
            ends = [oracle.tool({**at, name: low + k * (high - low) / 2})[:3, :3] for k in range(3)]
            cosines = [(np.trace(one.T @ other) - 1) / 2 for one, other in pairwise(ends)]
            whole += sum(math.acos(min(1.0, max(-1.0, float(each)))) for each in cosines)
        yield isinstance(told, Degrees) and abs(math.radians(told.value) - whole) < EVIDENT and whole < WHOLE

    def _plots(self, told: dict[str, float]) -> Iterator[Plot]:
        """Where the first axis is that of z and meets the origin, and the region a part of a ring."""
        import numpy as np

        w, o = self.arm.axis
        if self.turn is None or abs(abs(w[2]) - 1) > NEAR or np.hypot(*o[:2]) > NEAR:
            return
        rho, phi = self.arm.directions
        ends = told["r_min"], told["r_max"]
        turn = self.turn if w[2] > 0 else (-self.turn[1], -self.turn[0])
        curve = filled(swept(rho, phi, turn, ends), ends)
        unit = unit_of_lengths(self.problem, dict(self.place).values())
        yield from_along([[*zip(*curve, strict=True)]], ("x", "y"), unit)

    @cached_property
    def _seen(self) -> SectionSeen:
        known = dict(oracle_of(self.problem).at(point_of(dict(self.place), self.problem.where)))
        return seen_in_numbers(self.problem, self.chain, self.point, self.rows, known)

    def _claims(self, facts: Facts, told: dict[str, float]) -> Iterator[Claim]:
        assert facts.plane and facts.description
        about = facts.plane.said.about
        yield route(
            "section-joints", moved_by(self.problem, self.chain, self.point, about["first"], about["others"])
        )
        yield route("section-ends", self._seen.distances(told))
        if facts.orientations.key == "too-little-turn":
            yield route("orientations", self._turned(facts.orientations.about["turn"]))
        key = facts.description.key
        yield route("section-called", self._is_called(key, told))

    def _is_called(self, key: str, told: dict[str, float]) -> Iterator[bool]:
        own = self.problem.subject.links[self.section.first - 1].range
        yield ("part" in key) == (own is not None and self.turn is not None)
        yield ("annulus" in key) == (told["r_min"] > 0)
