"""A function and its constraints in numbers: slopes and curvatures by differences, nothing by a rule."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

from flint import arb, ctx

from derive.algebra.ball_arithmetic import BITS, precise, slope
from derive.algebra.function import Function
from derive.algebra.numbers.floats import Point, number
from derive.errors import NotReal
from derive.expression import Expr, Symbol, replace_all
from derive.kinds.problem import Problem

if TYPE_CHECKING:
    from numpy.typing import NDArray

Lie: TypeAlias = Literal["maximum", "minimum", "saddle", "undecided", "isolated", "singular"]
FLAT = 1e-6  # of the largest curvature, or of the largest gradient
CLOSER = 25  # steps towards the constraints


@dataclass(frozen=True, slots=True)
class Landscape:
    """f of the variables, and what vanishes on the constraints; names of `where` are put in."""

    variables: tuple[str, ...]
    f: Expr
    g: tuple[Expr, ...]

    @staticmethod
    def of(function: Function, problem: Problem) -> Landscape:
        names: dict[Expr, Expr] = {Symbol(name): value for name, value in problem.where.items()}

        def plain(tree: Expr) -> Expr:
            return replace_all(tree, names)

        constraints = tuple(plain(c.left) - plain(c.right) for c in function.constraints)
        return Landscape(function.variables, plain(function.values[0]), constraints)

    def gradient(self, tree: Expr, at: Point, names: Sequence[str] | None = None) -> NDArray[Any]:
        """By the variables, or by other names."""
        import numpy as np

        with ctx.workprec(BITS):
            point = {name: arb(value) for name, value in at.items()}
            return np.array([_float(_along(tree, name, point)) for name in names or self.variables])

    def curvature(self, tree: Expr, at: Point) -> NDArray[Any]:
        """The second derivatives by the variables."""
        import numpy as np

        with ctx.workprec(BITS):
            point = {name: arb(value) for name, value in at.items()}
            rows = [[_float(_twice(tree, x, y, point)) for y in self.variables] for x in self.variables]
            return np.array(rows)

    def border(self, at: Point) -> NDArray[Any]:
        """The gradients of the constraints, one a row."""
        import numpy as np

        rows = [self.gradient(each, at) for each in self.g]
        return np.array(rows).reshape(len(self.g), len(self.variables))

    def lie(self, at: Point) -> Lie:
        """What kind of point a stationary one is: by the curvature along the constraints, the eigenvalues of
        the second derivatives of f less the multipliers times g in the plane that touches them."""
        import numpy as np

        slopes, border = self.gradient(self.f, at), self.border(at)
        if self.g and np.linalg.matrix_rank(border, tol=FLAT * max(1.0, abs(border).max())) < len(self.g):
            return "singular"
        multipliers = np.linalg.lstsq(border.T, slopes, rcond=None)[0] if self.g else []
        whole = self.curvature(self.f, at)
        for factor, g in zip(multipliers, self.g, strict=True):
            whole = whole - factor * self.curvature(g, at)
        plane = np.linalg.svd(border)[2][len(self.g) :].T if self.g else np.eye(len(slopes))
        if plane.shape[1] == 0:
            return "isolated"
        values = np.linalg.eigvalsh(plane.T @ whole @ plane)
        flat = FLAT * max(abs(whole).max(), FLAT)
        up, down = values.max() > flat, values.min() < -flat
        if up and down:
            return "saddle"
        if (abs(values) <= flat).any():
            return "undecided"
        return "minimum" if up else "maximum"

    def is_stationary(self, at: Point) -> bool:
        """Whether the gradients are dependent there and the constraints hold."""
        import numpy as np

        on = all(abs(number(g, at)) < FLAT * (1 + max(map(abs, at.values())) ** 2) for g in self.g)
        rows = np.vstack([self.gradient(self.f, at)[None], self.border(at)])
        size = np.linalg.norm(rows, axis=1, keepdims=True)
        scaled = rows / np.maximum(size, FLAT)
        smallest = np.linalg.svd(scaled @ scaled.T, compute_uv=False)[-1] if len(rows) > 1 else size[0, 0]
        return on and bool(smallest < FLAT * (1 + max(map(abs, at.values()))) ** 2)

    def brought(self, at: Mapping[str, float]) -> dict[str, float] | None:
        """A place near by on the constraints; None where none is reached."""
        import numpy as np

        place = dict(at)
        for _ in range(CLOSER if self.g else 0):
            left = np.array([number(g, place) for g in self.g])
            step = np.linalg.pinv(self.border(place)) @ left
            place |= {x: place[x] - float(d) for x, d in zip(self.variables, step, strict=True)}
            if np.linalg.norm(step) < FLAT**2:
                break
        near = all(abs(number(g, place)) < FLAT for g in self.g)
        return place if near else None


def _along(tree: Expr, name: str, at: Mapping[str, arb]) -> arb:
    return slope(lambda x: precise(tree, {**at, name: x}), at[name])


def _twice(tree: Expr, x: str, y: str, at: Mapping[str, arb]) -> arb:
    return slope(lambda moved: _along(tree, x, {**at, y: moved}), at[y])


def _float(value: arb) -> float:
    if not value.is_finite():
        raise NotReal("the function is not real here")
    return float(value.mid())
