"""The dexterous workspace: the positions that are reached with every orientation."""

from __future__ import annotations

from collections.abc import Mapping

from derive.derivation import Derivation, Phrase, Result
from derive.errors import NotDerivable
from derive.expression import ZERO, Expr, Matrix, Symbol, factors_of
from derive.kinds.checks import route
from derive.kinds.fields import Place
from derive.kinds.robot._point import PointOn
from derive.kinds.robot._reach.dexterous import described, is_said, rings, starts_as_said
from derive.kinds.robot._reach.facts import Dexterous, Facts
from derive.kinds.robot._reach.regions import region_of
from derive.kinds.robot._reach.told import LAST_LINK
from derive.kinds.robot._reach.turning_about import TurningAbout
from derive.kinds.work import Work
from derive.names import free

EMPTY = ("two-orientations", "no-wrist", "no-joint-left", "no-freedom-left", "too-few-joints", "never-turned")
NEVER = {  # no position has every orientation
    **dict.fromkeys(EMPTY, "empty"),
    "the-base-alone": "the-base",
    "two-orientations-or-the-base": "empty-or-the-base",
}


def dexterous(arm: TurningAbout, point: PointOn | None, at: Place | None) -> Derivation:
    """The positions with every orientation, from what is reached at all. Raises NotDerivable where joints
    have ranges that matter for it."""
    problem = arm.problem
    reached = problem.ask("workspace", point=point, evaluate=at)
    told = reached.told(Facts)
    work, key = Work(problem, uses=(reached,)), told.orientations.key
    if key in LAST_LINK and told.limited is None:
        return _by_last_link(work, arm, told)
    same = key in ("both-the-same", "both-the-same-by-one")
    if not same and key not in NEVER:
        raise NotDerivable("the dexterous workspace of this arm is not derived yet", "kind")
    flat = _in_a_plane(told)
    enough = 1 if flat else 3
    freedoms = (arm.freedom(at, flat) for at in arm.points)
    work = work.claim(route("orientations", (same == (each >= enough) for each in freedoms)))
    if not same and flat and arm.is_of_two_links:
        work = work.claim(route("orientations", arm.at_the_base(NEVER[key])))
    where = told.description if same and told.description else Phrase(NEVER.get(key, "empty"))
    results: dict[str, Result] = {name: value for name, value in reached.results.items() if same} | {
        "description": where
    }
    whole = Phrase("all-of-it", {"whole": where}) if same else where
    facts = _facts(told, Dexterous(borders=(), measure=False, where=whole))
    return work.answer("workspace", results, facts)


def _by_last_link(work: Work, arm: TurningAbout, told: Facts) -> Derivation:
    """The rings of an arm in a plane with three links or more."""
    problem = work.problem
    found = rings(problem, region_of(problem, arm.found, arm.point))
    empty, far = found.pieces == (), Symbol(free(problem.taken, "rho_max"))
    results: dict[str, Result] = {"description": described(found)}
    if not empty:
        work = work.line(far, *found.far, value=found.r_max, rule="dexterous", label="r_max")
        results = {"r_max": found.r_max} | results
    if found.pieces:
        results = {"r_min": found.pieces[0][0], "rings": Matrix(found.pieces)} | results
    borders = len(found.pieces or ()) > 1
    if borders:
        work = work.line(found.inner, found.low, label="rho_1").line(found.outer, found.high, label="rho_2")
    A = Symbol(free(problem.taken, "A", "A_w"))
    if found.pieces and any(low != high for low, high in found.pieces):
        area = found.area()
        long = work.line(A, area, label="area")
        same = {*factors_of(area)} == {*factors_of(long[A])}  # in another order
        work = work.line(A, area, value=area, label="area") if same else long
        results["area"] = work[A]
        work = work.claim(route("area-covered", arm.covers(work[A])))
    work = work.claim(route("orientations", arm.rings(found)))
    where = Dexterous(
        borders=("rho_1", "rho_2") if borders else (), measure="area" in results, where=described(found)
    )
    said = (is_said(found, where.where), starts_as_said(found, told.orientations))
    work = work.claim(route("orientations", said))
    names: dict[str, Expr] = {"r_max": far}
    match found.pieces:
        case ((low, high),) if ZERO != low != high:
            names |= {"r_min": Symbol(free(problem.taken, "rho_min"))}
        case (_, _):
            names |= {"rings": Matrix(((ZERO, found.inner), (found.outer, far)))}
    if where.measure:
        names |= {"area": A}
    names = {name: called for name, called in names.items() if name in results}
    return work.answer("workspace", results, _facts(told, where, names))


def _in_a_plane(told: Facts) -> bool:
    return told.kinds.key in ("kinds-in-a-plane", "kinds-about-an-axis")


def _facts(told: Facts, where: Dexterous, names: Mapping[str, Expr] | None = None) -> Facts:
    """With the reason that was found with the whole workspace, and what is said in numbers by which name."""
    kinds = Phrase("dexterous-in-a-plane" if _in_a_plane(told) else "dexterous")
    return Facts(
        kinds=kinds, orientations=told.orientations, dexterous=where, page_names=names or {},
        numbers=None if names is None else (*names,),
    )  # fmt: skip
