"""The laws of an arm's dynamics in matrices, each tried on small ones of numbers.

What stands for the names in that case is found in another way than the law says.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal, normal_matrix
from derive.algebra.readable.form import readable, readable_matrix
from derive.derivation import Step
from derive.expression import (
    ZERO,
    Call,
    Derivative,
    Expr,
    Matrix,
    Quotient,
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
from derive.kinds.robot._dynamics.index_laws import in_general
from derive.kinds.robot._dynamics.sums import over, written_out
from derive.mechanics.dynamics import (
    LinkMotion,
    inertia_matrix,
    kinetic_energy,
    link_inertia,
)
from derive.names import free

HALF = number("1/2")
Q, RATE, RISE, U = symbols("q q_dot q_ddot u")


def _rows(*rows: Iterable[int]) -> Matrix:
    return Matrix(tuple(tuple(map(number, row)) for row in rows))


TURN = _rows((0, 0, 1), (1, 0, 0), (0, 1, 0))  # the axes change places in turn: no half or quarter turn
INERTIA, STIFFNESS, RUBBING = _rows((3, 1), (1, 2)), _rows((1, 2), (-2, 5)), _rows((2, 0), (0, 7))


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


def regressor_laws() -> tuple[Step, Step]:
    """tau = Y Theta, and the same of the parameters that are left, column by column."""
    Y, small, theta, kept = symbols("Y Y_b Theta Theta_b")
    matrix, values = _rows((1, 2, 3), (4, 0, -5)), _rows((2,), (-1,), (7,))
    case: dict[Expr, Expr] = {Y: matrix, small: matrix, **dict.fromkeys((theta, kept), values)}
    case[Symbol("tau")] = _rows((21,), (-27,))
    total = over("k", *symbols("y_k Theta_k"))
    columns: dict[Expr, Expr] = {Symbol(f"y_{k}"): column(matrix.T.rows[k - 1]) for k in (1, 2, 3)}
    columns |= {Symbol(f"Theta_{k}"): values.rows[k - 1][0] for k in (1, 2, 3)}
    case[total] = written_out(total, {}, columns)
    return (
        in_general("tau", Y * theta, case),
        Step("columns-law", (Symbol("tau"), small * kept, total), "law", instance=case),
    )


def energy_law(I: Symbol) -> Step:
    """K_i of a link in its velocities, tried on one that moves with a single joint; `I` is what the matrices
    of inertia are called: I_i, or I_ci."""
    m, v, omega, R = symbols("m_i v_ci omega_i R_i^0")
    mass, shift, spin = number(3), _rows((1,), (2,), (-1,)), _rows((2,), (0,), (5,))
    turn, moments = TURN, _rows((2, 1, 0), (1, 7, 0), (0, 0, 4))
    link = LinkMotion(normal(mass), *map(normal_matrix, (shift, shift, spin, turn, moments)))
    twice = link_inertia(link)[0, 0]
    linear, angular = (
        multiply(HALF, m, transpose(v), v),
        HALF * transpose(omega) * R * I * transpose(R) * omega,
    )
    case: dict[Expr, Expr] = {m: mass, v: shift, omega: spin, R: turn, I: moments}
    return in_general("K_i", linear + angular, {**case, Symbol("K_i"): HALF * readable(twice)})


def quadratic_law(I: Symbol) -> Step:
    """K of all links as a quadratic form in the rates, tried on two links and two joints."""
    m, v, omega, R, D = symbols("m_i v_ci omega_i R_i^0 D")
    rates, links, case = _rows((3,), (-2,)), [], dict[Expr, Expr]()
    for i in (1, 2):
        J_v, J_w = _rows((1, i), (2, -1), (0, 3)), _rows((0, 1), (i, 1), (1, 0))
        turn, moments = TURN, _rows((2, 1, 0), (1, 7 * i, 0), (0, 0, 4))
        parts = [*map(normal_matrix, (J_v, J_v, J_w, turn, moments))]
        links.append(LinkMotion(normal(number(i)), *parts))
        moved = (readable_matrix(J @ normal_matrix(rates)) for J in parts[1:3])
        named = *symbols(f"m_{i} v_c{i} omega_{i} R_{i}^0"), Symbol(f"{I.name[:-1]}{i}")
        case |= dict(zip(named, (number(i), *moved, turn, moments), strict=True))
    energy = add(m * transpose(v) * v, transpose(omega) * R * I * transpose(R) * omega)
    total, whole = over("i", energy), inertia_matrix(links)
    form = HALF * transpose(RATE) * D * RATE
    found: dict[Expr, Expr] = {total: written_out(total, {}, case, 2), D: readable_matrix(whole), RATE: rates}
    found[Symbol("K")] = readable(kinetic_energy(whole, normal_matrix(rates)))
    return in_general("K", HALF * total, found, form)


def acceleration_law() -> Step:
    """q_ddot = D^-1 (tau - h), tried on forces that are those of known accelerations."""
    D, tau, h = symbols("D tau h")
    rise, rest = _rows((2,), (-3,)), _rows((4,), (1,))
    forces = normal_matrix(INERTIA) @ normal_matrix(rise) + normal_matrix(rest)
    case: dict[Expr, Expr] = {D: INERTIA, h: rest, tau: readable_matrix(forces), RISE: rise}
    left = tau - h
    return in_general("q_ddot", D**-1 * left, case, Quotient(Call("adj", (D,)), Call("det", (D,))) * left)


def linear_laws(taken: Collection[str], rubs: bool) -> tuple[Step, ...]:
    """The equations about rest, the entries of K_0, and x_dot = A x + B u in blocks; tried on numbers, where
    A and B are what the equations make of each state and of each force alone."""
    D, K, F_v, A, B, x = symbols("D_0 K_0 F_v A B x")
    nothing, one, variable = Symbol("0"), Symbol("1"), Symbol(free(taken, "zeta_1"))
    state, force = _rows((1,), (-2,), (3,), (1,)), _rows((1,), (4,))
    square = [_motion(unit, _rows((0,), (0,)), rubs) for unit in _units(4)]
    forced = [_motion(_rows((0,), (0,), (0,), (0,)), unit, rubs) for unit in _units(2)]
    moved = _motion(state, force, rubs)
    case: dict[Expr, Expr] = {
        D: INERTIA, K: STIFFNESS, F_v: RUBBING, U: force, x: state,
        one: _rows((1, 0), (0, 1)), nothing: _rows((0, 0), (0, 0)),
        Q: Matrix(state.rows[:2]), RATE: Matrix(state.rows[2:]), RISE: Matrix(moved.rows[2:]),
        A: _beside(square), B: _beside(forced), Symbol("x_dot"): moved,
    }  # fmt: skip
    damping = F_v * RATE if rubs else ZERO
    below = (-(D**-1 * K), -(D**-1 * F_v) if rubs else nothing)
    gradient, entry = Derivative(*symbols("g_i q_j")), Symbol("k_ij")
    slope: dict[Expr, Expr] = {gradient: Derivative(sin(variable), variable), entry: Call("cos", (variable,))}
    return (
        Step("rest-law", (add(D * RISE, damping, K * Q), U), "law", instance=case),
        in_general("k_ij", gradient, slope),
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
