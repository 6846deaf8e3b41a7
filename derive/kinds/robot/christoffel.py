"""The Christoffel symbols of the inertia matrix, each from its partial derivatives."""

from __future__ import annotations

from derive.algebra.normal import normal
from derive.derivation import Derivation, PageFacts, Phrase
from derive.expression import ZERO, Symbol
from derive.kinds.fields import NoOptions as Options
from derive.kinds.problem import Problem
from derive.kinds.robot._by_index import by_index
from derive.kinds.robot._chain import BODIES_ALONE
from derive.kinds.robot._dynamics.arm import Arm
from derive.kinds.robot._dynamics.christoffel_lines import (
    left_out,
    left_out_rightly,
    lines,
    listed,
    named,
    ordered,
    shown,
    skew,
)
from derive.kinds.robot._dynamics.index_laws import christoffel_law
from derive.kinds.robot.inertia_matrix import Facts as InertiaFacts
from derive.kinds.work import Work
from derive.mechanics.robot import Robot

NEEDS = ("bodies",)
MOST_TERMS = 30_000  # of all symbols; more take longer than anyone waits
CLAIMS = ("names", "symmetric", "skew-symmetric", "others-vanish", "listed")


class Facts(PageFacts):
    """What is said of the symbols that are not shown, and whether these are all there are."""

    constant: bool
    others: Phrase | None


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """c_ijk = (d_kj,i + d_ki,j - d_ij,k) / 2 (Spong et al., eq. 6.38)."""
    arm = Arm(problem)
    arm.refuse_vast(MOST_TERMS)
    big, D, symbols = arm.inertia.told(InertiaFacts).big, arm.D, arm.christoffel
    work = Work(problem).resting_on(arm.inertia).showing(christoffel_law(problem.taken))
    told = () if big else shown(symbols)
    work = work if big else lines(work, symbols, arm.variables, arm.final)
    first = [ijk for ijk in symbols if ijk == ordered(ijk)]
    found = {ijk: work[named(ijk)] if ijk in told else arm.final(symbols[ijk]) for ijk in first}
    work = work.knowing({named(ijk): found[ordered(ijk)] for ijk in symbols})
    work = work.law("symmetric", (value == symbols[j, i, k] for (i, j, k), value in symbols.items()))
    work = work.law("skew-symmetric", skew(D, symbols, robot.variables))
    results = {named(ijk).name: found[ordered(ijk)] for ijk in sorted(symbols)}
    untold = [results[named(ijk).name] for ijk in symbols if ordered(ijk) not in told]
    vanish = sum(value == ZERO for value in untold)
    zero = {ijk: not normal(value, problem.names) for ijk, value in found.items() if ijk not in told}
    gone = sum(zero[ordered(ijk)] for ijk in symbols if ordered(ijk) not in told)
    work = work.law("others-vanish", (gone == vanish, big or gone == len(untold)))
    work = by_index(work, results)
    facts = Facts(
        constant=not big and not told,
        others=_others(big, len(symbols), vanish, len(told)),
        numbers=listed(results, symbols),
        remark=left_out(results, symbols),
    )
    return work.law("listed", left_out_rightly(facts, arm.exact_christoffel)).answer(
        "christoffel", results, facts, unread=BODIES_ALONE
    )


def _others(big: bool, count: int, vanish: int, told: int) -> Phrase | None:
    """What becomes of those that are not shown; of a `big` arm none is."""
    if big:
        return Phrase("long-symbols", {"count": count, "vanish": vanish})
    if not told:
        return Phrase("all-vanish", {"D": Symbol("D")})
    return Phrase("the-others-vanish") if vanish else None
