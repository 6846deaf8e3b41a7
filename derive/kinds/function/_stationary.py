"""The stationary points of a function, free or constrained, and what kind of point each is."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

from flint import arb, ctx

from derive.algebra.function import Function
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import Names, normal
from derive.algebra.scalar import Scalar
from derive.algebra.solving.polynomial_systems import BESIDE, Case, Solution, Value, put_in, solve
from derive.algebra.solving.polynomials import ball, known_sign, require_rational
from derive.algebra.solving.real_roots import BITS
from derive.errors import NotDerivable
from derive.expression import Symbol


@dataclass(frozen=True, slots=True)
class Task:
    """f and the constraints g = 0 in normal form, and everything that follows from them."""

    f: Scalar
    g: tuple[Scalar, ...]
    variables: tuple[str, ...]
    multipliers: tuple[str, ...]
    positive: frozenset[str]

    @staticmethod
    def of(
        function: Function, multipliers: Sequence[Symbol], names: Names, assumptions: Mapping[str, str]
    ) -> Task:
        """Raises NotDerivable for what is neither polynomial nor a fraction of polynomials."""
        f = normal(function.values[0], names)
        g = tuple(normal(c.left, names) - normal(c.right, names) for c in function.constraints)
        require_rational((f, *g), function.variables)
        positive = frozenset(name for name, what in assumptions.items() if what == "positive")
        letters = tuple(each.name for each in multipliers)
        return Task(f, g, function.variables, letters, positive)

    @property
    def lagrange(self) -> Scalar:
        """f - sum lambda_k g_k."""
        total = self.f
        for name, g in zip(self.multipliers, self.g, strict=True):
            total = total - Scalar.symbol(name) * g
        return total

    @property
    def gradients(self) -> ScalarMatrix:
        """Those of f and of every g, one a row."""
        return ScalarMatrix.of([h.diff(x) for x in self.variables] for h in (self.f, *self.g))

    def determinants(self) -> dict[tuple[int, ...], Scalar]:
        """By columns: the determinants that vanish where the gradients are linearly dependent."""
        rows, size = self.gradients, len(self.g) + 1
        return {k: rows.columns(*k).det() for k in combinations(range(len(self.variables)), size)}

    def candidates(self) -> Case:
        """Every point on the constraints at which the gradients are dependent."""
        return solve([*self.determinants().values(), *self.g], self.variables, self.positive)


@dataclass(frozen=True, slots=True)
class Point:
    """One point: the variables, the multipliers (none where the gradients of the constraints are
    dependent themselves), the value of f, and the minors that tell what it is.

    `kind`: "maximum", "minimum", "saddle", "undecided", "conditional" or "singular".
    """

    solution: Solution
    multipliers: tuple[Value, ...] | None
    value: Value
    minors: tuple[Value, ...] = ()
    kind: str = "undecided"

    @property
    def is_exact(self) -> bool:
        return all(isinstance(each, Scalar) for each in self.solution.values.values())


def is_flat_saddle(point: Point) -> bool:
    """Whether it rises along one direction, falls along another and is flat along a third."""
    return point.kind == "saddle" and _is_zero(point.minors[-1])


def points(task: Task, found: Case) -> tuple[Point, ...]:
    """The distinct ones, with what each of them is."""
    distinct: list[Solution] = []
    for solution in found.all_solutions():
        ordered = Solution(_ordered(solution.values, task.variables), solution.free, solution.real_if)
        fits = _defined(task, ordered) and _allowed(task, ordered)
        if fits and not any(_same(ordered, known) for known in distinct):
            distinct.append(ordered)
    return tuple(_point(task, solution) for solution in distinct)


def _ordered(values: Mapping[str, Value], names: Sequence[str]) -> dict[str, Value]:
    return {name: values[name] for name in names if name in values}


def _defined(task: Task, solution: Solution) -> bool:
    """Whether no denominator vanishes there."""
    bottoms = [Scalar(h.ring, h.denominator) for h in (task.f, *task.g) if h.denominator is not None]
    return not any(_is_zero(put_in(bottom, solution.values)) for bottom in bottoms)


def _allowed(task: Task, solution: Solution) -> bool:
    """Whether no variable declared positive is negative or zero there."""
    values = (solution.values.get(name) for name in task.variables if name in task.positive)
    return all(value is None or _sign(value, task.positive) in (1, None) for value in values)


def _same(left: Solution, right: Solution) -> bool:
    if left.values.keys() != right.values.keys():
        return False
    return all(_equal(left.values[name], right.values[name]) for name in left.values)


def _equal(a: Value, b: Value) -> bool:
    if isinstance(a, Scalar) and isinstance(b, Scalar):
        return a == b
    return isinstance(a, arb) and isinstance(b, arb) and bool(a.overlaps(b))


def _is_zero(value: Value) -> bool:
    return not value if isinstance(value, Scalar) else bool(value.contains(0))


def _point(task: Task, solution: Solution) -> Point:
    value = put_in(task.f, solution.values)
    gradients = [[put_in(entry, solution.values) for entry in row] for row in task.gradients.rows]
    chosen = _independent(gradients[1:])
    if chosen is None:
        return Point(solution, None, value, kind="singular")
    multipliers = _multipliers(gradients, chosen)
    at = {**solution.values, **dict(zip(task.multipliers, multipliers, strict=True))}
    rest = [k for k in range(len(task.variables)) if k not in chosen]
    minors = _minors(task, at, (*chosen, *rest))
    kind = classified(minors, len(task.g), task.positive)
    if kind == "undecided" and _rises_and_falls(task, at):
        kind = "saddle"
    return Point(solution, multipliers, value, minors, kind)


def _independent(rows: Sequence[Sequence[Value]]) -> tuple[int, ...] | None:
    """Columns in which the gradients of the constraints are independent."""
    if not rows:
        return ()
    for columns in combinations(range(len(rows[0])), len(rows)):
        if not _is_zero(_det([[row[k] for k in columns] for row in rows])):
            return columns
    return None


def _multipliers(gradients: Sequence[Sequence[Value]], columns: tuple[int, ...]) -> tuple[Value, ...]:
    """grad f = sum lambda_k grad g_k in those columns, by Cramer's rule."""
    f, *g = [[row[k] for k in columns] for row in gradients]
    whole = _det(g)
    found = [_det([f if i == k else row for i, row in enumerate(g)]) for k in range(len(g))]
    return tuple(_quotient(top, whole) for top in found)


def _quotient(top: Value, bottom: Value) -> Value:
    if isinstance(top, Scalar) and isinstance(bottom, Scalar):
        return top / bottom
    with ctx.workprec(BITS):
        return as_ball(top) / as_ball(bottom)


def _det(rows: Sequence[Sequence[Value]]) -> Value:
    """By the first row; the matrices here are small."""
    if not rows:
        return Scalar.of(1)
    if all(isinstance(entry, Scalar) for row in rows for entry in row):
        return ScalarMatrix.of(rows).det()
    with ctx.workprec(BITS):
        total = arb(0)
        for k, entry in enumerate(rows[0]):
            rest = _det([[e for j, e in enumerate(row) if j != k] for row in rows[1:]])
            term = as_ball(entry) * as_ball(rest)
            total = total - term if k % 2 else total + term
        return total


def as_ball(value: Value) -> arb:
    """The value as a ball. Raises NotDerivable where it holds parameters."""
    if isinstance(value, arb):
        return value
    try:
        return ball(value, {})
    except KeyError as error:
        raise NotDerivable(BESIDE) from error


def bordered_hessian(task: Task, order: Sequence[int] | None = None) -> ScalarMatrix:
    """[[0, dg/dx], [(dg/dx)^T, d^2 Lambda/dx^2]], the variables in this order."""
    names = [task.variables[k] for k in (order or range(len(task.variables)))]
    m = len(task.g)
    border = [[g.diff(x) for x in names] for g in task.g]
    inside = [[task.lagrange.diff(x).diff(y) for y in names] for x in names]
    top = [[Scalar.of(0)] * m + row for row in border]
    return ScalarMatrix.of([*top, *([row[k] for row in border] + inside[k] for k in range(len(names)))])


def _minors(task: Task, at: Mapping[str, Value], order: tuple[int, ...]) -> tuple[Value, ...]:
    """The leading principal minors of orders 2m + 1, ..., m + n at a point."""
    rows = [[put_in(entry, at) for entry in row] for row in bordered_hessian(task, order).rows]
    m, n = len(task.g), len(task.variables)
    return tuple(_det([row[:size] for row in rows[:size]]) for size in range(2 * m + 1, m + n + 1))


def classified(minors: Sequence[Value], m: int, positive: Collection[str] = ()) -> str:
    """By the signs of the minors (Magnus and Neudecker, chapter 7, section 13): all (-1)^m for a minimum;
    (-1)^(m + 1), (-1)^(m + 2), ... for a maximum; neither, the last one not zero, for a saddle."""
    signs = [_sign(minor, positive) for minor in minors]
    if not signs:
        return "isolated"
    if signs[-1] == 0:
        return "undecided"
    possible = [
        kind for kind, wanted in patterns(m, len(minors)).items()
        if all(sign in (want, None) for sign, want in zip(signs, wanted, strict=True))
    ]  # fmt: skip
    if not possible:
        return "saddle"
    return "conditional" if None in signs else possible[0]


def _rises_and_falls(task: Task, at: Mapping[str, Value]) -> bool:
    """Whether the second derivatives along the constraints have eigenvalues of both signs, some being zero.

    These are the roots of sum_j e_j (-x)^(n - j), all real, with e_j the sum of the bordered minors of j
    variables: by Descartes, as many are positive and negative as the coefficients change their sign.
    """
    rows = [[put_in(entry, at) for entry in row] for row in bordered_hessian(task).rows]
    m, n = len(task.g), len(task.variables)
    sums = [_sum_of_minors(rows, m, size) for size in range(m, n + 1)]
    signs = [_sign(each, task.positive) for each in sums]
    turned = [sign if sign is None or k % 2 == 0 else -sign for k, sign in enumerate(signs)]
    return _changes(signs) and _changes(turned)


def _sum_of_minors(rows: Sequence[Sequence[Value]], m: int, size: int) -> Value:
    """Of the border with every choice of so many variables."""
    places = ((*range(m), *kept) for kept in combinations(range(m, len(rows)), size))
    found = [_det([[rows[i][j] for j in place] for i in place]) for place in places]
    if all(isinstance(each, Scalar) for each in found):
        return sum((each for each in found if isinstance(each, Scalar)), Scalar.of(0))
    return sum(map(as_ball, found), arb(0))


def _changes(signs: Sequence[int | None]) -> bool:
    """Whether known signs differ."""
    return {1, -1} <= set(signs)


def patterns(m: int, count: int) -> dict[str, list[int]]:
    """The signs of the minors at a maximum and at a minimum."""
    return {
        "maximum": [(-1) ** (m + j) for j in range(1, count + 1)],
        "minimum": [(-1) ** m] * count,
    }


def _sign(value: Value, positive: Collection[str]) -> int | None:
    if isinstance(value, Scalar):
        return known_sign(value, positive)
    return 1 if value > 0 else -1 if value < 0 else 0
