"""The equations of motion linearised about a state of rest, and their state-space form."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import islice
from typing import Any

from derive.algebra.infix import text
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import Names, normal_matrix
from derive.algebra.numbers.floats import completed, number, number_rows, numbers
from derive.algebra.solving.polynomials import known_sign
from derive.derivation import Claim, Derivation, PageFacts, Phrase, Step, as_matrix
from derive.errors import NotDerivable, NotReal
from derive.expression import ZERO, Expr, Matrix, Symbol, add, column, free_symbols
from derive.kinds.checks import close, random_points, route
from derive.kinds.fields import Evaluation, Name, OptionsModel
from derive.kinds.lagrange._equations import written_fraction
from derive.kinds.lagrange._model import Model
from derive.kinds.lagrange._oracle import Differences
from derive.kinds.lagrange._rest import equations, inputs_of, require_steady, surely_positive, there
from derive.kinds.meanings import told
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.lagrangian import TIME, LagrangianSystem

DELTA = Symbol("delta")
NOTHING = Symbol("0")
SMALL = 1e-5  # a displacement small enough for the linear equations
LEFT_OVER = 1e-6
TRIED = 40  # points, of which two are looked at where the state is real
CLAIMS = ("symmetric", "small-motion", "as-told")


class Options(OptionsModel):
    """Where the equations are linearised, and what drives the system."""

    at: Evaluation = None
    """The coordinates at rest and inputs that are not zero there; what is left out stays a letter."""
    inputs: tuple[Name, ...] | None = None
    """The names that drive the system; those that stand in the forces only, if left out."""


@dataclass(frozen=True, slots=True)
class Linear:
    """M x'' + C x' + K x = F u about the state of rest."""

    M: ScalarMatrix
    C: ScalarMatrix
    K: ScalarMatrix
    F: ScalarMatrix | None
    inputs: tuple[str, ...]


class Facts(PageFacts):
    at: tuple[tuple[Symbol, Expr], ...]
    held: tuple[tuple[Symbol, Expr], ...]  # inputs
    inputs: tuple[Expr, ...]  # u and what it is
    damped: bool
    stability: Phrase | None


def derive(system: LagrangianSystem, options: Options, problem: Problem) -> Derivation:
    """The first terms of Taylor's series (Ogata, Modern Control Engineering, section 2.7).

    Raises NotDerivable under constraints, and where the state is no state of rest.
    """
    if system.constraints:
        raise NotDerivable(
            "with constraints only coordinates that are free can be linearised; eliminate the others",
            "constraints",
        )
    model = Model(system, problem)
    inputs = options.inputs if options.inputs is not None else inputs_of(model)
    at = _state(options, system, inputs)
    _require_rest(model, at)
    linear = _linear(model, at, inputs)
    if not linear.M.det():
        raise NotDerivable(
            "the mass matrix is singular at this state: a coordinate has no inertia there", "at"
        )
    matrices, state = (*_matrix_steps(model, linear),), (*_state_steps(model, linear),)
    steps, facts = (*matrices, *state), _facts(model, options, linear, at)
    results = {step.name: problem.final(step.result) for step in steps}
    motion = _small_motion(linear)
    work = Work(problem, uses=(equations(problem),)).showing(motion).step(*matrices)
    z = _state_vector(system)
    work = work.showing(Step("z", (Symbol("z"), z), "in-numbers")).step(*state)
    letters = problem.symbols.union(*map(free_symbols, at.values()))
    means = partial(_moving, results, problem)
    sides = tuple(NOTHING if side == ZERO else side for side in motion.chain)  # a column of zeros
    work = work.claim(told([sides], means, letters, problem.where, "linear-equation"))
    work = work.law("symmetric", linear.M == linear.M.T).claim(_second_route(model, linear, at, results))
    work = work.law("as-told", (_same(step.result, results[step.name], problem) for step in steps))
    work = work.law("said", _said(system, linear, facts, z, options))
    if facts.stability is not None:
        work = work.claim(_comes_back(results, facts.stability, problem, at))
    return work.answer("linearisation", results, facts)


def _said(
    system: LagrangianSystem, linear: Linear, facts: Facts, z: Matrix, options: Options
) -> Iterator[bool]:
    """What the words read: the state as it was given, the inputs, and what z holds."""
    given = dict(options.at or ())
    yield {name.name: value for name, value in facts.at} == {
        q: given[q] for q in system.coordinates if q in given
    }
    yield all(given[name.name] == value for name, value in facts.held)
    names_of = tuple(map(Symbol, linear.inputs))
    yield facts.inputs == (
        (Symbol("u"), *((column(names_of),) if names_of[1:] else names_of)) if names_of else ()
    )
    yield facts.damped == any(entry for row in linear.C.rows for entry in row)
    names = (*system.coordinates, *system.rates)
    yield [text(entry) for (entry,) in z.rows] == [f"delta*{name}" for name in names]


def _same(shown: Expr, result: Expr, problem: Problem) -> bool:
    """Whether a matrix on the page is the one in the results."""
    return normal_matrix(shown, problem.names) == normal_matrix(result, problem.names)


def _small_motion(linear: Linear) -> Step:
    """M_0 q'' + C_0 q' + K_0 q = F_0 u of the displacements."""
    damping = (Symbol("C_0") * DELTA * Symbol("q_dot"),) if linear.C else ()
    left = add(Symbol("M_0") * DELTA * Symbol("q_ddot"), *damping, Symbol("K_0") * DELTA * Symbol("q"))
    right = ZERO if linear.F is None else Symbol("F_0") * DELTA * Symbol("u")
    return Step("motion", (left, right), "in-numbers")


def _moving(results: Mapping[str, Expr], problem: Problem, at: Mapping[str, float]) -> Names:
    """The matrices, and a small motion that obeys them: its displacement, rate and input are any."""
    import numpy as np

    found = {name: np.array(number_rows(as_matrix(tree, name), at)) for name, tree in results.items()}
    n = len(found["K_0"])
    q, rate = np.linspace(0.3, 1.1, n)[:, None], np.linspace(-0.7, 0.4, n)[:, None]
    u = np.linspace(0.5, 0.9, found["F_0"].shape[1])[:, None] if "F_0" in found else np.zeros((1, 1))
    force = found["F_0"] @ u if "F_0" in found else np.zeros((n, 1))
    rest = found["K_0"] @ q + (found["C_0"] @ rate if "C_0" in found else 0.0)
    names: dict[Expr, Any] = {Symbol(name): value for name, value in found.items()}
    names |= {DELTA: 1.0, Symbol("q"): q, Symbol("q_dot"): rate, Symbol("u"): u}
    names[NOTHING] = np.zeros((n, 1))
    return {**names, Symbol("q_ddot"): np.linalg.solve(found["M_0"], force - rest)}


def _comes_back(
    results: Mapping[str, Expr], said: Phrase, problem: Problem, at: Mapping[Expr, Expr]
) -> Claim:
    """Whether K_0, which small motions obey, has a direction in which it does not drive back."""
    import numpy as np

    symbols = problem.symbols.union(*map(free_symbols, (*at.values(), *results.values())))

    def holds(point: Mapping[str, float]) -> bool:
        K = np.array(number_rows(as_matrix(results["K_0"], "K_0"), completed(point, problem.where)))
        least = float(np.linalg.eigvalsh((K + K.T) / 2).min())
        return least > 0 if stable else least < 0

    stable = said == _verdict(True)
    return route("stable" if stable else "unstable", map(holds, random_points(symbols, 3)))


def _state(options: Options, system: LagrangianSystem, inputs: tuple[str, ...]) -> dict[Expr, Expr]:
    """Names and what they are at rest; inputs are zero unless given. Raises NotDerivable."""
    given = dict(options.at or ())
    if unknown := given.keys() - set(system.coordinates) - set(inputs):
        names = ", ".join((*system.coordinates, *inputs))
        raise NotDerivable(f"{min(unknown)} under at: is neither a coordinate nor an input ({names})", "at")
    require_steady(given, (TIME, *system.rates, *system.accelerations), "at")
    rest: dict[Expr, Expr] = {Symbol(name): ZERO for name in (*inputs, *system.rates, *system.accelerations)}
    return {**rest, **{Symbol(name): value for name, value in given.items()}}


def _require_rest(model: Model, at: Mapping[Expr, Expr]) -> None:
    for k, q in enumerate(model.system.coordinates):
        left = there(model, model.rest[k] - model.forces[q], at)
        if left:
            written = text(model.problem.readable(left))
            raise NotDerivable(
                f"this is no state of rest: the equation of {q} leaves {written}, which is not zero; "
                "give the coordinates, or an input that holds the system, under at:",
                "at",
            )


def _linear(model: Model, at: Mapping[Expr, Expr], inputs: tuple[str, ...]) -> Linear:
    system = model.system
    whole = [model.rest[k] - model.forces[q] for k, q in enumerate(system.coordinates)]

    def derivatives(names: tuple[str, ...], sign: int = 1) -> ScalarMatrix:
        return ScalarMatrix.of([there(model, row.diff(name), at) * sign for name in names] for row in whole)

    return Linear(
        _mass(model, at),
        derivatives(system.rates),
        derivatives(system.coordinates),
        derivatives(inputs, -1) if inputs else None,
        inputs,
    )


def _mass(model: Model, at: Mapping[Expr, Expr]) -> ScalarMatrix:
    return ScalarMatrix.of([there(model, entry, at) for entry in row] for row in model.mass.rows)


def _matrix_steps(model: Model, linear: Linear) -> Iterator[Step]:
    readable = model.problem.readable_matrix
    yield Step("M_0", (Symbol("M_0"), readable(linear.M)), "linear")
    if linear.C:
        yield Step("C_0", (Symbol("C_0"), readable(linear.C)), "linear")
    yield Step("K_0", (Symbol("K_0"), readable(linear.K)), "linear")
    if linear.F is not None:
        yield Step("F_0", (Symbol("F_0"), readable(linear.F)), "linear")


def _state_steps(model: Model, linear: Linear) -> Iterator[Step]:
    """A = [0 1; -M^-1 K  -M^-1 C] and B = [0; M^-1 F], written in the inverse first."""
    n = len(model.system.coordinates)
    inverse = linear.M.inverse()
    zero, one = ScalarMatrix.zeros(n, n), ScalarMatrix.identity(n)
    A = ScalarMatrix.stacked(
        [
            ScalarMatrix.beside([zero, one]),
            ScalarMatrix.beside([-(inverse @ linear.K), -(inverse @ linear.C)]),
        ]
    )
    yield Step("A", (Symbol("A"), _written(A, model.problem)), "state-space")
    if linear.F is not None:
        B = ScalarMatrix.stacked([ScalarMatrix.zeros(n, len(linear.inputs)), inverse @ linear.F])
        yield Step("B", (Symbol("B"), _written(B, model.problem)), "state-space")


def _written(matrix: ScalarMatrix, problem: Problem) -> Matrix:
    return Matrix(tuple(tuple(written_fraction(entry, problem) for entry in row) for row in matrix.rows))


def _facts(model: Model, options: Options, linear: Linear, at: Mapping[Expr, Expr]) -> Facts:
    system = model.system
    return Facts(
        at=tuple((Symbol(q), at[Symbol(q)]) for q in system.coordinates if Symbol(q) in at),
        held=tuple((Symbol(u), at[Symbol(u)]) for u in linear.inputs if at[Symbol(u)] != ZERO),
        inputs=_input(linear.inputs),
        damped=bool(linear.C),
        stability=_stability(model, linear),
    )


def _input(names: tuple[str, ...]) -> tuple[Expr, ...]:
    """u and the input, or the column of them; nothing where there is none."""
    if len(names) < 2:
        return (Symbol("u"), *map(Symbol, names)) if names else ()
    return Symbol("u"), column(map(Symbol, names))


def _state_vector(system: LagrangianSystem) -> Matrix:
    """Displacements, then rates, as the page writes them."""
    names = (*system.coordinates, *system.rates)
    return column(Symbol("delta") * Symbol(name) for name in names)


def _stability(model: Model, linear: Linear) -> Phrase | None:
    """Of a conservative system: stable where K_0 is positive definite, unstable where a displacement lowers
    the potential energy (Lagrange and Dirichlet); None where it is not known."""
    if linear.C or linear.K != linear.K.T:
        return None
    assumed = model.problem.assumptions.items()
    positive = {name for name, what in assumed if what == "positive"} | surely_positive(model)
    n = len(linear.K.rows)
    signs = [known_sign(linear.K.block(slice(k), slice(k)).det(), positive) for k in range(1, n + 1)]
    if all(sign == 1 for sign in signs):
        return _verdict(True)
    diagonal = [known_sign(linear.K[k, k], positive) for k in range(n)]
    falls = -1 in diagonal or signs[-1] == -1
    return _verdict(False) if falls else None


def _verdict(stable: bool) -> Phrase:
    """What the stiffness says of the state of rest."""
    said = Phrase("rest-stable" if stable else "rest-unstable")
    return Phrase("definite" if stable else "not-definite", {"K_0": Symbol("K_0"), "verdict": said})


def _second_route(model: Model, linear: Linear, at: Mapping[Expr, Expr], told: Mapping[str, Expr]) -> Claim:
    """A small motion about the state, by differences of the Lagrangian, against the linear equations as they
    are told."""
    system, problem = model.system, model.problem
    differences = Differences(system, problem.where)
    moving = (*system.coordinates, *system.rates, *system.accelerations, *linear.inputs)
    letters = frozenset().union(*map(free_symbols, at.values()))
    names = sorted(problem.symbols | letters | {TIME, *moving})
    found = (
        _agree(model, linear.inputs, at, told, differences, point) for point in random_points(names, TRIED)
    )
    real = list(islice((holds for holds in found if holds is not None), 2))
    if not real:
        raise NotDerivable("this state is not real wherever it was tried, so nothing could be checked", "at")
    return route("small-motion", real)


def _agree(
    model: Model,
    inputs: tuple[str, ...],
    at: Mapping[Expr, Expr],
    told: Mapping[str, Expr],
    differences: Differences,
    point: dict[str, float],
) -> bool | None:
    """Whether they agree about the state of rest of one point; None where that is not real."""
    system = model.system
    known = completed(point, model.problem.where)
    rest = {**known}
    try:
        rest |= {name.name: number(tree, known) for name, tree in at.items() if isinstance(name, Symbol)}
    except NotReal:
        return None
    moving = (*system.coordinates, *system.rates, *system.accelerations, *inputs)

    def leftover(sign: int) -> list[float]:
        return differences.left_over({**rest, **{n: rest[n] + sign * SMALL * point[n] for n in moving}})

    slope = [(a - b) / (2 * SMALL) for a, b in zip(leftover(1), leftover(-1), strict=True)]
    second = [
        ("M_0", system.accelerations, 1), ("C_0", system.rates, 1), ("K_0", system.coordinates, 1),
        ("F_0", inputs, -1),
    ]  # fmt: skip
    first = [("A", (*system.coordinates, *system.rates), 1), ("B", inputs, 1)]
    matrices = {name: numbers(tree, rest) for name, tree in told.items()}
    changes = _total(matrices, first, point)
    n = len(system.coordinates)
    driven = {**point, **dict(zip(system.accelerations, changes[n:], strict=True))}
    return (
        close(slope, _total(matrices, second, point), LEFT_OVER)
        and close(changes[:n], [point[rate] for rate in system.rates])
        and close(_total(matrices, second, driven), [0.0] * n, LEFT_OVER)
    )


def _total(
    matrices: Mapping[str, Any], parts: Sequence[tuple[str, Sequence[str], int]], point: Mapping[str, float]
) -> Any:
    """M x'' + C x' + K x - F u, or A z + B u, for the displacement of a point."""
    import numpy as np

    known = [part for part in parts if part[0] in matrices]
    shaped = ((np.reshape(matrices[part], (-1, len(names))), names, sign) for part, names, sign in known)
    return sum(sign * matrix @ [point[name] for name in names] for matrix, names, sign in shaped)
