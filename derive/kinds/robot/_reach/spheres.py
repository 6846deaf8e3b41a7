"""The workspace of a point that two axes through one center carry: a sphere, or a part of one.

Where the point lies on the axis of a wrist's last joint, it tells to where the wrist can point.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from math import cos

import derive.algebra.numbers.floats as numeric
from derive.derivation import Derivation, Phrase, Result, Said, Step
from derive.errors import NotDerivable
from derive.expression import Call, Expr, Relation, Symbol, between
from derive.kinds.chains import closing
from derive.kinds.checks import close, random_points, route
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import oracle_of
from derive.kinds.robot._point import Tracked
from derive.kinds.robot._reach.facts import Facts, OnASphere
from derive.kinds.robot._reach.section_checks import moved_by
from derive.kinds.robot._reach.sections import orientations_held, orientations_in_space, seen_in_numbers
from derive.kinds.work import Work
from derive.mechanics.chain import Chain
from derive.mechanics.reach import size
from derive.mechanics.section import OnSphere, Section
from derive.names import free

POINTS, NEAR = 2, 1e-9
R_MAX = Symbol("r_max")


@dataclass(frozen=True)
class OnTwoAxes:
    """A point of an arm and the sphere on which two joints carry it."""

    problem: Problem
    chain: Chain
    point: Tracked
    section: Section
    sphere: OnSphere

    def derivation(self) -> Derivation:
        """Its radius, and the heights that are reached. Raises NotDerivable where the joints have ranges."""
        if any(self.problem.subject.links[i - 1].range for i in self.rows):
            raise NotDerivable(
                "the workspace of joints with ranges whose axes meet is found where a slide follows; of this "
                "arm it is not derived yet"
            )
        low, high = self.ends
        told = {"r_max": self.radius} | ({"z_max": high, "z_min": low} if self.part else {})
        final = {name: self.problem.final(tree) for name, tree in told.items()}
        steps = (
            closing(Step(name, (self.names[name], tree), name), final[name]) for name, tree in told.items()
        )
        work = Work(self.problem, uses=(self.problem.ask("forward-kinematics"),)).step(*steps)
        work = work.claim(route("on-sphere", self._seen()))
        description = Phrase("zone" if self.part else "sphere")
        results: dict[str, Result] = {"r_min": final["r_max"], **final, "description": description}
        about: dict[str, Said] = {
            name: Symbol(self.chain.joint(i).variable)
            for name, i in zip(("first", "second"), self.rows, strict=True)
        }
        facts = Facts(
            kinds=Phrase("kinds"),
            orientations=orientations_in_space(self.problem, self.chain, self.point, self.rows),
            description=description,
            limits=Phrase("without-limits"),
            shoulder=(Symbol("o_s"), self.problem.readable_matrix(self.sphere.center)),
            numbers=(*final,),
            page_names={name: self.names[name] for name in final},
            sphere=OnASphere(
                said=Phrase("two-axes-meet", about), part=self.part, directions=self._directions()
            ),
        )
        work = work.claim(
            route(
                "section-joints",
                moved_by(self.problem, self.chain, self.point, about["first"], (about["second"],)),
            ),
            orientations_held(self.problem, self.chain, self.point, facts.orientations),
        )
        if facts.sphere and self.part:
            work = work.claim(route("section-joints", _is_cosine(facts.sphere.directions)))
        return work.answer("workspace", results, facts)

    @property
    def rows(self) -> tuple[int, ...]:
        return self.section.first, *self.section.others

    @cached_property
    def names(self) -> dict[str, Symbol]:
        z = free(self.problem.taken, "z", "h", "zeta")
        return {"r_max": R_MAX, "z_min": Symbol(f"{z}_min"), "z_max": Symbol(f"{z}_max")}

    @property
    def radius(self) -> Expr:
        return self.problem.readable(size(self.sphere.square))

    @property
    def part(self) -> bool:
        """Whether some of the sphere is not reached."""
        return bool(self.sphere.middle) or self.sphere.swing != self.sphere.square

    @property
    def ends(self) -> tuple[Expr, Expr]:
        """The least and the largest height."""
        swing = size(self.sphere.swing)
        low, high = self.sphere.middle - swing, self.sphere.middle + swing
        return self.problem.readable(low), self.problem.readable(high)

    @property
    def cosines(self) -> tuple[Expr, Expr]:
        """The least and the largest one of the angle at the center between the point and the first axis."""
        swing, radius = size(self.sphere.swing), size(self.sphere.square)
        low, high = ((self.sphere.middle + each) / radius for each in (-swing, swing))
        return self.problem.readable(low), self.problem.readable(high)

    def _directions(self) -> Phrase:
        if not self.part:
            return Phrase("all-directions")
        low, high = self.cosines
        beta = Symbol(free(self.problem.taken, "beta", "gamma", "delta"))
        return Phrase(
            "cone-of-directions", {"beta": beta, "cosines": between(low, Call("cos", (beta,)), high)}
        )

    def _seen(self) -> Iterator[bool]:
        import numpy as np

        oracle = oracle_of(self.problem)
        for drawn in random_points(self.problem.symbols, POINTS):
            at = dict(oracle.at(drawn))
            seen = seen_in_numbers(self.problem, self.chain, self.point, self.rows, at)
            center = np.array(numeric.matrix_numbers(self.sphere.center, at)).ravel()
            radius = numeric.number(self.radius, at)
            low, high = (numeric.number(each, at) for each in self.ends)
            yield from seen.on_sphere(center, radius, (low, high))
            yield self.part == (low > -radius * (1 - NEAR) or high < radius * (1 - NEAR))
            cosines = [numeric.number(each, at) * radius for each in self.cosines]
            yield close(cosines, [low, high], NEAR)


def _is_cosine(said: Phrase) -> Iterator[bool]:
    """Whether it is the cosine of the angle that is said to be between two values."""
    bounds, beta = said.about["cosines"], said.about["beta"]
    assert isinstance(bounds, Relation) and isinstance(bounds.left, Relation) and isinstance(beta, Symbol)
    for k in range(7):
        yield close(numeric.number(bounds.left.right, {beta.name: k / 2}), cos(k / 2))
