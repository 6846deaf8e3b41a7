"""How evenly an arm moves and pushes in all directions: its measure and its ellipsoids."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice

from derive.algebra.numbers.arrays import arrays
from derive.algebra.numbers.floats import Point, number
from derive.algebra.roots_and_functions import root
from derive.algebra.scalar import Scalar
from derive.algebra.solving.factors import Factored
from derive.derivation import Derivation, PageFacts, Phrase, Record, Said, Step
from derive.errors import NotDerivable
from derive.expression import (
    Approximate,
    Call,
    Expr,
    Number,
    Power,
    Product,
    Symbol,
    is_negative,
    multiply,
    sqrt,
    transpose,
)
from derive.kinds.checks import close, random_points, route
from derive.kinds.fields import Evaluation, OptionsModel, Place
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import oracle_of
from derive.kinds.robot._degrees import in_degrees
from derive.kinds.robot._determinants import as_product, determinant, gram_determinant, natural, product_tree
from derive.kinds.robot._efforts import efforts
from derive.kinds.robot._lengths import unit_of_lengths
from derive.kinds.robot._point import PointOn
from derive.kinds.robot._singular.ways import seen_from_middle
from derive.kinds.robot._velocity.ellipsoid_laws import ellipsoid_laws
from derive.kinds.robot._velocity.ellipsoids import PointTold, at_point, decided, exactly, figure_of
from derive.kinds.robot._velocity.task import RowName, Task, task_of
from derive.kinds.sure import place as surely
from derive.kinds.work import Work
from derive.mechanics.minors import minors
from derive.mechanics.robot import Robot
from derive.mechanics.zeros import zeros

CLAIMED = {
    "axes": "eigenvectors",
    "directions": "eigenvectors",
    "force_axes": "force-axes",
    "force_directions": "force-axes",
}

DIFFERENCES, POINTS = 1e-6, 3
SIX = 6
SHORT = 12  # terms of all minors, whose squares may add up to something short
J, W = Symbol("J"), Symbol("w")

CLAIMS = ("singular-values|eigenvectors", "lines|said-of-the-axes", "rows-in-numbers|jacobian-here")


class Options(OptionsModel):
    """Which velocities count; `evaluate` gives the configuration of the ellipsoids."""

    rows: tuple[RowName, ...] = ()
    """The velocities that count."""
    point: PointOn | None = None
    """The point whose motion counts; that of the end-effector if left out."""
    evaluate: Evaluation = None


class General(Record):
    """What is said of all configurations."""

    rows: tuple[Symbol, ...]
    figure: Phrase
    efforts: Phrase  # of the joints
    measure: Phrase  # what w tells
    best: tuple[tuple[Expr, Expr], ...]
    mixed: Phrase | None  # velocities and angular velocities


class Facts(PageFacts):
    general: General | None = None
    here: PointTold | None = None
    w: tuple[Expr, Expr] | None = None  # there


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """w and the ellipsoids v^T (J J^T)^-1 v = 1 and F^T (J J^T) F = 1 (Siciliano et al., section 3.9;
    Yoshikawa, 1985).

    Raises NotDerivable where w is zero in every configuration.
    """
    if options.evaluate is not None:
        return _at_point(options, problem, options.evaluate)
    task = task_of(problem, options.rows, options.point)
    det, whole, w = _measure(task)
    work = _lines(task, whole, w).closed(W)
    work = work.agrees(
        "singular-values", task.symbols, work[W], lambda at: _singular_values(task, at), DIFFERENCES
    )
    printed = [step for step in work.steps if step.rule == "in-numbers"]
    points = islice(random_points(task.symbols, POINTS), POINTS)
    work = task.proved(work).claim(
        route("lines", (_holds(task, step, at) for at in points for step in printed))
    )
    best = _best(task, det)
    if best:
        work = work.claim(route("largest", _largest(task, best)))
    told = tuple(in_degrees(problem, *pair) for pair in best)
    facts = Facts(general=_general(task, told), numbers=("w",))
    return work.answer("manipulability", {"w": work[W]}, facts)


def _at_point(options: Options, problem: Problem, place: Place) -> Derivation:
    """The ellipsoids at a configuration, on top of the measure found once for all of them; the measure alone
    where symbols are left."""
    base = problem.answer("manipulability", options.model_copy(update={"evaluate": None}))
    task = task_of(problem, options.rows, options.point)
    if not decided(task, place):
        return base
    found = at_point(task, place, _compared(options, problem))
    w = base.scalar("w")
    size = number(w, found.place)
    shown = (W, exactly(problem, w, place) or Approximate(size))
    facts = Facts(here=found.told, w=shown, numbers=())
    here = found.place | surely({**problem.where, **dict(place)})
    told = close(number(shown[1], {}), _singular_values(task, here), DIFFERENCES)
    return (
        Work(problem, uses=(base,), steps=(found.step,))
        .claim(*found.claims, route("singular-values", told))
        .answer(
            "manipulability",
            {"w": w, **found.results},
            facts,
            evaluated={"w": size, **found.evaluated},
            plots=found.plots,
            units=_units(task, place),
        )
    )


def _compared(options: Options, problem: Problem) -> list[Place]:
    """The configurations of all questions about these velocities of this arm."""
    asked = [other for _, other in problem.questions if isinstance(other, Options)]
    return [
        each.evaluate
        for each in asked
        if each.evaluate and each.model_copy(update={"evaluate": options.evaluate}) == options
    ]


def _units(task: Task, place: Place) -> dict[Expr | Phrase, str]:
    """Those of semi-axes, for joints that turn by 1 rad/s and with 1 N m, and of w, in metres where lengths
    were typed so; none where joints slide, or where rows are about angular velocities."""
    turning = all(link.joint == "revolute" for link in task.problem.subject.links if link.variable)
    linear = all(row[0] == "v" for row in task.rows)
    if not (turning and linear and unit_of_lengths(task.problem, (value for _, value in place))):
        return {}
    size = min(len(task.rows), len(task.found.variables))
    return {Phrase("velocity"): "m/s", Phrase("force"): "N", W: "m" if size == 1 else f"m^{size}"}


def _measure(task: Task) -> tuple[Factored, Expr, Expr]:
    """det J, or det of the smaller of J J^T and J^T J, factored; the same and w as trees."""
    problem, variables = task.problem, task.found.variables
    if not task.square:
        return _of_minors(task)
    value = task.J.det() if len(task.rows) < SIX else seen_from_middle(task).det()
    det = natural(problem, value, variables)
    if not value:
        raise NotDerivable(_zero(task))
    return det, product_tree(problem, det), _absolute(problem, det)


def _zero(task: Task) -> str:
    return f"the rows {', '.join(task.rows)} are dependent in every configuration: w is zero"


def _of_minors(task: Task) -> tuple[Factored, Expr, Expr]:
    """By the squares of the minors; a rotation of the axes changes none of those of all six rows."""
    problem, variables = task.problem, task.found.variables
    J = task.J if len(task.rows) < SIX else seen_from_middle(task)
    values = [minor.value for minor in minors(J) if minor.value]
    if not values:
        raise NotDerivable(_zero(task))
    trees = (as_product(problem, value, variables) for value in values)
    whole = gram_determinant(problem, values, trees)
    if sum(len(value.numerator) for value in values) > SHORT:
        return Factored(Scalar.of(1), ()), whole, sqrt(whole)
    det = natural(problem, sum((value * value for value in values), Scalar.of(0)), variables)
    if all(power % 2 == 0 for _, power in det.factors) and (half := _root(problem, det)) is not None:
        return det, whole, half
    return det, whole, sqrt(whole)


def _root(problem: Problem, det: Factored) -> Expr | None:
    """The square root of a product of squares."""
    constant = root(det.constant)
    if constant.ring.roots:
        return None
    return _absolute(problem, Factored(constant, tuple((f, power // 2) for f, power in det.factors)))


def _absolute(problem: Problem, det: Factored) -> Expr:
    """|det|: what is positive by its nature, or known to be, stands outside."""
    tree = product_tree(problem, det)
    tree = -tree if is_negative(tree) else tree
    factors = tree.factors if isinstance(tree, Product) else (tree,)
    outside = tuple(f for f in factors if _positive(problem, f))
    inside = tuple(f for f in factors if f not in outside)
    return multiply(*outside, Call("abs", (multiply(*inside),))) if inside else tree


def _positive(problem: Problem, factor: Expr) -> bool:
    match factor:
        case Number(value):
            return value > 0
        case Power(_, Number(exponent)):
            return exponent % 2 == 0
        case Symbol(name):
            return problem.assumptions.get(name) in ("positive", "nonnegative")
    return False


def _lines(task: Task, det: Expr, w: Expr) -> Work:
    """J, its determinant or that of J J^T, and w."""
    thin = not (task.square or task.redundant)
    work, turned = task.board().showing(*ellipsoid_laws(thin)), transpose(J)
    gram = Product((J, turned) if task.square or task.redundant else (turned, J))
    size = sqrt(determinant(gram))
    if task.square:
        work = work.line(determinant(J), value=det, rule="determinant", label="det")
        return work.line(W, size, Call("abs", (determinant(J),)), value=w, rule="in-numbers")
    rule = "determinant" if len(task.rows) < SIX else "in-numbers"  # too long to be multiplied out again
    work = work.line(determinant(gram), value=det, rule=rule, label="det")
    return work.line(W, size, value=w, rule="in-numbers")


def _general(task: Task, best: tuple[tuple[Expr, Expr], ...]) -> General:
    figure = figure_of(task)
    size = Phrase("area" if figure.key == "ellipse" else "volume")
    about: dict[str, Said] = {
        "figure": figure, "size": size, "gram": J * transpose(J), "w": W, "J": J,
    }  # fmt: skip
    volume = Phrase("square" if task.square else "wide", about)
    return General(
        rows=task.velocities,
        figure=figure,
        efforts=efforts(task.problem.subject),
        measure=volume if task.square or task.redundant else Phrase("thin"),
        best=best,
        mixed=Phrase("mixed") if len({row[0] for row in task.rows}) > 1 else None,
    )


def _best(task: Task, det: Factored) -> tuple[tuple[Expr, Expr], ...]:
    """The values at which w is largest, where it depends on one angle alone and simply enough."""
    variables = [n for n in task.found.variables if any(f.diff(n) for f, _ in det.factors)]
    if not task.square or len(variables) != 1 or len(det.factors) != 1 or det.factors[0][1] != 1:
        return ()
    factor = det.factors[0][0]
    extremes = zeros(factor.diff(variables[0]), tuple(variables), task.problem.readable) or ()
    if not all(_flat(factor, variables[0]) for _ in extremes):
        return ()
    return tuple((Symbol(zero.variable), zero.value) for zero in extremes if zero.rule in ("sine", "cosine"))


def _flat(factor: Scalar, name: str) -> bool:
    """Whether it swings evenly about zero, so that both its extremes are equally far from it."""
    return factor.diff(name).diff(name) == -factor


def _holds(task: Task, step: Step, at: Point) -> bool:
    """Whether the expressions of a line have one value, with J by differences."""
    at = oracle_of(task.problem).at(at)
    first, *others = (arrays(each, {**at, J.name: task.numbers(at)}) for each in step.chain if each != W)
    return bool(others) and all(close(each, first, DIFFERENCES) for each in others)


def _largest(task: Task, best: tuple[tuple[Expr, Expr], ...]) -> Iterator[bool]:
    """Whether w is nowhere larger than at these values, and equally large at each of them."""
    for at in islice(random_points(task.symbols, POINTS), POINTS):
        there = [
            _singular_values(task, {**at, name.name: number(value, at)})
            for name, value in best
            if isinstance(name, Symbol)
        ]
        around = [
            _singular_values(task, {**at, name.name: 0.3 * k})
            for name, _ in best[:1]
            if isinstance(name, Symbol)
            for k in range(-11, 11)
        ]
        yield close(there, [max(there)] * len(there), DIFFERENCES)
        yield max(around) <= max(there) * (1 + DIFFERENCES)


def _singular_values(task: Task, at: Point) -> float:
    """Their product."""
    import numpy as np

    return float(np.prod(np.linalg.svd(task.numbers(at), compute_uv=False)))
