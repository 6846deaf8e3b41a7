"""What the rows of a Jacobian are called, and what acts along them."""

from __future__ import annotations

from collections.abc import Iterator

from derive.derivation import Phrase
from derive.kinds.spaces._linear_map import LinearMap
from derive.mechanics.task import ROWS

ONE = {"moments": "moment", "forces": "force", "wrenches": "wrench"}


def nouns(found: LinearMap) -> tuple[Phrase, Phrase, Phrase]:
    """What the rows are, what acts along them, and one of these, where they are all of one sort."""
    sorts = {each.name[0] for each in found.velocities} if found.sort == "rows" else set()
    acting = "moments" if sorts == {"w"} else "forces" if sorts == {"v"} else "wrenches"
    rows = Phrase("angular-velocities" if sorts == {"w"} else "velocities")
    return rows, Phrase(acting), Phrase(ONE[acting])


def nouns_hold(found: LinearMap, velocities: Phrase, wrenches: Phrase, acting: Phrase) -> Iterator[bool]:
    """By the places of the rows among the six of a Jacobian, the angular ones below."""
    places = [ROWS.index(each.name) for each in found.velocities] if found.sort == "rows" else []
    yield (velocities.key == "angular-velocities") == (bool(places) and min(places) > 2)
    for key in ("moment", "moments"):
        yield (key in (wrenches.key, acting.key)) == (bool(places) and min(places) > 2)
    for key in ("force", "forces"):
        yield (key in (wrenches.key, acting.key)) == (bool(places) and max(places) < 3)
