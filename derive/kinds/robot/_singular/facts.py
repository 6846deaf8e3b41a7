"""What the words about singular configurations need to know."""

from __future__ import annotations

from collections.abc import Sequence
from math import prod
from typing import TypeAlias

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.scalar import Scalar
from derive.derivation import PageFacts, Phrase, Record, Said
from derive.expression import ZERO, Expr, Product, Symbol, add, free_symbols, multiply, transpose
from derive.kinds.problem import Problem
from derive.kinds.robot._degrees import in_degrees
from derive.kinds.robot._determinants import mostly_negative
from derive.kinds.robot._singular.minors import Way
from derive.kinds.robot._singular.saying import clauses
from derive.kinds.robot._singular.sets import Analysed, Case, rooted, written
from derive.names import free

Chain: TypeAlias = tuple[Expr, ...]


class CaseTold(Record):
    """One branch of a set; the basis of a space is a chain, left out where there is none. Where velocities
    and angular velocities stand in one vector, which have no common unit, there are equations `satisfied` by
    what remains in place of a direction that is lost."""

    places: tuple[tuple[Expr, Expr], ...]
    looks: tuple[Phrase, ...]
    known: bool
    block: Symbol | None
    rank: int
    J: tuple[Chain, ...]
    null: tuple[Chain, ...]
    range: tuple[Chain, ...]
    lost: tuple[Chain, ...]
    satisfied: tuple[Chain, ...]
    missing: tuple[Phrase, ...]  # a motion for each of these equations that does not satisfy it


class Inside(Record):
    """The equations and values of a set: `choices` for each variable where they are independent of each
    other, `places` for each case where they are not; `long` are values that stand on lines of their own."""

    equations: tuple[tuple[Expr, Expr], ...]
    choices: tuple[tuple[tuple[Expr, Expr], ...], ...]
    places: tuple[tuple[tuple[Expr, Expr], ...], ...]
    long: tuple[Chain, ...]
    several: bool  # equations
    told: bool
    rank: int
    exact: bool


class SetTold(Record):
    """A set with its cases, two that are `alike` as one; `angular` where rotations are lost there."""

    inside: Inside
    cases: tuple[CaseTold, ...]
    alike: bool
    angular: bool
    frame: int | None
    conditions: tuple[Expr, ...]


class Facts(PageFacts):
    """The way to the determinant, and the sets on which the rank drops."""

    way: str  # "wrist", "minors", ...
    parts: tuple[Phrase, ...]  # of a wrist, else how the Jacobian is written
    taken: Phrase | None  # what is taken of it
    lengths: Phrase | None
    where: Phrase  # the rank drops
    sets: tuple[SetTold, ...]
    inner: tuple[Inside, ...]  # sets inside others
    inside: Phrase | None  # what is said of those
    holding: Phrase | None  # where what is said of a set holds
    none: bool
    sliding: bool  # whether a joint does not turn


def facts_of(
    problem: Problem, way: Way, sets: tuple[Analysed, ...], lengths: Phrase | None, sliding: bool
) -> Facts:
    """The way, and each set with its cases; what is taken for granted of `lengths`; whether there are
    `sliding` joints."""
    inner = tuple(each for each in sets if each.inner)
    none, outer = not sets and way.complete, len(sets) - len(inner)
    return Facts(
        way=way.name,
        parts=_parts(way),
        taken=_taken(way),
        lengths=None if none else lengths,
        where=Phrase(_where(way, none, outer)),
        sets=tuple(_set(problem, way, each) for each in sets if not each.inner),
        inner=tuple(_inside(problem, each) for each in inner),
        inside=Phrase("inside-of-a-wrist" if way.name == "wrist" else "inside-these") if inner else None,
        holding=_holding(len({each.rank for each in sets}) > 1, all(each.exact for each in sets)),
        none=none,
        sliding=sliding,
    )


def _parts(way: Way) -> tuple[Phrase, ...]:
    """How the Jacobian that is shown is written; of a wrist the two parts of it."""
    first = way.parts[0].block
    if way.name != "wrist":
        about: dict[str, Said] = {"rows": tuple(map(Symbol, first.rows)), "frame": first.frame or 0}
        return (Phrase("in-axes-of-a-frame" if first.frame else "rows-of-the-jacobian", about),)
    keys = ("velocity-of-the-center", "angular-velocity-of-the-hand")
    blocks = (part.block for part in way.parts)
    return tuple(
        Phrase(key, {"rates": _rates(block.variables), "frame": block.frame or 0})
        for key, block in zip(keys, blocks, strict=True)
    )


def _taken(way: Way) -> Phrase | None:
    """Of which matrix the determinant is taken."""
    block = way.parts[0].block
    if way.name == "wrist":
        return None
    if way.name != "minors":
        return Phrase("its-determinant")
    J, wide = Symbol(block.name), block.J.shape[0] < block.J.shape[1]
    gram = Product((J, transpose(J)) if wide else (transpose(J), J))
    return Phrase("more-columns" if wide else "more-rows", {"gram": gram})


def _where(way: Way, none: bool, count: int) -> str:
    if none:
        return "never"
    if way.name != "minors":
        return "vanishes-where" if count == 1 else "vanishes-in-cases"
    if way.complete:
        return "happens-where" if count == 1 else "happens-in-cases"
    return "happens-here-at-least" if count else "happens-somewhere"


def _holding(graded: bool, exact: bool) -> Phrase | None:
    """Sets have different ranks where they are `graded`."""
    if exact:
        return Phrase("holds-outside-of-others") if graded else None
    return Phrase("holds-in-general-and-others" if graded else "holds-in-general")


def _rates(variables: tuple[str, ...]) -> tuple[Symbol, ...]:
    return tuple(Symbol(f"{name}_dot") for name in variables)


def _set(problem: Problem, way: Way, each: Analysed) -> SetTold:
    cases = tuple(_case(problem, way, each, case) for case in each.cases)
    alike = len(cases) == 2 and not cases[1].known and cases[0].looks == cases[1].looks
    return SetTold(
        inside=_inside(problem, each),
        cases=cases[:1] if alike else cases,
        alike=alike,
        angular=each.block.name == "J_22" or each.block.rows[0][0] == "w",
        frame=each.block.frame,
        conditions=each.cases[0].conditions if each.cases else (),
    )


def _inside(problem: Problem, each: Analysed) -> Inside:
    choices = _choices([_places(problem, case) for case in each.cases])
    free = prod(map(len, choices)) == len(each.cases)
    decided = (in_degrees(problem, *pair) for pair in each.decided)
    equations = (*decided, *((equation, ZERO) for equation in each.equations))
    solved = len(each.cases) == 1 and {*equations} == {*_places(problem, each.cases[0])}  # nothing to solve
    long = choices[0] if len(choices) == 1 and any(free_symbols(value) for _, value in choices[0]) else ()
    return Inside(
        equations=() if solved else equations,
        choices=choices if free and not long else (),
        places=() if free else tuple(_places(problem, case) for case in each.cases),
        long=long,
        several=len(each.equations) > 1,
        told=any(case.J is not None for case in each.cases),
        rank=each.rank,
        exact=each.exact,
    )


def _places(problem: Problem, case: Case) -> tuple[tuple[Expr, Expr], ...]:
    return tuple(in_degrees(problem, *pair) for pair in case.values)


def _choices(cases: Sequence[tuple[tuple[Expr, Expr], ...]]) -> tuple[tuple[tuple[Expr, Expr], ...], ...]:
    found: dict[Expr, dict[tuple[Expr, Expr], None]] = {}
    for values in cases:
        for pair in values:
            found.setdefault(pair[0], {})[pair] = None
    return tuple(tuple(pairs) for pairs in found.values())


def _case(problem: Problem, way: Way, each: Analysed, case: Case) -> CaseTold:
    shown = case.J is not None and not rooted(case.J)
    J = Symbol(each.block.name)
    mixed = len({row[0] for row in each.block.rows}) > 1
    null, spanned, lost = _letters(problem, (case.null, case.range, case.lost))
    return CaseTold(
        places=_places(problem, case),
        looks=clauses(case, each.block, way.point),
        known=case.J is not None,
        block=J if each.block.name in ("J_11", "J_22") else None,
        rank=case.rank,
        J=((J, written(problem, case.J)),) if shown and case.J is not None else (),
        null=_basis(problem, null, tuple(_positive(problem, each) for each in case.null)),
        range=_basis(problem, spanned, case.range if shown else ()),
        lost=() if mixed else _basis(problem, lost, case.lost),
        satisfied=tuple(_satisfied(problem, each.block.rows, u) for u in case.lost if mixed),
        missing=tuple(_missing(problem, each.block.rows, u) for u in case.lost if mixed),
    )


def _missing(problem: Problem, rows: tuple[str, ...], u: ScalarMatrix) -> Phrase:
    """The part of u that is a velocity, or else the whole: times u it is a sum of squares, which is not
    zero."""
    coefficients = [entry for (entry,) in written(problem, _positive(problem, u)).rows]
    pairs = [(row, c) for row, c in zip(rows, coefficients, strict=True) if c != ZERO]
    chosen = [(row, c) for row, c in pairs if row.startswith("v")] or pairs
    names, values = tuple(Symbol(row) for row, _ in chosen), tuple(c for _, c in chosen)
    if len(chosen) == 1:
        return Phrase("motion-lost-alone", {"names": names})
    return Phrase("motion-lost", {"names": names, "coefficients": values})


def _satisfied(problem: Problem, rows: tuple[str, ...], u: ScalarMatrix) -> Chain:
    """u^T (v, omega) = 0, which holds of all that the joints can do."""
    coefficients = [entry for (entry,) in written(problem, _positive(problem, u)).rows]
    return (add(*(multiply(c, Symbol(row)) for c, row in zip(coefficients, rows, strict=True))), ZERO)


def _positive(problem: Problem, vector: ScalarMatrix) -> ScalarMatrix:
    """The vector or its opposite, so that its first component has no minus in front."""
    first = next((entry for (entry,) in written(problem, vector).rows if entry != ZERO), ZERO)
    return vector.scaled(Scalar.of(-1)) if mostly_negative(first) else vector


def _letters(problem: Problem, bases: Sequence[tuple[ScalarMatrix, ...]]) -> tuple[Symbol, ...]:
    """Names of a null space, a range and lost directions that the sheet does not use itself: of a vector a
    small letter, of a matrix of several columns a large one."""
    pairs = zip(("n", "b", "u"), bases, strict=True)
    letters = (letter.upper() if len(basis) > 1 else letter for letter, basis in pairs)
    return tuple(Symbol(free(problem.taken, letter, f"{letter}_J")) for letter in letters)


def _basis(problem: Problem, name: Symbol, columns: tuple[ScalarMatrix, ...]) -> tuple[Chain, ...]:
    """One chain, the vectors of a basis side by side; nothing where there is none."""
    return ((name, written(problem, ScalarMatrix.beside(columns))),) if columns else ()
