"""What the rows of a Jacobian are called, and what acts along them."""

from __future__ import annotations

from collections.abc import Iterator

from derive.derivation import Phrase
from derive.kinds.spaces._linear_map import LinearMap
from derive.mechanics.task import ROWS


def nouns(found: LinearMap) -> tuple[Phrase, Phrase]:
    """What the rows are and what acts along them, where they are all of one sort."""
    sorts = {each.name[0] for each in found.velocities} if found.sort == "rows" else set()
    acting = "moments" if sorts == {"w"} else "forces" if sorts == {"v"} else "wrenches"
    return Phrase("angular-velocities" if sorts == {"w"} else "velocities"), Phrase(acting)


def nouns_hold(found: LinearMap, velocities: Phrase, wrenches: Phrase) -> Iterator[bool]:
    """By the places of the rows among the six of a Jacobian, the angular ones below."""
    places = [ROWS.index(each.name) for each in found.velocities] if found.sort == "rows" else []
    yield (velocities.key == "angular-velocities") == (bool(places) and min(places) > 2)
    yield (wrenches.key == "moments") == (bool(places) and min(places) > 2)
    yield (wrenches.key == "forces") == (bool(places) and max(places) < 3)
