"""The determinant of a Jacobian, or its minors of full size, as lines; and where they vanish."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from math import comb

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.algebra.scalar import Scalar
from derive.algebra.solving.factors import TooLong, effort
from derive.derivation import Phrase, Step
from derive.errors import NotDerivable
from derive.expression import Expr, Indexed, Matrix, Product, Symbol, add, transpose
from derive.kinds.problem import Problem
from derive.kinds.robot._determinants import determinant, gram_determinant, natural, product_tree
from derive.kinds.robot._singular.sets import Block
from derive.kinds.work import Work
from derive.mechanics.budget import Budget
from derive.mechanics.minors import Minor, minors
from derive.mechanics.strata import of_determinant, of_minors
from derive.mechanics.vanishing import Locus, Vanishing

MOST_MINORS = 60
MOST_LINKED = 100  # terms of all minors up to which det(J J^T) is multiplied out to be compared with them
MOST_PRODUCTS = 300_000  # of terms, for the determinant or all minors
MOST_TERMS = 400  # of one of them
MOST_EFFORT = 100_000  # of taking them apart: a second or two


@dataclass(frozen=True, slots=True)
class Part:
    """A block and where it loses rank."""

    block: Block
    sets: tuple[Locus, ...]


@dataclass(frozen=True, slots=True)
class Way:
    """What the determinant came from: `name` is "determinant", "wrist" or "minors", `point` says whose
    velocity it is; `work` has the lines."""

    name: str
    point: Phrase
    work: Work
    det: Expr
    parts: tuple[Part, ...]
    complete: bool  # False where there may be more sets


def square(work: Work, block: Block, rule: str, search: Vanishing, point: Phrase) -> Way:
    """det J of a square Jacobian, factor by factor. Raises NotDerivable where it vanishes everywhere."""
    problem, name = work.problem, Symbol(block.name)
    (whole,) = minors_of(block.J, block.variables)
    det = natural(problem, whole.value, block.variables)
    refuse_dependent(block, bool(det.constant))
    tree, shown = product_tree(problem, det), problem.readable_matrix(block.J)
    chain = (determinant(name), *_two_by_two(shown), tree)
    work = work.step(Step("J", (name, shown), rule), closed(problem, "det", chain))
    parts = (Part(block, of_determinant(det, search)),)
    work = work.law("factors", det.value == whole.value)
    return Way("determinant", point, work, tree, parts, not search.open)


def oblong(work: Work, block: Block, rule: str, search: Vanishing, point: Phrase) -> Way:
    """All minors of full size, which vanish together: det(J J^T) is the sum of their squares. Raises
    NotDerivable where they vanish everywhere."""
    problem, name, J = work.problem, Symbol(block.name), block.J
    if comb(max(J.shape), min(J.shape)) > MOST_MINORS:
        raise NotDerivable(
            "the Jacobian has too many minors to be solved together; ask for some rows only", "rows"
        )
    found = [minor for minor in minors_of(J, block.variables) if minor.value]
    refuse_dependent(block, bool(found))
    names = [_minor_name(block, minor) for minor in found]
    trees = [product_tree(problem, natural(problem, minor.value, block.variables)) for minor in found]
    pairs = list(zip(names, trees, strict=True))
    tree = gram_determinant(problem, [minor.value for minor in found], trees)
    chain = (determinant(_gram(block, name)), add(*(each**2 for each in names)), tree)
    det = closed(problem, "det", chain)
    work = work.knowing(dict[Expr, Expr](pairs))
    if sum(len(minor.value.numerator) for minor in found) > MOST_LINKED:
        det = replace(det, rule="in-numbers")
        total = sum((minor.value * minor.value for minor in found), Scalar.of(0))
        work = work.law("minors", normal(tree) == total)
    work = work.step(
        Step("J", (name, problem.readable_matrix(J)), rule),
        *(Step(f"minor_{place}", pair, "minor") for place, pair in enumerate(pairs, 1)),
        det,
    )
    parts = (Part(block, of_minors([minor.value for minor in found], search)),)
    return Way("minors", point, work, tree, parts, not search.open)


def minors_of(J: ScalarMatrix, variables: tuple[str, ...]) -> tuple[Minor, ...]:
    """Raises NotDerivable before they outgrow what can be taken apart."""
    budget = Budget(MOST_PRODUCTS)
    try:
        found = minors(J, budget)
        Budget(MOST_EFFORT).spend(sum(effort(minor.value, variables) for minor in found))
        Budget(MOST_TERMS).spend(max(len(minor.value.numerator) for minor in found))
    except TooLong:
        raise NotDerivable(
            "the determinants of this Jacobian are too long to be taken apart; ask for fewer rows, or give "
            "numbers to lengths and twists, quarter turns where they will do",
            "rows",
        ) from None
    return found


def closed(problem: Problem, name: str, chain: Iterable[Expr]) -> Step:
    """The line of a determinant, ended by its value with the names of `where` replaced."""
    links = tuple(chain)
    final = problem.final(links[-1])
    return Step(name, links if final == links[-1] else (*links, final), "determinant")


def refuse_dependent(block: Block, regular: bool) -> None:
    """Raises NotDerivable where every determinant vanishes in every configuration."""
    if not regular and block.seeing is None:
        raise NotDerivable("the matrix never has full rank; find: rank has its spaces")
    if not regular:
        which = ", ".join(block.rows)
        raise NotDerivable(
            f"the rows {which} of the Jacobian are dependent in every configuration; ask for fewer rows",
            "rows",
        )


def _two_by_two(J: Matrix) -> tuple[Expr, ...]:
    """The products of a determinant of two rows, as they are subtracted."""
    if J.shape != (2, 2):
        return ()
    (a, b), (c, d) = J.rows
    return (Product((a, d)) - Product((b, c)),)  # a minus sign of b stays inside


def _minor_name(block: Block, minor: Minor) -> Expr:
    """Delta with the columns, or the rows, that it is made of."""
    if _wide(block) or block.seeing is None:
        return Symbol("Delta_" + "".join(str(k + 1) for k in minor.lines))
    return Indexed("Delta", tuple(Symbol(block.rows[k]) for k in minor.lines))


def _gram(block: Block, J: Symbol) -> Expr:
    return Product((J, transpose(J)) if _wide(block) else (transpose(J), J))


def _wide(block: Block) -> bool:
    return block.J.shape[0] < block.J.shape[1]
