"""Each singular set analysed: the Jacobian there, its rank, what it no longer moves and what it no longer
reaches."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from derive.algebra.elimination import column_space, eliminated, null_space
from derive.algebra.factors import TooLong
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.pinned import in_single_angles, pinned_matrix, rationalised
from derive.algebra.ring import Root
from derive.algebra.text import text
from derive.derivation import Branch
from derive.errors import NotDerivable
from derive.expression import Expr, Matrix, Symbol
from derive.kinds.problem import Problem
from derive.kinds.robot._singular.geometry import Look, Seeing
from derive.mechanics.singular import SingularSet
from derive.mechanics.zeros import Zero

LONGEST_VECTOR = 12  # terms; a longer direction tells nobody anything


@dataclass(frozen=True, slots=True)
class Block:
    """A part of the Jacobian that decides on its own: its name, its value (m by n), the joint variables of
    its columns, the row names of its velocities, the frame they are seen in (0: base), and the point."""

    name: str
    J: ScalarMatrix
    variables: tuple[str, ...]
    rows: tuple[str, ...]
    frame: int
    seeing: Seeing


@dataclass(frozen=True, slots=True)
class Case:
    """One solution of a set: the values, how it looks, and the Jacobian there (None where it is too long
    to be worth writing) with its rank, null space, range and lost directions (trees)."""

    values: tuple[tuple[Expr, Expr], ...]
    zeros: tuple[Zero, ...]
    looks: tuple[Look, ...]
    J: ScalarMatrix | None = None
    rank: int = 0
    null: tuple[ScalarMatrix, ...] = ()
    range: tuple[ScalarMatrix, ...] = ()
    lost: tuple[ScalarMatrix, ...] = ()

    @property
    def conditions(self) -> tuple[Expr, ...]:
        """What must not be negative for the values to be real."""
        return tuple(zero.condition for zero in self.zeros if zero.condition is not None)


@dataclass(frozen=True, slots=True)
class Analysed:
    """A set with its cases; `equations` are written out."""

    block: Block
    equations: tuple[Expr, ...]
    cases: tuple[Case, ...]

    @property
    def solved(self) -> bool:
        return bool(self.cases)


def analysed(problem: Problem, block: Block, found: SingularSet) -> Analysed:
    """Every case of a set; where its two solutions differ only in a direction, the Jacobian of the first."""
    equations = tuple(map(problem.readable, found.equations))
    once = any(zero.rule in ("direction", "triangle") for zero in found.zeros)
    cases = [
        _case(block, zeros, with_J=not (once and place)) for place, zeros in enumerate(found.cases)
    ]  # fmt: skip
    return Analysed(block, equations, tuple(cases))


def _case(block: Block, zeros: tuple[Zero, ...], with_J: bool) -> Case:
    values = tuple((Symbol(zero.variable), zero.value) for zero in zeros)
    case = Case(values, zeros, block.seeing.looks(zeros))
    if not with_J:
        return case
    try:
        return _with_spaces(block, case)
    except (TooLong, NotDerivable, ZeroDivisionError):
        return case


def _with_spaces(block: Block, case: Case) -> Case:
    J = at_zeros(block.J, case.zeros)
    null, lost = null_space(J, block.variables), null_space(J.T, block.variables)
    spanned = column_space(J, block.variables)
    return Case(
        case.values,
        case.zeros,
        case.looks,
        J,
        eliminated(J).rank,
        *(basis if all(map(_short, basis)) else () for basis in (null, spanned, lost)),
    )


def at_zeros(J: ScalarMatrix, zeros: Iterable[Zero]) -> ScalarMatrix:
    """The matrix where these hold, one after the other."""
    for zero in zeros:
        J = pinned_matrix(J, zero.variable, zero.at).map(rationalised)
    return ScalarMatrix.of(J.rows)


def _short(column: ScalarMatrix) -> bool:
    return not rooted(column) and sum(len(entry.numerator) for entry in column.entries) <= LONGEST_VECTOR


def rooted(matrix: ScalarMatrix) -> bool:
    """Whether it holds fractions, or roots that depend on the joint angles."""
    roots = {root.name for root in matrix.ring.roots if _turns(root)}
    return any(entry.denominator is not None or roots & set(entry.generators()) for entry in matrix.entries)


def _turns(root: Root) -> bool:
    return any(name.startswith(("cos(", "sin(")) for powers, _ in root.radicand for name, _ in powers)


def written(problem: Problem, matrix: ScalarMatrix) -> Matrix:
    """A matrix that may hold roots of sums of angles."""
    return problem.readable_matrix(matrix.map(in_single_angles) if matrix.ring.roots else matrix)


def branches(problem: Problem, found: Iterable[Analysed], point: str) -> tuple[Branch, ...]:
    """The solutions for the results: the values of each case, and what it looks like."""
    made = []
    for each in found:
        for case in each.cases:
            values = {str(text(name)): problem.final(value) for name, value in case.values}
            made.append(Branch(values, said(case, each.block, point) or _vanishing(each)))
        if not each.cases:
            made.append(Branch({}, _vanishing(each)))
    return tuple(made)


def _vanishing(each: Analysed) -> str:
    if not each.equations:
        return "all minors vanish"
    return " and ".join(f"{text(equation)} = 0" for equation in each.equations)


def said(case: Case, block: Block, point: str) -> str:
    """How a case looks, in plain words."""
    rows = block.seeing.rows
    return "; ".join(dict.fromkeys(_spoken(look, point, rows) for look in _telling(case)))


def _telling(case: Case) -> tuple[Look, ...]:
    """What says most: axes in line before anything; the plane only by itself. Where several joint variables
    are fixed, everything of that sort."""
    looks, several = case.looks, len(case.zeros) > 1
    for kinds in (("coincide",), ("stretched", "folded"), ("axis",), ("parallel",), ("plane",)):
        if found := tuple(look for look in looks if look.kind in kinds):
            return found if several or kinds == ("stretched", "folded") else found[-1:]
    return ()


def clauses(case: Case, block: Block, point: str) -> tuple[str, ...]:
    """The same as sentences to go on with."""
    rows = block.seeing.rows
    return tuple(dict.fromkeys(_clause(look, point, rows) for look in _telling(case)))


def _clause(look: Look, point: str, rows: tuple[int, ...]) -> str:
    name, _, rest = _spoken(look, point, rows).rpartition(": ")
    match look.kind:
        case "stretched" | "folded":
            return f"the elbow at joint {look.joints[-1]} is {look.kind}"
        case _:
            return f"{rest} (a {name} singularity)" if name else rest


def _spoken(look: Look, point: str, rows: tuple[int, ...]) -> str:
    """`rows` are the joints that move the point."""
    first, last = look.joints[0], look.joints[-1]
    of = point if not look.of else f"the point of axis {look.of}"
    shoulder = "shoulder: " if first == rows[0] else ""
    wrist = "wrist: " if look.joints == (rows[-1] - 2, rows[-1]) else ""
    return {
        "axis": f"{shoulder}{point} lies on the axis of joint {first}",
        "plane": f"{shoulder}{of} lies in the plane of the axes of joints {first} and {last}",
        "coincide": f"{wrist}the axes of joints {first} and {last} coincide",
        "parallel": f"{wrist}the axes of joints {first} and {last} are parallel",
        "stretched": f"elbow stretched at joint {last}",
        "folded": f"elbow folded at joint {last}",
    }[look.kind]
