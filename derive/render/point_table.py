"""Solutions at a point one below the other, each by what it is called."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from derive.derivation import Cell
from derive.errors import NotAsWritten
from derive.expression import Approximate, Degrees, Symbol
from derive.render.chain_links import chain_links
from derive.render.layout import Link
from derive.render.printed import Printed
from derive.render.same_numbers import same_numbers
from derive.render.skin import english
from derive.render.tables import unit_text

if TYPE_CHECKING:
    from derive.render.evaluated import Telling

ABOUT = ("when", "real", "free", "fixed", "true_at", "feasible")  # a solution, beside its values
ALL_DIGITS = 15
WHOLE_WITHIN = 1e-7  # degrees
EDGE = 1e-9  # radians
HALF = 0.5000001  # of the last decimal


@dataclass(frozen=True, slots=True)
class PointTable:
    """What is `told` on a page; names of the `working` are left out. Angles of a feasible solution are said
    within their `limits` (radians)."""

    told: Telling
    working: Collection[str]
    limits: Mapping[str, tuple[float, float]]

    def written(self, branches: Sequence[Mapping[str, Any]], labels: Sequence[Cell]) -> str:
        """The rows under their headings. At least one solution is real."""
        real = next(branch for branch in branches if branch.get("real", True))
        names = [name for name in real if name not in ABOUT and name not in self.working]
        is_open = any("free" in branch for branch in branches)
        is_judged = any("feasible" in branch for branch in branches)
        headings = [english("among"), *map(self._name, names), *([english("open")] if is_open else [])]
        headings += [english("feasible")] if is_judged else []
        rows = []
        for branch, label in zip(branches, labels, strict=True):
            rows.append([self._label(label)])
            if branch.get("real", True) != (branch.keys() >= {*names}):
                raise NotAsWritten("a solution has values and is not real, or has none and is")
            if branch.get("real", True):
                rows[-1] += [self._cell(name, self._within(name, branch)) for name in names]
            else:
                rows[-1] += [english("not_real"), *[""] * (len(names) - 1)]
            if is_open:
                rows[-1].append(self.told.speech.when(branch["when"][-1:]) if "free" in branch else "")
            if is_judged:
                rows[-1].append(_judged(branch))
        return self.told.skin.table(headings, rows)

    def _label(self, label: Cell) -> str:
        return label if isinstance(label, str) else self.told.speech.say(label)

    def _name(self, name: str) -> str:
        """The heading of a column, with the unit of what stands below it."""
        unit = self.told.unit(name)
        written = self.told.inline(chain_links((Symbol(name),), self.told.printer), Symbol(name), "")
        said = unit and not (name in self.told.angles and self.told.style.degrees)
        return f"{written} [{self.told.skin.plain(unit_text(unit))}]" if said else written

    def _within(self, name: str, branch: Mapping[str, Any]) -> float:
        """A value, with as many full turns as bring it into its range."""
        value: float = branch[name]
        if name not in self.limits or not branch.get("feasible"):
            return value
        low, high = self.limits[name]
        if low - EDGE <= value <= high + EDGE:
            return value
        turned = value + math.tau * math.ceil((low - EDGE - value) / math.tau)
        if not low - EDGE <= turned <= high + EDGE:
            raise NotAsWritten(f"{name} is said to be feasible and is not in its range")
        return turned

    def _cell(self, name: str, value: float) -> str:
        """One value; an angle in degrees with as many decimals as the others."""
        notation = self.told.printer.notation
        if name in self.told.angles and self.told.style.degrees:
            decimals = max(notation.digits - 2, 0)
            link, shown = _fixed(math.degrees(value), decimals)
            notation = replace(notation, digits=ALL_DIGITS)  # as many as are written
            told = abs(math.remainder(shown - math.degrees(value), 360)) <= HALF * 10**-decimals
        else:
            (link,) = chain_links((self.told.scalar(value, "", name in self.told.angles),), self.told.printer)
            told = link.tree is not None and same_numbers(link.tree, value)
        self.told.printed.append(replace(Printed.inline(link.latex, (link,), notation), evaluated=told))
        return f"${link.latex}$"


def _judged(branch: Mapping[str, Any]) -> str:
    """Whether a solution is feasible; empty where that is not said."""
    return english("yes" if branch["feasible"] else "no") if "feasible" in branch else ""


def _fixed(degrees: float, decimals: int) -> tuple[Link, float]:
    """An angle in degrees with so many decimals, and what is shown of it, above -180; a whole one without."""
    whole = round(degrees)
    if abs(degrees - whole) < WHOLE_WITHIN:
        return Link("=", rf"{whole}^\circ", Degrees(Fraction(whole))), whole
    rounded = round(degrees, decimals) + 0.0  # no negative zero
    rounded = 180.0 if rounded == -180 else rounded
    tree = Approximate(rounded) * Degrees(Fraction(1))
    return Link("=", rf"{rounded:.{decimals}f}^\circ", tree), rounded
