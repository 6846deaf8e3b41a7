"""States of rest held to differences of the energies: what is left there, and what small motions do."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice
from math import pi
from typing import TYPE_CHECKING, Any

from derive.algebra.numbers.floats import Point, completed, number
from derive.derivation import Branch, Claim, Phrase, Said, Step
from derive.expression import PI, Approximate, Expr, Relation, Symbol, free_symbols, walk
from derive.kinds.checks import random_points, route
from derive.kinds.lagrange._oracle import Differences
from derive.kinds.meanings import Names, told
from derive.kinds.problem import Problem
from derive.mechanics.lagrangian import TIME, LagrangianSystem

if TYPE_CHECKING:
    from numpy.typing import NDArray

STEP, SLOPES = 1e-5, 1e-6  # of differences, and what they leave
NEARLY = 1e-9
GROWING, STEADY = 1e-5, 1e-4  # real parts of eigenvalues, relative to the largest
EFFECTIVE = Symbol("V")  # minus the Lagrangian at rest
TRIED = 60  # points, where a state need not be real
UNREAL = (ValueError, ZeroDivisionError, OverflowError)


@dataclass(frozen=True, slots=True)
class Still:
    """A system that does not move; `given` are values of its inputs."""

    differences: Differences
    given: Mapping[Symbol, Expr]

    @property
    def system(self) -> LagrangianSystem:
        return self.differences.system

    @property
    def letters(self) -> frozenset[str]:
        """Names that a point must give besides those of the problem."""
        return frozenset().union({TIME}, self.system.coordinates, *map(free_symbols, self.given.values()))

    def at(self, point: Point) -> dict[str, float]:
        """The point with every rate and acceleration zero, and the inputs as given."""
        still = dict.fromkeys((*self.system.rates, *self.system.accelerations), 0.0)
        known = {**completed({**point, **still}, self.differences.where)}
        return known | {name.name: number(value, known) for name, value in self.given.items()}

    def slopes(self, at: Point, names: Sequence[str]) -> NDArray[Any]:
        """The derivatives (n by as many as names) of what is left of the equations."""
        import numpy as np

        left = self.differences.left_over
        columns = [
            np.subtract(left({**at, name: at[name] + STEP}), left({**at, name: at[name] - STEP})) / (2 * STEP)
            for name in names
        ]
        return np.array(columns).T

    def growth(self, at: Point) -> float | None:
        """The largest real part of the eigenvalues of a small motion, relative to their size; None where a
        coordinate has no inertia."""
        import numpy as np

        system = self.system
        M, C, K = (
            self.slopes(at, names) for names in (system.accelerations, system.rates, system.coordinates)
        )
        if np.linalg.cond(M) > 1 / NEARLY:
            return None
        n = len(M)
        A = np.block([[np.zeros((n, n)), np.eye(n)], [-np.linalg.solve(M, K), -np.linalg.solve(M, C)]])
        eigenvalues = np.linalg.eigvals(A)
        return float(eigenvalues.real.max() / max(abs(eigenvalues).max(), NEARLY))

    def is_decided(self, at: Point, neutral: Collection[str]) -> bool:
        """Whether a potential alone decides, no force feeding a motion: it drives the system back along all
        other coordinates (Lagrange and Dirichlet), or away along one where nothing turns with the rates."""
        import numpy as np

        kept = [k for k, q in enumerate(self.system.coordinates) if q not in neutral]
        K, C = (self.slopes(at, names) for names in (self.system.coordinates, self.system.rates))
        K = K[np.ix_(kept, kept)]
        size, lost = (max(np.abs(each).max(initial=0.0), NEARLY) for each in (K, C))
        even, braked = (
            np.abs(each - each.T).max(initial=0.0) < STEADY * scale for each, scale in ((K, size), (C, lost))
        )
        least, least_lost = (np.linalg.eigvalsh(each + each.T).min(initial=np.inf) for each in (K, C))
        away = braked and least < -STEADY * size
        return bool(even and least_lost > -STEADY * lost and (least > STEADY * size or away))


def held(
    still: Still,
    problem: Problem,
    steps: Sequence[Step],
    branches: Sequence[Branch],
    effective: Expr | None,
) -> Iterator[Claim]:
    """What is claimed of the states as they are told, and of the effective potential energy."""
    names = problem.symbols | still.letters
    chains = [(_name(step), step.chain[-1] if step.name == "K" else step.chain[0]) for step in steps]
    if effective is not None:
        chains.append((EFFECTIVE, effective))
    yield told(chains, lambda at: _meant(still, steps, at), names, problem.where, tolerance=SLOPES, points=1)
    places = [list(islice(_places(still, names, branch), 2)) for branch in branches]
    pairs = [(branch, at) for branch, each in zip(branches, places, strict=True) for at in each]
    if pairs:
        yield route("needs-no-force", (_needs_no_force(still, branch, at) for branch, at in pairs))
    verdicts = [
        holds
        for branch, at in pairs
        for said in branch.when
        if (holds := _is_so(still, branch, said, at)) is not None
    ]
    verdicts += [_is_neutral(still, said, at) for branch, at in pairs for said in branch.when]
    if verdicts:
        yield route("verdicts", verdicts)


def _name(step: Step) -> Symbol:
    return Symbol(step.name)


def _meant(still: Still, steps: Sequence[Step], at: Point) -> Names:
    """What is left of the equations at rest, anywhere, and its derivatives by the coordinates."""
    point = still.at(at)
    left = still.differences.left_over(point)
    rest: dict[Expr, Any] = {Symbol(f"rest_{k}"): value for k, value in enumerate(left, 1)}
    K = still.slopes(point, still.system.coordinates)
    energy = -still.differences.lagrangian_at(point)
    return {**rest, Symbol("K"): K if K.size > 1 else float(K[0, 0]), EFFECTIVE: energy}


def _places(still: Still, names: frozenset[str], branch: Branch) -> Iterator[dict[str, float]]:
    """Points where the state is real, with its coordinates as they are told."""
    for point in random_points(names, TRIED):
        at = still.at(point)
        try:
            yield {**at, **{q: number(tree, at) for q, tree in branch.values.items()}}
        except UNREAL:
            continue


def _needs_no_force(still: Still, branch: Branch, at: Point) -> bool:
    """Whether nothing is left of the equations; and whether fixed angles are said as those in (-pi, pi]."""
    size = 1 + max(map(abs, at.values())) ** 4
    fixed = [at[q] for q, tree in branch.values.items() if PI in walk(tree) and not free_symbols(tree)]
    principal = all(-pi + NEARLY < angle < pi + NEARLY for angle in fixed)
    return principal and all(abs(left) < NEARLY * size for left in still.differences.left_over(at))


def _is_so(still: Still, branch: Branch, said: Said, at: Point) -> bool | None:
    """Whether a verdict is so. What is said to be left open must be, but for rounded states."""
    if (plain := _undecided(said)) is None:
        return _verdict(said, at, still.growth(at))
    if any(isinstance(node, Approximate) for tree in branch.values.values() for node in walk(tree)):
        return None
    return not still.is_decided(at, plain)


def _undecided(said: Said) -> set[str] | None:
    """The coordinates along which it is said to be neutral, of a state left undecided; None of any other."""
    along = set[str]()
    while isinstance(said, Phrase) and said.key in ("neutral", "where"):
        along |= _names(said.about["along"]) if said.key == "neutral" else set()
        said = said.about["said"]
    return along if isinstance(said, Phrase) and said.key == "undecided" else None


def _names(said: Said) -> set[str]:
    return {each.name for each in said if isinstance(each, Symbol)} if isinstance(said, tuple) else set()


def _is_neutral(still: Still, said: Said, at: Point) -> bool:
    """Whether a displacement along the coordinates that are told so, and no other of its kind, changes
    nothing."""
    import numpy as np

    while isinstance(said, Phrase) and said.key == "where":
        said = said.about["said"]
    if not isinstance(said, Phrase) or said.key != "neutral":
        return True
    others, along = _names(said.about["others"]), _names(said.about["along"])
    K = np.abs(still.slopes(at, sorted(along)))
    size = np.abs(still.slopes(at, still.system.coordinates)).max()
    apart = not others & along and others | along == {*still.system.coordinates}
    return apart and bool(others and along) and bool(K.max() < STEADY * max(size, NEARLY))


def _verdict(said: Said, at: Point, growth: float | None) -> bool | None:
    """Whether what is said of the stability is so; None where it says nothing of this point."""
    if not isinstance(said, Phrase) or growth is None:
        return None
    about = said.about
    match said.key:
        case "stable":
            return growth < STEADY
        case "unstable":
            return growth > GROWING
        case "neutral":
            return _verdict(about["said"], at, growth)
        case "where":
            return _holds(about["need"], at) and _verdict(about["said"], at, growth)
        case "either-or" | "either-or-negative" | "it-is-if" if about["said"] != Phrase("stable"):
            return False
        case "either-or" | "either-or-negative" if about["other"] != Phrase("unstable"):
            return False
        case "either-or":
            need, opposite = _holds(about["need"], at), _holds(about["opposite"], at)
            return need != opposite and (growth < STEADY if need else growth > GROWING)
        case "it-is-if" | "either-or-negative":
            needs = about["needs"]
            if isinstance(needs, tuple) and all(_holds(need, at) for need in needs):
                return growth < STEADY
            return growth > GROWING if said.key == "either-or-negative" else None
    return None


def _holds(need: Said, at: Point) -> bool:
    if not isinstance(need, Relation) or isinstance(need.left, Relation):
        return False
    left, right = number(need.left, at), number(need.right, at)
    return {">": left > right, "<": left < right}.get(need.sign, False)
