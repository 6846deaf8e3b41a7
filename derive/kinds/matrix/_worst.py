"""Where a minor that changes with one cosine is smallest: that it is positive in every configuration becomes
conditions on its coefficients."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import pi
from typing import Any

from derive.algebra.angles import Form
from derive.algebra.normal import normal
from derive.algebra.numbers.floats import Point, number
from derive.algebra.scalar import Scalar, trig
from derive.algebra.substitution import pinned
from derive.derivation import Phrase, Said
from derive.errors import NotDerivable
from derive.expression import ZERO, Expr, Relation, Symbol, cos
from derive.kinds.fields import TREES
from derive.kinds.matrix._inertia import GivenInertia
from derive.kinds.robot._dynamics.definite import is_positive

POINTS, AROUND = 12, 24  # draws of the coefficients, angles looked at
ONE, NONE = Scalar.of(1), Scalar.of(0)


@dataclass(frozen=True)
class Worst:
    """The minors that change, each with the same cosine, and what has to be positive."""

    moving: tuple[Symbol, ...]
    cosine: Expr | None
    positive: tuple[Expr, ...]

    def told(self, D: Symbol) -> Phrase:
        conditions = tuple(Relation(each, ">", ZERO) for each in self.positive)
        key = "definite-just-where" if len(self.moving) == 1 else "definite-just-where-all"
        return Phrase(
            key, {"D": D, "minors": self.moving, "cosine": self.cosine or ZERO, "conditions": conditions}
        )


def worst(found: GivenInertia, minors: Sequence[tuple[Symbol, Expr]]) -> Worst | None:
    """Of minors whose sign is not known; None where one changes in another way, or none does."""
    moving, positive, angles = list[Symbol](), dict[Expr, None](), set[str]()
    for name, minor in minors:
        value = normal(minor, found.problem.names)
        held = [each for each in found.variables if each in value.letters()]
        ends = [value] if not held else _ends(found, value, held[0]) if len(held) == 1 else None
        if ends is None:
            return None
        if held:
            moving.append(name)
            angles |= {*held}
        positive |= dict.fromkeys(map(found.final, ends))
    if len(angles) != 1:
        return None
    return Worst(tuple(moving), cos(Symbol(angles.pop())), tuple(positive))


def _ends(found: GivenInertia, value: Scalar, name: str) -> list[Scalar] | None:
    """A + B c + C c^2 at c = 1 and c = -1, where it is smallest if C is not positive."""
    c, _ = trig(Form.of({name: 1}))
    try:
        front, back, side = (pinned(value, name, at) for at in ((ONE, NONE), (-ONE, NONE), (NONE, ONE)))
    except NotDerivable:
        return None
    B, C = (front - back) / 2, (front + back) / 2 - side
    if value != side + B * c + C * c * c or (C and not is_positive(found.final(-C), found.variables)):
        return None
    return [front] if front == back else [front, back]


def holds(found: GivenInertia, told: Worst) -> Iterator[bool]:
    """Whether the conditions are met just where the matrix in numbers is positive definite all around."""
    import numpy as np

    conditions = told.told(found.name).about["conditions"]
    assert isinstance(conditions, tuple)
    (name,) = [each for each in found.variables if told.cosine == cos(Symbol(each))]
    for at in found.points(POINTS):
        for grown in (1.0, 4.0):
            here: dict[str, Any] = {**at, **_grown(found, at, grown)}
            sizes = [
                np.linalg.eigvalsh(found.numbers({**here, name: 2 * pi * k / AROUND}))[0]
                for k in range(AROUND)
            ]
            yield (min(sizes) > 0) == all(_is_met(each, here) for each in conditions)


def _is_met(said: Said, here: Point) -> bool:
    """Whether a condition holds, as it is said: something is positive."""
    if not isinstance(said, Relation) or not isinstance(said.left, TREES):
        return False
    return said.sign == ">" and number(said.left, here) > number(said.right, here)


def _grown(found: GivenInertia, at: Any, by: float) -> dict[str, float]:
    """The first coefficient larger, so that the matrix may be positive definite."""
    first = min(found.problem.symbols - {*found.variables}, default=None)
    return {} if first is None else {first: by * abs(at[first])}
