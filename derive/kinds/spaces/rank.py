"""Which velocities an arm can give its end-effector in a configuration, and what its structure carries."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import islice
from math import prod
from typing import Any

from pydantic import Field

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.algebra.numbers.arrays import arrays
from derive.algebra.numbers.floats import Point
from derive.algebra.scalar import Scalar
from derive.algebra.signs import sign_of
from derive.algebra.solving.factors import primitive
from derive.derivation import Derivation, PageFacts, Phrase, Result
from derive.errors import NotDerivable, how_many
from derive.expression import (
    ZERO,
    Expr,
    Number,
    Relation,
    Symbol,
    add,
    column,
    free_symbols,
    is_negative,
    multiply,
    transpose,
)
from derive.kinds.checks import close, flat, random_points, route
from derive.kinds.fields import Quantity
from derive.kinds.problem import Problem
from derive.kinds.robot._velocity.functions import functions_given
from derive.kinds.spaces._falls import Falls, falls, seen
from derive.kinds.spaces._linear_map import LinearMap, MapOptions, linear_map
from derive.kinds.spaces._nouns import nouns, nouns_hold
from derive.kinds.spaces._span import Span, solution, span
from derive.kinds.values_at import Here, values_at
from derive.kinds.work import Work
from derive.mechanics.matrices import GivenMatrix
from derive.mechanics.minors import minors
from derive.mechanics.robot import Robot
from derive.names import free

SUBJECTS = ("robot", "matrix")
USES = frozenset({"variables"})
CLAIMS = ("factors", "rank-in-numbers", "spaces-in-numbers", "nouns")
CLAIMED = {"rank": "rank-in-numbers"} | dict.fromkeys(
    ("null_space", "range", "left_null_space"), "spaces-in-numbers"
)
POINTS, TRIES, SMALL = 3, 40, 1e-6
MOST_ENTRIES = 24  # of a matrix whose minors are looked at together
V, F, TAU, RATES = map(Symbol, ("v", "F", "tau", "qdot"))
SPACES = ("null_space", "range", "left_null_space")


class Options(MapOptions):
    """The map, and what is to be judged of it; `evaluate` gives the configuration."""

    velocity: tuple[Quantity, ...] | None = Field(None, min_length=1, max_length=12)
    """A velocity to be judged, one component for each row."""
    wrench: tuple[Quantity, ...] | None = Field(None, min_length=1, max_length=12)
    """A force to be judged, one component for each row."""


class Facts(PageFacts):
    sort: str  # "rows", "task", "matrix"
    place: tuple[tuple[Expr, Expr], ...]
    rows: tuple[Symbol, ...]
    velocities: Phrase  # what the rows are
    wrenches: Phrase | None = None  # what acts along them, that the structure carries
    acting: Phrase | None = None  # one of these
    rank: int
    nullity: int  # of J
    spare: int  # of its transpose
    leads: tuple[Expr, ...]  # where one of them vanishes the rank may be lower
    alone: tuple[Expr, ...] = ()  # it is where one of these does
    together: tuple[Expr, ...] = ()  # or all of these do
    there: int | None = None  # what it is there
    J: Symbol
    empty: tuple[bool, bool, bool]  # null space, range, left null space
    judged: str = ""  # "feasible", "feasible-where", "infeasible"
    left: Symbol | None = None  # the basis to which it is perpendicular, or not
    conditions: tuple[Expr, ...] = ()  # vanish where it is feasible
    free: tuple[Symbol, ...] = ()
    wrench: str = ""  # "carried", "torques"


def derive(subject: Robot | GivenMatrix, options: Options, problem: Problem) -> Derivation:
    """rank J, null(J), range(J), null(J^T) (Siciliano et al., sections 3.5 and 3.8; Strang, chapter 3).

    Raises NotDerivable where a velocity or wrench has not one component a row, and where a basis is too long.
    """
    found = linear_map(subject, options, problem)
    for key in ("velocity", "wrench"):
        _require_each_row(found, getattr(options, key), key)
    spaces = span(found.J, found.variables)
    names = _names(problem)
    work = _spanned(_board(found), found, spaces, names)
    results: dict[str, Result] = {"rank": Number(Fraction(spaces.rank))}
    for key, name, basis in zip(SPACES, names, (spaces.null, spaces.range, spaces.left), strict=True):
        results[key] = work[name] if basis else ()
    leads = _leads(found, spaces)
    lower = falls(found, spaces.rank, _nonzero(found)) if leads else None
    everywhere = not leads and spaces.rank == min(found.J.shape)
    if lower or everywhere:
        fallen = lower or Falls((), (), None)
        work = work.claim(route("rank-falls", seen(found, fallen, spaces.rank, _places(found))))
    velocities, wrenches, acting = nouns(found)
    work = work.claim(route("nouns", nouns_hold(found, velocities, wrenches, acting)))
    facts = Facts(
        sort=found.sort,
        place=tuple((Symbol(name), value) for name, value in found.place),
        rows=found.velocities if found.sort == "rows" else (),
        velocities=velocities,
        wrenches=wrenches if spaces.left else None,
        acting=acting if options.wrench or not spaces.left else None,
        rank=spaces.rank,
        nullity=len(spaces.null),
        spare=len(spaces.left),
        leads=leads,
        alone=lower.alone if lower else (),
        together=lower.together if lower else (),
        there=lower.there if lower else None,
        J=found.name,
        empty=(not spaces.null, not spaces.range, not spaces.left),
    )
    if options.velocity is not None:
        work, facts, told = _judged(work, found, spaces, options.velocity, facts)
        results |= told
    if options.wrench is not None:
        work, facts, told = _carried(work, found, options.wrench, facts)
        results = {**told, **results}
    answer = work.answer("rank", results, replace(facts, numbers=()), matrices=frozenset(SPACES))
    if options.evaluate is None:
        return answer
    here = Here.of(dict(found.place), problem.where, problem.style)
    numbers = {name: value for name, value in values_at(answer, here).items() if name != "feasible"}
    return replace(answer, evaluated=numbers)


def _names(problem: Problem) -> tuple[Symbol, Symbol, Symbol]:
    """What the bases are called."""
    return (
        Symbol(free(problem.taken, "N", "N_0")),
        Symbol(free(problem.taken, "B", "B_0")),
        Symbol(free(problem.taken, "U", "U_0")),
    )


def _board(found: LinearMap) -> Work:
    """J on a board, after the functions of a task."""
    work = Work(found.problem, uses=found.base)
    if found.functions:
        work = functions_given(work, found.functions)
    return work.line(found.name, value=found.J, rule=found.sort, label="J")


def _spanned(work: Work, found: LinearMap, spaces: Span, names: Sequence[Symbol]) -> Work:
    """Its reduced form and bases, and the proofs of them."""
    J = found.J
    if spaces.reduced is not None:
        work = work.line("E", value=spaces.reduced, rule="reduced")
    bases = (spaces.null, spaces.range, spaces.left)
    for label, name, basis in zip(SPACES, names, bases, strict=True):
        if basis:
            work = work.line(name, value=ScalarMatrix.beside(basis), label=label)
    pivots = ScalarMatrix.beside([J.columns(j) for j in spaces.pivots]) if spaces.pivots else None
    product = pivots @ spaces.reduced if pivots and spaces.reduced else ScalarMatrix.zeros(*J.shape)
    work = work.law("factors", (product == J, *_annihilated(J, spaces)))
    there = [*islice(_places(found), POINTS)]
    return work.claim(
        route("rank-in-numbers", (_rank(found.numbers(at)) == spaces.rank for at in there)),
        route("spaces-in-numbers", (each for at in there for each in _spans(work, found, spaces, names, at))),
    )


def _annihilated(J: ScalarMatrix, spaces: Span) -> Iterator[bool]:
    """J N = 0 and J^T U = 0, with as many columns as the rank leaves."""
    m, n = J.shape
    yield from (not J @ column for column in spaces.null)
    yield from (not J.T @ column for column in spaces.left)
    yield len(spaces.null) == n - spaces.rank and len(spaces.left) == m - spaces.rank


def _places(found: LinearMap, *more: Expr) -> Iterator[Point]:
    names = found.symbols.union(*map(free_symbols, more)) - found.at({}).keys()
    return (found.at(point) for point in random_points(names, TRIES))


def _rank(J: Any) -> int:
    import numpy as np

    sizes = np.linalg.svd(J, compute_uv=False)
    return int((sizes > SMALL * max(1.0, *sizes)).sum())


def _spans(work: Work, found: LinearMap, spaces: Span, names: Sequence[Symbol], at: Point) -> Iterator[bool]:
    """The reduced form and the bases as they are printed, against J by another route: its columns with pivots
    make J of that form; bases vanish, or lie in the range, and their columns are independent."""
    import numpy as np

    J, (m, n) = found.numbers(at), found.J.shape
    null, image, left = (
        _unit(arrays(work[name], at)) if basis else np.zeros((size, 0))
        for name, basis, size in zip(names, (spaces.null, spaces.range, spaces.left), (n, m, m), strict=True)
    )
    if spaces.pivots:
        yield close(J[:, list(spaces.pivots)] @ arrays(work["E"], at), J, SMALL)
    yield close(J @ null, np.zeros((m, null.shape[1])), SMALL)
    yield close(J.T @ left, np.zeros((n, left.shape[1])), SMALL)
    yield not image.shape[1] or _rank(np.hstack([J, image])) == spaces.rank == _rank(image)
    yield all(_rank(np.column_stack([J[:, j], image[:, k]])) == 1 for k, j in enumerate(spaces.pivots))
    yield all(not basis.shape[1] or _rank(basis) == basis.shape[1] for basis in (null, left))


def _unit(basis: Any) -> Any:
    """With columns of size one: a basis in whole numbers may have large ones."""
    import numpy as np

    return basis / np.linalg.norm(basis, axis=0)


def _leads(found: LinearMap, spaces: Span) -> tuple[Expr, ...]:
    """Where one of these vanishes the rank may be lower; none where the minors cannot vanish together.
    Lengths of an arm are nonzero."""
    problem, J, nonzero = found.problem, found.J, _nonzero(found)

    def never_zero(value: Scalar) -> bool:
        return sign_of(value, nonzero) is not None and value.letters() <= nonzero

    if spaces.rank and prod(J.shape) <= MOST_ENTRIES:
        pivots = ScalarMatrix.beside([J.columns(j) for j in spaces.pivots])
        if never_zero(sum((each.value * each.value for each in minors(pivots)), Scalar.of(0))):
            return ()
    told = (problem.readable(primitive(each)) for each in spaces.leads if not never_zero(each))
    return tuple(dict.fromkeys(map(_unsigned, told)))


def _nonzero(found: LinearMap) -> frozenset[str]:
    """The names of what is not zero; lengths of an arm are not."""
    known = found.problem.assumptions.items()
    nonzero = frozenset(name for name, what in known if what in ("positive", "nonzero"))
    return nonzero if found.sort == "matrix" else nonzero | found.symbols - {*found.variables}


def _unsigned(tree: Expr) -> Expr:
    return -tree if is_negative(tree) else tree


# -- a velocity, a wrench -----------------------------------------------------------------------------


def _require_each_row(found: LinearMap, given: tuple[Expr, ...] | None, key: str) -> None:
    """Raises NotDerivable where a vector does not fit."""
    if given is not None and len(given) != found.J.shape[0]:
        both = f"{how_many(len(given), 'component')} for {how_many(found.J.shape[0], 'row')}"
        raise NotDerivable(f"{both}; give one for each", key)


def _judged(
    work: Work, found: LinearMap, spaces: Span, given: tuple[Expr, ...], facts: Facts
) -> tuple[Work, Facts, dict[str, Result]]:
    """Whether joint rates give this velocity, and all that do."""
    problem = found.problem
    typed, v = column(given), normal_matrix(column(given), found.values)
    work = work.given(V, typed)
    x = solution(found.J, v)
    if x is None:
        left = [(u.T @ v)[0, 0] for u in spaces.left]
        open_ones = [each for each in left if each]
        some = any(sign_of(each, frozenset()) is not None for each in open_ones)
        said = "infeasible" if some else "feasible-where"
        conditions = () if some else tuple(map(problem.readable, open_ones))
        missed = (_misses(found, typed, at) for at in islice(_places(found, *given), POINTS))
        told = replace(facts, judged=said, conditions=conditions, left=_names(problem)[-1])
        answer: Result = False if some else tuple(Relation(each, "=", ZERO) for each in conditions)
        work = work.claim(route("no-rates", (*missed, *_is_left(found, work, typed, conditions, some))))
        return work, told, {"feasible": answer}
    letter = free(problem.taken, "k", "kappa", indices=[f"_{i}" for i in range(1, 7)])
    free_ones = tuple(Symbol(f"{letter}_{i}") for i, _ in enumerate(spaces.null, 1))
    own = [multiply(k, problem.readable_matrix(each)) for k, each in zip(free_ones, spaces.null, strict=True)]
    whole = x
    for k, each in zip(free_ones, spaces.null, strict=True):
        whole = whole + each.scaled(Scalar.symbol(k.name))
    work = work.line(RATES, add(problem.readable_matrix(x), *own), value=whole, rule="all-rates")
    met = (
        close(found.numbers(at) @ arrays(work[RATES], at), arrays(typed, at), SMALL)
        for at in islice(_places(found, *given, *free_ones), POINTS)
    )
    basis = _names(problem)[-1] if spaces.left else None
    told = replace(facts, judged="feasible", free=free_ones, left=basis)
    if basis:  # what the velocity is multiplied by is no other basis
        work = work.claim(route("velocity-met", _meets(found, work[basis], typed)))
    return work.claim(route("velocity-met", met)), told, {"feasible": True, "qdot": work[RATES]}


def _meets(found: LinearMap, basis: Expr, typed: Expr) -> Iterator[bool]:
    """Whether the columns of a basis are perpendicular to the range, and to the velocity."""
    for at in islice(_places(found, typed), POINTS):
        U = arrays(basis, at)
        both = U.T @ found.numbers(at), U.T @ arrays(typed, at)
        yield all(close(each, 0 * each, SMALL) for each in both)


def _is_left(
    found: LinearMap, work: Work, typed: Expr, conditions: tuple[Expr, ...], some: bool
) -> Iterator[bool]:
    """Whether the conditions say that the velocity is perpendicular to what is perpendicular to the range."""
    basis = work[_names(found.problem)[-1]]
    for at in islice(_places(found, typed), POINTS):
        left = [*flat(arrays(basis, at).T @ arrays(typed, at))]
        open_ones = [each for each in left if abs(each) > SMALL]
        yield some or close([arrays(each, at) for each in conditions], open_ones, SMALL)


def _misses(found: LinearMap, typed: Expr, at: Point) -> bool:
    """Whether v is outside the range: then [J v] has a higher rank."""
    import numpy as np

    J = found.numbers(at)
    return _rank(np.hstack([J, arrays(typed, at)])) > _rank(J)


def _carried(
    work: Work, found: LinearMap, given: tuple[Expr, ...], facts: Facts
) -> tuple[Work, Facts, dict[str, Result]]:
    """The joint torques of a wrench, and whether it needs none."""
    typed = column(given)
    tau = found.J.T @ normal_matrix(typed, found.values)
    work = work.given(F, typed).line(TAU, transpose(found.name) * F, value=tau, rule="virtual-work")
    held = (
        close(arrays(work[TAU], at), found.numbers(at).T @ arrays(typed, at), SMALL)
        for at in islice(_places(found, *given), POINTS)
    )
    told = replace(facts, wrench="torques" if tau else "carried")
    return work.claim(route("torques", held)), told, {"tau": work[TAU], "feasible": not tau}
