"""Three angles in numbers: the branches at a point, and every one of them put back into rotations composed by
another route."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any, TypeAlias

from derive.algebra.numbers.floats import Point, number, numbers
from derive.derivation import Branch, Claim, Condition, Phrase
from derive.expression import ZERO, Call, Expr, Relation, Symbol, column, cos, free_symbols, sin
from derive.kinds.checks import route
from derive.kinds.fields import Place
from derive.kinds.meanings import Chain, Names, told
from derive.kinds.pose._euler_facts import Case, Facts
from derive.kinds.pose._euler_steps import Comparison
from derive.kinds.pose._meanings import entries_of
from derive.kinds.values_at import point_of
from derive.kinds.work import Work
from derive.mechanics.euler import Euler
from derive.mechanics.oracle import in_sequence

if TYPE_CHECKING:
    from numpy.typing import NDArray

Route: TypeAlias = Callable[[Point], list[Any]]
NEARLY_SINGULAR = 1e-9
FREE = 0.7  # rad, an angle that may be chosen


def put_back(work: Work, compared: Comparison, solutions: tuple[Branch, ...], facts: Facts) -> Work:
    """The formulas as they are written at random rotations, singular ones at singular rotations; then the
    answer itself."""
    euler, steps = compared.euler, {step.name: step.chain for step in work.steps}
    for branch in facts.branches:
        values = {name: steps[step][1] for name, step in zip(euler.names, branch.steps, strict=True)}
        routes, sign = _again(compared, values, branch.sign, facts.g), "+" if branch.sign > 0 else "-"
        work = work.agrees("branch-again", euler.names, *routes, sign=sign)
    for case, told_of in zip(compared.singular_cases, facts.cases, strict=True):
        work = work.claim(_singular(compared, euler.singular_angles(case), told_of, facts, steps))
    work = work.claim(*_entries(compared, facts, steps), route("angles", _named_as_meant(facts)))
    if facts.chosen or facts.same:
        meant = partial(_angles_meant, (*facts.chosen, *facts.same), euler)
        work = work.agrees("angles-said", compared.problem.symbols, meant, compared.given.turns)
    return _answers(work, compared, solutions, facts)


def _angles_meant(told: tuple[tuple[Expr, Expr], ...], euler: Euler, at: Point) -> NDArray[Any]:
    """The rotation by the angles as they are said to be."""
    return rotation_at(euler, {name: number(value, at) for name, value in told_by_name(told)})


def told_by_name(told: tuple[tuple[Expr, Expr], ...]) -> Iterator[tuple[str, Expr]]:
    """Values by the names of angles."""
    return ((name.name, value) for name, value in told if isinstance(name, Symbol))


def _named_as_meant(facts: Facts) -> Iterator[bool]:
    """Whether the angles are those that stand in the entries."""
    middle, outer = {facts.middle.name}, ({facts.first.name}, {facts.last.name})
    if facts.entries is not None:
        yield free_symbols(facts.entries.middle[1]) == middle
        yield [len(pair) for pair in facts.entries.pairs] == [2, 2]
        for name, pair in zip(outer, facts.entries.pairs, strict=True):
            yield from (free_symbols(tree) - middle == name for _, tree in pair)
    both = {"first": facts.first, "last": facts.last}
    key = "in-each-case" if len(facts.cases) > 1 else "in-this-case"
    yield facts.free == (Phrase(key, both) if facts.cases else None)
    for case in facts.cases:
        yield case.middle[0] == facts.middle and free_symbols(case.sum) == outer[0] | outer[1]


def rotation_at(euler: Euler, at: Point) -> NDArray[Any]:
    """R (3 by 3) in NumPy, by the letters of the convention."""
    return in_sequence(euler.convention.letters, (at[name] for name in euler.names))


def _again(compared: Comparison, values: Mapping[str, Expr], sign: int, g: Expr) -> tuple[Route, Route]:
    """The rotation of the angles found at a rotation, and the sign of g there; and what they should be."""
    euler = compared.euler

    def back(at: Point) -> list[Any]:
        known = _named(entries_of(rotation_at(euler, at)))
        angles = {name: number(value, known) for name, value in values.items()}
        return [*rotation_at(euler, angles).ravel(), _sign_of(number(g, angles))]

    return back, lambda at: [*rotation_at(euler, at).ravel(), float(sign)]


def _sign_of(value: float) -> float:
    """1 or -1, and 0 within what floats leave."""
    return 0.0 if abs(value) < NEARLY_SINGULAR else 1.0 if value > 0 else -1.0


def _named(values: Mapping[Expr, Any]) -> dict[str, float]:
    return {name.name: value for name, value in values.items() if isinstance(name, Symbol)}


def _entries(compared: Comparison, facts: Facts, steps: Mapping[str, Chain]) -> Iterator[Claim]:
    """What is said of single entries, at random angles; and the chains of the angles, where numbers are put
    in, at the rotation that is given."""
    entries = facts.entries
    if entries is None:
        yield from _put_in(compared, [case.determined for case in facts.cases], steps)
        return
    said = (entries.middle, *(pair for pairs in entries.pairs for pair in pairs))
    size = (entries.size, Call("abs", (facts.g,)))
    euler = compared.euler
    yield told((*said, size), lambda at: entries_of(rotation_at(euler, at)), euler.names, {}, "entries")
    yield from _put_in(compared, [name for branch in facts.branches for name in branch.steps], steps)


def _put_in(compared: Comparison, names: Sequence[str], steps: Mapping[str, Chain]) -> Iterator[Claim]:
    """What the formulas of these steps come to, at the rotation that is given."""
    given, problem = compared.given, compared.given.problem
    chains = [_around(steps[name][1:]) for name in names]
    if any(len(chain) > 1 for chain in chains):
        written = [each for name in names for each in steps[name][1:]]
        chains += [(each, Call("abs", (each,))) for each in written if _is_half_turn(each)]
        yield told(chains, lambda at: entries_of(given.turns(at)), problem.symbols, problem.where)


def _is_half_turn(angle: Expr) -> bool:
    """Whether it is half a turn from either side; 180 deg is said, and never -180 deg."""
    return not free_symbols(angle) and abs(abs(number(angle, {})) - math.pi) < NEARLY_SINGULAR


def _around(chain: Chain) -> Chain:
    """Angles by their cosine and sine, so that half a turn is the same from either side."""
    return tuple(column((cos(angle), sin(angle))) for angle in chain)


def _singular(
    compared: Comparison, angles: Mapping[str, Expr], case: Case, facts: Facts, steps: Mapping[str, Chain]
) -> Claim:
    """All that is said of a singular case, where its middle angle is as it is written: the matrix, what its
    entries are, what they determine, and the angles put back."""
    euler, (name, value) = compared.euler, case.middle
    determined = (case.sum, steps[case.determined][1])
    again = Symbol("angles put back")
    chains = (steps[case.matrix], case.entry, *case.relations, _around(determined), (facts.g, ZERO))

    def meant(at: Point) -> Names:
        there = {**at, str(getattr(name, "name", "")): number(value, {})}
        R = rotation_at(euler, there)
        known = {**_named(entries_of(R)), euler.outer[2]: FREE}
        back = rotation_at(euler, {each: number(angle, known) for each, angle in angles.items()})
        letters: dict[Expr, Any] = {Symbol(each): angle for each, angle in there.items()}
        return {**letters, **entries_of(R), facts.rotation: R, again: back}

    every = (*chains, (again, facts.rotation))
    return told(every, meant, euler.names, {}, "singular-again", at=Relation(name, "=", value))


def _answers(work: Work, compared: Comparison, solutions: tuple[Branch, ...], facts: Facts) -> Work:
    """The solutions of the subject itself, at random values of its symbols where it is regular."""
    euler, given = compared.euler, compared.given
    for branch in solutions:
        needed = frozenset().union(*map(free_symbols, branch.values.values()))
        if euler.outer[2] in needed and not (given.numeric or not compared.regular):
            work = work.claim(_where_it_says(branch, euler.outer[1]))
            continue

        def back(at: Point, branch: Branch = branch) -> list[Any]:
            known = {euler.outer[2]: FREE, **given.place(at)}
            angles = {name: number(value, known) for name, value in branch.values.items()}
            return [*rotation_at(euler, angles).ravel(), *(_gap(each, angles) for each in branch.when)]

        def there(at: Point, count: int = len(branch.when)) -> list[Any]:
            return [*given.turns(at).ravel(), *[0.0] * count]

        work = work.agrees("orientation-again", given.problem.symbols, back, there, when=branch.when)
    return work


def _where_it_says(branch: Branch, middle: str) -> Claim:
    """Whether the middle angle of a singular case is that of its condition; the others are put back with its
    formulas, as every rotation is another one there."""
    angle = {middle: number(branch.values[middle], {})}
    return route("orientation-again", [not _gap(each, angle) for each in branch.when], when=branch.when)


def _gap(condition: Condition, angles: Point) -> float:
    """0 where a condition of a branch holds, as it is told."""
    at = condition.about.get("at") if isinstance(condition, Phrase) else condition
    if not isinstance(at, Relation) or isinstance(at.left, Relation):
        return 1.0
    left, right = number(at.left, angles), number(at.right, angles)
    holds = {">": left > right, "<": left < right, "=": abs(left - right) < NEARLY_SINGULAR}
    return 0.0 if holds.get(at.sign, False) else 1.0


def _principal(angle: float) -> float:
    """The same angle in (-pi, pi]."""
    return angle if -math.pi < angle <= math.pi else math.pi - (math.pi - angle) % (2 * math.pi)


def branches_at(place: Place | None, compared: Comparison, solutions: tuple[Branch, ...]) -> dict[str, Any]:
    """The solutions in floats at a point, nothing where symbols are left; the case that does not occur there
    is not real. A free angle is chosen zero."""
    point = point_of(dict(place or ()), compared.problem.where)
    try:
        R = numbers(compared.problem.readable_matrix(compared.given.R), point)
    except KeyError:
        return {}
    pair = (compared.euler.first.sine, compared.euler.first.cosine)
    singular = sum(R[entry.row][entry.col] ** 2 for entry in pair) < NEARLY_SINGULAR**2
    here = R[compared.euler.middle.row][compared.euler.middle.col]
    regular = len(solutions) - len(compared.singular_cases)
    found: list[dict[str, Any]] = []
    for k, branch in enumerate(solutions):
        case = compared.singular_cases[k - regular] if k >= regular else None
        occurs = singular and here * case.entry > 0 if case else not singular
        free = {compared.euler.outer[2]: 0.0, **point}
        values = {name: _principal(number(value, free)) for name, value in branch.values.items() if occurs}
        found.append({**values, "when": branch.when, **({} if occurs else {"real": False})})
    return {"R": R, "solutions": found}
