"""The degrees of freedom of a mechanism by Grübler's formula, and where that formula is blind."""

from __future__ import annotations

from derive.algebra.numbers.floats import number as at
from derive.derivation import Cell, Derivation, Phrase, Step, Table
from derive.expression import ONE, Expr, add, number, symbols
from derive.kinds.fields import NoOptions as Options
from derive.kinds.mechanism._checks import proofs
from derive.kinds.mechanism._facts import Facts as Facts
from derive.kinds.mechanism._facts import Other
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.mobility import FREEDOMS, LAMBDA, Joints, Mechanism, Space

C, DOF, SIZE, N, C_I, F_I = symbols("C dof lambda n c_i f_i")
MOVING_LOOPS = (4, 5, 6)  # revolute joints of single loops that move although the formula says they do not
HEADINGS = ("joint", "number", "freedoms", "constraints-of-each", "constraints-together")
OTHERS: dict[Space, tuple[Space, ...]] = {"spatial": ("planar", "spherical"), "planar": (), "spherical": ()}

CLAIMS = (
    "constraints-of-a-joint", "as-written", "random-instance|random-joints", "as-said", "without-idle",
)  # fmt: skip
CLAIMED = {"effective": "without-idle", "idle": "without-idle"}


def derive(mechanism: Mechanism, options: Options, problem: Problem) -> Derivation:
    """dof = lambda (n - 1) - sum c_i (Lynch and Park, section 2.2)."""
    size = LAMBDA[mechanism.space]
    taken = number(sum(each.total for each in mechanism.joints))
    free = number(size) * (number(mechanism.bodies) + -1)
    formulas = (free - C, number(size * (mechanism.bodies - 1)) - taken)
    of_joint, gruebler = _laws(mechanism, taken)
    work = Work(problem).showing(Step("size", (SIZE, number(size)), "given"), of_joint)
    work = work.line(C, _total(mechanism), value=taken, label="constraints").showing(gruebler)
    work = work.line(DOF, *formulas, value=number(mechanism.dof))
    told, results = _facts(mechanism, size), _results(mechanism)
    found = {name: round(at(tree, {})) for name, tree in results.items()}
    work = work.claim(*proofs(mechanism, work.steps, told, found))
    return work.answer("mobility", results, told)


def _laws(mechanism: Mechanism, taken: Expr) -> tuple[Step, Step]:
    """What a joint takes away, and what is left; tried on the first sort of joint, and on the whole."""
    first, size = mechanism.joints[0], number(LAMBDA[mechanism.space])
    freedoms = number(LAMBDA[mechanism.space] - first.constraints)
    of_joint: dict[Expr, Expr] = {C_I: number(first.constraints), SIZE: size, F_I: freedoms}
    whole: dict[Expr, Expr] = {DOF: number(mechanism.dof), SIZE: size, N: number(mechanism.bodies), C: taken}
    return (
        Step("joint", (C_I, SIZE - F_I), "law", instance=of_joint),
        Step("gruebler", (DOF, SIZE * (N - ONE) - C), "law", instance=whole),
    )


def _results(mechanism: Mechanism) -> dict[str, Expr]:
    found: dict[str, Expr] = {"dof": number(mechanism.dof)}
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
        pairs=number(mechanism.pairs) if _known(mechanism) else None,
        loops=number(mechanism.loops) if mechanism.loops else None,
        table=_table(mechanism.joints, size),
        coincident=tuple(
            (
                Phrase(each.name) if each.name else None,
                number(each.joining),
                number(each.joining - 1),
            )
            for each in mechanism.joints
            if each.joining > 2
        ),
        legs=tuple((chain, number(count), number(len(chain) - 1)) for chain, count in mechanism.legs),
        sign=(mechanism.dof > 0) - (mechanism.dof < 0),
        missing=number(-mechanism.dof) if mechanism.loops and mechanism.dof < 0 else None,
        idle=number(mechanism.rods) if mechanism.rods else None,
        effective=number(mechanism.dof - mechanism.rods) if mechanism.rods else None,
        may_spin=Phrase("idle-rods-apart")
        if mechanism.space == "spatial" and not mechanism.rods and spherical >= 2 and mechanism.loops > 0
        else None,
        others=_others(mechanism),
    )


def _table(joints: tuple[Joints, ...], size: int) -> Table:
    """How each sort is counted."""
    return Table(tuple(map(Phrase, HEADINGS)), tuple(_row(each, size) for each in joints))


def _row(each: Joints, size: int) -> tuple[Cell, ...]:
    freedoms = FREEDOMS[each.name] if each.name else size - each.constraints
    counts = (each.pairs, freedoms, each.constraints, each.total)
    return Phrase(each.name or "other"), *map(number, counts)


def _others(mechanism: Mechanism) -> tuple[Other, ...]:
    """What its joints would leave if their axes were parallel, or met in a point, and that is more."""
    if mechanism.loops == 0:
        return ()
    counts = ((space, mechanism.counted_as(space)) for space in OTHERS[mechanism.space])
    known = ((space, n) for space, n in counts if n is not None and n > max(mechanism.dof, 0))
    return tuple((space, (SIZE, number(LAMBDA[space])), number(n)) for space, n in known)


def _known(mechanism: Mechanism) -> bool:
    only_revolute = all(each.name == "revolute" for each in mechanism.joints)
    return (
        mechanism.space == "spatial"
        and only_revolute
        and mechanism.loops == 1
        and mechanism.pairs in MOVING_LOOPS
    )
