"""The Christoffel symbols of an inertia matrix that is given, each from its partial derivatives."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from derive.algebra.normal import normal
from derive.algebra.numbers.floats import Point, number
from derive.derivation import Derivation, PageFacts, Phrase
from derive.expression import ZERO, Expr, Symbol
from derive.kinds.checks import close, route
from derive.kinds.fields import NoOptions as Options
from derive.kinds.matrix._inertia import GivenInertia, inertia_of
from derive.kinds.problem import Problem
from derive.kinds.robot._dynamics.christoffel_lines import lines, named, ordered, shown, skew
from derive.kinds.robot._dynamics.index_laws import christoffel_law
from derive.mechanics.matrices import GivenMatrix

USES = frozenset({"variables"})
CLAIMS = ("symmetric", "skew-symmetric", "others-vanish", "differences")
POINTS, DIFFERENCES = 3, 1e-7


class Facts(PageFacts):
    """The name of the matrix, and what is said of the symbols that are not shown."""

    D: Symbol
    constant: bool
    others: Phrase | None


def derive(given: GivenMatrix, options: Options, problem: Problem) -> Derivation:
    """c_ijk = (d_kj,i + d_ki,j - d_ij,k) / 2 (Spong et al., eq. 6.38).

    Raises NotDerivable for a matrix that can be no inertia matrix.
    """
    found = inertia_of(given, problem)
    symbols, long = found.christoffel, found.long
    work = found.board().showing(christoffel_law(problem.taken))
    told = () if long else shown(symbols)
    work = work if long else lines(work, symbols, found.variables, found.final)
    first = [ijk for ijk in symbols if ijk == ordered(ijk)]
    values = {ijk: work[named(ijk)] if ijk in told else found.final(symbols[ijk]) for ijk in first}
    work = work.knowing({named(ijk): values[ordered(ijk)] for ijk in symbols})
    work = work.law("symmetric", (value == symbols[j, i, k] for (i, j, k), value in symbols.items()))
    work = work.law("skew-symmetric", skew(found.D, symbols, found.variables))
    results = {named(ijk).name: values[ordered(ijk)] for ijk in sorted(symbols)}
    untold = [results[named(ijk).name] for ijk in symbols if ordered(ijk) not in told]
    vanish = sum(value == ZERO for value in untold)
    gone = sum(not normal(value, problem.names) for value in untold)
    work = work.law("others-vanish", (gone == vanish, long or gone == len(untold)))
    work = work.claim(route("differences", _by_differences(found, results)))
    facts = Facts(
        D=found.name,
        constant=not long and not told,
        others=_others(found.name, long, len(symbols), vanish, len(told)),
    )
    return work.answer("christoffel", results, facts)


def _others(D: Symbol, long: bool, count: int, vanish: int, told: int) -> Phrase | None:
    """What becomes of those that are not shown."""
    if long:
        return Phrase("long-symbols", {"count": count, "vanish": vanish})
    if not told:
        return Phrase("all-vanish", {"D": D})
    return Phrase("the-others-vanish") if vanish else None


def _by_differences(found: GivenInertia, results: Mapping[str, Expr]) -> Iterator[bool]:
    """Whether each is that of the matrix as it was typed, by differences of its numbers."""
    n = range(len(found.variables))
    for at in found.points(POINTS):
        slopes = found.slopes(at)
        for i in n:
            for j in n:
                yield close(
                    [_symbol(results, at, i, j, k) for k in n],
                    [(slopes[i][k, j] + slopes[j][k, i] - slopes[k][i, j]) / 2 for k in n],
                    DIFFERENCES,
                )


def _symbol(results: Mapping[str, Expr], at: Point, i: int, j: int, k: int) -> float:
    return number(results[named((i + 1, j + 1, k + 1)).name], at)
