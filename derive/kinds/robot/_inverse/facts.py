"""What the words of inverse kinematics read, beside the steps."""

from __future__ import annotations

from typing import Literal

from derive.derivation import Condition, PageFacts, Phrase, Record, Step, Table
from derive.expression import ZERO, Expr, Relation, Symbol


def zero(*trees: Expr) -> tuple[Relation, ...]:
    """That each of these is zero."""
    return tuple(Relation(tree, "=", ZERO) for tree in trees)


class Compared(Record):
    """Which entries of a pose are compared: `axes` of a position (of the `centre` of the wrist or shoulder,
    where that is said), or elements of the `product` that is known, and where it is multiplied out what that
    `equals`. `frame` is the one it is seen from, None that in which the position is known: the end-effector's
    for a shoulder, else the base."""

    axes: tuple[str, ...]
    entries: tuple[str, ...]
    frame: int | None
    centre: Literal["wrist", "shoulder"] | None
    product: Expr | None
    equals: Symbol | None


class Polynomial(Record):
    """Of an equation of the fourth degree: its `root`, the `height` that does not change with the `first`
    joint and does with the `second`, and its steps by their rules."""

    root: Symbol
    height: Expr
    first: Symbol
    second: Expr
    split: tuple[Step, ...]
    joined: tuple[Step, ...]
    half: tuple[Step, ...]
    quartic: tuple[Step, ...]
    aside: tuple[Step, ...]
    expanded: tuple[Step, ...]
    squared: tuple[Step, ...]


class Method(Record):
    """How a sub-problem is solved, by `name`, and on what conditions.

    `unless` must not hold (of a difference and of two opposite directions: not all of them together);
    `vector` is what the unknown turns into the known sides; `factor` has a sign that was chosen before;
    `exists` has to lie between -1 and 1; `bound` has to hold for a real solution; `half` is the angle of
    which the unknown is twice. `by_name` says that the angle is a given one, `by_length` that other elements
    give the size of the other function, `positive` that only one of two lengths counts; `squared` which of
    the equations are, where not all.
    """

    name: str
    unless: tuple[Relation, ...] = ()
    vector: tuple[Expr, ...] = ()
    factor: Expr | None = None
    exists: Expr | None = None
    bound: Relation | None = None
    half: Expr | None = None
    by_name: bool = False
    by_length: bool = False
    positive: bool = False
    squared: Phrase | None = None
    quartic: Polynomial | None = None

    @property
    def signs(self) -> tuple[Relation, ...]:
        """Those of the factor, in the order of the choices."""
        return tuple(Relation(self.factor, sign, ZERO) for sign in "><") if self.factor else ()


class SolvedFacts(Record):
    """Of one sub-problem: where its equations were read, or that they are those of one before, its steps by
    their rules, and whether an orientation is what is out of reach where it has no solution. The first of
    `two` values makes something `positive`, or `negative`; where the unknown is `open` nothing determines it.
    A sum is `called` by a name; `form` is the equation that is solved, where it stands in no other step.
    """

    method: Method
    unknown: Expr
    single: bool
    called: Expr
    compared: tuple[Compared, ...]
    again: Phrase | None
    two: Phrase | None
    positive: Expr | None
    negative: Expr | None  # the opposite, where that has no minus in front
    open: Phrase | None
    orientation: bool
    whole: bool  # whether a position and an orientation are wanted
    resting: tuple[Symbol, ...]  # the joints, found before, that decide whether a value is real
    sides: tuple[Expr, ...]  # the known ones of equations that stand above
    names: tuple[Step, ...]
    equations: tuple[Step, ...]
    squares: tuple[Step, ...]
    aside: tuple[Step, ...]
    form: Step | None
    solved: tuple[Step, ...]
    choices: tuple[Step, ...]
    left: tuple[Step, ...]
    chosen: Phrase | None = None  # which joint may be chosen where it is open

    def is_like(self, other: SolvedFacts) -> bool:
        """Whether both are told by equations and choices alone, in which the same factor cancels."""
        factor = self.method.factor
        return factor is not None and factor == other.method.factor and self._is_short and other._is_short

    @property
    def _is_short(self) -> bool:
        others = (self.names, self.squares, self.aside, self.solved, self.left)
        return self.method.name == "direction" and bool(self.equations) and not any(others)


class SingularWrist(Record):
    """The middle angle at which the outer axes of a wrist coincide, and what is determined there."""

    said: Phrase
    step: Step


class Wrist(Record):
    """Of a spherical wrist or shoulder: where its axes meet, and the place of that centre, where it has to be
    found; what the other joints leave it to make, in which `elements`, and what it makes in the angles that
    are `named`; its sub-problems, and its singular cases."""

    meeting: Phrase | None
    centre: tuple[Step, ...]
    before: Phrase | None
    wanted: tuple[Step, ...]
    elements: tuple[Step, ...]
    whole: bool  # whether these are all
    named: Phrase
    stands: bool  # whether what it makes was displayed with the pose of the end-effector
    made: Step
    solved: tuple[tuple[SolvedFacts, ...], ...]
    singular: tuple[SingularWrist, ...]


class ByAngle(Record):
    """Of a shoulder that is turned by the arm angle: what is said of the two `centres` and of the `turn`, the
    `line` between them, its `directions` in the base and in `frame`, which follows the shoulder (`bent`), the
    frame on it seen from either, what the shoulder has to make in which `elements`, what it makes, and its
    sub-problems."""

    centres: Phrase
    turn: Phrase
    line: Step
    directions: tuple[Step, ...]
    frame: int
    bent: Step
    before: Step
    after: Step
    wanted: Step
    elements: tuple[Step, ...]
    whole: bool  # whether these are all
    made: Step
    solved: tuple[SolvedFacts, ...]


class Eliminated(Record):
    """Of six joints that no formula inverts: `why`; the equation of poses that `cut`s the arm, with three
    joints on each side; those that are left (`triple`, with the `unknown`), the two and the `last` that
    are eliminated; direction and position of the `line` along the axis of `last` and what follows from them
    to be `equal` on both sides; the tangent of half the unknown, the polynomial of some `degree` in it, and
    how many real `roots` that has, several solutions sharing one (`shared`). All that is taken `beside` the
    pose where the determinant is zero at the pose itself."""

    why: Phrase
    cut: Relation
    triple: tuple[Symbol, ...]
    pair: tuple[Symbol, ...]
    last: Symbol
    others: tuple[Symbol, ...]  # these three
    line: tuple[Symbol, Symbol]
    equal: tuple[Expr, ...]
    unknown: Symbol
    root: Symbol
    half: Step
    polynomial: Step
    degree: int
    roots: Phrase
    shared: Phrase | None
    beside: Phrase | None

    @property
    def steps(self) -> tuple[Step, ...]:
        """In the order of the page."""
        return self.half, self.polynomial


class ElbowTold(Record):
    """One of the two ways to bend it."""

    when: tuple[Condition, ...]
    step: str


class Triangle(Record):
    """Of two links, the line of length `r` to the end-effector, and the angle at the `elbow`, whose cosine is
    that of its neighbour `mirrored`; links that are
    equally long can be `folded` to nothing."""

    r: Expr
    elbow: Expr
    mirrored: Relation
    theta_1: Symbol
    elbows: tuple[ElbowTold, ...]
    folded: Phrase | None


class AtPlace(Record):
    """At the place asked for: `out_of_reach` where no branch is real, `missed` where some are but do not
    bring the end-effector there, `free` where an unknown can be chosen at will, `rounded` where the nearest
    rotation was taken for the one typed; `unreal` branches `of` all have no real values where others have."""

    out_of_reach: bool = False
    missed: bool = False
    free: bool = False
    rounded: bool = False
    unreal: int = 0
    of: int = 0

    @property
    def said(self) -> tuple[Phrase, ...]:
        """What is told of it."""
        cases = {
            "out-of-reach": self.out_of_reach,
            "free-there": self.free,
            "rounded-pose": self.rounded,
            "missed": self.missed,
        }
        told = tuple(Phrase(key) for key, holds in cases.items() if holds)
        if not self.unreal:
            return told
        key = "one-unreal" if self.unreal == 1 else "some-unreal"
        return (Phrase(key, {"unreal": self.unreal, "all": self.of}), *told)


class Facts(PageFacts):
    """Of the whole: the pose that is `given`, by its elements, and how it is `known`; `conditions` on it; the
    sub-problems of the `arm`, then of its wrist; how many solutions there are, the `tree` of choices
    where there are several, and the `meaning` of their names. `partial`: not every solution is one at every
    pose. `held` are joints that are chosen beforehand."""

    triangle: Triangle | None = None
    eliminated: Eliminated | None = None
    held: Phrase | None = None
    given: tuple[Step, ...] = ()
    known: Phrase | None = None
    conditions: tuple[tuple[Expr, ...], ...] = ()
    arm: tuple[SolvedFacts, ...] = ()
    by_angle: ByAngle | None = None
    wrist: Wrist | None = None
    count: Phrase | None = None
    tree: Table | None = None
    meaning: tuple[Phrase, ...] = ()
    partial: Phrase | None = None
    place: tuple[Phrase, ...] = ()
    feasible: Phrase | None = None
