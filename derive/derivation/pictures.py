"""Figures as data: plots of curves, and drawings of strokes and captions. Nothing is drawn here."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TypeAlias

from derive.derivation.said import (
    Label,
    Phrase,
)
from derive.expression import Expr

Place: TypeAlias = tuple[float, float]  # to the right and up
Curve: TypeAlias = tuple[tuple[float, ...], tuple[float, ...]]  # to the right, and up


@dataclass(frozen=True, slots=True)
class Span:
    """A named length between two places of a plot: along the horizontal axis (a rise time), or along the
    vertical one where both are at the same time (an overshoot)."""

    label: Label
    start: Place
    end: Place


@dataclass(frozen=True, slots=True)
class Plot:
    """Curves to draw: labels of the axes and named series of points. Data only, no drawing.

    `marks` are horizontal lines, `moments` vertical ones, named on the horizontal axis, `levels` heights that
    are named on the vertical one; `band` is between two
    heights. `regions` are outlines to be filled, `arms` links from joint to joint, `arrows` vectors from one
    place to another, `points` places, `spans` lengths that are read off. `counted` are values at whole
    numbers, `log` says that heights are on a logarithmic scale, `equal` that both axes have the same scale,
    `unscaled` that numbers along them mean nothing.
    """

    name: str
    x_label: Label
    y_label: Label
    series: Mapping[Label, Curve]
    marks: Mapping[Label, float] = field(default_factory=dict)
    moments: Mapping[Label, float] = field(default_factory=dict)
    levels: Mapping[Label, float] = field(default_factory=dict)
    band: tuple[float, float] | None = None
    regions: Mapping[Label, Curve] = field(default_factory=dict)
    arms: Mapping[Label, Curve] = field(default_factory=dict)
    arrows: Mapping[Label, tuple[Place, Place]] = field(default_factory=dict)
    points: tuple[Place, ...] = ()
    spans: tuple[Span, ...] = ()
    counted: bool = False
    log: bool = False
    equal: bool = False
    unscaled: bool = False
    caption: Phrase | None = None
    alt: Phrase | None = None


@dataclass(frozen=True, slots=True)
class Panels:
    """Plots one above the other over the same horizontal axis, or `beside` each other."""

    name: str
    plots: tuple[Plot, ...]
    beside: bool = False
    caption: Phrase | None = None
    alt: Phrase | None = None


@dataclass(frozen=True, slots=True)
class Stroke:
    """A line through places, or a filled shape; `role` says what it stands for ("link", "z", "wire")."""

    places: tuple[Place, ...]
    role: str


@dataclass(frozen=True, slots=True)
class Words:
    """Words as they stand, with mathematics in LaTeX between dollars."""

    text: str


@dataclass(frozen=True, slots=True)
class Caption:
    """What is written beside a place, on the side `towards`, or upon it where that is (0, 0): a tree, a name,
    several names, or words. `others` are places, each with its side, beside which it may stand as well;
    `clear` is how far from its place it begins, in the measure of the drawing."""

    at: Place
    text: Expr | str | tuple[str, ...] | Phrase | Words
    towards: Place = (0.0, 0.0)
    role: str = ""
    others: tuple[tuple[Place, Place], ...] = ()
    clear: float = 0.0


@dataclass(frozen=True, slots=True)
class Drawing:
    """A picture of a subject: strokes from back to front, and captions. Data only, no drawing. `caption` is
    what stands under it, `alt` what it shows, for those who do not see it; `highest` is how high it may be
    (points) where it needs less than there is room for, `unit` how large one of its measures is on paper
    where that is not for the paper to choose. The lengths in a `schematic` one mean nothing."""

    name: str
    strokes: tuple[Stroke, ...]
    captions: tuple[Caption, ...] = ()
    caption: Phrase | None = None
    alt: Phrase | None = None
    highest: float = 0.0
    unit: float = 0.0
    schematic: bool = False

    def same(self, other: Drawing) -> bool:
        """Whether both show the same; of schemes, with the same names."""
        if self.schematic and other.schematic:
            return self._scheme == other._scheme
        return (self.strokes, self.captions) == (other.strokes, other.captions)

    @property
    def _scheme(self) -> tuple[object, ...]:
        roles = tuple(stroke.role for stroke in self.strokes)
        return roles, tuple((caption.role, caption.text) for caption in self.captions)


Figure: TypeAlias = Plot | Panels | Drawing
