"""Workspaces without a simpler shape, of arms whose first joint turns: on a sphere, or by their section."""

from __future__ import annotations

from derive.derivation import Derivation
from derive.kinds.fields import Place
from derive.kinds.problem import Problem
from derive.kinds.robot._point import Tracked
from derive.kinds.robot._reach.pointing import Still
from derive.kinds.robot._reach.regions import refuse_repeated
from derive.kinds.robot._reach.sections import InSectionOf
from derive.kinds.robot._reach.spheres import OnTwoAxes
from derive.mechanics.chain import Chain
from derive.mechanics.reach import moving_joints, planar_arm, swung_arm
from derive.mechanics.section import Section, on_sphere, section


def cut(problem: Problem, found: Chain, point: Tracked) -> Section | None:
    """The section of an arm; None where it has a simpler shape, or no section. Raises NotDerivable where its
    joints do not move the point independently."""
    at = point.position, point.last
    ranged = any(problem.subject.links[i - 1].range for i in moving_joints(found, *at))
    if planar_arm(found, *at) or (swung_arm(found, *at) and not ranged):
        return None
    seen = section(found, *at)
    if seen is not None:
        refuse_repeated(seen, found, seen.determinant(found))
    return seen


def by_section(problem: Problem, found: Chain, point: Tracked, place: Place | None) -> Derivation | None:
    """What it reaches. Raises NotDerivable where joints have ranges that are not honoured."""
    if not moving_joints(found, point.position, point.last):
        return Still(problem, found, point).derivation()
    if (seen := cut(problem, found, point)) is None:
        return None
    ranged = any(problem.subject.links[i - 1].range for i in seen.others)
    if not ranged and (sphere := on_sphere(found, seen, point.position)) is not None:
        return OnTwoAxes(problem, found, point, seen, sphere).derivation()
    return InSectionOf(problem, found, point, seen, place or ()).derivation()
