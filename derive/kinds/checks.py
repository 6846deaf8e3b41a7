"""What every derivation is held to: links between the steps, laws, and a second route in numbers."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import replace as fields_replaced
from itertools import pairwise
from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import Names, Walk, walk_over
from derive.algebra.numbers.floats import Point, completed, numbers
from derive.algebra.values import Value
from derive.derivation import Claim, Said, Step
from derive.errors import NotDerivable, NotReal
from derive.expression import Approximate, Expr, Indexed, Matrix, Number, Symbol, free_symbols, replace, walk
from derive.kinds.problem import expressions

NORMAL_FORM = "normal-form"
SECOND_ROUTE = "independent-route"
TOLERANCE = 1e-9
FAR = 1e12  # times as large: of the sum of such floats a claim at 1e-9 has too few digits left
TRIES = 40  # points drawn for those that count


def links(steps: Iterable[Step], names: Names) -> tuple[Claim, ...]:
    """Each chain equal from end to end; one claim a step, inner steps included.

    A step by rule "law" states what holds in general: it is compared in the case that is its instance.
    """
    inner = [each for step in steps for each in step.all()]
    chains = {step.name: _exact(step, names) for step in inner if step.rule != "law"}
    walk_of = walk_over([expr for chain in chains.values() for expr in chain], names)
    found = tuple(_link(name, chain, walk_of) for name, chain in chains.items() if len(chain) > 1)
    return (*found, *(in_its_instance(step, names) for step in inner if step.rule == "law" and step.instance))


def in_its_instance(law: Step, names: Names) -> Claim:
    """A law that holds in general, compared in one case: by normal form, in numbers where it has none."""
    chain = tuple(replace(expr, law.instance) for expr in law.chain)
    with suppress(NotDerivable):
        claim = _link(law.name, chain, walk_over(chain, names))
        if claim.holds or any(isinstance(node, Matrix) for expr in chain for node in walk(expr)):
            return fields_replaced(claim, tried=len(chain) - 1)
    return fields_replaced(_in_numbers(law.name, chain, names), link=True)


def _in_numbers(name: str, chain: tuple[Expr, ...], names: Names) -> Claim:
    """A chain compared at random points of what its names rest on."""
    where = {each.name: value for each, value in names.items() if isinstance(each, Symbol)}
    needed = frozenset().union(*map(free_symbols, (*chain, *where.values()))) - where.keys()

    def ends(side: slice) -> Callable[[Point], list[Any]]:
        return lambda at: [numbers(expr, completed(at, where)) for expr in chain[side]]

    return agreement("links", needed, ends(slice(None, -1)), ends(slice(1, None)), step=name)


def law(key: str, holds: bool | Iterable[bool], **about: Said) -> Claim:
    """A law decided by normal form: `law("orthogonal", R.T @ R == identity, R="R_AB")`, or of each of several
    things, `law("symmetric", (each == each.T for each in tensors))`. The words of the kind have a line for
    the key, `orthogonal: {R}^T {R} = 1`."""
    return every(key, holds, NORMAL_FORM, **about)


def route(key: str, holds: bool | Iterable[bool], **about: Said) -> Claim:
    """A second route, taken here and found to agree at each of its places."""
    return every(key, holds, SECOND_ROUTE, **about)


def every(key: str, holds: bool | Iterable[bool], by: str, **about: Said) -> Claim:
    """That something holds of each of several things, which are counted; of nothing it does not hold."""
    found = [bool(each) for each in holds] if isinstance(holds, Iterable) else [bool(holds)]
    return Claim(key, by, all(found), about, tried=len(found))


def agreement(
    key: str,
    symbols: Iterable[str],
    ours: Callable[[Mapping[str, float]], Any],
    other: Callable[[Mapping[str, float]], Any],
    tolerance: float = TOLERANCE,
    points: int = 3,
    **about: Said,
) -> Claim:
    """Two routes to the same numbers at random points of the symbols where they are real. Raises NotReal
    where no such point is found."""
    holds, met = True, 0
    for at in random_points(symbols, TRIES):
        try:
            holds &= close(ours(at), other(at), tolerance)
        except NotReal:  # acos(q) at q = 1.5
            continue
        met += 1
        if met == points:
            break
    if not met:
        raise NotReal("no values of the symbols were found for which this is real, so nothing was verified")
    return Claim(key, SECOND_ROUTE, holds, about, tried=met)


def random_points(names: Iterable[str], count: int) -> Iterator[dict[str, float]]:
    """Points anyone gets again: the same names give the same numbers. Without names there is one point."""
    ordered = sorted(names)
    draw = random.Random(" ".join(ordered))
    for _ in range(count if ordered else 1):
        yield {name: draw.uniform(0.2, 1.9) for name in ordered}


def close(left: Any, right: Any, tolerance: float = TOLERANCE) -> bool:
    """Whether floats or nested lists of them agree, relative to their size."""
    a, b = list(flat(left)), list(flat(right))
    scale = max([1.0, *map(abs, a), *map(abs, b)])
    return len(a) == len(b) and all(abs(x - y) <= tolerance * scale for x, y in zip(a, b, strict=True))


def flat(value: Any) -> Iterator[float]:
    """The numbers in nested lists or arrays, in order."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, list | tuple):
        for part in value:
            yield from flat(part)
    else:
        yield float(value)


def far_apart(value: Any) -> tuple[float, float] | None:
    """The smallest and the largest number of a subject, where floats that add them lose the smaller one."""
    sizes = sorted(
        abs(float(node.value))
        for tree in expressions(value)
        for node in walk(tree)
        if isinstance(node, Number) and node.value
    )
    return (sizes[0], sizes[-1]) if sizes and sizes[-1] > FAR * sizes[0] else None


def is_rotation(R: ScalarMatrix, name: str = "R") -> tuple[Claim, ...]:
    """R^T R = 1 and det R = 1."""
    return (
        law("orthogonal", ScalarMatrix.identity(3) == R.T @ R, R=name),
        law("right-handed", R.det() == 1, R=name),
    )


def _exact(step: Step, names: Names) -> tuple[Expr, ...]:
    """The chain without rounded numbers, and without a name at its head that it defines."""
    chain = step.chain
    if chain and isinstance(chain[0], Symbol | Indexed) and chain[0] not in names:
        chain = chain[1:]
    return tuple(expr for expr in chain if not _rounded(expr))


def _link(name: str, chain: tuple[Expr, ...], walk_of: Walk) -> Claim:
    values = [_plain(walk_of.value(expr)) for expr in chain]
    holds = all(a == b for a, b in pairwise(values))
    return Claim("links", NORMAL_FORM, holds, {"step": name}, link=True)


def _plain(value: Value) -> Value:
    """A product such as g^T o is a scalar, though a matrix of one entry."""
    return value[0, 0] if isinstance(value, ScalarMatrix) and value.shape == (1, 1) else value


def _rounded(expr: Expr) -> bool:
    return any(isinstance(node, Approximate) for node in walk(expr))
