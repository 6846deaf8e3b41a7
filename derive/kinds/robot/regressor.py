"""The torques as a linear function of masses, moments and frictions: the regressor and its parameters."""

from __future__ import annotations

import operator
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from dataclasses import replace as with_field
from functools import partial
from math import ceil

from derive.algebra.normal import normal, normal_matrix
from derive.algebra.numbers.floats import Point, number, number_rows, numbers
from derive.algebra.scalar import Scalar
from derive.derivation import Derivation, PageFacts, Phrase, Step, Table, as_matrix
from derive.expression import (
    ZERO,
    Expr,
    Matrix,
    Relation,
    Symbol,
    children,
    column,
    replace,
    symbols,
)
from derive.kinds.checks import random_points, route
from derive.kinds.fields import TREES, Evaluation, OptionsModel
from derive.kinds.meanings import Names, column_of, told
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import chain_of
from derive.kinds.robot._dynamics.arm import Arm
from derive.kinds.robot._dynamics.bodies import weighted
from derive.kinds.robot._dynamics.matrix_laws import regressor_laws
from derive.kinds.robot._dynamics.regressor import (
    Base,
    Standard,
    base_parameters,
    dependent,
    has_zeros,
    referred_to,
    standard_parameters,
)
from derive.kinds.robot._dynamics.regressor_lines import (
    column_name,
    equal_ones,
    gathered_by,
    made_of_others,
    table_of,
    typed_name,
)
from derive.kinds.robot._dynamics.vast_regressor import MOST_PRINTED, Columns, in_numbers, terms_of
from derive.kinds.robot._families import of_each, said_of_each
from derive.kinds.work import Work
from derive.mechanics.regressor import ELEMENTS, MOMENTS, NAMES
from derive.mechanics.robot import Robot

CLAIMED = {"groups": "motion-of-each-body", "names": "motion-of-each-body"}
INTRODUCED = r"(M|M[XYZ]|[XYZ]{2}|IA|F[VS])_\d+"  # the parameters of a body

NEEDS = ("bodies",)
CLAIMS = ("motion-of-each-body", "smallest")
COLUMNS = {"IA": "column-IA", "FV": "column-FV", "FS": "column-FS"}
ABOUT = {
    "before": "about-before", "own": "about-own", "either": "about-either", "axis": "about-axis",
}  # fmt: skip
THETA, THETA_B = symbols("Theta Theta_b")
LONG = 3_000  # terms of all columns, of an arm whose inertia matrix certainly fills pages
PRODUCTS = (("Y", "parameters"), ("Y_b", "base_parameters"))
INDEPENDENT = 1e-8  # the smallest singular value, relative to the largest


class Options(OptionsModel):
    """`evaluate`: a motion, where the regressor is wanted in numbers too."""

    evaluate: Evaluation = None


class Facts(PageFacts):
    table: Table
    all: int
    smallest: int
    mass: Expr  # of a link i, as its moments and elements
    moments: tuple[Expr, ...]
    elements: tuple[Expr, ...]
    about: Phrase  # the points that these refer to
    others: tuple[Phrase, ...]  # that belong to no body
    zeros: bool  # whether some of a body are zero, and are left out as known to be so
    terms: int | None = None  # of all columns, where there are too many to be printed
    there: bool = False  # whether they are given in numbers
    alike: Phrase | None  # parameters of the smallest set that are equal, by the values given here


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """tau = Y(q, qdot, qddot) Theta (Spong et al., section 6.5.3; Khalil and Dombre, section 9.4). One that
    would fill pages is given in numbers, under `evaluate`.

    Raises NotDerivable where a body or the friction of a joint changes with a joint variable.
    """
    parameters = standard_parameters(problem)
    if terms_of(parameters) <= MOST_PRINTED:
        return _in_symbols(robot, problem, parameters)
    base = base_parameters(parameters, made_of := dependent(problem, parameters))
    columns = {"Y": Columns(parameters), "Y_b": Columns(base)}
    answer = _parameters_alone(robot, problem, Found(parameters, base, made_of), columns)
    if options.evaluate is None:
        return answer
    facts = with_field(answer.told(Facts), there=True)
    return with_field(in_numbers(answer, problem, options.evaluate, columns), facts=facts)


@dataclass(frozen=True)
class Found:
    """All parameters, the smallest set, and what the others are made of."""

    parameters: Sequence[Standard]
    base: Sequence[Base]
    made_of: Mapping[int, Mapping[int, Scalar]]


def _parameters_alone(
    robot: Robot, problem: Problem, found: Found, columns: Mapping[str, Columns]
) -> Derivation:
    """The parameters and their groups; of the columns it is held in numbers that they make the torques."""
    arm, parameters, moments = Arm(problem), found.parameters, _moments(problem)

    def final(value: Scalar) -> Expr:
        return problem.final(problem.readable(value), moments)

    values: dict[Expr, Expr] = {part.name: final(part.value) for part in parameters}
    theta: dict[Expr, Expr] = {each.name: final(each.value) for each in found.base}
    gathered = [gathered_by(problem, each, theta[each.name]) for each in found.base]
    lost = [made_of_others(problem, parameters, j, weights) for j, weights in found.made_of.items()]
    work = Work(problem, aside=moments).knowing({**values, **theta})
    law, by_columns = regressor_laws()
    work = work.showing(law, *lost, *gathered, by_columns).linked(but=[step.name for step in lost])
    results: dict[str, Expr] = {
        "parameters": problem.final(column(values.values())),
        "base_parameters": problem.final(column(theta.values())),
        "names": column(map(typed_name, values)),
        "groups": column(typed_name(step.chain[1]) for step in gathered),
    }
    if lost:
        means = partial(columns["Y"].by_name, [column_name(part.name) for part in parameters])
        work = work.claim(told([step.chain for step in lost], means, arm.moving, problem.where, "dependent"))
    others = [part for part in parameters if part.name.base not in NAMES]
    if others:
        work = work.law("of-their-joints", (_moves_its_joint(robot, part) for part in others))
    for Y, name in PRODUCTS:
        ours = partial(columns[Y].torques, results[name])
        work = work.agrees("motion-of-each-body", arm.moving, ours, arm.rubbing.torques, Y=Y, theta=name)
    work = _told_equal(work, found.base, theta)
    work = work.claim(route("smallest", columns["Y_b"].independent(arm)))
    facts = _facts(problem, parameters, found.base, values, terms_of(parameters))
    work = work.law("listed", _lists(facts.table, results))
    return work.answer("regressor", results, facts)


def _moments(problem: Problem) -> dict[Expr, Expr]:
    """The names of shapes' moments, and what they stand for."""
    bodies = weighted(problem, chain_of(problem))
    return {name: value for body in bodies for name, value in body.named.items()}


def _in_symbols(robot: Robot, problem: Problem, parameters: Sequence[Standard]) -> Derivation:
    """With every column."""
    arm, moments = Arm(problem), _moments(problem)
    long = terms_of(parameters) > LONG or arm.long
    made_of = dependent(problem, parameters)
    base = base_parameters(parameters, made_of)

    def final(value: Scalar) -> Expr:
        return problem.final(problem.readable(value), moments)

    values: dict[Expr, Expr] = {part.name: final(part.value) for part in parameters}
    theta: dict[Expr, Expr] = {each.name: final(each.value) for each in base}
    gathered = [gathered_by(problem, each, theta[each.name]) for each in base]
    lost = [made_of_others(problem, parameters, j, weights) for j, weights in made_of.items()]
    all_columns = [problem.readable_matrix(part.column) for part in parameters]
    columns = [each for j, each in enumerate(all_columns) if j not in made_of]
    work = Work(problem, aside=moments).knowing({**values, **theta})
    work = work.knowing({column_name(part.name): y for part, y in zip(parameters, all_columns, strict=True)})
    law, by_columns = regressor_laws()
    work = work.showing(law, *lost, *gathered, by_columns).linked(
        but=[step.name for step in lost] if long else ()
    )
    results: dict[str, Expr] = {
        "Y": problem.final(_beside(all_columns)),
        "parameters": problem.final(column(values.values())),
        "Y_b": problem.final(_beside(columns)),
        "base_parameters": problem.final(column(theta.values())),
        "names": column(map(typed_name, values)),
        "groups": column(typed_name(step.chain[1]) for step in gathered),
    }
    if not long:
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
    work = _told_equal(work, base, theta)
    work = work.claim(route("smallest", _is_smallest(arm, as_matrix(results["Y_b"], "Y_b"))))
    facts = _facts(problem, parameters, base, values)
    work = work.law("listed", _lists(facts.table, results))
    return work.answer("regressor", results, facts, matrices=frozenset({"Y", "Y_b"}))


def _told_equal(work: Work, base: Sequence[Base], theta: Mapping[Expr, Expr]) -> Work:
    """With the claim that those of the smallest set are equal of which that is said."""
    alike = tuple(equal_ones(work.problem, base))
    if not alike:
        return work
    return work.law("alike", (not normal(replace(one + -other, theta)) for one, other in alike))


def _facts(
    problem: Problem,
    parameters: Sequence[Standard],
    base: Sequence[Base],
    values: Mapping[Expr, Expr],
    terms: int | None = None,
) -> Facts:
    """Of a regressor that is not printed the `terms`."""
    others = [part for part in parameters if part.name.base not in NAMES]
    alike = tuple(Relation(one, "=", other) for one, other in equal_ones(problem, base))
    printed = () if terms else ("Y", "parameters", "Y_b", "base_parameters")
    return Facts(
        table=table_of(values),
        all=len(parameters),
        smallest=len(base),
        mass=of_each("M"),
        moments=tuple(map(of_each, MOMENTS)),
        elements=tuple(map(of_each, sorted(ELEMENTS))),
        about=Phrase(ABOUT[referred_to(problem)]),
        others=said_of_each(COLUMNS, (part.name for part in others)),
        zeros=has_zeros(problem),
        alike=_told_alike(alike) if alike else None,
        terms=terms,
        numbers=printed,
        page_names={"parameters": THETA, "base_parameters": THETA_B},
    )


def _lists(table: Table, results: Mapping[str, Expr]) -> bool:
    """Whether it has each parameter of the results beside its value."""
    rows = [(typed_name(name), value) for name, value in table.rows if isinstance(name, TREES)]
    names, values = (children(results[each]) for each in ("names", "parameters"))
    return rows == [*zip(names, values, strict=True)] and len(rows) == len(table.rows)


def _told_alike(alike: tuple[Relation, ...]) -> Phrase:
    """That they are, by the bodies given: of a single one that is zero, of others."""
    alone = len(alike) == 1 and alike[0].right == ZERO
    return Phrase("zero-here" if alone else "equal-here", {"equal": alike})


def _moves_its_joint(robot: Robot, part: Standard) -> bool:
    """Whether it is numbered by the row of the joint, the only one that it acts on."""
    row = int(number(part.name.lower[0], {}))
    own = robot.variables.index(robot.links[row - 1].variable or "")
    return [bool(entry) for entry in part.column.entries] == [k == own for k in range(len(robot.variables))]


def _is_smallest(arm: Arm, Y_b: Matrix) -> Iterator[bool]:
    """Whether no column of Y_b is a combination of the others: the rows of enough motions of one arm have
    full rank."""
    import numpy as np

    n, b = Y_b.shape
    points = [*random_points(arm.moving, 2 * ceil(b / n) + n)]
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


def _columns_at(parameters: Sequence[Standard], Y: Matrix, at: Point) -> Names:
    """The column of Y of each parameter in numbers."""
    columns = zip(*number_rows(Y, at), strict=True)
    return {column_name(part.name): column_of(each) for part, each in zip(parameters, columns, strict=True)}


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
