"""The degrees of freedom of a mechanism by Grübler's formula, and where that formula is blind."""

from __future__ import annotations

from derive.algebra.numbers.floats import number as at
from derive.derivation import Derivation, Phrase, Said, Step
from derive.expression import ONE, Expr, add, number, symbols
from derive.kinds.fields import NoOptions as Options
from derive.kinds.mechanism._checks import proofs
from derive.kinds.mechanism._facts import Facts as Facts
from derive.kinds.mechanism._facts import Other
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.mobility import LAMBDA, Joints, Mechanism, Space

C, DOF, SIZE, N, C_I, F_I = symbols("C dof lambda n c_i f_i")
MOVING_LOOPS = (4, 5, 6)  # revolute joints of single loops that move although the formula says they do not
OTHERS: dict[Space, tuple[Space, ...]] = {"spatial": ("planar", "spherical"), "planar": (), "spherical": ()}

NEEDS = ("parts",)
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
    work = Work(problem).showing(Step("size", (SIZE, number(size)), "given"), of_joint, gruebler)
    work = work.line(C, _total(mechanism), value=taken, label="constraints")
    work = work.line(DOF, *formulas, value=number(mechanism.dof))
    if mechanism.rods:
        work = _without_idle(work, number(mechanism.dof), number(mechanism.rods))
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


def _without_idle(work: Work, counted: Expr, idle: Expr) -> Work:
    """What the count leaves without the rotations that move nothing."""
    return work.line(DOF - idle, counted - idle, label="effective")


def _results(mechanism: Mechanism) -> dict[str, Expr]:
    found: dict[str, Expr] = {"dof": number(mechanism.dof)}
    if mechanism.rods:
        found |= {"idle": number(mechanism.rods), "effective": number(mechanism.dof - mechanism.rods)}
    return found


def _total(mechanism: Mechanism) -> Expr:
    """Each sort: how many times how much."""
    return add(*(number(each.pairs) * number(each.constraints) for each in _sorts(mechanism)))


def _sorts(mechanism: Mechanism) -> tuple[Joints, ...]:
    """The joints, those alike together; each joins two bodies."""
    found: dict[tuple[str, int], int] = {}
    for each in mechanism.joints:
        alike = each.name, each.constraints
        found[alike] = found.get(alike, 0) + each.pairs
    return tuple(Joints(name, count, constraints) for (name, constraints), count in found.items())


def _facts(mechanism: Mechanism, size: int) -> Facts:
    spherical = sum(each.pairs for each in mechanism.joints if each.name == "spherical")
    effective = mechanism.dof - mechanism.rods
    given_apart = mechanism.space == "spatial" and not mechanism.rods and not mechanism.legs
    return Facts(
        space=mechanism.space,
        bodies=(N, number(mechanism.bodies)),
        pairs=number(mechanism.pairs) if _known(mechanism) else None,
        loops=_loops(mechanism),
        takes=tuple(_takes(each, size) for each in _sorts(mechanism)),
        together=tuple(map(_together, _sorts(mechanism))),
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
        motors=number(effective) if effective > 0 else None,
        may_spin=Phrase("idle-rods-apart") if given_apart and spherical >= 2 and mechanism.loops else None,
        sliders=any(each.name == "prismatic" for each in mechanism.joints),
        others=_others(mechanism),
    )


def _loops(mechanism: Mechanism) -> Phrase | None:
    """That their constraints are taken to be independent."""
    if mechanism.loops < 2:
        return Phrase("one-loop") if mechanism.loops else None
    return Phrase("loops", {"count": number(mechanism.loops)})


def _takes(each: Joints, size: int) -> Phrase:
    """What one joint of the sort leaves, and what it takes away."""
    about: dict[str, Said] = {
        "freedoms": number(size - each.constraints),
        "constraints": number(each.constraints),
    }
    return (
        Phrase("takes", {"sort": Phrase(each.name), **about}) if each.name else Phrase("other-takes", about)
    )


def _together(each: Joints) -> Phrase:
    """So many of them."""
    about: dict[str, Said] = {"sort": Phrase(each.name or "other")}
    return (
        Phrase("joints", {"count": number(each.count), **about}) if each.count > 1 else Phrase("one", about)
    )


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
