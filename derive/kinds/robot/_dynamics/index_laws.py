"""The laws of an arm's dynamics entry by entry, each tried on a matrix of three variables.

What stands for the entry in that case is found in another way than the law says, so that a sign or an index
of the law cannot be wrong.
"""

from __future__ import annotations

from collections.abc import Collection
from itertools import product

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal, normal_matrix
from derive.algebra.readable.form import readable, readable_matrix
from derive.derivation import Step
from derive.expression import (
    ONE,
    Call,
    Derivative,
    Expr,
    Matrix,
    Sum,
    Symbol,
    add,
    multiply,
    number,
    symbols,
    terms_of,
)
from derive.kinds.robot._dynamics.sums import over, written_out
from derive.mechanics.dynamics import (
    christoffel,
    coriolis_matrix,
    kinetic_energy,
    rate_column,
    time_derivative,
)
from derive.names import free

HALF = number("1/2")
M_IJK, M_IKJ, M_JKI = symbols("m_ijk m_ikj m_jki")  # derivatives of the entries of M


def in_general(name: str, formula: Expr, case: dict[Expr, Expr], *more: Expr) -> Step:
    """A line of a law and the case in which it is tried; the step is called `c_ijk-law`."""
    return Step(f"{name}-law", (Symbol(name), formula, *more), "law", instance=case)


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
    m_ij, q_k = symbols("m_ij q_k")
    slope, taken_so = Derivative(m_ij, q_k), Derivative(M.rows[2][0], variables[1])
    case: dict[Expr, Expr] = {M_IJK: m[3, 1, 2], M_IKJ: m[3, 2, 1], M_JKI: m[1, 2, 3]}
    case[Symbol("b_ijk")] = readable(christoffel(value, names)[1, 2, 3])
    first = in_general("m_ijk", slope, {slope: taken_so, M_IJK: m[3, 1, 2]})
    return first, in_general("b_ijk", multiply(HALF, Sum((M_IJK, M_IKJ, -M_JKI))), case)


def _moving(taken: Collection[str]) -> tuple[dict[Expr, Expr], ScalarMatrix, tuple[Symbol, ...]]:
    """A case for sums: entries of D, their slopes, the symbols of Christoffel, rates and accelerations as
    they are called there; D, and its variables."""
    M, variables = varying(taken)
    D, names = normal_matrix(M), tuple(name.name for name in variables)
    case: dict[Expr, Expr] = {}
    for (k, j), (i, variable) in product(product((1, 2, 3), repeat=2), enumerate(variables, 1)):
        entry = Symbol(f"d_{k}{j}")
        case[entry] = M.rows[k - 1][j - 1]
        case[Derivative(entry, Symbol(f"q_{i}"))] = readable(D[k - 1, j - 1].diff(variable.name))
    for ijk, value in christoffel(D, names).items():
        case[Symbol(f"c_{''.join(map(str, ijk))}")] = readable(value)
    for i, variable in enumerate(variables, 1):
        case |= {Symbol(f"q_{i}_{dots}"): Symbol(f"{variable.name}_{dots}") for dots in ("dot", "ddot")}
    return case, D, variables


def coriolis_law(taken: Collection[str]) -> Step:
    """C_kj, tried for 32."""
    case, D, variables = _moving(taken)
    names = tuple(name.name for name in variables)
    whole = coriolis_matrix(christoffel(D, names), rate_column(names))
    total = over("i", *symbols("c_ijk q_i_dot"))
    found: dict[Expr, Expr] = {total: written_out(total, {"k": 3, "j": 2}, case)}
    return in_general("C_kj", total, {**found, Symbol("C_kj"): readable(whole[2, 1])})


def skew_law(taken: Collection[str]) -> Step:
    """n_kj of dD/dt - 2C, tried for 32."""
    case, D, variables = _moving(taken)
    names = tuple(name.name for name in variables)
    C = coriolis_matrix(christoffel(D, names), rate_column(names))
    value = time_derivative(D, names) - C.scaled(2)
    d_kj, d_ij, d_ki, c_ijk, q_i, q_j, q_k, rate = symbols("d_kj d_ij d_ki c_ijk q_i q_j q_k q_i_dot")
    first = over("i", Derivative(d_kj, q_i) - 2 * c_ijk, rate)
    second = over("i", Derivative(d_ij, q_k) - Derivative(d_ki, q_j), rate)
    found: dict[Expr, Expr] = {each: written_out(each, {"k": 3, "j": 2}, case) for each in (first, second)}
    found[Symbol("n_kj")] = readable(value[2, 1])
    return in_general("n_kj", first, found, second)


def motion_law(taken: Collection[str], viscous: bool, coulomb: bool) -> Step:
    """The equation of joint k, tried for the third one by d/dt of dK/dqdot - dK/dq + dP/dq."""
    case, D, variables = _moving(taken)
    names, P = tuple(name.name for name in variables), normal(multiply(*variables, variables[2]))
    rate, rise = rate_column(names), rate_column(names, "ddot")
    momentum = (time_derivative(D, names) @ rate + D @ rise)[2, 0]
    tau = momentum - kinetic_energy(D, rate).diff(names[2]) + P.diff(names[2])
    g_k, f_vk, q_k, rubbing = symbols("g_k f_vk q_k_dot tau_ck")
    inertial, moving = over("j", *symbols("d_kj q_j_ddot")), over("i j", *symbols("c_ijk q_i_dot q_j_dot"))
    found: dict[Expr, Expr] = {each: written_out(each, {"k": 3}, case) for each in (inertial, moving)}
    turning = Symbol(f"{names[2]}_dot")
    against = [f_vk * q_k] * viscous + [rubbing * Call("sign", (q_k,))] * coulomb
    forces = [number(5) * turning] * viscous + [number(7) * Call("sign", (turning,))] * coulomb
    found |= {g_k: readable(P.diff(names[2])), f_vk: number(5), rubbing: number(7), q_k: turning}
    found[Symbol("tau_k")] = add(readable(tau), *forces)
    chain = (add(inertial, moving, g_k, *against), Symbol("tau_k"))
    return Step("tau_k-law", chain, "law", instance=found)


def torque_law(name: Symbol, taken: Collection[str]) -> Step:
    """tau = D q_ddot + C q_dot without gravity, by d/dt of dK/dqdot - dK/dq; `name` is what D is called."""
    _, D, variables = _moving(taken)
    names = tuple(each.name for each in variables)
    rate, rise = rate_column(names), rate_column(names, "ddot")
    energy = kinetic_energy(D, rate)
    momenta = (time_derivative(D, names) @ rate + D @ rise).entries
    tau = [momentum - energy.diff(each) for momentum, each in zip(momenta, names, strict=True)]
    C, q_dot, q_ddot = symbols("C q_dot q_ddot")
    case: dict[Expr, Expr] = {
        name: readable_matrix(D),
        C: readable_matrix(coriolis_matrix(christoffel(D, names), rate)),
        q_dot: readable_matrix(rate),
        q_ddot: readable_matrix(rise),
        Symbol("tau"): readable_matrix(ScalarMatrix.column(tau)),
    }
    return Step("motion-law", (Symbol("tau"), name * q_ddot + C * q_dot), "law", instance=case)


def rest_law(taken: Collection[str], viscous: bool, coulomb: bool) -> Step:
    """h_k, what the equation of joint k has beside accelerations, tried in the same case."""
    whole = motion_law(taken, viscous, coulomb)
    inertial, *rest = terms_of(whole.chain[0])
    h_k, case = Symbol("h_k"), whole.instance
    return in_general("h_k", add(*rest), {**case, h_k: case[whole.chain[-1]] - case[inertial]})
