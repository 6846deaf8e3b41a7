"""How the parameter of a path goes from rest to rest: cubic, quintic, or with a trapezoidal velocity.

Siciliano et al., section 4.2.1; Spong et al., section 5.5.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from derive.algebra.normal import normal
from derive.errors import NotDerivable
from derive.expression import (
    ONE,
    ZERO,
    Call,
    Expr,
    Matrix,
    Relation,
    Symbol,
    add,
    multiply,
    number,
    replace_all,
    sqrt,
    symbols,
    walk,
)
from derive.expression import replace as put_in
from derive.kinds.path._frenet import Bent
from derive.kinds.path._sizes import told
from derive.kinds.work import Work
from derive.mechanics.paths import Timing
from derive.names import free

T, T_1, T_2, A = symbols("t t_1 t_2 a_c")
TWO, HALF = number(2), ONE / number(2)
OPEN = "whether the velocity reaches its limit depends on symbols; give values under where:"
NO_TIME = "this time is too short or too long for a trapezoidal velocity of these sizes"


@dataclass(frozen=True, slots=True)
class Piece:
    """The parameter and its first two derivatives by time, and when."""

    laws: tuple[Expr, Expr, Expr]
    when: Relation


@dataclass(frozen=True, slots=True)
class Timed:
    """The laws in pieces, on a board with the sizes in them; `whole` are the laws in one formula each."""

    work: Work
    law: str
    names: tuple[Symbol, Symbol, Symbol]  # s and its derivatives
    time: Symbol
    pieces: tuple[Piece, ...]
    whole: tuple[Expr, Expr, Expr]
    given: dict[str, Symbol] = field(default_factory=dict)
    lines: tuple[str, ...] = ()
    reached: bool = True  # whether it goes on at the greatest velocity
    ramps: Expr | None = None  # what both ramps cover, where that is to be compared
    way: Expr = ONE  # with this


def timed(timing: Timing, found: Bent, work: Work) -> Timed:
    """The laws of a path whose lines are on the board."""
    s = found.along.s
    names = (s, Symbol(f"{s.name}_dot"), Symbol(f"{s.name}_ddot"))
    low, high = found.along.between or (ZERO, ONE)
    if timing.law == "trapezoidal":
        return _trapezoid(timing, found, work, names, low)
    work, (T_f,) = work.naming(t_f=timing.time or ONE)
    way = high if low == ZERO else work.readable(work.scalar(high - low))
    cubic = timing.law == "cubic"
    powers = ((3, 2), (-2, 3)) if cubic else ((10, 3), (-15, 4), (6, 5))
    laws = tuple(_polynomial(way, T_f, powers, order) for order in range(3))
    first = laws[0] if low == ZERO else add(low, laws[0])
    whole = (first, laws[1], laws[2])
    when = Relation(Relation(ZERO, "<=", T), "<=", T_f)
    return Timed(work, timing.law, names, T_f, (Piece(whole, when),), whole, {"time": T_f})


def _polynomial(way: Expr, T_f: Symbol, powers: tuple[tuple[int, int], ...], order: int) -> Expr:
    """The way times a polynomial in t/T, differentiated by t."""
    terms = []
    for coefficient, k in powers:
        for step in range(order):
            coefficient *= k - step
        rest = k - order
        above = ONE if rest == 0 else T if rest == 1 else T ** number(rest)
        terms.append(multiply(number(coefficient), above) / T_f ** number(k))
    return multiply(way, add(*terms))


# -- trapezoids ---------------------------------------------------------------------------------------


def _trapezoid(
    timing: Timing, found: Bent, work: Work, names: tuple[Symbol, Symbol, Symbol], low: Expr
) -> Timed:
    """By two of its sizes: along the path, or of the parameter of a function."""
    along, by_length = found.along, work.problem.subject.along
    L: Expr = along.L if by_length else work.readable(work.scalar((along.between or (ZERO, ONE))[1] - low))
    given: dict[str, Symbol] = {}
    for key, usual in (("time", "t_f"), ("v_max", "v_M"), ("a_max", "a_M")):
        value = getattr(timing, key)
        if value is not None:
            work, (given[key],) = work.naming(**{usual: value})
    T_f = given.get("time") or Symbol(free(work.problem.taken, "t_f", "t_e"))
    strong: Expr = given.get("a_max", A)
    before = len(work.steps)
    reached, ramps = True, None
    if timing.time is None:
        v, a = given["v_max"], given["a_max"]
        ramps = v**2 / a
        room = work.sign(L - ramps)
        if room is None:
            raise NotDerivable(OPEN)
        reached = room > 0
        work = told(work, T_1, v / a if reached else sqrt(L / a))
        work = told(work, T_f, L / v + T_1 if reached else TWO * T_1)
    elif timing.a_max is None:
        work = told(work, T_1, T_f - L / given["v_max"])
        work = told(work, A, given["v_max"] / T_1)
    else:
        if work.sign(T_f**2 / number(4) - L / given["a_max"]) not in (0, 1):
            raise NotDerivable(NO_TIME)
        work = told(work, T_1, T_f / TWO - sqrt(T_f**2 / number(4) - L / given["a_max"]))
    if timing.time is not None:
        left = work.sign(T_f - TWO * T_1)
        if work.sign(T_1) != 1 or left not in (0, 1):
            raise NotDerivable(NO_TIME)
        reached = left == 1
    rate = strong if found.unit or not by_length else strong / found.speed
    work = told(work, T_2, T_f - T_1) if reached else work
    laws = _laws(rate, T_f, low, reached)
    ends: list[Expr] = [ZERO, T_1, T_2, T_f] if reached else [ZERO, T_1, T_f]
    pieces = tuple(
        Piece(law, Relation(Relation(start, "<=", T), "<=", end))
        for law, start, end in zip(laws, ends, ends[1:], strict=False)
    )
    lines = tuple(step.name for step in work.steps[before:])
    whole = _in_one(rate, T_2 if reached else T_1, low)
    return Timed(work, timing.law, names, T_f, pieces, whole, given, lines, reached, ramps, L)


def _laws(rate: Expr, T_f: Symbol, low: Expr, plateau: bool) -> list[tuple[Expr, Expr, Expr]]:
    """While it speeds up, at the greatest velocity, and while it slows down."""

    def from_low(tree: Expr) -> Expr:
        return tree if low == ZERO else add(low, tree)

    left = T_f - T
    up = (from_low(multiply(rate, T**2) / TWO), multiply(rate, T), rate)
    level = (from_low(multiply(rate, T_1, T - T_1 / TWO)), multiply(rate, T_1), ZERO)
    total = multiply(rate, T_1, T_f - T_1)
    down = (from_low(total - multiply(rate, left**2) / TWO), multiply(rate, left), -rate)
    return [up, level, down] if plateau else [up, down]


def _in_one(rate: Expr, until: Symbol, low: Expr) -> tuple[Expr, Expr, Expr]:
    """The same for all times: what begins at t_1 and when it goes evenly no more is zero before."""

    def later(start: Expr) -> Expr:
        return Call("max", (ZERO, T - start))

    starts = (T_1, until)
    place = multiply(rate, T**2 - later(starts[0]) ** 2 - later(starts[1]) ** 2) / TWO
    speed = multiply(rate, T - later(starts[0]) - later(starts[1]))
    change = -multiply(rate, add(*(Call("sign", (T - start,)) for start in starts))) / TWO
    return (place if low == ZERO else add(low, place)), speed, change


def in_time(tree: Expr, time: Timed) -> Expr:
    """A formula of the parameter and its derivatives as one of the time alone."""
    laws: dict[Expr, Expr] = dict(zip(time.names, time.whole, strict=True))
    known: dict[Expr, Expr] = {**time.work.problem.names, **time.work.definitions}
    return _written(replace_all(put_in(tree, laws), known), time.work)


def _written(tree: Expr, work: Work) -> Expr:
    """As a person writes it, where it has a normal form that can be read back."""

    def entry(part: Expr) -> Expr:
        if any(isinstance(node, Call) and node.function in ("max", "sign", "abs") for node in walk(part)):
            return part
        try:
            return work.problem.readable(normal(part))
        except NotDerivable:
            return part

    if isinstance(tree, Matrix):
        return Matrix(tuple(tuple(map(entry, row)) for row in tree.rows))
    return entry(tree)
