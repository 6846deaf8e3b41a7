"""The cases: which robot, and what is asked of it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Literal, TypeAlias

from derive.mechanics.robot import Robot
from derive.sheet.load import load_sheet

Asked: TypeAlias = Literal["pose", "jacobian", "D", "c", "g"]

SHEETS = Path(__file__).parent / "robots"
KINEMATICS: tuple[Asked, ...] = ("pose", "jacobian")
DYNAMICS: tuple[Asked, ...] = ("D", "c", "g")


@dataclass(frozen=True, slots=True)
class Case:
    """A robot by its sheet, and what is derived: its pose, its Jacobian, D, every c_ijk, g."""

    letter: str
    title: str
    sheet: str
    asked: tuple[Asked, ...]

    @property
    def path(self) -> Path:
        return SHEETS / f"{self.sheet}.yaml"

    def robot(self) -> Robot:
        """The robot of the sheet. Raises SheetErrors."""
        subject = load_sheet(self.path).problems[0].subject
        if not isinstance(subject, Robot):
            raise TypeError(f"{self.path.name} is not about a robot")
        return subject


CASES = (
    Case("A", "2R, uniform links: D, c, g", "two-joints", DYNAMICS),
    Case("B", "anthropomorphic 3R, diagonal inertias: D, c, g", "anthropomorphic", DYNAMICS),
    Case("C", "Stanford arm: pose and Jacobian", "stanford", KINEMATICS),
    Case("D", "Stanford arm, diagonal inertias: D, c, g", "stanford", DYNAMICS),
    Case("E", "PUMA 560, 60 inertial symbols: D, c, g", "puma", DYNAMICS),
    Case("F", "7R, alternating quarter twists: all", "seven-joints", (*KINEMATICS, *DYNAMICS)),
    Case("G3", "planar 3R: D, c, g", "planar-3", DYNAMICS),
    Case("G6", "planar 6R: D, c, g", "planar-6", DYNAMICS),
    Case("G10", "planar 10R: D, c, g", "planar-10", DYNAMICS),
)


def case(letter: str) -> Case:
    """The case with this letter. Raises KeyError."""
    return {each.letter: each for each in CASES}[letter]
