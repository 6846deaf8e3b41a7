"""Khatib's matrices C (centrifugal) and B (Coriolis) from the partial derivatives of the mass matrix."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from itertools import combinations, combinations_with_replacement, product

from derive.algebra.normal import normal_matrix
from derive.derivation import Derivation, PageFacts, Phrase, Record
from derive.expression import ZERO, Derivative, Expr, Matrix, Symbol, add, column, multiply, number, squared
from derive.expression import replace as put_in
from derive.kinds.checks import random_points, route
from derive.kinds.fields import NoOptions as Options
from derive.kinds.problem import Problem
from derive.kinds.robot._by_index import EVERY, Meaning, by_index
from derive.kinds.robot._dynamics.arm import Arm
from derive.kinds.robot._dynamics.index_laws import M_IJK, M_IKJ, M_JKI, khatib_laws
from derive.kinds.robot._dynamics.matrix_laws import speed_law
from derive.kinds.robot._units import of_joints
from derive.kinds.work import Work
from derive.mechanics.dynamics import Christoffel, christoffel, rate_column, velocity_terms
from derive.mechanics.oracle.heavy import Heavy
from derive.mechanics.robot import Robot
from derive.names import entry_symbol, require_free

NEEDS = ("bodies",)
CLAIMS = ("makes-v", "names", "rates-alone", "derivatives-vanish")
measures = of_joints("v", effort=True)


SAME = 1e-12  # of inertia matrices in numbers
TWO = number(2)
C, B, V = Symbol("C"), Symbol("B"), Symbol("v")


MEANINGS: Mapping[str, Meaning] = {
    **EVERY,
    "v": lambda arm, _: arm.C @ arm.rates,
    "M": lambda arm, _: arm.D,
    "G": lambda arm, _: arm.g,
    "C": lambda arm, _: [[arm.christoffel[j, j, i] for j in range(n)] for i, n in _each(arm)],
    "B": lambda arm, _: [
        [2 * arm.christoffel[j, k, i] for j, k in combinations(range(n), 2)] for i, n in _each(arm)
    ],
}


class Facts(PageFacts):
    """What is said of the derivatives, and of the b_ijk that are not shown; how many joints there are."""

    derivatives: Phrase
    others: Phrase | None
    one: bool


class Row(Record):
    """The first index of a b_ijk."""

    row: int


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """v = C [qdot^2] + B [qdot qdot] (Khatib, Introduction to Robotics, dynamics; Craig, eq. 6.63)."""
    require_free(problem.taken, "C", "B", "v")
    arm, n = Arm(problem), len(robot.variables)
    symbols = christoffel(normal_matrix(arm.inertia.definitions[Symbol("D")]), arm.variables)
    values = {(i, j, k): symbols[j, k, i] for i, j, k in sorted((i, j, k) for j, k, i in symbols if j <= k)}
    laws = (speed_law(), *khatib_laws(problem.taken))
    work = Work(problem).resting_on(arm.inertia).showing(*laws)
    work = work.linked() if arm.long else _entries(work, arm)  # in names alone there is nothing to compare
    shown = [] if arm.long else [ijk for ijk in values if values[ijk]]
    *_, general = laws
    for i, j, k in shown:
        raw = put_in(general.result, {M_IJK: _m(i, j, k), M_IKJ: _m(i, k, j), M_JKI: _m(j, k, i)})
        names = (_b(i, k, j), raw) if j != k else (raw,)
        work = work.line(_b(i, j, k), *names, value=arm.final(values[i, j, k]), rule="b", facts=Row(row=i))
    b = {ijk: work[_b(*ijk)] if ijk in shown else arm.final(value) for ijk, value in values.items()}
    for (i, j, k), value in b.items():
        work = work.knowing({_b(i, j, k): value, _b(i, k, j): value})
    work = _matrices(work, arm, symbols)
    results = {name.name: work.matrix(name) for name in ((C, B) if n > 1 else (C,))}
    others = sum(ijk not in shown for ijk in values)
    made = _whole(arm, results["C"], results.get("B")) - work[V]
    work = arm.agrees(work.law("makes-v", not work.value_matrix(made)), "v", work[V])
    derivatives = _derivatives(work, arm)
    work = work.claim(route("derivatives-vanish", _is_told(derivatives, arm)))
    entries = {_b(*ijk).name: value for ijk, value in sorted(b.items())}
    work = by_index(work, {**results, **entries, "v": work[V]}, MEANINGS)
    return work.answer(
        "coriolis-matrices",
        {**results, **entries, "v": work[V]},
        Facts(
            derivatives=derivatives,
            others=Phrase("others-vanish") if shown and others else None,
            one=n == 1,
        ),
        matrices=frozenset({"C", "B"}),
    )


def _derivatives(work: Work, arm: Arm) -> Phrase:
    """What is said of the derivatives of the entries of M."""
    if arm.long:
        return Phrase("long-sums")
    shown = sum(step.rule == "entry-derivative" for step in work.steps)
    return Phrase("derivatives" if shown > 1 else "derivative" if shown else "none-changes")


def _each(arm: Heavy) -> Iterator[tuple[int, int]]:
    """(joint, how many there are)."""
    n = len(arm.oracle.robot.variables)
    return ((i, n) for i in range(n))


def _is_told(derivatives: Phrase, arm: Arm) -> Iterator[bool]:
    """Whether the inertia matrix is called constant exactly where it is: in numbers, at rest here and with
    the joints elsewhere."""
    for at in random_points(arm.still, 2):
        elsewhere = {**at, **{name: 2.2 - at[name] for name in arm.variables}}
        here, there = (arm.rigid.inertia_matrix(each) for each in (at, elsewhere))
        yield derivatives.key == "long-sums" or (abs(here - there).max() < SAME) == (
            derivatives.key == "none-changes"
        )


def _entries(work: Work, arm: Arm) -> Work:
    """m_ijk, the derivative of m_ij by q_k, for i <= j; those that vanish are left out."""
    D, n = work.matrix("D"), range(1, len(arm.variables) + 1)
    work = work.knowing({entry_symbol("m", i, j): D.rows[i - 1][j - 1] for i in n for j in n})
    work = work.knowing({_m(*ijk): ZERO for ijk in product(n, n, n)})
    for (i, j), (k, name) in product(combinations_with_replacement(n, 2), enumerate(arm.variables, 1)):
        if value := arm.D[i - 1, j - 1].diff(name):
            partial, end = Derivative(entry_symbol("m", i, j), Symbol(name)), arm.final(value)
            names = (_m(j, i, k), partial) if i != j else (partial,)
            work = work.line(_m(i, j, k), *names, value=end, rule="entry-derivative")
            work = work.knowing({_m(j, i, k): end})
    return work


def _matrices(work: Work, arm: Arm, symbols: Christoffel) -> Work:
    """C, B and v in names and written out; of a long arm the lines stay in names, and what they stand for is
    put together as it comes."""
    n = len(arm.rates)

    def b(*ijk: int) -> Expr:
        return work[_b(*ijk)]

    def doubled(i: int, j: int, k: int) -> Expr:
        return multiply(TWO, b(i, j, k)) if arm.long else arm.final(2 * symbols[j, k, i])

    values = {C: _centrifugal(n, b), B: _coriolis(n, doubled)}
    if arm.long:
        values[V] = _sums(arm, values[C], values[B])
    else:
        terms = velocity_terms(symbols, rate_column(arm.variables))
        values[V] = column(map(arm.final, terms.entries))
    formulas: dict[Symbol, Expr] = {
        C: _centrifugal(n, _b),
        B: _coriolis(n, lambda *ijk: multiply(TWO, _b(*ijk))),
        V: _whole(arm, C, B if n > 1 else None),
    }
    for name in (C, B, V) if n > 1 else (C, V):
        shown = formulas[name] if arm.long else values[name]
        work = work.line(name, formulas[name], value=shown, rule="matrix").knowing({name: values[name]})
    return work


def _sums(arm: Arm, C: Matrix, B: Matrix) -> Matrix:
    """v as it comes."""
    return column(
        add(
            *(multiply(each, rate, rate) for each, rate in zip(alone, arm.rates, strict=True)),
            *(multiply(each, *pair) for each, pair in zip(both, combinations(arm.rates, 2), strict=True)),
        )
        for alone, both in zip(C.rows, B.rows, strict=True)
    )


def _centrifugal(n: int, b: Callable[[int, int, int], Expr]) -> Matrix:
    """The b_ijj (n by n), written as `b` says."""
    return Matrix(tuple(tuple(b(i, j, j) for j in range(1, n + 1)) for i in range(1, n + 1)))


def _coriolis(n: int, doubled: Callable[[int, int, int], Expr]) -> Matrix:
    """The 2 b_ijk with j < k (n by n(n-1)/2), in the order 12, 13, ..., 23, ..., as `doubled` writes them."""
    pairs = [*combinations(range(1, n + 1), 2)]
    return Matrix(tuple(tuple(doubled(i, j, k) for j, k in pairs) for i in range(1, n + 1)))


def _whole(arm: Arm, C: Expr, B: Expr | None) -> Expr:
    """C [qdot^2] + B [qdot qdot]; an arm of one joint has no B."""
    alone = C * column(map(squared, arm.rates))
    return alone if B is None else alone + B * column(p * q for p, q in combinations(arm.rates, 2))


def _m(i: int, j: int, k: int) -> Symbol:
    return entry_symbol("m", i, j, k)


def _b(i: int, j: int, k: int) -> Symbol:
    return entry_symbol("b", i, j, k)
