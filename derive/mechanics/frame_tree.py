"""Frames composed along the tree of their parents: poses in normal form, and the way between two frames."""

from __future__ import annotations

from dataclasses import dataclass
from functools import reduce

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import Names, normal, normal_matrix
from derive.errors import NotDerivable
from derive.mechanics.frames import ByMatrix, Frame, Frames, FrameSource, Observed
from derive.mechanics.poses import composed, homogeneous, inverse_pose


@dataclass(frozen=True, slots=True)
class Way:
    """From one frame to another: up to the frame both stand in, and down from there. Each tuple lists
    frames so that their local poses multiply from left to right; those of `down` are inverted together."""

    up: tuple[Frame, ...]
    down: tuple[Frame, ...]
    meeting: int


def local(frame: Frame, names: Names | None = None) -> ScalarMatrix:
    """T (4 by 4) of a frame in its parent."""
    return pose_of(frame.source, names)


def pose_of(source: FrameSource, names: Names | None = None) -> ScalarMatrix:
    """T (4 by 4) of a frame however it is given."""
    if isinstance(source, Observed):
        axes = [[normal(part, names) for part in axis] for axis in (source.x, source.y, source.z)]
        return homogeneous(ScalarMatrix.of(axes).T, [normal(part, names) for part in source.origin])
    if isinstance(source, ByMatrix):
        matrix = normal_matrix(source.matrix, names)
        return matrix if matrix.shape == (4, 4) else homogeneous(matrix, (0, 0, 0))
    return composed(source.moves, names)


def mismatch(frames: Frames, frame: Frame, names: Names | None = None) -> ScalarMatrix:
    """E (4 by 4) of a frame given again: where the second description puts it, seen from where the first
    one does. The identity where they agree."""
    return inverse_pose(relative(frames, frame.number, frame.parent, names)) @ local(frame, names)


def require_closed(frames: Frames, names: Names | None = None) -> None:
    """Raises NotDerivable where a frame is given twice and in two places."""
    for frame in frames.again:
        if mismatch(frames, frame, names) != ScalarMatrix.identity(4):
            raise NotDerivable(
                f"frame {frame.number} is given twice, and the second time (in frame {frame.parent}) it "
                "stands elsewhere; find: loop shows the difference"
            )


def ancestry(frames: Frames, number: int, about: str = "") -> tuple[Frame, ...]:
    """The frames from the one in the world down to `number`, itself included; empty for the world.

    Raises NotDerivable where there is no such frame; `about` is the option that asked for it.
    """
    if not 0 <= number <= len(frames.frames):
        raise NotDerivable(f"there is no frame {number}: the frames are 0 to {len(frames.frames)}", about)
    found: list[Frame] = []
    while number:
        found.append(frames.frames[number - 1])
        number = found[-1].parent
    return tuple(reversed(found))


def way(frames: Frames, source: int, target: int) -> Way:
    """How frame `source` is seen from frame `target`."""
    up, down = ancestry(frames, source, "from"), ancestry(frames, target, "to")
    shared = sum(a == b for a, b in zip(up, down, strict=False))
    meeting = up[shared - 1].number if shared else 0
    return Way(up[shared:], down[shared:], meeting)


def along(path: tuple[Frame, ...], names: Names | None = None) -> ScalarMatrix:
    """T (4 by 4), the product of local poses; the identity for no frames."""
    return reduce(ScalarMatrix.__matmul__, (local(frame, names) for frame in path), ScalarMatrix.identity(4))


def relative(frames: Frames, source: int, target: int, names: Names | None = None) -> ScalarMatrix:
    """T (4 by 4) of frame `source` in frame `target`."""
    path = way(frames, source, target)
    T = along(path.up, names)
    return inverse_pose(along(path.down, names)) @ T if path.down else T
