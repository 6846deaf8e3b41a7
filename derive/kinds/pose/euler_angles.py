"""Three angles that give an orientation, about the axes of any sequence."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Annotated, Any

from pydantic import AfterValidator

from derive.algebra.normal import normal_matrix
from derive.algebra.numbers.floats import number_rows
from derive.derivation import Derivation, Phrase
from derive.errors import NotDerivable
from derive.expression import Product
from derive.kinds.checks import is_rotation
from derive.kinds.fields import Name
from derive.kinds.pose._euler_checks import branches_at, put_back, rotation_at
from derive.kinds.pose._euler_facts import Facts as Facts
from derive.kinds.pose._euler_steps import Comparison, factors_of
from derive.kinds.pose._given import PoseOptions, given_pose
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.euler import Convention, Euler

ORDERS = {True: "about-current", False: "about-world"}  # of capital letters, and of small ones
SUBJECTS = ("motion", "frames", "robot", "rotation")
DEFAULTS = (("phi", "theta", "psi"), ("alpha", "beta", "gamma"), ("phi_e", "theta_e", "psi_e"))
CLAIMS = ("orthogonal", "right-handed", "as-convention", "branch-again|singular-again", "orientation-again")
CLAIMED = {"solutions": "branch-again|singular-again"}


def known_convention(text: str) -> str:
    """The letters of a sequence of axes. Raises ValueError for any others."""
    Convention.of(text)
    return text


class Options(PoseOptions):
    """Which angles are wanted, and their names."""

    convention: Annotated[str, AfterValidator(known_convention)] = "ZYX"
    """The order in which the rotations are made: ZYX about current axes, xyz about world axes, as in
    SciPy."""
    angles: tuple[Name, Name, Name] | None = None
    """Names for the three angles, in the order of the convention."""


def derive(subject: Any, options: Options, problem: Problem) -> Derivation:
    """Three angles (rad) by comparing entries, first where they are determined, then in the singular cases
    (Siciliano et al., section 2.4).

    Raises NotDerivable where the names of the angles mean something else.
    """
    euler = Euler(Convention.of(options.convention), _names(options, problem))
    compared = Comparison(euler, given_pose(options, problem))
    E, rotation, factors = compared.written, compared.given.rotation, factors_of(euler)
    work = Work(problem, factors, uses=compared.given.uses)
    work = work.line(rotation, Product(tuple(factors)), value=E, rule="sequence", label="R").linked()
    work = replace(work, steps=(*work.steps, *compared.steps()))  # the names of angles stand for no one value
    work = work.claim(*compared.laws(), *is_rotation(normal_matrix(E)))
    solutions, facts = compared.solutions(), compared.facts()
    work = work.law(
        "order", (facts.order == Phrase(ORDERS[options.convention.isupper()]), facts.rotation == rotation)
    )
    both = partial(number_rows, E), partial(rotation_at, euler)
    work = work.agrees("as-convention", euler.names, *both)
    return put_back(work, compared, solutions, facts).answer(
        "euler-angles",
        {"R": E, "solutions": solutions},
        facts,
        evaluated=branches_at(options.evaluate, compared, solutions) if options.evaluate is not None else {},
    )


def _names(options: Options, problem: Problem) -> tuple[str, str, str]:
    """Names that stand for nothing else. Raises NotDerivable where the author's own ones do."""
    if options.angles is None:
        return usual_angles(problem)
    if used := problem.taken & set(three(options.angles)):
        raise NotDerivable(f"{min(used)} has a meaning in this problem: name the angles otherwise", "angles")
    return options.angles


def usual_angles(problem: Problem) -> tuple[str, str, str]:
    """The first of the usual names that stand for nothing else."""
    return next((names for names in DEFAULTS if not problem.taken & set(names)), DEFAULTS[-1])


def three(names: tuple[str, str, str]) -> tuple[str, str, str]:
    """The names of an author. Raises NotDerivable where two of them are the same."""
    if len(set(names)) < 3:
        raise NotDerivable("the three angles need three different names", "angles")
    return names
