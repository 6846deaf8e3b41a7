"""The point in which the couplers of a five-bar linkage meet, for angles of both motors."""

from __future__ import annotations

from collections.abc import Iterator

from derive.algebra.numbers.floats import number as at
from derive.derivation import Branch, Derivation, Phrase, Step
from derive.errors import NotDerivable, NotReal
from derive.expression import Symbol, add, cos, free_symbols, sin, sqrt, squared, subtract
from derive.kinds.checks import close, random_points, route
from derive.kinds.mechanism._assemblies import Assembly
from derive.kinds.mechanism._facts import PositionFacts
from derive.kinds.mechanism._loop_oracle import tip
from derive.kinds.mechanism._position_checks import in_turn
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.linkages import FiveBar
from derive.names import free

DRAWS, POINTS = 400, 3


def meeting(robot: FiveBar, problem: Problem) -> Derivation:
    """Circles about the ends of both cranks meet in two points, one on each side of the line between them.

    Raises NotDerivable where they do not meet anywhere.
    """
    (first, second), (third, fourth) = robot.cranks, robot.couplers
    work, (a_1, a_2, b_1, b_2, d) = Work(problem).naming(
        a_1=first, a_2=second, b_1=third, b_2=fourth, d=robot.ground
    )
    given, taken = work.typed, problem.taken
    one, two = (Symbol(free(taken, f"theta_{k}", f"q_{k}")) for k in (1, 2))
    x, y = (Symbol(free(taken, axis, f"p_{axis}")) for axis in "xy")
    x_1, y_1, u, v, E, k, w = (
        Symbol(free(taken, name, f"{name[0]}{name}")) for name in ("x_1", "y_1", "u", "v", "E", "k", "w")
    )
    formulas = {
        x_1: a_1 * cos(one),
        y_1: a_1 * sin(one),
        u: d + a_2 * cos(two) - x_1,
        v: subtract(a_2 * sin(two), y_1),
        E: u**2 + v**2,
        k: (E if b_1 == b_2 else E + b_1**2 - b_2**2) / 2,
        w: sqrt(E * b_1**2 - k**2),
    }
    for name in (x_1, y_1):
        work = work.worked(name.name, formulas[name])
    for name in (u, v, E):
        work = work.line(name, formulas[name], value=formulas[name])
    distances = (
        (add(squared(subtract(x, x_1)), squared(subtract(y, y_1))), b_1**2),
        (add(squared(x - x_1 - u), squared(y - y_1 - v)), b_2**2),
    )
    work = work.showing(*(Step(f"distance_{k}", each, "in-numbers") for k, each in enumerate(distances, 1)))
    for name in (k, w):
        work = work.line(name, formulas[name], value=formulas[name])
    places = {
        "beyond-left": (x_1 + (k * u - w * v) / E, y_1 + (k * v + w * u) / E),
        "beyond-right": (x_1 + (k * u + w * v) / E, y_1 + (k * v - w * u) / E),
    }
    for side, pair in places.items():
        for name, place in zip((x, y), pair, strict=True):
            work = work.showing(Step(f"{side}-{name.name}", (name, place), "in-numbers"))
    assemblies = [
        Assembly(Phrase(side), {**formulas, x: pair[0], y: pair[1]}, (x, y)) for side, pair in places.items()
    ]
    branches = tuple(each.branch(problem, dict(given)) for each in assemblies)
    work = work.claim(route("closes", _closes(robot, work, assemblies, branches, (one, two))))
    sides = [(each.side, f"{each.side.key}-{x.name}", f"{each.side.key}-{y.name}") for each in assemblies]
    facts = PositionFacts(
        given=given, end=(x_1, y_1), meeting=(u.name, v.name, E.name, k.name, w.name),
        motors=(one, two), sides_of_line=tuple(sides), unknown=(x, y),
    )  # fmt: skip
    return work.answer("position", {"solutions": branches}, facts)


def _closes(
    robot: FiveBar, work: Work, assemblies: list[Assembly], branches: tuple[Branch, ...],
    motors: tuple[Symbol, Symbol],
) -> Iterator[bool]:  # fmt: skip
    """In numbers, both couplers reach the point from the ends of the cranks, on the side that is said; each
    line holds. Raises NotDerivable where they do not meet anywhere."""
    problem, found = work.problem, 0
    yield motors[0] != motors[1]
    trees = [problem.final(tree) for tree in (*robot.cranks, *robot.couplers, robot.ground)]
    letters = frozenset().union(*map(free_symbols, trees)) | {name.name for name in motors}
    typed = {name.name: problem.final(value) for name, value in work.typed if isinstance(name, Symbol)}
    for point in random_points(letters, DRAWS):
        start = {**point, **{name: at(value, point) for name, value in typed.items()}}
        try:
            ways = [in_turn(start, each.formulas) for each in assemblies]
        except (NotReal, ValueError):
            continue
        a_1, a_2, b_1, b_2, d = (at(tree, point) for tree in trees)
        first, second = tip(a_1, point[motors[0].name]), d + tip(a_2, point[motors[1].name])
        for assembly, values, branch in zip(assemblies, ways, branches, strict=True):
            x, y = (values[name.name] for name in assembly.unknown)
            spot = complex(x, y)
            yield close([abs(spot - first), abs(spot - second)], [b_1, b_2])
            turn = ((second - first).conjugate() * (spot - first)).imag
            yield assembly.side.key == ("beyond-left" if turn > 0 else "beyond-right")
            lines = [s.chain for s in work.steps if s.name.startswith(("distance", assembly.side.key))]
            yield all(close(at(left, values), at(right, values)) for left, right in lines)
            short = in_turn(point, {Symbol(name): tree for name, tree in branch.short.items()})
            whole = [at(problem.final(tree), point) for tree in branch.values.values()]
            yield close(whole, [x, y]) and close([short[name] for name in branch.values], [x, y])
        found += 1
        if found == POINTS:
            return
    if not found:
        raise NotDerivable("no position was found in which bars of these lengths can be joined")
