"""Gears, belts and gear boxes between a motor and its load: what is known of each stage."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from derive.expression import Expr

Form: TypeAlias = Literal["gears", "ring", "belt", "crossed", "harmonic", "planetary", "ratio"]
Size: TypeAlias = Literal["teeth", "radii", "diameters", ""]


@dataclass(frozen=True, slots=True)
class Stage:
    """One stage of a transmission, from what drives it to what it drives.

    `sizes` are, in this order: of `gears` that mesh outside, of a pinion in a `ring` and of the pulleys of a
    `belt` (open, or `crossed`) those of the driving and of the driven wheel; of a `harmonic` drive the teeth
    of its flexspline, which moves, and of its circular spline, which is held; of a `planetary` gear those of
    its sun, which drives, and of its ring, which is held; of what is given by its `ratio` that. `measured`
    says of the wheels what the sizes are. `inertia` (kg m^2) is that of the shaft behind the stage.
    """

    form: Form
    sizes: tuple[Expr, ...]
    measured: Size = "teeth"
    inertia: Expr | None = None
