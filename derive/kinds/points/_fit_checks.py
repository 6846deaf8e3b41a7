"""A fit held to the points as they were given: every line and result in numbers, by routes of NumPy's own."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from derive.algebra.numbers.floats import completed, number
from derive.derivation import Claim, Phrase
from derive.expression import Expr, Product, Symbol, transpose
from derive.kinds.checks import close, route
from derive.kinds.meanings import Chain, farthest, valued
from derive.kinds.points._data import Facts
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.fitting import PointPairs, by_quaternion

if TYPE_CHECKING:
    from numpy.typing import NDArray

CLOSE = 1e-7
NEARLY = 1e-9
ONE = Symbol("I")
LEFT = ("something-left", "nothing-left")


@dataclass(frozen=True, slots=True)
class Pairs:
    """Points in two frames (m by 2 or 3 each), a row for each."""

    a: NDArray[Any]
    b: NDArray[Any]

    @staticmethod
    def of(pairs: PointPairs, problem: Problem) -> Pairs:
        import numpy as np

        known = completed({}, problem.where)
        a, b = (
            np.array([[number(x, known) for x in point] for point in points])
            for points in (pairs.source, pairs.target)
        )
        return Pairs(a, b)

    @property
    def centred(self) -> tuple[NDArray[Any], NDArray[Any]]:
        return self.a - self.a.mean(axis=0), self.b - self.b.mean(axis=0)

    def rms(self, R: NDArray[Any], p: NDArray[Any]) -> float:
        """The root mean square of |R a_i + p - b_i|."""
        gaps = self.a @ R.T + p - self.b
        return float((gaps**2).sum(axis=1).mean() ** 0.5)


def best_rotation(work: Work, facts: Facts, results: Mapping[str, Expr], pairs: Pairs) -> tuple[Claim, ...]:
    """Horn's rotation for every R; the factors of H, of which others would do too, by what they must be."""
    import numpy as np

    told = facts.svd
    if told is None:
        return ()
    X, Y = pairs.centred
    H = X.T @ Y
    R, mean_a, mean_b = np.array(by_quaternion(H.tolist())), pairs.a.mean(axis=0), pairs.b.mean(axis=0)
    p = mean_b - R @ mean_a
    names: dict[Expr, Any] = {
        **_names("X Y H R", X, Y, H, R), Symbol("rms"): pairs.rms(R, p), ONE: np.eye(len(H)),
        Symbol("a_m"): mean_a[:, None], Symbol("b_m"): mean_b[:, None], Symbol("p"): p[:, None],
    }  # fmt: skip
    for name in "USV":
        names[Symbol(name)] = valued(work[name], names)
    U, S, V = (names[Symbol(name)] for name in "USV")
    det = float(np.linalg.det(V @ U.T))
    names[Symbol("D")] = np.diag([*[1.0] * (len(H) - 1), float(np.sign(det))])
    turned = [told.turned] if told.turned else []
    apart = farthest([*_of_work(work), *_factors(), *_results(results), *turned], names)
    values = np.diag(S)
    ordered = bool((values >= -NEARLY).all() and (np.diff(values) <= NEARLY).all())
    flat = bool(values[-1] <= NEARLY * values[0])
    exact = names[Symbol("rms")] <= CLOSE * max(1.0, float(abs(pairs.b).max()))
    lying = {3: "best-in-a-plane", 2: "best-on-a-line"}[len(H)] if flat else "best-reflected"
    verdicts = (
        close(S, np.diag(values)) and ordered, (told.turned is None) == (det > 0),
        told.best.key == ("best-rotation" if det > 0 else lying),
        told.left.key in LEFT,
        told.mirrored == (Phrase("mirrored") if det < 0 and not flat else None),
        exact or told.left.key == LEFT[0],
    )  # fmt: skip
    return route("as-told", apart < CLOSE), route("verdicts", verdicts)


def _factors() -> tuple[Chain, ...]:
    """H = U S V^T, U^T U = V^T V = 1."""
    U, S, V, H = (Symbol(name) for name in "USVH")
    orthogonal = tuple((ONE, transpose(each) * each) for each in (U, V))
    return ((H, Product((U, S, transpose(V)))), *orthogonal)


def rows_fitted(work: Work, facts: Facts, results: Mapping[str, Expr], pairs: Pairs) -> tuple[Claim, ...]:
    """Each row by the singular values of the table."""
    import numpy as np

    told = facts.rows
    if told is None:
        return ()
    count, size = pairs.a.shape
    table = np.hstack([pairs.a, np.ones((count, 1))])
    rows = np.linalg.lstsq(table, pairs.b, rcond=None)[0].T
    lengths = np.linalg.norm(rows[:, :size], axis=1)
    R, p = rows[:, :size] / lengths[:, None], rows[:, size]
    T = np.vstack([rows, [0.0] * size + [1.0]])
    names: dict[Expr, Any] = {
        **_names("M T R", table, T, R), Symbol("p"): p[:, None], Symbol("rms"): pairs.rms(R, p),
    }  # fmt: skip
    for k in range(size):
        names[Symbol(f"beta_{k + 1}")], names[Symbol(f"x_{k + 1}")] = pairs.b[:, k : k + 1], rows[k][:, None]
        names[Symbol(f"r_{k + 1}")] = rows[k, :size]
    apart = farthest([*_of_work(work), *_results(results)], names)
    orthogonal, det = close(R @ R.T, np.eye(size)), float(np.linalg.det(R))
    what = ("rows-rotation" if det > 0 else "rows-reflection") if orthogonal else "rows-neither"
    counts = {} if orthogonal else {"numbers": rows.size, "freedoms": size + size * (size - 1) // 2}
    verdicts = told.verdict.key == what, dict(told.verdict.about) == counts
    return route("as-told", apart < CLOSE), route("verdicts", verdicts)


def _names(letters: str, *values: NDArray[Any]) -> dict[Expr, Any]:
    return {Symbol(letter): value for letter, value in zip(letters.split(), values, strict=True)}


def _of_work(work: Work) -> list[Chain]:
    return [step.chain for step in work.steps]


def _results(results: Mapping[str, Expr]) -> list[Chain]:
    return [(Symbol(name), tree) for name, tree in results.items()]
