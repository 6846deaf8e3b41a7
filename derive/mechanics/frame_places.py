"""Where frames are, in numbers: each put into the world upon its parent, and one seen from another.

Nothing is known here of the way between two frames.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from derive.algebra.numbers.floats import Point, number
from derive.mechanics.frames import ByMatrix, Frame, Frames, Observed
from derive.mechanics.oracle import made

if TYPE_CHECKING:
    from numpy.typing import NDArray


def seen(frames: Frames, number_of: int, reference: int, point: Point) -> NDArray[Any]:
    """T (4 by 4) of a frame in another."""
    import numpy as np

    return np.linalg.solve(in_the_world(frames, reference, point), in_the_world(frames, number_of, point))


def in_the_world(frames: Frames, number_of: int, point: Point) -> NDArray[Any]:
    """T (4 by 4) of a frame in frame 0."""
    import numpy as np

    if number_of == 0:
        return np.eye(4)
    (frame,) = (each for each in frames.frames if each.number == number_of)
    T: NDArray[Any] = in_the_world(frames, frame.parent, point) @ in_its_parent(frame, point)
    return T


def in_its_parent(frame: Frame, point: Point) -> NDArray[Any]:
    """T (4 by 4) of a frame in its parent, straight from what was given."""
    import numpy as np

    T, source = np.eye(4), frame.source
    match source:
        case Observed(x, y, z, origin):
            for j, axis in enumerate((x, y, z, origin)):
                T[:3, j] = [number(part, point) for part in axis]
            return T
        case ByMatrix(matrix):
            rows = np.array([[number(entry, point) for entry in row] for row in matrix.rows])
            T[: len(rows), : len(rows)] = rows
            return T
    return made(source.moves, point)
