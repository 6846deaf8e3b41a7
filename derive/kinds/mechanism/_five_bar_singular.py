"""Where a five-bar linkage is singular: a leg in line at the border of its reach, or its couplers in line."""

from __future__ import annotations

from derive.derivation import Branch, Derivation, Phrase, Step
from derive.expression import ZERO, Call, Expr, Symbol, number, subtract
from derive.kinds.checks import route
from derive.kinds.mechanism._facts import SingularFacts
from derive.kinds.mechanism._five_bar_checks import in_line
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.linkages import FiveBar
from derive.names import free


def of_five_bars(robot: FiveBar, problem: Problem) -> Derivation:
    """An entry of J_q vanishes, or det J_x (Gosselin and Angeles, Singularity analysis of closed-loop
    kinematic chains)."""
    base = problem.ask("jacobian")
    (first, second), (third, fourth) = robot.cranks, robot.couplers
    work, (a_1, a_2, b_1, b_2) = Work(problem, uses=(base,)).naming(
        a_1=first, a_2=second, b_1=third, b_2=fourth
    )
    r_1, r_2, e = (Symbol(free(problem.taken, name, f"{name[0]}{name}")) for name in ("r_1", "r_2", "e"))
    rows: list[tuple[Symbol, str, int, Expr]] = [
        (r_1, "leg-stretched", 1, a_1 + b_1), (r_1, "leg-folded", 1, _apart(a_1, b_1)),
        (r_2, "leg-stretched", 2, a_2 + b_2), (r_2, "leg-folded", 2, _apart(a_2, b_2)),
        (e, "couplers-stretched", 0, b_1 + b_2), (e, "couplers-folded", 0, _apart(b_1, b_2)),
    ]  # fmt: skip
    branches, lines = list[Branch](), list[tuple[Phrase, str]]()
    for name, key, leg, size in rows:
        value = work.shown(size)
        links = (name, size) if value == size else (name, size, value)
        work = work.showing(Step(f"{key}-{leg}", links, "in-numbers"))
        said = Phrase(key, {"leg": number(leg)} if leg else {})
        lines.append((said, f"{key}-{leg}"))
        branches.append(Branch({name.name: problem.final(value)}, (said,)))
    meeting = [_meeting(branch.values[e.name]) for branch in branches[4:]]
    work = work.claim(route("all-around", in_line(robot, work, base, branches, meeting)))
    loose = tuple((*line, meets) for line, meets in zip(lines[4:], meeting, strict=True))
    facts = SingularFacts(distances=(r_1, r_2, e), at_border=tuple(lines[:4]), loose=loose)
    return work.answer("singularities", {"solutions": tuple(branches)}, facts)


def _meeting(apart: Expr) -> Phrase:
    """What meets where the ends of the cranks are so far apart and the couplers lie in line."""
    return Phrase("elbows-meet" if apart == ZERO else "assemblies-meet")


def _apart(one: Expr, other: Expr) -> Expr:
    """How much longer one of two bars is than the other."""
    return number(0) if one == other else Call("abs", (subtract(one, other),))
