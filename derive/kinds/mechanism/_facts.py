"""What the words read of a count of freedoms."""

from __future__ import annotations

from typing import TypeAlias

from derive.derivation import PageFacts, Phrase, Record
from derive.expression import Expr, Symbol
from derive.mechanics.mobility import Space

Other: TypeAlias = tuple[Space, tuple[Expr, Expr], Expr]  # its lambda, and the freedoms with that


class Facts(PageFacts):
    space: Space
    bodies: tuple[Expr, Expr]
    pairs: Expr | None  # revolute joints of a loop that may move though the formula does not see it
    loops: Phrase | None  # that are closed
    takes: tuple[Phrase, ...]  # what a joint of each sort takes away
    together: tuple[Phrase, ...]  # how many of each sort there are
    coincident: tuple[tuple[Phrase | None, Expr, Expr], ...]  # joints: name, bodies, pairs
    legs: tuple[tuple[str, Expr, Expr], ...]  # chain, count, bodies between
    sign: int  # of the degrees of freedom
    missing: Expr | None  # where there are less than none
    idle: Expr | None
    motors: Expr | None  # that drive it
    may_spin: Phrase | None
    sliders: bool  # among its joints
    others: tuple[Other, ...]


class LegFacts(PageFacts):
    given: tuple[tuple[Expr, Expr], ...] = ()
    delta: bool = False
    legs: tuple[tuple[Expr, tuple[str, ...], tuple[Phrase, Phrase]], ...] = ()  # numbers, lines, elbows
    across: Symbol | None = None  # a coordinate of the point that is as it is for every leg
    angle: Symbol | None = None  # of the first leg
    vectors: tuple[str, ...] = ()  # lines of those along legs that extend
    lengths: tuple[str, ...] = ()
    points: tuple[Symbol, Symbol] | None = None  # of the first leg, on the base and on the platform
    place: Symbol | None = None  # of the platform
    turned: Symbol | None = None


class JacobianFacts(PageFacts):
    given: tuple[tuple[Expr, Expr], ...] = ()
    # Lines of vectors: along the rod of each leg, or from the middle of a platform to its end.
    rods: tuple[str, ...] = ()
    first: Symbol  # of the first leg
    angles: tuple[Symbol, ...] = ()
    delta: bool = False
    along: Expr | None = None  # the direction of the first leg that extends


class PositionFacts(PageFacts):
    given: tuple[tuple[Expr, Expr], ...]
    end: tuple[Symbol, Symbol]  # coordinates of the end of the crank
    unknown: tuple[Symbol, ...]  # coordinates that are sought
    rod: Symbol | None = None  # the bar that joins the crank to what it moves
    rocker: tuple[Symbol, Symbol] | None = None  # its length and the ground
    lines: tuple[str, ...] = ()  # of the working
    offset: Expr | None = None  # of a slider
    sides: tuple[Phrase, Phrase] | None = None  # on which the assemblies are
    motors: tuple[Symbol, Symbol] | None = None  # the angles of two cranks
    meeting: tuple[str, ...] = ()  # lines of the working for the point in which their couplers meet
    sides_of_line: tuple[tuple[Phrase, str, str], ...] = ()  # where it lies, and the lines of its coordinates


class EndTold(Record):
    """Where what is moved is at the end of its range, by a step, and how that goes with the crank."""

    line: str
    said: Phrase


class Singular(Record):
    """How bars lie, the step that says where, or that it is nowhere, and where an end of a range is."""

    lie: Phrase
    line: str
    nowhere: Phrase | None
    end: EndTold | None


class SingularFacts(PageFacts):
    det: tuple[Expr, ...] = ()
    factors: tuple[Expr, Expr] | None = None  # of the determinant, and of the rate of what is moved
    unbounded: tuple[Singular, ...] = ()
    at_rest: tuple[Singular, ...] = ()
    last: Symbol | None = None  # the rate of what is moved
    around: Phrase | None = None  # whether the crank turns all the way round
    four: bool = False
    angle: Symbol | None = None
    distances: tuple[Symbol, Symbol, Symbol] | None = None  # of the point from the pivots; of the elbows
    at_border: tuple[tuple[Phrase, str], ...] = ()  # legs in line, and the steps of their distances
    loose: tuple[tuple[Phrase, str, Phrase], ...] = ()  # couplers in line, and what meets there
