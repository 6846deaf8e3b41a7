"""A Jacobian seen from the frame in whose axes it is shortest: its rank is the same in all of them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import permutations

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.ring import Ring, ring
from derive.algebra.scalar import Scalar
from derive.mechanics.chain import Chain
from derive.mechanics.poses import position_part, rotation_part
from derive.mechanics.task import ROWS


def seen_shortest(
    chain: Chain, J: ScalarMatrix, rows: tuple[str, ...]
) -> tuple[int, tuple[str, ...], ScalarMatrix]:
    """(frame, names of the rows there, the rows) of a whole Jacobian (6 by n, base axes). Frame 0 and the
    rows as they were asked for where they are no shorter elsewhere."""
    best = 0, rows, ScalarMatrix(tuple(J.rows[ROWS.index(row)] for row in rows))
    least = _length(shortened(best[2]))
    for frame in range(1, len(chain.T)):
        seen = seen_from(chain, J, rows, frame)
        if seen is not None and (length := _length(shortened(seen[1]))) < least:
            best, least = (frame, *seen), length
    return best


def easiest(chain: Chain, J: ScalarMatrix, rows: tuple[str, ...], point: ScalarMatrix) -> ScalarMatrix:
    """A matrix that has the rank of these rows of the whole Jacobian of a point, the shortest of its kind:
    seen from another frame, columns subtracted, and where all six rows are asked for by another point too."""
    if set(rows) == set(ROWS):
        others = (_of_point(J, position_part(T) - point) for T in chain.T[1:])
        J = min((J, *others), key=lambda each: _length(shortened(each)))
    return shortened(seen_shortest(chain, J, rows)[2])


def _of_point(J: ScalarMatrix, away: ScalarMatrix) -> ScalarMatrix:
    """The whole Jacobian of a point of the same body that lies `away` (3 by 1): v + omega x away."""
    v, w = J.block(slice(0, 3), slice(None)), J.block(slice(3, 6), slice(None))
    turned = [w.columns(j).cross(away) for j in range(J.shape[1])]
    return ScalarMatrix.stacked([v + ScalarMatrix.beside(turned), w])


def seen_from(
    chain: Chain, J: ScalarMatrix, rows: tuple[str, ...], frame: int
) -> tuple[tuple[str, ...], ScalarMatrix] | None:
    """The rows that span the same velocities in the axes of a frame; None where no rows do."""
    home = _from_there(chain, frame)
    home = home.union(J.ring) if chain.coupling else home
    R_T, J = rotation_part(chain.T[frame]).T.into(home), J.into(home)
    names: list[str] = []
    kept: list[tuple[Scalar, ...]] = []
    for part, first in (("v", 0), ("w", 3)):
        asked = [k for k in range(3) if ROWS[first + k] in rows]
        if not asked:
            continue
        turned = R_T @ J.block(slice(first, first + 3), slice(None))
        same = list(_same(R_T, asked))
        if len(same) != len(asked):
            return None
        names += [f"{part}{'xyz'[k]}" for k in same]
        kept += [turned.rows[k] for k in same]
    return tuple(names), ScalarMatrix.of(kept)


def _from_there(chain: Chain, frame: int) -> Ring:
    """The ring with sums of angles that begin at the frame, so that those before it cancel."""
    home = chain.T[0].ring
    turning = [i for i, joint in chain.moving if joint.type != "prismatic"]
    sums = home.angles[: len(turning)]
    k = sum(1 for i in turning if i <= frame) - 1
    if k < 0 or chain.coupling:
        return home
    own = {atom for atom, _ in sums[k].moving.parts}
    moved = {
        form: form + sums[k].scaled(-1) if j > k else sums[k] + form.scaled(-1)
        for j, form in enumerate(sums)
        if j != k and own & {atom for atom, _ in form.moving.parts}
    }
    return ring(home.roots, tuple(moved.get(form, form) for form in home.angles), home.symbols)


def shortened(J: ScalarMatrix) -> ScalarMatrix:
    """With columns subtracted from each other where that makes them shorter: of parallel axes little is
    left. No minor of all rows changes what it says, and no rank."""
    columns = list(zip(*J.rows, strict=True))
    changed = True
    while changed:
        changed = False
        for i, j in permutations(range(len(columns)), 2):
            for sign in (1, -1):
                shorter = tuple(a - b * sign for a, b in zip(columns[i], columns[j], strict=True))
                if any(columns[j]) and _terms(shorter) < _terms(columns[i]):
                    columns[i], changed = shorter, True
    return ScalarMatrix(tuple(zip(*columns, strict=True)))


def _terms(column: Sequence[Scalar]) -> int:
    return sum(len(entry.numerator) for entry in column)


def _same(R_T: ScalarMatrix, asked: list[int]) -> Iterator[int]:
    """Axes of the frame that lie in the span of the asked ones of the base."""
    others = [k for k in range(3) if k not in asked]
    return (k for k in range(3) if not any(R_T[k, other] for other in others))


def _length(J: ScalarMatrix) -> int:
    return sum(len(entry.numerator) for entry in J.entries)
