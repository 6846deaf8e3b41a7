"""The torques as a linear function of masses, moments and frictions: the regressor and its parameters."""

from __future__ import annotations

import operator
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from functools import partial

from derive.algebra.infix import text
from derive.algebra.normal import normal, normal_matrix
from derive.algebra.numbers.floats import Point, number, number_rows, numbers
from derive.algebra.rationals import significant_digits
from derive.algebra.scalar import Scalar
from derive.derivation import Derivation, PageFacts, Phrase, Step, Table, as_matrix
from derive.expression import (
    Approximate,
    Expr,
    Indexed,
    Matrix,
    Measured,
    Relation,
    Symbol,
    add,
    children,
    column,
    multiply,
    replace,
    walk,
)
from derive.kinds.checks import random_points, route
from derive.kinds.fields import NoOptions as Options
from derive.kinds.meanings import Names, column_of, told
from derive.kinds.problem import Problem
from derive.kinds.robot._dynamics.arm import Arm
from derive.kinds.robot._dynamics.matrix_laws import regressor_laws
from derive.kinds.robot._dynamics.regressor import (
    Base,
    Standard,
    base_parameters,
    dependent,
    referred_to,
    standard_parameters,
)
from derive.kinds.robot._families import of_each, said_of_each
from derive.kinds.work import Work
from derive.mechanics.regressor import ELEMENTS, MOMENTS, NAMES
from derive.mechanics.robot import Robot

CLAIMED = {"groups": "motion-of-each-body", "names": "motion-of-each-body"}

NEEDS = ("bodies",)
CLAIMS = ("motion-of-each-body", "smallest")
COLUMNS = {"IA": "column-IA", "FV": "column-FV", "FS": "column-FS"}
ABOUT = {
    "before": "about-before", "own": "about-own", "either": "about-either", "axis": "about-axis",
}  # fmt: skip
PRODUCTS = (("Y", "parameters"), ("Y_b", "base_parameters"))
UNITS = {"M": "kg", **dict.fromkeys(MOMENTS, "kg m")}  # of the parameters of bodies, and of what they gather
MOMENT = "kg m^2"  # of all the others
INDEPENDENT = 1e-8  # the smallest singular value, relative to the largest
MOST_DIGITS = 4  # of a decimal that is still written in full
LONGEST_NUMBER = 10**6  # denominator of a number that is still written in full


class Facts(PageFacts):
    table: Table
    all: int
    smallest: int
    mass: Expr  # of a link i, as its moments and elements
    moments: tuple[Expr, ...]
    elements: tuple[Expr, ...]
    about: Phrase  # the points that these refer to
    others: tuple[Phrase, ...]  # that belong to no body
    alike: Phrase | None  # parameters of the smallest set that are equal, by the values given here


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """tau = Y(q, qdot, qddot) Theta (Spong et al., section 6.5.3; Khalil and Dombre, section 9.4).

    Raises NotDerivable where a body or the friction of a joint changes with a joint variable.
    """
    arm, parameters = Arm(problem), standard_parameters(problem)
    made_of = dependent(problem, parameters)
    base = base_parameters(parameters, made_of)
    values: dict[Expr, Expr] = {part.name: arm.final(part.value) for part in parameters}
    theta: dict[Expr, Expr] = {each.name: arm.final(each.value) for each in base}
    gathered = [_gathered(problem, each, theta[each.name]) for each in base]
    lost = [_lost(problem, parameters, j, weights) for j, weights in made_of.items()]
    columns = [problem.readable_matrix(each.column) for each in base]
    all_columns = [problem.readable_matrix(part.column) for part in parameters]
    work = Work(problem, aside=arm.moments).knowing({**values, **theta})
    work = work.knowing({_y(part.name): y for part, y in zip(parameters, all_columns, strict=True)})
    law, by_columns = regressor_laws()
    work = work.showing(law, *lost, *gathered, by_columns).linked(
        but=[step.name for step in lost] if arm.long else ()
    )
    results: dict[str, Expr] = {
        "Y": problem.final(_beside(all_columns)),
        "parameters": problem.final(column(values.values())),
        "Y_b": problem.final(_beside(columns)),
        "base_parameters": problem.final(column(theta.values())),
        "names": column(map(_plain, values)),
        "groups": column(_plain(step.chain[1]) for step in gathered),
    }
    if not arm.long:
        shown = _columns(columns)
        work = work.law("columns", _are_columns(work, shown, as_matrix(results["Y_b"], "Y_b")))
        work = _linear(work.showing(*shown), results)
    elif lost:
        means = partial(_columns_at, parameters, as_matrix(results["Y"], "Y"))
        work = work.claim(told([step.chain for step in lost], means, arm.moving, problem.where, "dependent"))
    others = [part for part in parameters if part.name.base not in NAMES]
    if others:
        work = work.law("of-their-joints", (_moves_its_joint(robot, part) for part in others))
    for Y, name in PRODUCTS:
        ours = partial(_product, as_matrix(results[Y], Y), results[name])
        work = work.agrees("motion-of-each-body", arm.moving, ours, arm.rubbing.torques, Y=Y, theta=name)
    alike = tuple(_alike(problem, base))
    if alike:
        work = work.law("alike", (not normal(replace(one + -other, theta)) for one, other in alike))
    work = work.claim(route("smallest", _is_smallest(arm, as_matrix(results["Y_b"], "Y_b"))))
    facts = Facts(
        table=_table(values),
        all=len(parameters),
        smallest=len(base),
        mass=of_each("M"),
        moments=tuple(map(of_each, MOMENTS)),
        elements=tuple(map(of_each, sorted(ELEMENTS))),
        about=Phrase(ABOUT[referred_to(problem)]),
        others=said_of_each(COLUMNS, (part.name for part in others)),
        alike=Phrase("equal-here", {"equal": tuple(Relation(one, "=", other) for one, other in alike)})
        if alike
        else None,
        numbers=("Y", "parameters", "Y_b", "base_parameters"),
    )
    return work.answer("regressor", results, facts, matrices=frozenset({"Y", "Y_b"}))


def _moves_its_joint(robot: Robot, part: Standard) -> bool:
    """Whether it is numbered by the row of the joint, the only one that it acts on."""
    row = int(number(part.name.lower[0], {}))
    own = robot.variables.index(robot.links[row - 1].variable or "")
    return [bool(entry) for entry in part.column.entries] == [k == own for k in range(len(robot.variables))]


def _alike(problem: Problem, base: Sequence[Base]) -> Iterator[tuple[Expr, Expr]]:
    """Theta_2 and Theta_3, or Theta_3 and a multiple of Theta_2, where this arm has them equal:
    each beside the first that it goes with. Of numbers all are, and none is told."""
    first: list[Base] = []
    for each in (each for each in base if each.value.constant is None):
        ratios = (((each.value / other.value).constant, other) for other in first)
        ratio, other = next(((ratio, other) for ratio, other in ratios if ratio is not None), (None, None))
        if other is None or ratio is None:
            first.append(each)
        else:
            yield (
                (other.name, each.name)
                if ratio == 1
                else (each.name, multiply(problem.readable(Scalar.of(ratio)), other.name))
            )


def _is_smallest(arm: Arm, Y_b: Matrix) -> Iterator[bool]:
    """Whether no column of Y_b is a combination of the others: the rows of enough motions of one arm have
    full rank."""
    import numpy as np

    points = [*random_points(arm.moving, 2 * len(Y_b.rows[0]))]
    varying = {f"{name}{dots}" for name in arm.variables for dots in ("", "_dot", "_ddot")}
    lengths = {name: value for name, value in points[0].items() if name not in varying}
    rows = np.array([row for at in points for row in number_rows(Y_b, {**at, **lengths})])
    values = np.linalg.svd(rows / np.abs(rows).max(axis=0), compute_uv=False)
    yield bool(values[-1] > INDEPENDENT * values[0])


def _linear(work: Work, results: Mapping[str, Expr]) -> Work:
    """Both products are tau."""
    tau = normal_matrix(work.problem.ask("dynamics").matrix("tau"))
    for Y, theta in PRODUCTS:
        work = work.law("linear", normal_matrix(results[Y] * results[theta]) == tau, Y=Y, theta=theta)
    return work


def _product(Y: Matrix, theta: Expr, at: Point) -> list[float]:
    """Y theta in numbers (n)."""
    values = numbers(theta, at)
    return [sum(map(operator.mul, row, values)) for row in number_rows(Y, at)]


def _y(name: Indexed) -> Indexed:
    """The column of a parameter."""
    return Indexed("y", (name,))


def _columns_at(parameters: Sequence[Standard], Y: Matrix, at: Point) -> Names:
    """The column of Y of each parameter in numbers."""
    columns = zip(*number_rows(Y, at), strict=True)
    return {_y(part.name): column_of(each) for part, each in zip(parameters, columns, strict=True)}


def _gathered(problem: Problem, each: Base, value: Expr) -> Step:
    """Theta_1 = ZZ_1 + a1^2 M_2 = its value, rounded where that is a long number."""
    sum_of = add(*(multiply(problem.readable(weight), name) for name, weight in each.parts))
    constant = each.value.constant
    long = constant is not None and _is_long(constant)
    shown = Approximate(float(constant)) if long and constant is not None else value
    if constant is not None and problem.style.units:
        shown = Measured(shown, UNITS.get(each.parts[0][0].base, MOMENT))
    return Step(each.name.name, (each.name, sum_of, shown), "base-parameter")


def _is_long(value: Fraction) -> bool:
    """Whether a number is rounded where it is said."""
    return value.denominator > LONGEST_NUMBER or (significant_digits(value) or 0) > MOST_DIGITS


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


def _columns(columns: Sequence[Matrix]) -> tuple[Step, ...]:
    """The columns of Y_b."""
    named = ((Symbol(f"y_{k}"), each) for k, each in enumerate(columns, 1))
    return tuple(Step(name.name, (name, each), "column", spare=(each,)) for name, each in named)


def _are_columns(work: Work, shown: Sequence[Step], Y_b: Matrix) -> Iterator[bool]:
    """Whether each column as it is shown is that of Y_b."""
    for step, entries in zip(shown, zip(*Y_b.rows, strict=True), strict=True):
        yield normal_matrix(step.result, work.problem.names) == normal_matrix(column(entries))


def _beside(columns: Sequence[Matrix]) -> Matrix:
    return Matrix(tuple(zip(*(children(each) for each in columns), strict=True)))


def _table(values: Mapping[Expr, Expr]) -> Table:
    """Every parameter and its value."""
    return Table((Phrase("parameter"), Phrase("value")), tuple(values.items()))
