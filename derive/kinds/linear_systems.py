"""Linear equations that stand in place of a formula, solved in numbers: in floats from their trees, and in
ball arithmetic from their text."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import chain
from typing import Any

from flint import arb, arb_mat, ctx

from derive.algebra.ball_arithmetic import balls
from derive.algebra.fold import fold
from derive.algebra.numbers.floats import Point, completed, numbers
from derive.derivation import LinearSystem
from derive.errors import DivisionByZero
from derive.expression import Expr, free_symbols
from derive.kinds.sure import ROUNDS, read, sure

SINGULAR = 1e-12  # what the least singular value is of the largest, at most
ROUNDING = 1e-14  # of the largest unknown: what is smaller is nothing


def solution_at(system: LinearSystem, point: Point) -> list[Any]:
    """The unknowns that are wanted, floats or rows of them. Raises KeyError for a name without a value,
    DivisionByZero where the equations have not one solution."""
    import numpy as np

    at = completed(point, system.names)
    left, right = (np.array(numbers(each, at)) for each in (system.left, system.right))
    sizes = np.linalg.svd(left, compute_uv=False)
    if sizes[-1] <= SINGULAR * sizes[0]:
        raise DivisionByZero("the equations for it are dependent there")
    found = np.linalg.solve(left, right.reshape(-1))
    found[abs(found) <= ROUNDING * max(abs(found))] = 0.0
    return [*system.shaped([*map(float, found)])]


def unknowns_of(written: Mapping[str, Any]) -> tuple[str, ...]:
    """All of them, as they stand in the JSON: those of a matrix row by row."""
    rows = ((each,) if isinstance(each, str) else each for each in written["unknowns"])
    return (*chain.from_iterable(rows), *written.get("auxiliary", ()))


def solved_as_written(written: Mapping[str, Any], point: Mapping[str, Expr]) -> list[float]:
    """All unknowns of equations as they stand in the JSON, `{"unknowns": ["x"], "equations": ["2*x = a"]}`,
    sure to the last digit. Raises as `sure` does, and DivisionByZero where they have not one solution."""
    unknowns = unknowns_of(written)
    given = {**point, **{name: read(text) for name, text in written.get("where", {}).items()}}
    gaps = [left - right for left, right in (map(read, each.split(" = ")) for each in written["equations"])]
    held = [free_symbols(gap) for gap in gaps]
    names = frozenset().union(*held) - {*unknowns}
    known = {name: sure(given[name], given) for name in names}
    with ctx.workprec(ROUNDS[0]):
        nothing = {**known, **dict.fromkeys(unknowns, arb(0))}
        rest = [fold(gap, balls(nothing)) for gap in gaps]
        columns = []
        for name in unknowns:
            one = balls({**nothing, name: arb(1)})
            column = zip(gaps, held, rest, strict=True)
            columns.append([fold(gap, one) - still if name in its else arb(0) for gap, its, still in column])
        try:
            found = arb_mat(columns).transpose().solve(arb_mat([[-each] for each in rest]))
        except ZeroDivisionError as error:
            raise DivisionByZero("the equations have not one solution") from error
        return [0.0 if each.contains(0) else float(each.mid()) for each in found.entries()]
