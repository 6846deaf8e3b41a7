"""The lengths of the legs of a Stewart-Gough platform in a pose."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from math import dist

from derive.algebra.numbers.floats import number as at
from derive.derivation import Derivation, Result
from derive.errors import NotDerivable
from derive.expression import ZERO, Expr, Matrix, Product, Symbol, add, column, free_symbols, sqrt, squared
from derive.kinds.checks import close, random_points, route
from derive.kinds.mechanism._facts import LegFacts
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.elementary import rotation_matrix
from derive.mechanics.euler import Convention
from derive.mechanics.linkages import Stewart
from derive.names import free

Turn = tuple[str, tuple[Expr, Expr, Expr] | None]
POINTS = 3


def lengths_of_legs(
    robot: Stewart, position: Sequence[Expr] | None, turn: Turn, problem: Problem
) -> Derivation:
    """L_i = p + R b_i - a_i, as long as the leg (Lynch and Park, Modern Robotics, section 7.1.2).

    Raises NotDerivable for a position that is none in space.
    """
    if position is not None and len(position) != 3:
        raise NotDerivable(f"{len(position)} coordinates are given, 3 are needed", "position")
    count = len(robot.base)
    ends = [f"_{k}" for k in range(1, count + 1)]
    taken = problem.taken
    a, b, L, l = (free(taken, name, name * 2, indices=ends) for name in ("a", "b", "L", "l"))
    p, R = Symbol(free(taken, "p", "p_e")), Symbol(free(taken, "R", "R_e"))
    wanted = position or tuple(Symbol(free(taken, axis, f"p_{axis}")) for axis in "xyz")
    work = Work(problem).given(p, column(wanted))
    convention, angles = turn
    if angles is not None:
        work = work.line(R, _product(convention, angles))
    vectors, lengths = ([Symbol(name + end) for end in ends] for name in (L, l))
    for vector, end, foot, top in zip(vectors, ends, robot.base, robot.platform, strict=True):
        first, second = Symbol(a + end), Symbol(b + end)
        work = work.knowing({first: column(foot), second: column(top)})
        work = work.line(vector, add(p, R * second if angles is not None else second) - first)
    for vector, length in zip(vectors, lengths, strict=True):
        if all(entry == ZERO for entry in work.entries(vector)):
            raise NotDerivable(f"leg {vector.name.rpartition('_')[2]} has no length in this pose", "position")
        formula = sqrt(add(*(squared(each) for each in work.entries(vector) if each != ZERO)))
        work = work.line(length, formula, value=formula if free_symbols(formula) else work.shown(formula))
    pages = {f"L{end}": vector.name for end, vector in zip(ends, vectors, strict=True)}
    pages |= {f"l{end}": length.name for end, length in zip(ends, lengths, strict=True)}
    results: dict[str, Result] = {name: work.final(line) for name, line in pages.items()}
    work = work.claim(route("lengths-measured", _measured(robot, wanted, turn, problem, results)))
    facts = LegFacts(
        vectors=tuple(each.name for each in vectors), lengths=tuple(each.name for each in lengths),
        points=(Symbol(f"{a}_1"), Symbol(f"{b}_1")), place=p, turned=R if angles is not None else None,
        page_names=pages, numbers=tuple(f"l{end}" for end in ends),
    )  # fmt: skip
    return work.answer("inverse-kinematics", results, facts)


def _product(convention: str, angles: tuple[Expr, Expr, Expr]) -> Expr:
    """The rotations in the order of the product, from the left."""
    order = Convention.of(convention)
    turns = [*zip(order.axes, angles, strict=True)]
    made = turns if order.about == "current" else turns[::-1]
    factors: list[Expr] = [rotation_matrix(axis, angle) for axis, angle in made if angle != ZERO]
    if len(factors) > 1:
        return Product(tuple(factors))
    return factors[0] if factors else rotation_matrix("z", ZERO)


def _measured(
    robot: Stewart, wanted: Sequence[Expr], turn: Turn, problem: Problem, results: Mapping[str, Result]
) -> Iterator[bool]:
    """The platform is put there in numbers, and the distances between the joints are measured."""
    from derive.mechanics.oracle import in_sequence

    convention, angles = turn
    trees = [*wanted, *(angles or ())]
    trees += [part for points in (robot.base, robot.platform) for point in points for part in point]
    names = frozenset().union(*map(free_symbols, map(problem.final, trees)))
    for point in random_points(names, POINTS):

        def worth(tree: Expr, here: Mapping[str, float] = point) -> float:
            return at(problem.final(tree), here)

        place = [worth(each) for each in wanted]
        R = in_sequence(convention, map(worth, angles or (ZERO, ZERO, ZERO)))
        for k, (foot, top) in enumerate(zip(robot.base, robot.platform, strict=True), 1):
            spot = [c + d for c, d in zip(place, R @ [worth(part) for part in top], strict=True)]
            start = [worth(part) for part in foot]
            vector, length = results[f"L_{k}"], results[f"l_{k}"]
            if isinstance(vector, Matrix) and not isinstance(length, Matrix):
                leg = [at(entry, point) for (entry,) in vector.rows]
                yield close(leg, [float(c - d) for c, d in zip(spot, start, strict=True)])
                yield close(at(length, point), dist(spot, start))  # type: ignore[arg-type]
