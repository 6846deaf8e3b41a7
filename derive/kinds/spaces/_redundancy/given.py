"""What a question about redundancy gives: the matrix, the velocity, and what its method needs."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import ClassVar, Literal

from pydantic import Field

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal, normal_matrix
from derive.algebra.numbers.floats import Point, number, scalar_number
from derive.algebra.scalar import Scalar
from derive.errors import NotDerivable, how_many
from derive.expression import ZERO, Expr, Matrix, column, free_symbols
from derive.kinds.fields import Evaluation, OptionsModel, Place, Quantity
from derive.kinds.problem import Problem
from derive.kinds.robot._point import PointOn
from derive.kinds.robot._velocity.task import RowName
from derive.kinds.spaces._linear_map import LinearMap, MapOptions, linear_map
from derive.mechanics.matrices import GivenMatrix
from derive.mechanics.robot import Robot

MOST = 12
STEP = 1e-6  # of a joint variable, for differences
Method = Literal[
    "least-norm", "weighted", "damped", "null-space", "task-priority", "extended", "within-limits"
]
NEEDS = {
    "weighted": "weights",
    "damped": "damping",
    "null-space": "gradient",
    "task-priority": "second",
    "extended": "second",
    "within-limits": "limits",
}


class Second(OptionsModel):
    """A second task, done as well as the first one allows."""

    rows: tuple[RowName, ...] = ()
    """Rows of the Jacobian of an arm."""
    point: PointOn | None = None
    """The point whose motion counts; that of the end-effector if left out."""
    task: tuple[Quantity, ...] = ()
    """Functions of the joint variables, in place of rows."""
    matrix: tuple[tuple[Quantity, ...], ...] = Field((), max_length=MOST)
    """The matrix of the second task, where the first one is given as such."""
    rate: tuple[Quantity, ...] = Field((), max_length=MOST)
    """What is wanted of each row; zero if left out."""


class Options(MapOptions):
    """The task, and by which rule the rates are chosen among all that do it; `evaluate` gives the
    configuration."""

    ONLY_WITH: ClassVar = {
        "weights": ("method", "weighted"),
        "damping": ("method", "damped"),
        "gradient": ("method", "null-space"),
        "limits": ("method", "within-limits"),
    }

    velocity: tuple[Quantity, ...] | None = Field(None, min_length=1, max_length=MOST)
    """The velocity that is wanted, an entry for each row; letters if left out."""
    method: Method = "least-norm"
    """By which rule the rates are chosen."""
    weights: tuple[Quantity, ...] | None = Field(None, min_length=1, max_length=MOST)
    """Of the method weighted: one for each joint."""
    damping: Quantity | None = None
    """Of the method damped: the factor that is squared before it stands beside J J^T."""
    gradient: tuple[Quantity, ...] | Quantity | None = None
    """Of the method null-space: an entry for each joint, or the function whose gradient it is."""
    second: Second | None = None
    """The second task of the methods task-priority and extended."""
    limits: tuple[Quantity, ...] | None = Field(None, min_length=1, max_length=MOST)
    """Of the method within-limits: the greatest rate of each joint."""
    evaluate: Evaluation = None


@dataclass(frozen=True)
class Given:
    """All of it, in trees as they were typed; `place` is the configuration without the velocities."""

    problem: Problem
    map: LinearMap
    options: Options
    velocity: Matrix
    place: Place
    second: LinearMap | None = None
    rate: Matrix | None = None

    @property
    def size(self) -> tuple[int, int]:
        """Rows and joints."""
        return self.map.J.shape

    def exact(self, tree: Expr) -> ScalarMatrix:
        """A matrix as typed, at the configuration."""
        return normal_matrix(tree, self.map.values)

    @property
    def trees(self) -> Iterator[Expr]:
        """What is typed beside the map."""
        yield self.velocity
        yield from (value for _, value in self.place)
        yield from self.options.weights or ()
        yield from self.options.limits or ()
        if self.options.damping is not None:
            yield self.options.damping
        gradient = self.options.gradient
        if gradient is not None:
            yield from gradient if isinstance(gradient, tuple) else (gradient,)
        if self.rate is not None:
            yield self.rate
        second = self.options.second
        yield from (entry for row in (second.matrix if second else ()) for entry in row)

    @property
    def symbols(self) -> frozenset[str]:
        """Every name without a value."""
        found = self.map.symbols | (self.second.symbols if self.second else frozenset())
        return found.union(*map(free_symbols, self.trees)) - self.map.at({}).keys()

    @property
    def nonzero(self) -> frozenset[str]:
        """Names that stand for no zero: those its author says are none, lengths of an arm, and weights."""
        said = self.problem.assumptions.items()
        found = frozenset(name for name, what in said if what in ("positive", "nonzero"))
        found = found.union(*map(free_symbols, self.options.weights or ()))
        return found if self.map.sort == "matrix" else found | (self.map.symbols - {*self.map.variables})

    @property
    def gradient(self) -> tuple[Expr | None, Matrix]:
        """The function, where there is one, and the gradient (n by 1) as typed or differentiated."""
        typed = self.options.gradient
        if isinstance(typed, tuple):
            return None, column(typed)
        assert typed is not None
        found = normal(typed, self.problem.names)
        rows = ((self.problem.readable(found.diff(name)),) for name in self.map.variables)
        return typed, Matrix(tuple(rows))

    def slope(self, function: Expr, point: Point) -> list[float]:
        """The gradient of a function by differences."""

        def there(name: str, by: float) -> float:
            return number(function, {**point, name: point[name] + by})

        return [(there(q, STEP) - there(q, -STEP)) / (2 * STEP) for q in self.map.variables]

    def numbers(self, typed: tuple[Expr, ...], key: str) -> list[Fraction]:
        """Positive numbers, one for each joint. Raises NotDerivable."""
        try:
            found = [_fraction(normal(each, self.map.values)) for each in typed]
        except KeyError as error:
            raise NotDerivable(f"no value is known of {error.args[0]} in the {key}", key) from error
        if not all(each > 0 for each in found):
            raise NotDerivable(f"{key} are positive numbers", key)
        return found


def _fraction(value: Scalar) -> Fraction:
    """A number; one that is irrational, such as 120 deg, as a float has it. Raises KeyError."""
    exact = value.constant
    if exact is None:
        return Fraction(f"{scalar_number(value, {}):.15f}")
    return Fraction(int(exact.numerator), int(exact.denominator))


def given(subject: Robot | GivenMatrix, options: Options, problem: Problem) -> Given:
    """What a question gives. Raises NotDerivable for what is missing, does not fit or is not used."""
    values = dict(options.evaluate or ())
    start = linear_map(subject, options, problem)
    wanted = {each.name for each in start.velocities}
    place = tuple((name, value) for name, value in values.items() if name not in wanted)
    found = linear_map(subject, options.model_copy(update={"evaluate": place or None}), problem)
    m, n = found.J.shape
    _require_what_is_needed(options)
    _require_length(options.velocity, m, "velocity", "row")
    for key in ("weights", "limits"):
        _require_length(getattr(options, key), n, key, "joint")
    if isinstance(options.gradient, tuple):
        _require_length(options.gradient, n, "gradient", "joint")
    if options.velocity is not None and wanted & values.keys():
        raise NotDerivable("a velocity is given twice, by `velocity` and under evaluate", "velocity")
    velocity = options.velocity or tuple(values.get(each.name, each) for each in found.velocities)
    second, rate = _second(subject, options, place, problem, n)
    return Given(problem, found, options, column(velocity), place, second, rate)


def _require_what_is_needed(options: Options) -> None:
    needed = NEEDS.get(options.method)
    if needed and getattr(options, needed) is None:
        raise NotDerivable(f"the method {options.method} needs {needed}", "method")
    if options.second is not None and needed != "second":
        raise NotDerivable(f"`second` is not used by the method {options.method}", "second")


def _require_length(
    typed: tuple[Expr, ...] | None, size: int, key: str, what: str, further: str = ""
) -> None:
    if typed is not None and len(typed) != size:
        given = how_many(len(typed), "entry", "entries")
        raise NotDerivable(f"{given} for {how_many(size, what)}{further}; give one for each", key)


def _second(
    subject: Robot | GivenMatrix, options: Options, place: Place, problem: Problem, n: int
) -> tuple[LinearMap | None, Matrix | None]:
    """The map of the second task, and what is wanted of it."""
    second = options.second
    if second is None:
        return None, None
    asked = MapOptions(
        rows=second.rows, point=second.point, task=second.task, evaluate=place or None
    )  # fmt: skip
    if second.matrix:
        if {len(row) for row in second.matrix} != {n} or second.rows or second.task:
            raise NotDerivable(f"the second matrix has {n} columns, and stands alone", "second")
        subject = GivenMatrix(Matrix(second.matrix), getattr(subject, "variables", ()))
        asked = MapOptions(evaluate=place or None)
    elif not second.rows and not second.task:
        raise NotDerivable("the second task needs rows, functions or a matrix", "second")
    found = linear_map(subject, asked, problem)
    rate = second.rate or (ZERO,) * found.J.shape[0]
    _require_length(rate, found.J.shape[0], "second", "row", " of the second task")
    return found, column(rate)
