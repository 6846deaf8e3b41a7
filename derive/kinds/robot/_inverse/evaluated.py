"""The branches at the point an author gives: in numbers, or in the letters that are left."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise, product
from typing import Any

from derive.algebra.numbers.floats import Point, number
from derive.derivation import Branch
from derive.errors import NotDerivable
from derive.expression import Expr, Number, Symbol, free_symbols, rebuild
from derive.kinds.evaluation import Place
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import oracle_of
from derive.kinds.robot._inverse.branches import Solutions, plain
from derive.kinds.robot._inverse.moves import Definition, Item
from derive.kinds.robot._inverse.numbers import AtPoint, Leaf
from derive.kinds.robot._inverse.settled import Leaves, Settled, told
from derive.kinds.values_at import point_of
from derive.mechanics.chain import Chain
from derive.mechanics.inverse.goal import Goal
from derive.mechanics.inverse.plan import Plan
from derive.mechanics.oracle import Oracle

REACHED = 1e-6  # in lengths of the arm
ROUNDED = 5e-3  # how far R^T R of a rotation typed with three digits may be from one
SMALL = 1e-7  # of a coefficient, which rounding may leave
EXACTLY = 1e-13
FEWEST_PLACES, MOST_PLACES = 3, 8  # of numbers that are taken as rounded
ROTATION = tuple(f"r{i}{j}" for i, j in product((1, 2, 3), repeat=2))


@dataclass(frozen=True, slots=True)
class Evaluated:
    """What the JSON says under `evaluated`, and about it: `out_of_reach` where no branch is real, `missed`
    where some are but do not bring the end-effector there, `free` where an unknown can be chosen at will,
    `rounded` where the nearest rotation was taken for the one typed."""

    values: Mapping[str, Any]
    out_of_reach: bool = False
    missed: bool = False
    free: bool = False
    rounded: bool = False

    @property
    def facts(self) -> dict[str, bool]:
        names = ("out_of_reach", "missed", "free", "rounded")
        return {name: getattr(self, name) for name in names}


def evaluated(
    solutions: Solutions, items: tuple[Item, ...], chain: Chain, plan: Plan, goal: Goal, place: Place | None
) -> Evaluated:
    """`solutions` with floats, where every name that they need has a value. Empty without a point. `items`
    are all definitions and moves, those that no branch needs included.

    Raises NotDerivable where what is typed as a rotation is none.
    """
    if place is None:
        return Evaluated({})
    problem = solutions.problem
    point = known_at(place, problem)
    if needed(solutions) - point.keys():
        return Evaluated(in_letters(solutions.branches, place, problem))
    point, rounding = _with_rotation(point)
    size = _size(oracle_of(problem), _anything(point, problem))
    typed = _last_digit({name: value for name, value in place if name in goal.names}) / size
    at = AtPoint(solutions, items, chain, plan, size, max(SMALL, 4 * rounding))
    found = Evaluated({})
    for here, off in ((at, rounding), (replace(at, meeting=8 * typed), max(rounding, typed))):
        leaves = _leaves(here, solutions, point)
        found = at_point(leaves, solutions.conditions, chain, goal, problem, point, off)
        if not found.out_of_reach or not typed:  # a stretched arm may be out of reach by what was rounded
            break
    return found


def _leaves(at: AtPoint, solutions: Solutions, point: Point) -> Leaves:
    exactly = replace(at, small=EXACTLY, meeting=EXACTLY)

    def leaves(k: int, pins: Mapping[int, float], usual: float, exact: bool) -> Iterator[Leaf]:
        return (exactly if exact else at).leaves(solutions.chosen[k], point, pins, usual)

    return leaves


def at_point(
    leaves: Leaves, conditions: Sequence[Sequence[str]], chain: Chain, goal: Goal, problem: Problem,
    point: Point, rounding: float = 0.0,
) -> Evaluated:  # fmt: skip
    """The solutions at a point, from the values that `leaves` gives for each branch; `rounding` is how far
    what is typed may be off, in lengths of the arm and in elements of R."""
    wanted = _anything(point, problem)
    oracle = oracle_of(problem)
    slides = frozenset(joint.variable for _, joint in chain.moving if joint.type == "prismatic")
    size = _size(oracle, wanted)
    settled = Settled(oracle, goal, chain.variables, slides, leaves, wanted, size, REACHED + 10 * rounding)
    found = settled.solutions(len(conditions))
    real = [any(leaf.values for leaf in leaves(k, {}, 0.0, False)) for k in range(len(conditions))]
    return Evaluated(
        {"solutions": told(found, conditions, real, len(chain.variables) < goal.size)},
        out_of_reach=not any(real),
        missed=any(real) and not found,
        free=any(each.freedom for each in found),
        rounded=rounding > REACHED,
    )


def _anything(point: Point, problem: Problem) -> dict[str, float]:
    """The point, with a value for what nothing rests on."""
    return {**dict.fromkeys(problem.symbols, 1.0), **point}


def known_at(place: Place, problem: Problem) -> dict[str, float]:
    """Every name that has a value; one that is given in letters without values has none."""
    return dict(point_of(dict(place), problem.where))


def needed(solutions: Solutions) -> frozenset[str]:
    """The names that the branches rest on: what is given, and lengths."""
    defined = {item.name.name for item in solutions.items if isinstance(item, Definition)}
    trees = [item.value for item in solutions.items if isinstance(item, Definition)]
    trees += [option.value for taken in solutions.chosen for option in taken.values()]
    return frozenset().union(*map(free_symbols, trees)) - defined - set(solutions.joints)


def _size(oracle: Oracle, point: Point) -> float:
    """A length of the arm: what its links and the place it should reach measure together."""
    import numpy as np

    home = {**dict.fromkeys(oracle.robot.variables, 0.0), **point}
    poses = [*oracle.poses(home), oracle.tool(home)]
    links = sum(float(np.linalg.norm(b[:3, 3] - a[:3, 3])) for a, b in pairwise(poses))
    return links + sum(abs(point.get(axis, 0.0)) for axis in "xyz") or 1.0


def _last_digit(place: Mapping[str, Expr]) -> float:
    """Half a unit of the last decimal place of what is typed, where it has some digits and not all that a
    program prints; else 0."""
    places = [
        next((k for k in range(MOST_PLACES + 1) if (value.value * 10**k).denominator == 1), 0)
        for value in place.values()
        if isinstance(value, Number)
    ]
    most = max(places, default=0)
    return 0.5 * 10.0**-most if most >= FEWEST_PLACES else 0.0


def _with_rotation(point: dict[str, float]) -> tuple[dict[str, float], float]:
    """The point with the rotation that is nearest to the one typed, and how far that is from one."""
    import numpy as np

    if not point.keys() >= set(ROTATION):
        return point, 0.0
    R = np.array([point[name] for name in ROTATION]).reshape(3, 3)
    off = float(np.abs(R @ R.T - np.eye(3)).max())
    if off > ROUNDED or np.linalg.det(R) < 0:
        why = "it is left-handed" if off <= ROUNDED else f"R R^T differs from one by {off:.2g}"
        raise NotDerivable(f"r11 ... r33 are no rotation matrix at the place asked for: {why}")
    U, _, V = np.linalg.svd(R)
    nearest = dict(zip(ROTATION, map(float, (U @ V).flat), strict=True))
    return ({**point, **nearest}, off) if off > 1e-12 else (point, 0.0)


# -- in letters ------------------------------------------------------------------------------------------


def in_letters(branches: tuple[Branch, ...], place: Place, problem: Problem) -> dict[str, Any]:
    """What has all its values as numbers, the rest as trees in the letters left."""
    return {"solutions": [_branch_in_letters(branch, dict(place), problem) for branch in branches]}


def _branch_in_letters(branch: Branch, place: Mapping[str, Expr], problem: Problem) -> dict[str, Any]:
    known: dict[Expr, Expr] = {Symbol(name): value for name, value in place.items()}
    found: dict[str, Any] = {}
    for name, formula in (branch.short or branch.values).items():
        value = _put(formula, known, problem)
        if free_symbols(value):
            found[name] = value
            continue
        try:
            found[name] = number(value, {})
        except (ValueError, ZeroDivisionError):
            return {"when": branch.when, "real": False}
        known[Symbol(name)] = Number(Fraction(f"{found[name]:.12g}"), decimal=True)
    return {**found, "when": branch.when}


def _put(tree: Expr, known: Mapping[Expr, Expr], problem: Problem) -> Expr:
    """With the values put in; inside functions nothing is expanded that they do not hold."""
    if plain(tree):
        return problem.final(tree, known)
    return rebuild(tree, lambda part: _put(part, known, problem))
