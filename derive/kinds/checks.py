"""What an answer is held to beside its links: laws, and a second route in numbers. Each counts its tries."""

from __future__ import annotations

import random
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.derivation import Cell, Claim, Said, Table
from derive.errors import NotReal
from derive.expression import number

NORMAL_FORM = "normal-form"
SECOND_ROUTE = "independent-route"
FLOATS = "floating-point"
TOLERANCE = 1e-9
TRIES = 40  # points drawn for those that count


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
    moving: Collection[str] = (),
    **about: Said,
) -> Claim:
    """Two routes to the same numbers at random points of the symbols where they are real, those that are
    `moving` on both sides of zero. Raises NotReal where no such point is found."""
    holds, met = True, 0
    for at in random_points(symbols, TRIES, moving):
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


def random_points(
    names: Iterable[str], count: int, moving: Collection[str] = ()
) -> Iterator[dict[str, float]]:
    """Points anyone gets again: the same names give the same numbers. Without names there is one point.
    What moves, which are the names in `moving`, rates, and what these are rates of, is negative at every
    other one."""
    ordered = sorted(names)
    draw = random.Random(" ".join(ordered))
    below = {*moving}.union(*(_in_motion(name) for name in ordered))
    for k in range(count if ordered else 1):
        point = {name: draw.uniform(0.2, 1.9) for name in ordered}
        yield {name: -value if k % 2 and name in below else value for name, value in point.items()}


def _in_motion(name: str) -> set[str]:
    """A rate or an acceleration, and what it is that of."""
    stem = name.removesuffix("_ddot").removesuffix("_dot")
    return set() if stem == name else {name, stem, f"{stem}_dot"}


def close(left: Any, right: Any, tolerance: float = TOLERANCE) -> bool:
    """Whether floats or nested lists of them agree, relative to their size."""
    a, b = list(flat(left)), list(flat(right))
    scale = max([1.0, *map(abs, a), *map(abs, b)])
    return len(a) == len(b) and all(abs(x - y) <= tolerance * scale for x, y in zip(a, b, strict=True))


def flat(value: Any) -> Iterator[float]:
    """The numbers in nested lists or arrays, in order."""
    if hasattr(value, "ravel"):
        yield from map(float, value.ravel().tolist())
    elif isinstance(value, list | tuple):
        for part in value:
            yield from flat(part)
    else:
        yield float(value)


def lists(table: Table, rows: Iterable[Sequence[Cell]], first: int = 0) -> bool:
    """Whether a table holds just these rows, with their numbers from the first one on before them."""
    return table.rows == tuple((number(k), *row) for k, row in enumerate(rows, first))


def is_rotation(R: ScalarMatrix, name: str = "R") -> tuple[Claim, ...]:
    """R^T R = 1 and det R = 1."""
    return (
        law("orthogonal", ScalarMatrix.identity(3) == R.T @ R, R=name),
        law("right-handed", R.det() == 1, R=name),
    )
