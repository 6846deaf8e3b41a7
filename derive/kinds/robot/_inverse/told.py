"""What the words read of an inverse that was worked by sub-problems."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from derive.derivation import Phrase, Said, Step
from derive.expression import Expr, Matrix, Number, Symbol
from derive.kinds.robot._inverse.branches import Solutions
from derive.kinds.robot._inverse.choices import Choices
from derive.kinds.robot._inverse.evaluated import Evaluated
from derive.kinds.robot._inverse.facts import ByAngle, Facts, SolvedFacts, Wrist
from derive.kinds.robot._inverse.left_open import Choosable
from derive.kinds.robot._inverse.postures import explained
from derive.kinds.robot._inverse.subproblem import Solved
from derive.kinds.robot._inverse.worked import Orientation, Worked
from derive.mechanics.inverse.goal import AXES

ELEMENTS = 9  # of a rotation matrix


OF_A_SHOULDER = {
    "axes-meet": "shoulder-axes-meet",
    "axes-meet-at-the-end": "shoulder-axes-meet-at-the-end",
    "in-angles-of-the-wrist": "shoulder-in-angles-of-the-wrist",
    "last-in-angles-of-the-wrist": "shoulder-last-in-angles-of-the-wrist",
    "rest-to-make": "shoulder-rest-to-make",
}


@dataclass(frozen=True, slots=True)
class Told:
    """An inverse, and how its solutions are counted."""

    worked: Worked
    solutions: Solutions
    choices: Choices
    open: Sequence[Choosable] = ()

    def facts(self, partial: bool, values: Evaluated, degrees: bool) -> Facts:
        """What the words choose their sentences by."""
        worked = self.worked
        return Facts(
            given=worked.pose,
            at_pose=_by_names(worked.pose),
            known=self._known(),
            conditions=worked.conditions,
            arm=tuple(map(self._in_arm, worked.arm)),
            by_angle=self._by_angle(),
            wrist=self._wrist(),
            count=self.choices.count,
            tree=self.choices.table,
            meaning=tuple(explained(self.choices.postures, worked.chain)),
            partial=Phrase("partial") if partial else None,
            place=(*values.said, *values.place.said),
            labels=tuple(self.choices.called(each) or str(k) for k, each in enumerate(values.branches, 1)),
            remark=values.remark,
            angle_results=self.solutions.turning,
            style=worked.problem.style,
            in_degrees=degrees,
        )

    def _known(self) -> Phrase | None:
        """What is given of the pose."""
        goal, pose = self.worked.goal, self.worked.pose
        if goal.angle:
            about: dict[str, Said] = {
                "name": Symbol(goal.angle),
                "base": Symbol(AXES[goal.plane[0]]),
                "axis": Symbol(AXES[goal.plane[2]]),
            }
            return Phrase("known-angle" if pose else "known-angle-alone", about)
        turned = goal.R is not None and not goal.whole_position
        return Phrase("known-orientation" if turned else "known-pose") if pose else None

    def _wrist(self) -> Wrist | None:
        worked = self.worked
        if worked.plan.decoupling is None or worked.orientation is None:
            return None
        key = "axes-meet-at-the-end" if worked.at_end else "axes-meet"
        before = Phrase(self._of("rest-to-make"), {"before": worked.orientation.before})
        joints = tuple(map(Symbol, worked.spherical))
        meeting = Phrase(self._of(key), {"joints": joints}) if worked.arm else None
        if worked.by_angle:
            meeting = Phrase("wrist-alone", {"joints": joints})
        return Wrist(
            meeting=meeting,
            centre=worked.centre,
            before=(before if worked.orientation.wanted else Phrase("not-turned")) if worked.arm else None,
            wanted=worked.orientation.wanted,
            elements=worked.elements,
            whole=len(worked.elements) == ELEMENTS,
            named=self._named(worked.orientation),
            stands=not worked.arm,
            made=worked.orientation.made,
            solved=tuple(tuple(map(self._in_wrist, together)) for together in worked.hand),
            singular=worked.singular,
        )

    def _named(self, turned: Orientation) -> Phrase:
        """In which angles a rotation is written that stands behind the wanted one, or else alone."""
        if not self.worked.arm:
            return Phrase("in-joint-angles", {"pose": Symbol(f"T_{self.worked.last}^0")})
        return Phrase(self._of(f"{'last-' if turned.wanted else ''}in-angles-of-the-wrist"))

    def _by_angle(self) -> ByAngle | None:
        found = self.worked.by_angle
        if found is None:
            return None
        angle = found.angle
        elbow, shoulder = Symbol(angle.elbow), tuple(map(Symbol, angle.joints))
        elements = self.worked.swung_elements
        return ByAngle(
            centres=Phrase("shoulder-alone", {"joints": shoulder, "elbow": elbow}),
            turn=Phrase("arm-angle", {"psi": Symbol(angle.psi), "elbow": elbow}),
            line=found.line,
            directions=found.directions,
            frame=angle.shoulder.frame,
            bent=found.bent,
            before=found.before,
            after=found.after,
            wanted=found.wanted,
            elements=elements,
            whole=len(elements) == ELEMENTS,
            made=found.made,
            solved=tuple(each.facts for each in self.worked.swung),
        )

    def _of(self, key: str) -> str:
        """The same said of a shoulder."""
        return OF_A_SHOULDER[key] if self.worked.shoulder else key

    def _in_arm(self, solved: Solved) -> SolvedFacts:
        """With the joint that may be chosen where its equations leave it open."""
        said = next((each.said for each in self.open if each.number == solved.number), None)
        return replace(solved.facts, chosen=said)

    def _in_wrist(self, solved: Solved) -> SolvedFacts:
        """What happens where the outer axes coincide is said once."""
        facts = solved.facts
        if self.worked.singular and facts.method.factor:
            return replace(facts, open=None, method=replace(facts.method, unless=()))
        return facts


def _by_names(pose: Sequence[Step]) -> tuple[Expr, Matrix] | None:
    """What is given, where its elements are names."""
    for step in pose:
        name, matrix = step.chain
        if isinstance(matrix, Matrix) and all(
            isinstance(entry, Symbol | Number) for row in matrix.rows for entry in row
        ):
            return name, matrix
    return None
