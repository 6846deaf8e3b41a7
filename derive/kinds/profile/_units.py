"""What the names of a motion measure, as far as its sheet says what moves."""

from __future__ import annotations

from collections.abc import Mapping

from derive.derivation import Phrase
from derive.expression import Degrees, Expr, Number, Symbol, walk
from derive.kinds.fields import Place
from derive.mechanics.profile import NO_UNITS, Profile, Sort, Units

DEGREES = Units(("", "/s", "/s^2"), "s")
TIMES = ("t", "t_1", "t_2", "t_3", "t_m", "t_b", "t_f", "t_min")
RATES: Mapping[str, int | None] = {
    **dict.fromkeys(TIMES), "q": 0, "d": 0, "v": 1, "a": 2, "v_peak": 1, "a_peak": 2,
}  # fmt: skip


def units_of(profile: Profile, rates: Mapping[Expr, int | None]) -> dict[Expr | Phrase, str]:
    """The units of these names, each with how often it is differentiated (None: a time), and of those that
    every motion has; of none where symbols stand for what is given."""
    if profile.units == NO_UNITS:
        return {}
    usual: dict[Expr, int | None] = {Symbol(name): rate for name, rate in RATES.items()}
    return {name: _unit(profile, rate) for name, rate in (usual | {**rates}).items()}


def sort_at(profile: Profile, place: Place | None) -> Sort:
    """What moves, as far as the data say it, or the values of a point."""
    typed = [node for _, value in place or () for node in walk(value)]
    units = {node.unit.partition("/")[0] for node in typed if isinstance(node, Number)}
    angle = "rad" in units or any(isinstance(node, Degrees) for node in typed)
    return profile.sort or ("angle" if angle else "length" if "m" in units else "")


def _unit(profile: Profile, rate: int | None) -> str:
    base = profile.units.motion[0] or "deg"
    if rate is None:
        return "s"
    return base + ("" if rate == 0 else "/s" if rate == 1 else f"/s^{rate}")
