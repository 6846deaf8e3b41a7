"""What is printed, in numbers: every line valued with what its names mean by another route.

Links compare a chain with what the board holds under its names; a name that stands for the wrong thing passes
them, and so does a line that nothing stands beside. Here names are arrays of NumPy found from the subject
alone, and each member of a chain, as it is written, must come to the same.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from functools import reduce
from math import isfinite
from typing import TYPE_CHECKING, Any, TypeAlias

from derive.algebra.numbers.floats import FUNCTIONS, Point, completed, number
from derive.derivation import Claim, Said
from derive.errors import DivisionByZero, NotReal
from derive.expression import Call, Expr, Indexed, Matrix, Measured, Power, Product, Quotient, Sum, Symbol
from derive.kinds.checks import agreement, flat

if TYPE_CHECKING:
    from derive.kinds.work import Work

Names: TypeAlias = Mapping[Expr, Any]  # floats, and arrays with two axes: a column is n by 1
Meanings: TypeAlias = Callable[[Point], Names]
Chain: TypeAlias = tuple[Expr, ...]
TOLERANCE = 1e-8


def as_told(
    work: Work,
    meanings: Meanings,
    chains: Iterable[Chain] = (),
    key: str = "as-told",
    tolerance: float = TOLERANCE,
    symbols: Iterable[str] | None = None,
    points: int = 2,
    **about: Said,
) -> Work:
    """With the claim that the lines on the board so far, and `chains` that are told beside them, hold in
    numbers. A name at the head of a line that means nothing by itself is left out."""
    lines = (inner.chain for step in work.steps for inner in step.all())
    names = work.problem.symbols if symbols is None else symbols
    every = [*lines, *chains]
    moving = work.problem.moving
    where = work.problem.where
    return work.claim(told(every, meanings, names, where, key, tolerance, points, moving, **about))


def told(
    chains: Sequence[Chain],
    meanings: Meanings,
    symbols: Iterable[str],
    where: Mapping[str, Expr],
    key: str = "as-told",
    tolerance: float = TOLERANCE,
    points: int = 2,
    moving: Collection[str] = (),
    **about: Said,
) -> Claim:
    """The claim by itself: the members of each chain come to the same at random points of the symbols."""

    def gap(at: Point) -> float:
        point = completed(at, where)
        letters: Names = {Symbol(name): value for name, value in point.items()}
        return farthest(chains, {**letters, **meanings(point)})

    return agreement(key, symbols, gap, lambda _: 0.0, tolerance, points, moving, **about)


def farthest(chains: Iterable[Chain], names: Names) -> float:
    """How far members of one chain are apart at most, relative to their size; 1 where nothing is compared,
    which proves nothing."""
    return max(_gaps(chains, names), default=1.0)


def _gaps(chains: Iterable[Chain], names: Names) -> Iterator[float]:
    """How far the members of each chain are apart, relative to their size."""
    for chain in chains:
        values = [list(flat(valued(each, names))) for each in _meant(chain, names)]
        for value in values[1:]:
            scale = max([1.0, *map(abs, value), *map(abs, values[0])])
            same = len(value) == len(values[0])
            gaps = [0.0 if a == b else abs(a - b) for a, b in zip(value, values[0], strict=same)]
            yield max(gaps) / scale if same and all(map(isfinite, gaps)) else 1.0


def _meant(chain: Chain, names: Names) -> Chain:
    head = chain[0] if chain else None
    return chain[1:] if isinstance(head, Symbol | Indexed) and head not in names else chain


def valued(tree: Expr, names: Names) -> Any:
    """A tree as it is written, its names valued: a float or an array. A part that is named itself, as a
    derivative, has the value of its name. Raises KeyError for a name without a value, NotReal."""
    import numpy as np

    if tree in names:
        return np.array(names[tree]) if isinstance(names[tree], list) else names[tree]
    match tree:
        case Sum(terms):
            return reduce(np.add, [valued(term, names) for term in terms])
        case Product(factors):
            return reduce(_times, [valued(factor, names) for factor in factors])
        case Quotient(top, bottom):
            return _over(valued(top, names), valued(bottom, names))
        case Power(base, exponent):
            return _power(valued(base, names), valued(exponent, names))
        case Matrix(rows):
            return _of_blocks([[np.atleast_2d(valued(entry, names)) for entry in row] for row in rows])
        case Call(function, arguments):
            return _called(function, [valued(each, names) for each in arguments])
        case Measured(value):
            return valued(value, names)
        case Symbol(name) if name != "pi":
            raise KeyError(name)
    return number(tree, {})


def _of_blocks(rows: list[list[Any]]) -> Any:
    """Entries or blocks beside each other; a zero stands for as many as there is room for."""
    import numpy as np

    heights = [max(len(block) for block in row) for row in rows]
    widths = [max(block.shape[1] for block in column) for column in zip(*rows, strict=True)]
    return np.block(
        [
            [
                block if block.size > 1 or block.any() else np.zeros((h, w))
                for block, w in zip(row, widths, strict=True)
            ]
            for row, h in zip(rows, heights, strict=True)
        ]
    )


def _times(left: Any, right: Any) -> Any:
    return left @ right if _wide(left) and _wide(right) else left * right


def _wide(value: Any) -> bool:
    """Whether it is a matrix, and not one of one entry, which is a scalar."""
    return getattr(value, "ndim", 0) == 2 and value.size > 1


def _over(top: Any, bottom: Any) -> Any:
    if bottom == 0:
        raise DivisionByZero("a division by zero")
    return top / bottom


def _power(base: Any, exponent: Any) -> Any:
    import numpy as np

    if _wide(base):
        return np.linalg.matrix_power(base, int(exponent))
    return FUNCTIONS["pow"](float(base), float(exponent))


def _called(function: str, arguments: list[Any]) -> Any:
    import numpy as np

    of_matrices: dict[str, Callable[..., Any]] = {
        "transpose": np.transpose,
        "inverse": np.linalg.inv,
        "det": lambda M: np.linalg.det(np.atleast_2d(M)),
        "cross": lambda a, b: np.cross(a, b, axis=0),
    }
    if function in of_matrices:
        return of_matrices[function](*arguments)
    if function == "abs" and np.size(arguments[0]) > 1:  # of a vector
        return float(np.linalg.norm(arguments[0]))
    try:
        return FUNCTIONS[function](*map(float, map(_single, arguments)))
    except ValueError as error:
        raise NotReal(f"{function} is not real") from error


def _single(value: Any) -> Any:
    return value.item() if hasattr(value, "item") else value


def skew_of(vector: Any) -> Any:
    """S(w) (3 by 3) of an array of three."""
    import numpy as np

    x, y, z = np.ravel(vector)
    return np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])


def column_of(vector: Any) -> Any:
    """An array of n as a column (n by 1)."""
    import numpy as np

    return np.reshape(vector, (-1, 1))
