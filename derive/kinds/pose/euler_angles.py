"""Three angles that give an orientation, about the axes of any sequence."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import AfterValidator

from derive.algebra.normal import normal_matrix
from derive.derivation import Derivation, Result
from derive.errors import NotDerivable
from derive.expression import Expr
from derive.kinds.checks import is_rotation, links
from derive.kinds.fields import Name
from derive.kinds.pose._euler_checks import put_back
from derive.kinds.pose._euler_steps import Facts as Facts
from derive.kinds.pose._euler_steps import Work, branches_at
from derive.kinds.pose._given import PoseOptions, given_pose
from derive.kinds.problem import Problem
from derive.mechanics.elementary import rotation_matrix
from derive.mechanics.euler import Convention, Euler

SUBJECTS = ("motion", "frames", "robot")
RESULTS = {
    "R": "the rotation matrix of the three angles",
    "solutions": "each angle by its name, and when it is the solution; singular cases included",
}
EXAMPLE = """\
title: Yaw, pitch and roll
problems:
- motion:
  - {rotate: x, by: 30 deg, about: world}
  - {rotate: z, by: 45 deg, about: world}
  find: euler-angles
  convention: ZYX
"""
DEFAULTS = (("phi", "theta", "psi"), ("alpha", "beta", "gamma"), ("phi_e", "theta_e", "psi_e"))


def known_convention(text: str) -> str:
    Convention.of(text)
    return text


class Options(PoseOptions):
    """`convention` as in SciPy: `ZYX` about current axes, `xyz` about world axes, in the order in which
    the rotations are made; `angles`: their names in that order."""

    convention: Annotated[str, AfterValidator(known_convention)] = "ZYX"
    angles: tuple[Name, Name, Name] | None = None


def derive(subject: Any, options: Options, problem: Problem) -> Derivation:
    """The angles by comparing entries, first where they are determined, then in the singular cases
    (Siciliano et al., section 2.4)."""
    given = given_pose(options, problem)
    euler = Euler(Convention.of(options.convention), _names(options, problem))
    work = Work(euler, given, problem)
    E = work.written
    name = given.rotation
    steps = (work.sequence(), *work.steps())
    factors: dict[Expr, Expr] = {
        factor: rotation_matrix(str(move.axis), move.by)
        for move, factor in zip(euler.factors, work.factors, strict=True)
    }
    solutions = work.solutions()
    results: dict[str, Result] = {"R": E, "solutions": solutions}
    claims = (
        *links(steps[:1], {**factors, name: E}),
        *work.claims(),
        *is_rotation(normal_matrix(E)),
        *put_back(euler, work, solutions),
    )
    evaluated = branches_at(options.evaluate, work, solutions) if options.evaluate is not None else {}
    definitions: dict[Expr, Expr] = {**factors, name: E}
    return Derivation(
        "euler-angles", steps, results, claims, definitions, evaluated, given.uses, facts=work.facts()
    )


def _names(options: Options, problem: Problem) -> tuple[str, str, str]:
    """Names that stand for nothing else. Raises NotDerivable where the author's own ones do."""
    taken = problem.taken
    if options.angles is None:
        return next((names for names in DEFAULTS if not taken & set(names)), DEFAULTS[-1])
    if len(set(options.angles)) < 3:
        raise NotDerivable("the three angles need three different names")
    if used := taken & set(options.angles):
        raise NotDerivable(f"{min(used)} has a meaning in this problem: name the angles otherwise")
    return options.angles
