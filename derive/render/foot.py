"""The foot of a page: what of it was proved, how and how often, and what could not be, in words."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from derive.derivation import Claim
from derive.render.printed import Reading
from derive.render.skin import environment


@dataclass(frozen=True, slots=True)
class Proved:
    """How often each truth was tried: lines compared with one another, laws, answers that were found a second
    time and at how many places, numbers at a point, formulas read back from the page; and how many results
    could be compared with nothing."""

    steps: int = 0
    laws: int = 0
    routes: int = 0
    places: int = 0
    numbers: int = 0
    reading: Reading = field(default_factory=Reading)
    alone: int = 0

    @classmethod
    def of(cls, claims: Iterable[Claim], reading: Reading, alone: int = 0) -> Proved:
        """What these claims come to, and what was read."""
        by_truth: dict[str, list[Claim]] = {}
        for claim in claims:
            by_truth.setdefault(claim.truth, []).append(claim)
        tried = {truth: sum(claim.tried for claim in found) for truth, found in by_truth.items()}
        routes = by_truth.get("second-route", [])
        return cls(
            tried.get("step", 0),
            len(by_truth.get("law", ())),
            len(routes),
            tried.get("second-route", 0),
            tried.get("number", 0),
            reading,
            alone,
        )

    def said(self) -> str:
        """Some sentences; none where nothing was claimed."""
        found = environment().get_template("words/_verified.j2").render(proved=self)
        return " ".join(found.split())
