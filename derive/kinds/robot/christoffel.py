"""The Christoffel symbols of the inertia matrix, each from its partial derivatives."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from fractions import Fraction

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.algebra.scalar import Scalar
from derive.derivation import Derivation, PageFacts, Phrase
from derive.expression import ZERO, Derivative, Expr, Number, Sum, Symbol, add, multiply, number
from derive.kinds.fields import NoOptions as Options
from derive.kinds.problem import Problem
from derive.kinds.robot._by_index import by_index
from derive.kinds.robot._dynamics.arm import Arm
from derive.kinds.robot._dynamics.index_laws import christoffel_law
from derive.kinds.robot.inertia_matrix import Facts as InertiaFacts
from derive.kinds.work import Work
from derive.mechanics.dynamics import Christoffel
from derive.mechanics.robot import Robot
from derive.names import entry_symbol

NEEDS = ("bodies",)
CLAIMS = ("names", "symmetric", "skew-symmetric", "others-vanish")
Index = tuple[int, int, int]
HALF = number("1/2")


class Facts(PageFacts):
    """What is said of the symbols that are not shown, and whether these are all there are."""

    constant: bool
    others: Phrase | None


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """c_ijk = (d_kj,i + d_ki,j - d_ij,k) / 2 (Spong et al., eq. 6.38)."""
    arm = Arm(problem)
    big, D, symbols = arm.inertia.told(InertiaFacts).big, arm.D, arm.christoffel
    work = Work(problem).resting_on(arm.inertia).showing(christoffel_law(problem.taken))
    shown = () if big else _shown(symbols)
    for ijk in shown:
        work = _line(work, arm, ijk, symbols[ijk])
    ordered = [ijk for ijk in symbols if ijk == _ordered(ijk)]
    found = {ijk: work[_name(ijk)] if ijk in shown else arm.final(symbols[ijk]) for ijk in ordered}
    work = work.knowing({_name(ijk): found[_ordered(ijk)] for ijk in symbols})
    work = work.law("symmetric", (value == symbols[j, i, k] for (i, j, k), value in symbols.items()))
    work = work.law("skew-symmetric", _skew(D, symbols, robot.variables))
    results = {_name(ijk).name: found[_ordered(ijk)] for ijk in sorted(symbols)}
    untold = [results[_name(ijk).name] for ijk in symbols if _ordered(ijk) not in shown]
    vanish = sum(value == ZERO for value in untold)
    gone = sum(not normal(value, problem.names) for value in untold)
    work = work.law("others-vanish", (gone == vanish, big or gone == len(untold)))
    work = by_index(work, results)
    others = _others(big, len(symbols), vanish, len(shown))
    return work.answer("christoffel", results, Facts(constant=not big and not shown, others=others))


def _others(big: bool, count: int, vanish: int, shown: int) -> Phrase | None:
    """What becomes of those that are not shown; of a `big` arm none is."""
    if big:
        return Phrase("long-symbols", {"count": count, "vanish": vanish})
    if not shown:
        return Phrase("all-vanish", {"D": Symbol("D")})
    return Phrase("the-others-vanish") if vanish else None


def _shown(symbols: Christoffel) -> tuple[Index, ...]:
    """Those with i <= j that do not vanish, grouped by equation of motion."""
    ordered = sorted((ijk for ijk in symbols if ijk[0] <= ijk[1]), key=lambda ijk: (ijk[2], ijk))
    return tuple(ijk for ijk in ordered if symbols[ijk])


def _line(work: Work, arm: Arm, ijk: Index, value: Scalar) -> Work:
    """c_121 = c_211 = (three partial derivatives) / 2 = (those that are left) / 2 = value."""
    i, j, k = ijk
    raw = [
        (_partial(arm, k, j, i), 1),
        (_partial(arm, k, i, j), 1),
        (_partial(arm, i, j, k), -1),
    ]
    whole = multiply(HALF, Sum(tuple((-d if n < 0 else d for d, n in raw))))
    formulas = (*([_name((j, i, k))] if i != j else []), whole, *_collected(raw), work.readable(value))
    return work.line(_name(ijk), *formulas, value=arm.final(value), rule="christoffel")


def _partial(arm: Arm, a: int, b: int, by: int) -> Expr:
    return Derivative(entry_symbol("d", min(a, b), max(a, b)), Symbol(arm.variables[by - 1]))


def _collected(raw: list[tuple[Expr, int]]) -> tuple[Expr, ...]:
    """Half the sum with equal derivatives collected; none where none are equal."""
    counts: Counter[Expr] = Counter()
    for derivative, sign in raw:
        counts[derivative] += sign
    kept = [(derivative, n) for derivative, n in counts.items() if n]
    if len(kept) == len(raw):
        return ()
    return (add(*(multiply(Number(Fraction(n, 2)), derivative) for derivative, n in kept)),)


def _skew(D: ScalarMatrix, symbols: Christoffel, variables: tuple[str, ...]) -> Iterator[bool]:
    """Whether dD/dt - 2C is skew-symmetric for each rate."""
    n = range(1, len(variables) + 1)
    by_rate = [ScalarMatrix.of([[symbols[i, j, k] for j in n] for k in n]) for i in n]
    skew = [D.diff(name) - C.scaled(2) for name, C in zip(variables, by_rate, strict=True)]
    return (N == -N.T for N in skew)


def _name(ijk: Index) -> Symbol:
    return entry_symbol("c", *ijk)


def _ordered(ijk: Index) -> Index:
    i, j, k = ijk
    return (min(i, j), max(i, j), k)
