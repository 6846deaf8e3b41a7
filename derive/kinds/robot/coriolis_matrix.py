"""The matrix C of Coriolis and centrifugal terms from the Christoffel symbols."""

from __future__ import annotations

from collections.abc import Callable

from derive.derivation import Derivation, PageFacts, Step
from derive.expression import ZERO, Expr, Matrix, Symbol, add, column, multiply
from derive.kinds.fields import NoOptions as Options
from derive.kinds.problem import Problem
from derive.kinds.robot._by_index import by_index
from derive.kinds.robot._dynamics.arm import Arm
from derive.kinds.robot._dynamics.index_laws import coriolis_law
from derive.kinds.work import Work
from derive.mechanics.dynamics import coriolis_matrix, rate_column, velocity_terms
from derive.mechanics.robot import Robot
from derive.names import entry_symbol, require_free

NEEDS = ("bodies",)
CLAIMS = ("makes-the-terms", "names", "rates-alone")
C = Symbol("C")


class Facts(PageFacts):
    """Whether C stays in the names of the symbols."""

    big: bool


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """C_kj = sum of c_ijk qdot_i (Spong et al., eq. 6.42; Siciliano et al., eq. 7.45)."""
    require_free(problem.symbols, "C")
    arm = Arm(problem)
    symbols, rate = arm.christoffel, rate_column(arm.variables)
    value = coriolis_matrix(symbols, rate)
    work = Work(problem).resting_on(arm.inertia, problem.ask("christoffel"))
    work = work.showing(coriolis_law(problem.taken))
    if arm.long:
        work = work.knowing({C: _sums(arm, lambda symbol: work[symbol])})
    else:
        named = _sums(arm, lambda symbol: symbol if work[symbol] != ZERO else ZERO)
        work = work.step(Step("C", (C, named, arm.final(value)), "coriolis"))
    work = work.law("makes-the-terms", value @ rate == velocity_terms(symbols, rate))
    product = column(add(*map(multiply, row, arm.rates)) for row in work.matrix(C).rows)
    work = arm.agrees(work, "C qdot", product)
    work = by_index(work, {"C": work[C]})
    return work.answer("coriolis-matrix", {"C": work[C]}, Facts(big=arm.long), matrices=frozenset({"C"}))


def _sums(arm: Arm, symbol: Callable[[Symbol], Expr]) -> Matrix:
    """C_kj as sums of symbols and rates; `symbol` says how c_ijk is written."""
    n, rates = range(1, len(arm.rates) + 1), arm.rates
    terms = {
        (k, j): [multiply(symbol(entry_symbol("c", i, j, k)), rate) for i, rate in enumerate(rates, 1)]
        for k in n
        for j in n
    }
    return Matrix(tuple(tuple(add(*terms[k, j]) for j in n) for k in n))
