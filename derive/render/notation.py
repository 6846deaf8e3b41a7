"""How a sheet wants its mathematics printed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from derive.render.lettering import HOUSE, Lettering


@dataclass(frozen=True, slots=True)
class Notation:
    """The choices of a sheet.

    `atan2`: `yx` prints atan2(y, x), `xy` prints Atan2(x, y) as Spong does. `trig`: `short` prints
    c_1 and s_{12} for joint angles. `digits`: significant digits of evaluated numbers.
    `short_names`: further angles that short notation abbreviates by their whole name, c_\\phi.
    `meant`: indices with which a c or an s is a name of the sheet, which short notation may not use.
    `alike`: letters of the sheet that also bear such an index, L beside L_c.
    `letters`: what the answers' own names are printed as. `angles`: how those of
    results are written, None as they were typed. `columns`: the order of a table of link parameters.
    `angular_first`: whether twists begin with the angular velocity.
    """

    atan2: Literal["yx", "xy"] = "yx"
    trig: Literal["short", "long"] = "short"
    digits: int = 3
    short_names: frozenset[str] = frozenset()
    meant: frozenset[str] = frozenset()
    alike: frozenset[str] = frozenset()
    letters: Lettering = HOUSE
    angles: Literal["deg", "rad"] | None = None
    columns: tuple[str, ...] = ()
    angular_first: bool = False
