"""The linear and angular velocity of a point of an arm."""

from __future__ import annotations

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.numbers.floats import Point, numbers
from derive.algebra.scalar import Scalar
from derive.derivation import Derivation, PageFacts
from derive.expression import Expr, Matrix, Symbol, column, free_symbols, symbols
from derive.kinds.fields import OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import chain_of, oracle_of
from derive.kinds.robot._point import PointOn, tracked
from derive.kinds.robot._units import of_variables, together
from derive.kinds.work import Work
from derive.mechanics.jacobian import halves
from derive.mechanics.robot import Robot

CLAIMS = ("rate-of-the-point", "twist-in-numbers")
measures = together(of_variables, v="m/s", omega="rad/s")


DIFFERENCES = 1e-6  # what central differences leave
J, Q_DOT, V, OMEGA = symbols("J q_dot v omega")


class Options(OptionsModel):
    """Whose velocity is wanted."""

    point: PointOn | None = None
    """The point whose motion counts; that of the end-effector if left out."""


class Facts(PageFacts):
    rates: tuple[Symbol, ...]


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """v and omega (3 by 1 each, in the axes of the base), J qdot (Spong et al., eq. 4.49)."""
    rates = tuple(Symbol(f"{name}_dot") for name in robot.variables)
    work = Work(problem).resting_on(problem.ask("jacobian", point=options.point))
    work = work.knowing({Q_DOT: column(rates)})
    product = J * Q_DOT
    twist = work.value_matrix(product)
    v, omega = halves(twist)
    both = Matrix(((V,), (OMEGA,)))
    work = work.line(both, value=product, rule="velocity", label="twist")
    work = work.line(V, value=v, rule="velocity").line(OMEGA, value=omega, rule="velocity")
    work = work.closed(V).closed(OMEGA)
    work = work.law("rate-of-the-point", _by_chain_rule(options, problem) == v)
    results = {"v": work.final(V), "omega": work.final(OMEGA)}
    work = work.agrees(
        "twist-in-numbers",
        problem.symbols.union((rate.name for rate in rates), *map(free_symbols, _offset(options))),
        lambda at: [numbers(each, at) for each in results.values()],
        lambda at: _by_differences(options, problem, at),
        DIFFERENCES,
    )
    return work.answer("velocity", results, Facts(rates=rates))


def _offset(options: Options) -> tuple[Expr, ...]:
    return options.point.at if options.point else ()


def _by_differences(options: Options, problem: Problem, at: Point) -> list[float]:
    """v and omega (6) of J by differences of the poses."""
    point, robot = tracked(problem, chain_of(problem), options.point), problem.subject
    J_now = oracle_of(problem).jacobian(at, point.frame, point.offset)
    return [row @ [at[f"{name}_dot"] for name in robot.variables] for row in J_now]


def _by_chain_rule(options: Options, problem: Problem) -> ScalarMatrix:
    """do/dt (3 by 1) of the position of the point."""
    found = chain_of(problem)
    position = tracked(problem, found, options.point).position
    total = ScalarMatrix.zeros(3, 1)
    for name in found.variables:
        total = total + position.diff(name).scaled(Scalar.symbol(f"{name}_dot"))
    return total
