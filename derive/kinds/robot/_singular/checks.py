"""That a singular set is one, in numbers: the rank drops there and nowhere else."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from derive.algebra.numbers import floats as numeric
from derive.derivation import Claim
from derive.kinds.checks import SECOND_ROUTE, random_points
from derive.kinds.robot._chain import oracle_of
from derive.kinds.robot._singular.sets import Analysed, Case
from derive.kinds.robot._velocity.task import Task
from derive.mechanics.task import ROWS

SMALL = 1e-5  # a singular value, relative to the largest; differences leave less


def checked(task: Task, sets: Iterable[Analysed]) -> Iterator[Claim]:
    """Claims about every case, and about configurations at random."""
    full = min(task.J.shape)
    regular = all(_rank(task.numbers(at)) == full for at in random_points(task.symbols, 3))
    yield Claim("full-rank", SECOND_ROUTE, regular)
    for each in sets:
        for zeros in each.places:
            name = ", ".join(zero.variable for zero in zeros)
            ranks = [_rank(task.numbers(here)) for here in each.block.seeing.places(zeros)]
            holds = all(rank == each.rank for rank in ranks)
            yield Claim("rank", SECOND_ROUTE, holds, {"rank": each.rank, "names": name})
        for case in each.cases:
            if case.J is not None:
                name = ", ".join(zero.variable for zero in case.zeros)
                yield Claim("spaces", SECOND_ROUTE, _spaces(task, each, case), {"names": name})


def _rank(J: Any) -> int:
    import numpy as np

    values = np.linalg.svd(J, compute_uv=False)
    return int((values > SMALL * max(1.0, values[0])).sum())


def _spaces(task: Task, each: Analysed, case: Case) -> bool:
    """J x = 0 and u J = 0 of the block in numbers, and its rank."""
    import numpy as np

    holds = True
    for here in each.block.seeing.places(case.zeros):
        J = _block_numbers(task, each, here)
        size = max(1.0, float(np.abs(J).max()))
        holds &= _rank(J) == case.rank
        for vectors, matrix in ((case.null, J), (case.lost, J.T)):
            for vector in vectors:
                v = np.array(numeric.matrix_numbers(vector, here))
                longest = max(1.0, float(np.abs(v).max()))
                holds &= bool(np.abs(matrix @ v).max() <= SMALL * size * longest)
    return holds


def _block_numbers(task: Task, each: Analysed, here: dict[str, float]) -> Any:
    """The block by differences of the poses: its rows and columns of the Jacobian of its own point, turned
    into its own frame."""
    import numpy as np

    block = each.block
    oracle = oracle_of(task.problem)
    known = oracle.at(here)
    columns = [task.found.variables.index(name) for name in block.variables]
    if block.frame == 0:
        return task.numbers(here)[:, columns]
    poses = oracle.poses(known)
    if block.name in ("J_11", "J_22"):
        p = np.array([row[0] for row in numeric.matrix_numbers(block.seeing.point, known)])
        T = poses[-1]
        J = oracle.jacobian(known, len(poses) - 1, T[:3, :3].T @ (p - T[:3, 3]))
    elif block.J.shape == (len(ROWS), len(ROWS)):
        J = oracle.jacobian(known, len(poses) - 1, (0.0, 0.0, 0.0))
    else:
        J = oracle.jacobian(known, task.point.frame, task.point.offset)
    R = poses[block.frame][:3, :3]
    turned = np.vstack([R.T @ J[:3], R.T @ J[3:]])
    return turned[[ROWS.index(row) for row in block.rows]][:, columns]
