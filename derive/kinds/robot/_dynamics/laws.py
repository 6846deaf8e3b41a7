"""The general laws of an arm's dynamics as lines, each tried on small matrices of numbers or functions.

What stands for the names in that case is found in another way than the law says, so that a sign or an index
of the law cannot be wrong.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal, normal_matrix
from derive.algebra.readable.form import readable, readable_matrix
from derive.derivation import Step
from derive.expression import (
    ONE,
    ZERO,
    Call,
    Derivative,
    Expr,
    Matrix,
    Quotient,
    Sum,
    Symbol,
    add,
    column,
    multiply,
    number,
    sin,
    squared,
    symbols,
    transpose,
)
from derive.mechanics.dynamics import LinkMotion, christoffel, link_inertia
from derive.names import free

HALF = number("1/2")
Q, RATE, RISE, U = symbols("q q_dot q_ddot u")


def _rows(*rows: Iterable[int]) -> Matrix:
    return Matrix(tuple(tuple(map(number, row)) for row in rows))


INERTIA, STIFFNESS, RUBBING = _rows((3, 1), (1, 2)), _rows((1, 2), (-2, 5)), _rows((2, 0), (0, 7))


def in_general(name: str, formula: Expr, case: dict[Expr, Expr], *more: Expr) -> Step:
    """A line of a law and the case in which it is tried; the step is called `c_ijk-law`."""
    return Step(f"{name}-law", (Symbol(name), formula, *more), "law", instance=case)


# -- the symbols of Christoffel ---------------------------------------------------------------------------


def varying(taken: Collection[str]) -> tuple[Matrix, tuple[Symbol, ...]]:
    """A symmetric matrix (3 by 3) of three variables, none of whose derivatives are alike."""
    x, y, z = found = tuple(Symbol(free(taken, f"zeta_{k}")) for k in (1, 2, 3))
    return Matrix(((ONE, x * z, y * z**2), (x * z, ONE, x * y), (y * z**2, x * y, ONE))), found


def christoffel_law(taken: Collection[str]) -> Step:
    """c_ijk, tried for the symbol 123."""
    D, variables = varying(taken)
    found = christoffel(normal_matrix(D), tuple(name.name for name in variables))[1, 2, 3]
    d_kj, d_ki, d_ij, q_i, q_j, q_k = symbols("d_kj d_ki d_ij q_i q_j q_k")
    slopes = Derivative(d_kj, q_i), Derivative(d_ki, q_j), Derivative(d_ij, q_k)
    entries = D.rows[2][1], D.rows[2][0], D.rows[0][1]
    case: dict[Expr, Expr] = dict(zip(slopes, map(Derivative, entries, variables), strict=True))
    case[Symbol("c_ijk")] = readable(found)
    return in_general("c_ijk", multiply(HALF, Sum((slopes[0], slopes[1], -slopes[2]))), case)


def khatib_laws(taken: Collection[str]) -> tuple[Step, Step]:
    """m_ijk and b_ijk, tried for 312: b_312 is the symbol c_123."""
    M, variables = varying(taken)
    names = tuple(name.name for name in variables)
    value = normal_matrix(M)
    places = ((3, 1, 2), (3, 2, 1), (1, 2, 3))
    m = {(i, j, k): readable(value[i - 1, j - 1].diff(names[k - 1])) for i, j, k in places}
    m_ij, q_k, m_ijk, m_ikj, m_jki = symbols("m_ij q_k m_ijk m_ikj m_jki")
    slope, taken_so = Derivative(m_ij, q_k), Derivative(M.rows[2][0], variables[1])
    case: dict[Expr, Expr] = {m_ijk: m[3, 1, 2], m_ikj: m[3, 2, 1], m_jki: m[1, 2, 3]}
    case[Symbol("b_ijk")] = readable(christoffel(value, names)[1, 2, 3])
    first = in_general("m_ijk", slope, {slope: taken_so, m_ijk: m[3, 1, 2]})
    return first, in_general("b_ijk", multiply(HALF, Sum((m_ijk, m_ikj, -m_jki))), case)


def speed_law() -> Step:
    """v = C [qdot^2] + B [qdot qdot], tried on a quadratic form in two rates."""
    C, B, x, y = *symbols("C B"), number(3), number(5)
    squares, products = Call("bracket", (squared(RATE),)), Call("bracket", (RATE * RATE,))
    case: dict[Expr, Expr] = {
        C: _rows((1, 2), (4, -3)),
        B: _rows((6,), (7,)),
        squares: column((squared(x), squared(y))),
        products: column((x * y,)),
        Symbol("v"): _rows((9 + 50 + 90,), (36 - 75 + 105,)),
    }
    return in_general("v", C * squares + B * products, case)


# -- energies and motion ----------------------------------------------------------------------------------


def energy_law() -> Step:
    """K_i of a link in its velocities, tried on one that moves with a single joint."""
    m, v, omega, R, I = symbols("m_i v_ci omega_i R_i^0 I_i")
    mass, shift, spin = number(3), _rows((1,), (2,), (-1,)), _rows((2,), (0,), (5,))
    turn, moments = _rows((0, -1, 0), (1, 0, 0), (0, 0, 1)), _rows((2, 1, 0), (1, 7, 0), (0, 0, 4))
    link = LinkMotion(normal(mass), *map(normal_matrix, (shift, shift, spin, turn, moments)))
    twice = link_inertia(link)[0, 0]
    linear, angular = (
        multiply(HALF, m, transpose(v), v),
        HALF * transpose(omega) * R * I * transpose(R) * omega,
    )
    case: dict[Expr, Expr] = {m: mass, v: shift, omega: spin, R: turn, I: moments}
    return in_general("K_i", linear + angular, {**case, Symbol("K_i"): HALF * readable(twice)})


def acceleration_law() -> Step:
    """q_ddot = D^-1 (tau - h), tried on forces that are those of known accelerations."""
    D, tau, h = symbols("D tau h")
    rise, rest = _rows((2,), (-3,)), _rows((4,), (1,))
    forces = normal_matrix(INERTIA) @ normal_matrix(rise) + normal_matrix(rest)
    case: dict[Expr, Expr] = {D: INERTIA, h: rest, tau: readable_matrix(forces), RISE: rise}
    left = tau - h
    return in_general("q_ddot", D**-1 * left, case, Quotient(Call("adj", (D,)), Call("det", (D,))) * left)


def linear_laws(taken: Collection[str], rubs: bool) -> tuple[Step, ...]:
    """The equations about rest, K_0, and x_dot = A x + B u with A and B in blocks; tried on numbers, where A
    and B are what the equations make of each state and of each force alone."""
    D, K, B_f, A, B, x = symbols("D_0 K_0 B_f A B x")
    nothing, one, variable = Symbol("0"), Symbol("1"), Symbol(free(taken, "zeta_1"))
    state, force = _rows((1,), (-2,), (3,), (1,)), _rows((1,), (4,))
    square = [_motion(unit, _rows((0,), (0,)), rubs) for unit in _units(4)]
    forced = [_motion(_rows((0,), (0,), (0,), (0,)), unit, rubs) for unit in _units(2)]
    moved = _motion(state, force, rubs)
    case: dict[Expr, Expr] = {
        D: INERTIA, K: STIFFNESS, B_f: RUBBING, U: force, x: state,
        one: _rows((1, 0), (0, 1)), nothing: _rows((0, 0), (0, 0)),
        Q: Matrix(state.rows[:2]), RATE: Matrix(state.rows[2:]), RISE: Matrix(moved.rows[2:]),
        A: _beside(square), B: _beside(forced), Symbol("x_dot"): moved,
    }  # fmt: skip
    damping = B_f * RATE if rubs else ZERO
    below = (-(D**-1 * K), -(D**-1 * B_f) if rubs else nothing)
    gradient = Derivative(Symbol("g"), Q)
    slope: dict[Expr, Expr] = {gradient: Derivative(sin(variable), variable), K: Call("cos", (variable,))}
    return (
        Step("rest-law", (add(D * RISE, damping, K * Q), U), "law", instance=case),
        in_general("K_0", gradient, slope),
        in_general("x_dot", A * x + B * U, case),
        in_general("A", Matrix(((nothing, one), below)), case),
        in_general("B", Matrix(((nothing,), (D**-1,))), case),
    )


def _motion(state: Matrix, force: Matrix, rubs: bool) -> Matrix:
    """x_dot (4 by 1) of two joints."""
    whole, forces = normal_matrix(state), normal_matrix(force)
    q, rate = whole.block(slice(0, 2), slice(None)), whole.block(slice(2, 4), slice(None))
    left = forces - normal_matrix(STIFFNESS) @ q
    if rubs:
        left = left - normal_matrix(RUBBING) @ rate
    inertia = normal_matrix(INERTIA)
    rise = (inertia.adjugate() @ left).map(lambda entry: entry / inertia.det())
    return readable_matrix(ScalarMatrix.stacked([rate, rise]))


def _units(size: int) -> list[Matrix]:
    return [_rows(*((int(i == k),) for i in range(size))) for k in range(size)]


def _beside(columns: Iterable[Matrix]) -> Matrix:
    return Matrix(tuple(zip(*(column.T.rows[0] for column in columns), strict=True)))
