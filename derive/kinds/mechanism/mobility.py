"""The degrees of freedom of a mechanism by Grübler's formula, and where that formula is blind."""

from __future__ import annotations

from derive.derivation import Cell, Claim, Derivation, PageFacts, Phrase, Result, Table
from derive.expression import Expr, Symbol, add, number
from derive.kinds.checks import SECOND_ROUTE
from derive.kinds.fields import NoOptions as Options
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.mobility import FREEDOMS, LAMBDA, Joints, Mechanism, Space

C, DOF = Symbol("C"), Symbol("dof")
MOVING_LOOPS = (4, 5, 6)  # revolute joints of single loops that move although the formula says they do not
HEADINGS = ("joint", "number", "freedoms", "constraints-of-each", "constraints-together")
OTHERS: dict[Space, tuple[Space, ...]] = {"spatial": ("planar", "spherical"), "planar": (), "spherical": ()}


class Facts(PageFacts):
    space: Space
    bodies: Expr
    pairs: Expr
    loops: Expr
    closed: bool
    table: Table
    coincident: tuple[tuple[Phrase | None, Expr, Expr, Expr], ...]  # joints: name, count, bodies, pairs
    legs: tuple[tuple[str, Expr, Expr], ...]  # chain, count, bodies between
    sign: int  # of the degrees of freedom
    missing: Expr
    idle: Expr | None
    effective: Expr
    may_spin: bool
    others: tuple[tuple[Space, Expr], ...]
    known: bool  # whether the formula does not see moving loops of so many revolute joints


def derive(mechanism: Mechanism, options: Options, problem: Problem) -> Derivation:
    """dof = lambda (n - 1) - sum c_i (Lynch and Park, section 2.2)."""
    size = LAMBDA[mechanism.space]
    taken = number(sum(each.total for each in mechanism.joints))
    free = number(size) * (number(mechanism.bodies) + -1)
    formulas = (free - C, number(size * (mechanism.bodies - 1)) - taken)
    work = Work(problem).line(C, _total(mechanism), value=taken, label="constraints")
    work = work.line(DOF, *formulas, value=number(mechanism.dof))
    work = work.claim(Claim("loop-freedoms", SECOND_ROUTE, mechanism.by_loops == mechanism.dof))
    return work.answer("mobility", _results(mechanism), _facts(mechanism, size))


def _results(mechanism: Mechanism) -> dict[str, Result]:
    found: dict[str, Result] = {"dof": number(mechanism.dof)}
    if mechanism.rods:
        found |= {"idle": number(mechanism.rods), "effective": number(mechanism.dof - mechanism.rods)}
    return found


def _total(mechanism: Mechanism) -> Expr:
    """Each sort: how many times how much."""
    return add(*(number(each.pairs) * number(each.constraints) for each in mechanism.joints))


def _facts(mechanism: Mechanism, size: int) -> Facts:
    spherical = sum(each.pairs for each in mechanism.joints if each.name == "spherical")
    return Facts(
        space=mechanism.space,
        bodies=number(mechanism.bodies),
        pairs=number(mechanism.pairs),
        loops=number(mechanism.loops),
        closed=mechanism.loops > 0,
        table=_table(mechanism.joints, size),
        coincident=tuple(
            (
                Phrase(each.name) if each.name else None,
                number(each.count),
                number(each.joining),
                number(each.joining - 1),
            )
            for each in mechanism.joints
            if each.joining > 2
        ),
        legs=tuple((chain, number(count), number(len(chain) - 1)) for chain, count in mechanism.legs),
        sign=(mechanism.dof > 0) - (mechanism.dof < 0),
        missing=number(-mechanism.dof),
        idle=number(mechanism.rods) if mechanism.rods else None,
        effective=number(mechanism.dof - mechanism.rods),
        may_spin=mechanism.space == "spatial"
        and not mechanism.rods
        and spherical >= 2
        and mechanism.loops > 0,
        others=_others(mechanism),
        known=_known(mechanism),
    )


def _table(joints: tuple[Joints, ...], size: int) -> Table:
    """How each sort is counted."""
    return Table(tuple(map(Phrase, HEADINGS)), tuple(_row(each, size) for each in joints))


def _row(each: Joints, size: int) -> tuple[Cell, ...]:
    freedoms = FREEDOMS[each.name] if each.name else size - each.constraints
    counts = (each.pairs, freedoms, each.constraints, each.total)
    return Phrase(each.name or "other"), *map(number, counts)


def _others(mechanism: Mechanism) -> tuple[tuple[Space, Expr], ...]:
    """What its joints would leave if their axes were parallel, or met in a point, and that is more."""
    if mechanism.loops == 0:
        return ()
    counts = ((space, mechanism.counted_as(space)) for space in OTHERS[mechanism.space])
    return tuple((space, number(n)) for space, n in counts if n is not None and n > max(mechanism.dof, 0))


def _known(mechanism: Mechanism) -> bool:
    only_revolute = all(each.name == "revolute" for each in mechanism.joints)
    return (
        mechanism.space == "spatial"
        and only_revolute
        and mechanism.loops == 1
        and mechanism.pairs in MOVING_LOOPS
    )
