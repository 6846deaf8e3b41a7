"""The torques as a linear function of masses, moments and frictions: the regressor and its parameters."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from derive.algebra.infix import text
from derive.algebra.normal import normal_matrix
from derive.algebra.numbers import floats as numeric
from derive.algebra.readable.operation_count import operations
from derive.algebra.scalar import Scalar
from derive.derivation import Claim, Derivation, PageFacts, Phrase, Step, Table
from derive.expression import (
    Approximate,
    Expr,
    Indexed,
    Matrix,
    Product,
    Symbol,
    add,
    children,
    column,
    multiply,
    replace,
    walk,
)
from derive.kinds.checks import agreement, law, links
from derive.kinds.fields import NoOptions as Options
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import matrix_of, moment_names, oracle_of
from derive.kinds.robot._dynamics.rates import is_long, rated
from derive.kinds.robot._dynamics.regressor import (
    Base,
    Standard,
    base_parameters,
    dependent,
    standard_parameters,
)
from derive.mechanics.robot import Robot

RESULTS = {
    "Y": "the regressor of all parameters that act (n by p): tau = Y parameters",
    "parameters": "their values (p): of each link ZZ, XX, XY, XZ, YZ, MX, MY, YY, MZ, M, IA; then FV, FS",
    "Y_b": "the regressor of the smallest set (n by b): tau = Y_b base_parameters",
    "base_parameters": "the values of the smallest set (b)",
    "names": "the names of `parameters`, as ZZ_1 (p)",
    "groups": "what each of the smallest set gathers, as ZZ_1 + a1^2*M_2 (b)",
}
NEEDS = ("bodies",)
EXAMPLE = """\
title: The regressor of a planar arm
problems:
- robot:
    gravity: [0, -g, 0]
    links:
    - {theta: theta1*, d: 0, a: l1, alpha: 0, mass: m1, com: [l_c1 - l1, 0, 0], inertia: [0, 0, I1]}
    - {theta: theta2*, d: 0, a: l2, alpha: 0, mass: m2, com: [l_c2 - l2, 0, 0], inertia: [0, 0, I2]}
  find: regressor
"""
LONGEST_COLUMN = 30  # operations of a column of Y that is still shown
MOST_LISTED = 20  # parameters
LONGEST_NUMBER = 10**6  # denominator of a number that is still written in full


class Facts(PageFacts):
    table: Table | None
    all: int
    smallest: int
    rotors: bool
    friction: bool


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """tau = Y(q, qdot, qddot) Theta (Spong et al., section 6.5.3; Khalil and Dombre, section 9.4)."""
    inertia = problem.ask("inertia-matrix")
    named, big = moment_names(inertia), is_long(problem)
    parameters = standard_parameters(problem)
    made_of = dependent(problem, parameters)
    base = base_parameters(parameters, made_of)
    values: dict[Expr, Expr] = {part.name: _final(problem, part.value, named) for part in parameters}
    theta: dict[Expr, Expr] = {each.name: _final(problem, each.value, named) for each in base}
    gathered = tuple(_gathered(problem, each, theta[each.name]) for each in base)
    lost = tuple(_lost(problem, parameters, j, weights) for j, weights in made_of.items())
    columns = {each.name: problem.readable_matrix(each.column) for each in base}
    shown = () if big else _columns(columns)
    results: dict[str, Expr] = {
        "Y": _beside([problem.readable_matrix(part.column) for part in parameters]),
        "parameters": column(values.values()),
        "Y_b": _beside(list(columns.values())),
        "base_parameters": column(theta.values()),
    }
    results = {name: problem.final(value) for name, value in results.items()}
    results |= {
        "names": column(map(_plain, values)),
        "groups": column(_plain(step.chain[1]) for step in gathered),
    }
    definitions = {**values, **theta}
    definitions |= {_y(part.name): problem.readable_matrix(part.column) for part in parameters}
    claims = (
        *links(gathered if big else (*lost, *gathered), {**problem.names, **definitions, **named}),
        *(() if big else _laws(problem, results)),
        *_second_routes(problem, results),
    )
    return Derivation(
        "regressor",
        (*lost, *gathered, *shown),
        results,
        claims,
        definitions,
        facts=Facts(
            table=_table(values),
            all=len(parameters),
            smallest=len(base),
            rotors=any(part.name.base == "IA" for part in parameters),
            friction=any(part.name.base in ("FV", "FS") for part in parameters),
            numbers=("Y", "parameters", "Y_b", "base_parameters"),
        ),
        matrices=frozenset({"Y", "Y_b"}),
    )


def _final(problem: Problem, value: Scalar, named: Mapping[Expr, Expr]) -> Expr:
    return problem.final(problem.readable(value), named)


def _y(name: Indexed) -> Indexed:
    """The column of a parameter."""
    return Indexed("y", (name,))


def _gathered(problem: Problem, each: Base, value: Expr) -> Step:
    """Theta_1 = ZZ_1 + a1^2 M_2 = its value, rounded where that is a long number."""
    sum_of = add(*(multiply(problem.readable(weight), name) for name, weight in each.parts))
    constant = each.value.constant
    long = constant is not None and constant.denominator > LONGEST_NUMBER
    shown = Approximate(float(constant)) if long and constant is not None else value
    return Step(each.name.name, (each.name, sum_of, shown), "base-parameter")


def _plain(expr: Expr) -> Expr:
    """With names that can be typed, ZZ_1, in place of those with an index."""
    names: dict[Expr, Expr] = {
        node: Symbol(f"{node.base}_{text(node.lower[0])}") for node in walk(expr) if isinstance(node, Indexed)
    }
    return replace(expr, names)


def _lost(problem: Problem, parameters: Sequence[Standard], j: int, weights: Mapping[int, Scalar]) -> Step:
    """y_M2 = a1^2 y_ZZ1 + a1 y_MX1."""
    name = _y(parameters[j].name)
    terms = (multiply(problem.readable(weight), _y(parameters[i].name)) for i, weight in weights.items())
    return Step(f"y_{j + 1}_dependent", (name, add(*terms)), "dependent")


def _columns(columns: Mapping[Symbol, Matrix]) -> tuple[Step, ...]:
    """The columns of Y_b, none where one of them is long."""
    if any(sum(map(operations, children(value))) > LONGEST_COLUMN for value in columns.values()):
        return ()
    named = ((Symbol(f"y_{k}"), value) for k, value in enumerate(columns.values(), 1))
    return tuple(Step(name.name, (name, value), "column") for name, value in named)


def _beside(columns: Sequence[Matrix]) -> Matrix:
    return Matrix(tuple(zip(*(children(each) for each in columns), strict=True)))


def _table(values: Mapping[Expr, Expr]) -> Table | None:
    """Every parameter and its value, where they are not too many."""
    return (
        Table((Phrase("parameter"), Phrase("value")), tuple(values.items()))
        if len(values) <= MOST_LISTED
        else None
    )


def _laws(problem: Problem, results: Mapping[str, Expr]) -> tuple[Claim, ...]:
    """Both products are tau."""
    tau = normal_matrix(matrix_of(problem.ask("dynamics"), "tau"))
    pairs = (("Y", "parameters"), ("Y_b", "base_parameters"))
    return tuple(
        law("linear", normal_matrix(Product((results[Y], results[theta]))) == tau, Y=Y, theta=theta)
        for Y, theta in pairs
    )


def _second_routes(problem: Problem, results: Mapping[str, Expr]) -> tuple[Claim, ...]:
    """Both products against Newton and Euler."""
    arm = oracle_of(problem)

    def product(Y: str, theta: str) -> Claim:
        def ours(at: Mapping[str, float]) -> list[float]:
            import numpy as np

            whole = arm.at(at)
            found = np.array(numeric.numbers(results[Y], whole)) @ numeric.numbers(results[theta], whole)
            return [float(entry) for entry in found]

        return agreement("motion-of-each-body", rated(problem), ours, arm.torques, Y=Y, theta=theta)

    return product("Y", "parameters"), product("Y_b", "base_parameters")
