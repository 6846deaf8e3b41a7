"""Where the border of a workspace runs: the distances that an arm reaches stretched and folded, as chains."""

from __future__ import annotations

from dataclasses import dataclass

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.algebra.scalar import Scalar
from derive.algebra.signs import sign_of
from derive.derivation import Record
from derive.errors import NotDerivable
from derive.expression import ZERO, Call, Expr, Symbol, add, sqrt
from derive.kinds.problem import Problem
from derive.kinds.robot._point import Tracked
from derive.mechanics.chain import Chain
from derive.mechanics.reach import PlanarArm, SwungArm, planar_arm, swung_arm
from derive.mechanics.section import Section


@dataclass(frozen=True, slots=True)
class Region:
    """`kind` is "planar" or "swung"; `lengths` of the links, as trees; r_min and r_max with the chains that
    lead to them, and the distances they count: from `center` (3 by 1)."""

    kind: str
    lengths: tuple[Expr, ...]
    smallest: tuple[Expr, ...]
    largest: tuple[Expr, ...]
    center: ScalarMatrix
    offset: Expr = ZERO
    side: Expr = ZERO
    slides: bool = False


class Secondary(Record):
    """Between which distances every orientation is possible: the last link, in any direction, has to start
    where the others reach."""

    far: Expr
    gap: Expr
    inside: Expr


def region_of(problem: Problem, found: Chain, point: Tracked) -> Region:
    """What a point reaches. Raises NotDerivable for an arm of another build."""
    planar = planar_arm(found, point.position, point.last)
    if planar:
        return _annulus(problem, planar)
    swung = swung_arm(found, point.position, point.last)
    if swung:
        return _shell(problem, swung)
    raise NotDerivable(
        "the workspace is found where all joints that move the point are parallel, where a first one swings "
        "links about its axis that move in a plane through it or beside it, and of at most three joints of "
        "which the first turns; this arm is neither"
    )


def refuse_repeated(seen: Section, found: Chain, determinant: Scalar | None = None) -> None:
    """Raises NotDerivable where a joint moves the point nowhere in the section where no other does."""
    names = [found.joint(i).variable for i in (seen.first, *seen.others)]
    still = any(not seen.square.diff(name) and not seen.height.diff(name) for name in names[1:])
    if still or determinant == Scalar.of(0):
        raise NotDerivable(
            f"one of {', '.join(names)} only repeats what the others do to the point, as where two axes "
            "coincide; leave it out of the arm"
        )


def refuse_coupled(found: Chain, point: Tracked) -> None:
    """Raises NotDerivable where the rows do not turn as they like, or the point moves in its link."""
    if point.drift is not None or not _each_its_row(found):
        raise NotDerivable(
            "the workspace is found where every row turns freely; in this arm the motion of one is tied to "
            "that of another"
        )


def _each_its_row(found: Chain) -> bool:
    """Whether the rows with joints move one by one, as they do where joints are not coupled."""
    coupling = found.coupling
    return coupling is None or (coupling.free and coupling.rows == tuple(i for i, _ in found.moving))


def _annulus(problem: Problem, arm: PlanarArm) -> Region:
    lengths = tuple(map(problem.readable, arm.lengths))
    smallest = lengths if len(lengths) == 1 else _folded(problem, arm.lengths)
    return Region("planar", lengths, smallest, _sum(problem, arm.lengths), arm.center, slides=arm.slides)


def _shell(problem: Problem, arm: SwungArm) -> Region:
    lengths = tuple(map(problem.readable, arm.lengths))
    offset, side = problem.readable(arm.offset), problem.readable(arm.side)
    if offset != ZERO:
        whole = _aside(_sum(problem, (arm.offset, *arm.lengths)), side)
        return Region("torus", lengths, _folded(problem, arm.lengths), whole, arm.center, offset, side)
    near = _aside(_folded(problem, arm.lengths), side)
    far = _aside(_sum(problem, arm.lengths), side)
    return Region("swung", lengths, near, far, arm.center, offset, side)


def _folded(problem: Problem, lengths: tuple[Scalar, ...]) -> tuple[Expr, ...]:
    """How near two links or more come to where they begin."""
    if len(lengths) == 2:
        return _difference(problem, lengths)
    return _holes(problem, _overreach(problem, lengths))


def _aside(distance: tuple[Expr, ...], side: Expr) -> tuple[Expr, ...]:
    """The same distance to a point that lies to the side of it. Raises NotDerivable where it depends on
    lengths whether there is one."""
    if side == ZERO:
        return distance
    if isinstance(distance[-1], Call) and distance[-1].function == "max":
        raise NotDerivable(
            "give the lengths of the links in numbers: whether there is a hole depends on them"
        )
    return (side,) if distance[-1] == ZERO else (sqrt(_bare(distance[-1]) ** 2 + side**2),)


def _bare(tree: Expr) -> Expr:
    """The inside of |...|, where its square is all that counts."""
    return tree.arguments[0] if isinstance(tree, Call) and tree.function == "abs" else tree


def _sum(problem: Problem, lengths: tuple[Scalar, ...]) -> tuple[Expr, ...]:
    """l1 + l2, and its value where that is shorter."""
    written = add(*map(problem.readable, lengths))
    value = problem.readable(sum(lengths, Scalar.of(0)))
    return (written,) if value == written else (written, value)


def _difference(problem: Problem, lengths: tuple[Scalar, ...]) -> tuple[Expr, ...]:
    """|l1 - l2|."""
    one, two = map(problem.readable, lengths)
    value = lengths[0] - lengths[1]
    written = Call("abs", (one - two,))
    if value.constant is None:
        return (written,)
    return written, problem.readable(value if value.constant >= 0 else -value)


def _holes(problem: Problem, holes: tuple[Expr, ...]) -> tuple[Expr, ...]:
    """max(0, l1 - l2 - l3, ...): the longest link reaches over all others, or there is no hole."""
    chain: tuple[Expr, ...] = (Call("max", (ZERO, *dict.fromkeys(holes))),)
    decided = _largest(problem, holes)
    return chain if decided == chain[0] else (*chain, decided)


def _largest(problem: Problem, holes: tuple[Expr, ...]) -> Expr:
    """max(0, ...), what is certainly not positive left out; a value where that is known."""
    values = {hole: normal(hole) for hole in holes}
    signs = {hole: sign_of(value, value.letters()) for hole, value in values.items()}
    numbers = [value.constant for value in values.values() if value.constant is not None]
    best = max(numbers, default=None)
    left = tuple(hole for hole, value in values.items() if signs[hole] is None and value.constant is None)
    if best is not None and best > 0 and not left:
        return problem.readable(Scalar.of(best))
    positive = tuple(hole for hole in values if signs[hole] == 1)
    if not left and len(positive) <= 1:
        return positive[0] if positive else ZERO
    return Call("max", (ZERO, *positive, *left))


def _overreach(problem: Problem, lengths: tuple[Scalar, ...]) -> tuple[Expr, ...]:
    """By how much each link is longer than all the others together."""
    whole = sum(lengths, Scalar.of(0))
    return tuple(problem.readable(2 * length - whole) for length in lengths)


def secondary(problem: Problem, region: Region) -> Secondary:
    *others, last = region.lengths
    far = problem.readable(normal(add(*others) - last))
    scalars = tuple(map(normal, others))
    chain = _folded(problem, scalars)
    gap = chain[-1]  # the radius of the hole in the workspace of these links
    return Secondary(far=far, gap=gap, inside=Call("abs", (Symbol("r") - last,)))


def final_distance(problem: Problem, tree: Expr) -> Expr:
    """With the values of `where`; a value that is a number is one."""
    if isinstance(tree, Call) and tree.function == "max":
        return _largest(problem, tuple(problem.final(part) for part in tree.arguments))
    return problem.final(tree)
