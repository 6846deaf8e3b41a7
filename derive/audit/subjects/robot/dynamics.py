"""Dynamics: each result from the energies of the bodies, at one configuration."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from derive.audit.asked import Asked, Beyond, Holds, Same, Test
from derive.audit.linear import det, inverse, product, rank, solve, transposed
from derive.audit.points import Number, Point, agree, shown
from derive.audit.subjects.robot.arm import entries, numbers
from derive.audit.subjects.robot.bodies import Mechanics
from derive.audit.subjects.robot.dynamics_in_numbers import is_in_numbers, moved, shown_at_the_hand
from derive.audit.subjects.robot.series import values
from derive.audit.subjects.robot.task import Task


def inertia_matrix(asked: Asked, point: Point) -> Iterator[Test]:
    """D, and the Jacobians of each center of mass."""
    arm = Mechanics(asked, point)
    yield Same("D", numbers(arm.D))
    for body in arm.bodies:
        yield Same(f"J_v{body.i}", numbers(body.J_v))
        yield Same(f"J_w{body.i}", numbers(body.J_w))


def christoffel(asked: Asked, point: Point) -> Iterator[Test]:
    """Every c_ijk."""
    arm = Mechanics(asked, point)
    for i, j, k in arm.triples():
        yield Same(_named("c", i, j, k), arm.christoffel(i, j, k))


def _named(letter: str, *indices: int) -> str:
    """c_123; with commas where an index has two digits."""
    numbered = [str(index + 1) for index in indices]
    return f"{letter}_" + ("," if max(map(len, numbered)) > 1 else "").join(numbered)


def coriolis_matrix(asked: Asked, point: Point) -> Iterator[Test]:
    """C of Christoffel's symbols."""
    yield Same("C", Mechanics(asked, point).C.tolist())


def coriolis_matrices(asked: Asked, point: Point) -> Iterator[Test]:
    """Khatib's C, for the squares of the rates, and B, for their products."""
    yield from _khatib(Mechanics(asked, point))


def _khatib(arm: Mechanics) -> Iterator[Test]:
    n, c = arm.indices, arm.christoffel
    yield Same("C", [[c(j, j, i) for j in n] for i in n])
    if arm.n > 1:
        yield Same("B", [[2 * c(j, k, i) for j, k in combinations(n, 2)] for i in n])
    for i, j, k in arm.triples():
        if (name := _named("b", i, j, k)) in arm.asked.results:
            yield Same(name, c(j, k, i))
    yield Same("v", (arm.C @ arm.qdot).tolist())


def gravity(asked: Asked, point: Point) -> Iterator[Test]:
    """P and its slopes."""
    arm = Mechanics(asked, point)
    yield Same("P", arm.P.value)
    yield Same("g", entries(arm.g))


def energy(asked: Asked, point: Point) -> Iterator[Test]:
    """The energies of each body, of the rotors, and of them all."""
    arm = Mechanics(asked, point)
    for body in arm.bodies:
        yield Same(f"K_{body.i}", arm.kinetic(body.D))
        yield Same(f"P_{body.i}", body.potential(arm.gravity).value)
    if "K_m" in asked.results:
        parts = zip(values(arm.rotors), arm.qdot, strict=True)
        yield Same("K_m", sum(each * rate * rate for each, rate in parts) / point.number(2))
    yield Same("K", arm.kinetic(arm.D))
    yield Same("P", arm.P.value)


def dynamics(asked: Asked, point: Point) -> Iterator[Test]:
    """Lagrange's equations and all that is in them, by Spong's names or Khatib's."""
    arm = Mechanics(asked, point)
    yield Same("tau", arm.tau.tolist())
    if asked.options.notation == "khatib":
        yield Same("M", numbers(arm.D))
        yield Same("G", entries(arm.g))
        yield from (test for test in _khatib(arm) if isinstance(test, Same) and test.name in asked.results)
        return
    yield Same("D", numbers(arm.D))
    for i, j, k in arm.triples():
        yield Same(_named("c", i, j, k), arm.christoffel(i, j, k))
    yield Same("P", arm.P.value)
    yield Same("g", entries(arm.g))


def residual(asked: Asked, point: Point) -> Iterator[Test]:
    """The momentum, what is known of its rate, and the filter that a residual is."""
    arm = Mechanics(asked, point)
    yield Same("p", (values(arm.D) @ arm.qdot).tolist())
    yield Same("alpha", (entries(arm.g) - arm.C.T @ arm.qdot + arm.friction).tolist())
    n = range(1, arm.n + 1)
    given = asked.options.gain
    gains = given if isinstance(given, tuple) else [given] * arm.n
    followed = []
    for k, gain in zip(n, gains, strict=True):
        size = point[f"k_{k}"] if gain is None else point.at(asked.formula(gain))
        followed.append(size * (point[f"tau_ext_{k}"] - point[f"r_{k}"]))
    yield Same("r_dot", followed)


def newton_euler(asked: Asked, point: Point) -> Iterator[Test]:
    """The torques."""
    yield Same("tau", Mechanics(asked, point).tau.tolist())


def forward_dynamics(asked: Asked, point: Point) -> Iterator[Test]:
    """The accelerations that torques make."""
    if is_in_numbers(asked):
        yield from moved(asked, point)
        return
    arm = Mechanics(asked, point)
    D = numbers(arm.D)
    if "D" in asked.results:
        yield Same("D", D)
    else:
        yield Same("det", det(D))
        yield Same("D_inv", inverse(D))
    yield Same("h", arm.rest.tolist())
    yield Same("qddot", accelerations(arm))


def accelerations(arm: Mechanics) -> list[Number]:
    """D^-1 (tau - h)."""
    found = solve(numbers(arm.D), [[force] for force in arm.torques - arm.rest])
    return [row[0] for row in found]


def operational_space_inertia(asked: Asked, point: Point) -> Iterator[Test]:
    """J^-T D J^-1, or the inverse of J D^-1 J^T."""
    if is_in_numbers(asked):
        yield from shown_at_the_hand(asked, point)
        return
    arm = Mechanics(asked, point)
    J, D = Task(arm).J, numbers(arm.D)
    yield Same("J", J)
    if "D" in asked.results:
        yield Same("D", D)
        yield Same("Lambda", inverse(product(J, solve(D, transposed(J)))))
        return
    J_inv = inverse(J)
    yield Same("J_inv", J_inv)
    yield Same("Lambda", product(transposed(J_inv), product(D, J_inv)))


def state_space(asked: Asked, point: Point) -> Iterator[Test]:
    """The state, its derivative, and both matrices about rest."""
    arm = Mechanics(asked, point)
    names = [*arm.robot.variables, *(f"{name}_dot" for name in arm.robot.variables)]
    yield Same("x", [point.at(arm.asked.read(name)) for name in names])
    yield Same("f", [*arm.qdot.tolist(), *accelerations(arm)])
    if asked.options.at is not None:
        yield from _linearised(asked, point)


def _linearised(asked: Asked, point: Point) -> Iterator[Test]:
    """About rest at the values given, where the torques hold the weight: A from -D^-1 dg/dq and viscous
    friction, for all that is quadratic in the rates has no part in it."""
    fixed = {name: asked.formula(value) for name, value in asked.options.at}
    arm = Mechanics(asked, point.where(**fixed))
    n = arm.n
    stiffness = [[arm.P.diff(i).diff(j).value for j in arm.indices] for i in arm.indices]
    viscous = [link.friction.viscous if link.friction else None for link in arm.robot.links if link.variable]
    damping = [
        [arm.series(b).value if b is not None and i == j else 0 for j in range(n)]
        for i, b in enumerate(viscous)
    ]
    D = numbers(arm.D)
    left = solve(D, [[-entry for entry in (*k, *d)] for k, d in zip(stiffness, damping, strict=True)])
    upper = [[0] * n + [int(i == j) for j in range(n)] for i in range(n)]
    yield Same("tau_0", entries(arm.g))
    yield Same("A", [*upper, *left])
    yield Same("B", [*([0] * n for _ in range(n)), *inverse(D)])


def properties(asked: Asked, point: Point) -> Iterator[Test]:
    """D_dot - 2 C, and the regressor."""
    arm = Mechanics(asked, point)
    yield Same("D_dot", arm.D_dot.tolist())
    yield Same("N", (arm.D_dot - 2 * arm.C).tolist())
    yield from _regressors(arm)


def regressor(asked: Asked, point: Point) -> Iterator[Test]:
    """tau as a linear function of the parameters, and of the fewest of them."""
    yield from _regressors(Mechanics(asked, point))
    names = [str(name) for name in asked.result("names")]
    parameters = asked.result("parameters")
    yield Holds("names", len({*names}) == len(parameters), "one for each parameter")
    values_of = dict(zip(names, parameters, strict=True))
    groups = [group.subs(values_of, simultaneous=True) for group in asked.result("groups")]
    yield Same("base_parameters", point.each(groups))
    yield Holds("groups", len(groups) == len(asked.result("base_parameters")), "one for each base parameter")


def _regressors(arm: Mechanics) -> Iterator[Test]:
    """Y theta = tau where Y knows nothing of the bodies; the columns of Y_b are independent."""
    if "Y" not in arm.asked.results:
        yield Beyond("parameters", "the regressor is not told in symbols")
        return
    for Y, theta in (("Y", "parameters"), ("Y_b", "base_parameters")):
        column = [[each] for each in arm.point.vector(arm.asked.result(theta))]
        made = [row[0] for row in product(arm.point.matrix(arm.asked.result(Y)), column)]
        right = all(agree(own, other, other) for own, other in zip(made, arm.tau, strict=True))
        for name in (Y, theta):
            yield Holds(name, right, f"{Y} {theta} is tau = {[shown(each) for each in arm.tau]}")
    yield Holds("Y_b", _independent(arm), "a matrix with independent columns")


class Motion(Point):
    """Another motion of the arm that stands at a point: its joint variables and their rates drawn again."""

    def __init__(self, seed: int, arm: Mechanics) -> None:
        here = arm.point
        super().__init__(here.seed, here.exact, here.angles, here.assumptions, here.fixed)
        self.again, self.moving = seed, arm.robot.variables

    def seed_of(self, name: str) -> int:
        """The other one for what moves."""
        moving = name.removesuffix("_dot").removesuffix("_ddot") in self.moving
        return self.again if moving else self.seed


def _independent(arm: Mechanics) -> bool:
    """Whether the columns of Y_b are, over enough motions of the arm."""
    rows: list[list[Number]] = []
    columns = len(arm.asked.result("base_parameters"))
    seed = 100
    while len(rows) < columns + arm.n:
        place = Motion(seed, arm)
        rows += place.matrix(arm.asked.result("Y_b"))
        seed += 1
    return rank(rows) == columns
