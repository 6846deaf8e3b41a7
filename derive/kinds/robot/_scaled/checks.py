"""A scaled motion held to the bodies in numbers: joints by the conditions at both ends or by differences, and
torques by the motion of each body, of the slower motion too."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import isclose
from typing import TYPE_CHECKING, Any

from derive.algebra.numbers.floats import number, numbers
from derive.derivation import Result
from derive.expression import Expr, Matrix, Symbol, squared
from derive.kinds.checks import close
from derive.kinds.fields import TREES
from derive.kinds.meanings import column_of, farthest
from derive.kinds.path._timing import T as MOMENT
from derive.kinds.robot._chain import oracle_of
from derive.kinds.robot._scaled.demands import Demands
from derive.kinds.robot._scaled.told import JUST, Told
from derive.mechanics import shapes
from derive.mechanics.course import at

if TYPE_CHECKING:
    from numpy.typing import NDArray

SHARES = (0.07, 0.31, 0.58, 0.93)  # of the whole time
GRID = 48  # moments at which the slower motion is looked at
NEAR, LOOSE, BOUND = 1e-7, 1e-4, 1e-6
STEP = 1e-3  # of the whole time, for differences


class Moved:
    """The motion in numbers, by another route than its polynomials or derivatives, `k` times as long."""

    def __init__(self, demands: Demands, k: float = 1.0) -> None:
        self.demands, self.k = demands, k
        self.plan, self.point, self.whole = demands.plan, demands.point, demands.whole

    def joints(self, t: float) -> NDArray[Any]:
        """Joint variables, rates and accelerations (3 by n) at a time of the original motion."""
        import numpy as np

        plan = self.plan
        if plan.law is not None:
            (_, first), (_, last) = plan.given[:2]
            ends = [np.array(numbers(each, self.point)).ravel() for each in (first, last)]
            course = shapes.course(plan.law, 1.0, self.whole)
            parts = [at(course, t, order) for order in range(3)]
            way = ends[1] - ends[0]
            return np.array([ends[0] + parts[0] * way, parts[1] * way, parts[2] * way])
        h = STEP * self.whole
        a, b, c, d, e = (self._typed(t + by * h) for by in (-2, -1, 0, 1, 2))
        return np.array(
            [c, (a - 8 * b + 8 * d - e) / (12 * h), (-a + 16 * b - 30 * c + 16 * d - e) / (12 * h * h)]
        )

    def _typed(self, t: float) -> NDArray[Any]:
        import numpy as np

        there = {**self.point, MOMENT.name: t}
        return np.array([number(entry, there) for (entry,) in self.plan.by_time[0].rows])

    def torques(self, t: float, still: bool = False) -> NDArray[Any]:
        """Of the motion of each body, or of gravity alone."""
        q, rates, rises = self.joints(t)
        names = self.plan.problem.subject.variables
        there: dict[str, float] = {**self.point, **dict(zip(names, map(float, q), strict=True))}
        there |= {f"{name}_dot": float(x) / self.k for name, x in zip(names, rates, strict=True)}
        there |= {f"{name}_ddot": float(x) / self.k**2 for name, x in zip(names, rises, strict=True)}
        oracle = oracle_of(self.plan.problem)
        found: NDArray[Any] = oracle.torques_at_rest(there) if still else oracle.torques(there)
        return found


def moves(demands: Demands) -> Iterator[bool]:
    """The lines of the motion, and the joints by the time."""
    plan, moved = demands.plan, Moved(demands)
    for share in SHARES:
        t = share * demands.whole
        q = moved.joints(t)
        names: dict[Expr, Any] = {Symbol(name): value for name, value in demands.point.items()}
        names |= {MOMENT: t, plan.T: demands.whole}
        names |= {
            name: column_of(numbers(tree, demands.point)) for name, tree in plan.given if name != plan.T
        }
        if plan.law is not None:
            course = shapes.course(plan.law, 1.0, demands.whole)
            names |= {step.chain[0]: at(course, t, order) for order, step in enumerate(plan.shares)}
        names |= {step.chain[0]: column_of(row) for step, row in zip(plan.joints, q, strict=True)}
        chains = [step.chain for step in (*plan.shares, *plan.joints)]
        yield farthest(chains, names) < LOOSE
        found = plan.at(t, demands.point)
        variables = plan.problem.subject.variables
        told = [[found[f"{name}{end}"] for name in variables] for end in ("", "_dot", "_ddot")]
        yield close(told, q, LOOSE)


def scales(demands: Demands, told: Told) -> Iterator[bool]:
    """Every line of one joint as it is written, at moments of the motion and of slower ones."""
    lines = {step.name: step.chain for step in told.steps}
    names, k = told.names, max(each.k for each in demands.peaks)
    whole: dict[Expr, Any] = {demands.plan.T: demands.whole, names.k: k, names.T_k: k * demands.whole}
    yield farthest([lines["factor"], lines["time"]], whole) < NEAR
    for share, slower in zip(SHARES, (0.8, 1.3, 2.0, 3.0), strict=True):
        t = share * demands.whole
        tau, g = Moved(demands).torques(t), Moved(demands).torques(t, still=True)
        after = Moved(demands, slower).torques(t)
        for i, most in enumerate(demands.most):
            at_joint: dict[Expr, Any] = {names.tau: tau[i], names.g: g[i], names.k: slower, names.most: most}
            yield farthest([lines["scaled"]], {**at_joint, names.new: after[i]}) < LOOSE
            needed = farthest([lines["needed"]], {**at_joint, names.k_i: _needed(demands, t, i)})
            yield needed < LOOSE


def _needed(demands: Demands, t: float, joint: int) -> float:
    """The factor in which the torque just reaches its limit, by halving."""
    low, high = 0.0, 1.0
    most = demands.most[joint]
    while abs(Moved(demands, high).torques(t)[joint]) > most:
        low, high = high, 2 * high
    for _ in range(40):
        middle = (low + high) / 2
        kept = middle > 0 and abs(Moved(demands, middle).torques(t)[joint]) <= most
        low, high = (low, middle) if kept else (middle, high)
    return high


def keeps(demands: Demands, told: Told) -> Iterator[bool]:
    """In the new time no torque is beyond its limit, and one just reaches it, at its first moment."""
    import numpy as np

    k = max(each.k for each in demands.peaks)
    moved, most = Moved(demands, k), np.array(demands.most)
    yield from (0 <= each.t <= demands.whole for each in demands.peaks)
    for place in range(GRID + 1):
        yield bool((abs(moved.torques(demands.whole * place / GRID)) <= most * (1 + LOOSE)).all())
    joint = told.active.about["joint"]
    yield told.greatest.about == ({"joint": joint} if len(most) > 1 else {})
    if isinstance(joint, int):
        reached = abs(moved.torques(demands.peaks[joint - 1].t)[joint - 1]) / most[joint - 1]
        yield isclose(reached, 1.0, rel_tol=LOOSE)
    else:
        yield False


def as_tabled(demands: Demands, told: Told, results: Mapping[str, Result]) -> Iterator[bool]:
    """Of each joint the torques at the moment that is told, and no greater factor at any other."""
    factors, moments = (_column(results[key]) for key in ("factors", "moments"))
    moved = Moved(demands)
    for i, row in enumerate(told.table.rows):
        place, t, tau, g, most, k = (number(cell, demands.point) for cell in row if isinstance(cell, TREES))
        yield place == i + 1 and isclose(k, factors[i]) and t == moments[i] and isclose(most, demands.most[i])
        yield close([tau, g], [moved.torques(t)[i], moved.torques(t, still=True)[i]], LOOSE)
        slower = Moved(demands, k) if k else None
        for part in range(GRID + 1):
            time = demands.whole * part / GRID
            beyond = abs((slower.torques(time) if slower else moved.torques(time, still=True))[i])
            yield bool(beyond <= most * (1 + LOOSE))
        yield slower is None or isclose(abs(slower.torques(t)[i]), most, rel_tol=LOOSE)
    for said in told.again:
        joint, times = said.about["joint"], said.about["times"]
        if not isinstance(joint, int) or not isinstance(times, tuple):
            raise TypeError("a joint and times are wanted")
        slower = Moved(demands, factors[joint - 1])
        for each in times:
            reached = abs(slower.torques(number(each, {}))[joint - 1]) if isinstance(each, TREES) else 0.0
            yield isclose(reached, demands.most[joint - 1], rel_tol=LOOSE)
            yield number(each, {}) > moments[joint - 1] if isinstance(each, TREES) else False


def as_drawn(demands: Demands, told: Told) -> Iterator[bool]:
    """The curves at some of their places."""
    k = max(each.k for each in demands.peaks)
    for plot, factor in zip(told.picture.plots, (1.0, k), strict=True):
        moved = Moved(demands, factor)
        curves = list(plot.series.values())
        yield len(curves) == len(demands.most)
        for place in range(0, len(curves[0][0]), 40):
            t = curves[0][0][place]
            shares = moved.torques(t / factor) / demands.most
            yield close([curve[1][place] for curve in curves], shares, LOOSE)


def right_words(demands: Demands, told: Told) -> Iterator[bool]:
    """Which joint needs most, whether the limits are kept, and by which law the joints go."""
    k = max(each.k for each in demands.peaks)
    torques = Moved(demands).torques
    times = [demands.whole * place / GRID for place in range(GRID + 1)] + [each.t for each in demands.peaks]
    beyond = max(float(max(abs(torques(t)) / demands.most)) for t in times)
    yield told.verdict.key == (
        "just-kept" if isclose(k, 1, rel_tol=JUST) else "not-kept" if k > 1 else "kept"
    )
    yield (beyond > 1 + BOUND) <= (told.verdict.key == "not-kept")
    yield (beyond < 1 - BOUND) <= (told.verdict.key == "kept")
    one = "-one" if len(torques(0.0)) == 1 else ""
    yield told.law.key == (f"by-{demands.plan.law}{one}" if demands.plan.law else "by-functions")
    yield (told.needs.key, told.greatest.key) == (f"needs{one}", f"greatest{one}")
    yield told.law.about.get("s") == (demands.plan.shares[0].chain[0] if demands.plan.law else None)
    k_name = told.names.k
    yield told.slower.about == {"k": k_name, "square": squared(k_name)}
    yield told.limit.about == {"most": told.names.most}


def _column(result: Result) -> list[float]:
    if not isinstance(result, Matrix):
        raise TypeError("a column is wanted")
    return [number(entry, {}) for (entry,) in result.rows]
