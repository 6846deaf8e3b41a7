"""What the words of inverse kinematics read, beside the steps."""

from __future__ import annotations

from collections.abc import Sequence

from derive.derivation import PageFacts, Record, Step, Table
from derive.expression import Degrees, Expr, Symbol


class Compared(Record):
    """Which entries of a pose are compared: `axes` of a position (of the wrist's centre, where `wrist`), or
    elements of the `product` that is known, and where it is multiplied out what that `equals`. `frame` is the
    one it is seen from, None the base."""

    axes: tuple[str, ...]
    entries: tuple[str, ...]
    frame: int | None
    wrist: bool
    product: Expr
    equals: Symbol | None


class Method(Record):
    """How a sub-problem is solved, by `name`, and on what conditions.

    `unless` must not vanish (of a difference and of two opposite directions: all of them together); `factor`
    has a sign that was chosen before; `exists` has to lie between -1 and 1, or under a root not to be
    negative; `least` has to be no less than `c`; `form` is the equation that is solved, where no step has it.
    `by_name` says that the angle is a given one, `by_length` that other elements give the size of the other
    function, `positive` that only one of two lengths counts.
    """

    name: str
    unless: Sequence[Expr] = ()
    factor: Expr | None = None
    exists: Expr | None = None
    least: Expr | None = None
    c: Expr | None = None
    form: tuple[Expr, Expr] | None = None
    by_name: bool = False
    by_length: bool = False
    positive: bool = False


class SolvedFacts(Record):
    """Of one sub-problem: where its equations were read, its steps by their rules, and whether an orientation
    is what is out of reach where it has no solution."""

    method: Method
    unknown: Expr
    compared: tuple[Compared, ...]
    orientation: bool
    names: tuple[Step, ...]
    equations: tuple[Step, ...]
    squares: tuple[Step, ...]
    aside: tuple[Step, ...]
    solved: tuple[Step, ...]
    choices: tuple[Step, ...]
    left: tuple[Step, ...]


class SingularWrist(Record):
    """The middle angle at which the outer axes of a wrist coincide, and what is determined there."""

    middle: tuple[Symbol, Degrees]
    step: Step


class Wrist(Record):
    """Of a spherical wrist: the rows of its joints; the place of its centre, where that has to be found, and
    whether it is the origin of the end-effector's frame; the rotation before it, what it has to make and in
    which `elements`, and what it makes; its sub-problems, and its singular cases."""

    joints: tuple[int, int, int]
    centre: tuple[Step, ...]
    at_end: bool
    before: Symbol
    wanted: tuple[Step, ...]
    elements: tuple[Step, ...]
    made: Step
    solved: tuple[SolvedFacts, ...]
    singular: tuple[SingularWrist, ...]


class Triangle(Record):
    """Of two links, the line of length `r` to the end-effector, and the angle at the `elbow`; `same` of links
    that are equally long."""

    r: Expr
    elbow: Expr
    theta_1: Symbol
    theta_2: Symbol
    same: bool


class GivenAngle(Record):
    """From an axis of the base to one of the end-effector."""

    name: Symbol
    base: str
    axis: str


class AtPlace(Record):
    """At the place asked for: `out_of_reach` where no branch is real, `missed` where some are but do not
    bring the end-effector there, `free` where an unknown can be chosen at will, `rounded` where the nearest
    rotation was taken for the one typed."""

    out_of_reach: bool = False
    missed: bool = False
    free: bool = False
    rounded: bool = False


class Facts(PageFacts):
    """Of the whole: the `pose` that is given, by its elements, as a position and an angle or an orientation;
    `conditions` on it; the sub-problems of the `arm`, then of its wrist; `chosen` are the joint variables
    with two values, in a `tree` where there are several. `partial`: not every solution is one at every
    pose."""

    triangle: Triangle | None = None
    pose: tuple[Step, ...] = ()
    angle: GivenAngle | None = None
    orientation: bool = False
    conditions: tuple[tuple[Expr, ...], ...] = ()
    arm: tuple[SolvedFacts, ...] = ()
    wrist: Wrist | None = None
    tree: Table | None = None
    count: int = 0
    chosen: tuple[Expr, ...] = ()
    partial: bool = False
    place: AtPlace = AtPlace()
