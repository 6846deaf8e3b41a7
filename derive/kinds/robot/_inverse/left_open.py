"""Where equations leave a joint open because the arm is singular: which joint may be chosen there, and which
others follow from it."""

from __future__ import annotations

import math
import random
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from derive.derivation import Phrase, Said
from derive.expression import Call, Relation, Symbol
from derive.kinds.robot._inverse.subproblem import Solved
from derive.kinds.robot._inverse.target import Target, Values

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

STEP, NONE, SAME = 1e-5, 1e-4, 1e-8  # of a difference; below which a rate is none; of what is given
MOVED, NEWTON, TRIED = 0.005, 12, 2


@dataclass(frozen=True, slots=True)
class Choosable:
    """A joint that may be chosen where something is zero, and those that follow from it."""

    number: int  # of the sub-problem that tells it
    zero: Relation
    joint: str
    others: tuple[str, ...]

    @property
    def said(self) -> Phrase:
        """The sentence."""
        about: dict[str, Said] = {"joint": Symbol(self.joint), "others": tuple(map(Symbol, self.others))}
        return Phrase("chosen-there" if len(self.others) > 1 else "one-follows-there", about)


def choosable(solved: Sequence[Solved], target: Target) -> Iterator[Choosable]:
    """For each thing that leaves joints open where it is zero: the last of those joints, if the arm can move
    just there, and in one way, without changing what is given."""
    last = {each.facts.method.unless: each for each in solved if _left_open(each)}
    for (zero, *more), each in last.items():
        if more or not isinstance(each.head, Symbol):
            continue
        joint, moving = each.head.name, {_moving(target, at) for at in singular(zero, target)}
        if len(moving) == 1 and joint in (names := moving.pop()) and len(names) > 1:
            yield Choosable(each.number, zero, joint, tuple(name for name in names if name != joint))


def follow(found: Choosable, target: Target) -> Iterator[bool]:
    """Whether the arm keeps what is given as the joint is moved a little and just the others
    follow, each of them."""
    import numpy as np

    for at in singular(found.zero, target):
        wanted = np.array(target.there(at))
        there = {**at, found.joint: at[found.joint] + MOVED}
        for _ in range(NEWTON):
            missing = wanted - np.array(target.there(there))
            step = np.linalg.lstsq(_rates(target, there, found.others), missing, rcond=1e-9)[0]
            there |= {name: there[name] + float(by) for name, by in zip(found.others, step, strict=True)}
        yield bool(np.abs(wanted - np.array(target.there(there))).max() < SAME)
        yield all(abs(there[name] - at[name]) > SAME for name in found.others)


def singular(zero: Relation, target: Target) -> Iterator[Values]:
    """Configurations drawn at random in which a joint makes it zero; none where that is no sine or slide."""
    match zero.left:
        case Call("sin", (Symbol(name),)):
            values: tuple[float, ...] = (0.0, math.pi)
        case Symbol(name) if name in target.slides:
            values = (0.0,)
        case _:
            return
    if name not in target.joints:
        return
    draw = random.Random(name)
    for _ in range(TRIED):
        names = sorted({*target.names, *target.joints})
        at = dict(target.oracle.at({each: draw.uniform(0.6, 1.3) for each in names}))
        yield from ({**at, name: value} for value in values)


def _left_open(solved: Solved) -> bool:
    """Not of a wrist, of which its own sentences tell where it is singular."""
    said = solved.facts.open
    return said is not None and said.key == "singular-if" and solved.stage not in ("hand", "shoulder")


def _moving(target: Target, at: Values) -> tuple[str, ...]:
    """The joints of the only motion that changes nothing; none where there is no such, or more than one."""
    import numpy as np

    _, sizes, directions = np.linalg.svd(_rates(target, at, target.joints))
    still = [*sizes, *[0.0] * (len(target.joints) - len(sizes))]
    if sum(size < NONE for size in still) != 1:
        return ()
    return tuple(name for name, rate in zip(target.joints, directions[-1], strict=True) if abs(rate) > NONE)


def _rates(target: Target, at: Mapping[str, float], joints: Sequence[str]) -> Array:
    """How what is given changes with each of these joints."""
    import numpy as np

    def there(name: str, by: float) -> Array:
        return np.array(target.there({**at, name: at[name] + by}))

    columns = [(there(name, STEP) - there(name, -STEP)) / (2 * STEP) for name in joints]
    return np.column_stack(columns)
