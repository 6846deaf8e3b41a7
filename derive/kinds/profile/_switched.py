"""The fastest motion between two velocities: the acceleration at its limit, then the opposite one, with a
stretch at the greatest velocity between them where that is reached."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

from derive.algebra.numbers.floats import Point, completed
from derive.algebra.numbers.floats import number as value_of
from derive.errors import NotDerivable
from derive.expression import ZERO, Expr, Symbol, add, free_symbols, number, sqrt, squared, subtract
from derive.kinds.meanings import Names
from derive.kinds.problem import Problem
from derive.kinds.profile._shapes import TIME
from derive.kinds.profile._units import units_of
from derive.kinds.work import Work
from derive.mechanics.profile import Journey, Profile
from derive.mechanics.switching import Ways, covered, searched
from derive.names import named

T_1, T_2, V, V_P, D_B, S_1, S_3 = map(Symbol, ("t_1", "t_2", "v", "v_p", "d_b", "s_1", "s_3"))
NUMBERS_ONLY = "which way it goes first cannot be told without numbers; give values under where:"


@dataclass(frozen=True, slots=True)
class Motion:
    """What is given by name (zero where it is zero, None where there is no limit), the way of the first
    acceleration (1 or -1), whether the greatest velocity is reached, and the lines."""

    d: Symbol
    v_0: Expr
    v_f: Expr
    a: Symbol
    fastest: Symbol | None
    ahead: int
    coasts: bool
    work: Work
    rates: dict[Expr, int | None]

    def at(self, point: Point) -> Ways:
        """In numbers. Raises KeyError where symbols are left."""
        known = completed(point, self.work.problem.where)
        names = (self.d, self.v_0, self.v_f, self.a)
        d, v_0, v_f, a = (value_of(self._value(name), known) for name in names)
        most = inf if self.fastest is None else value_of(self._value(self.fastest), known)
        return Ways(d, v_0, v_f, a, most)

    def _value(self, name: Expr) -> Expr:
        return self.work.problem.final(self.work.known.get(name, name))

    @property
    def rests(self) -> bool:
        """Whether it begins and ends at rest."""
        return self.v_0 == ZERO == self.v_f


def switched(profile: Profile, problem: Problem) -> Motion:
    """Bang-bang control of a double integrator (Lewis, Vrabie and Syrmos, Optimal Control, section 5.2).

    Raises NotDerivable where symbols leave open which way it goes first, and where a velocity at an end is
    beyond the limit."""
    journey = _journey(profile)
    given = _given(journey, profile, problem)
    if not given.rests:
        given = _braked(given)
    elif (sign := given.work.sign(given.d)) == 0:
        raise NotDerivable("the distance is zero: there is nothing to move", "distance")
    elif sign == -1:
        given = _changed(given, ahead=-1)
    return _timed(_peaked(given))


def _changed(
    motion: Motion, *, work: Work | None = None, ahead: int | None = None, coasts: bool | None = None
) -> Motion:
    return Motion(
        motion.d, motion.v_0, motion.v_f, motion.a, motion.fastest,
        motion.ahead if ahead is None else ahead, motion.coasts if coasts is None else coasts,
        work or motion.work, motion.rates,
    )  # fmt: skip


def _journey(profile: Profile) -> Journey:
    """One axis with a limit of its acceleration."""
    if profile.journey is None:
        raise NotDerivable("law: bang-bang is for one axis; several axes go by law: trapezoidal", "law")
    if profile.journey.a_max is None:
        raise NotDerivable("a limit of the acceleration is needed: a_max: ...")
    return profile.journey


def _given(journey: Journey, profile: Profile, problem: Problem) -> Motion:
    """Names for what is given."""
    values: dict[Expr, Expr] = {}
    rates: dict[Expr, int | None] = {}
    angular = profile.sort == "angle" and problem.style.degrees
    bare = Work(problem, {}, angular)

    def name(usual: str, value: Expr, rate: int) -> Symbol:
        symbol = named(usual, value, problem.taken)
        values[symbol], rates[symbol] = value, rate
        return symbol

    way = journey.end - journey.start
    d = name("d", way if free_symbols(way) else bare.shown(way), 0)
    v_0, v_f = (
        ZERO if speed == ZERO else name(usual, speed, 1)
        for usual, speed in (("v_0", journey.start_velocity), ("v_f", journey.end_velocity))
    )
    fastest = None if journey.v_max is None else name("v_M", journey.v_max, 1)
    a = name("a_M", journey.a_max or ZERO, 2)
    own: dict[Expr, int | None] = {V_P: 1, D_B: 0, S_1: 0, S_3: 0, TIME: None}
    work = Work(problem, values, angular, units=units_of(profile, {**rates, **own}))
    return Motion(d, v_0, v_f, a, fastest, 1, False, work, rates)


def _braked(motion: Motion) -> Motion:
    """Which way it goes first, by the distance of a single ramp."""
    work, v_0, v_f = motion.work, motion.v_0, motion.v_f
    rising = work.sign(v_f - v_0)
    if rising is None:
        raise NotDerivable(NUMBERS_ONLY)
    for speed, end in ((v_0, "start"), (v_f, "end")):
        if motion.fastest and speed != ZERO and work.sign(squared(motion.fastest) - squared(speed)) == -1:
            raise NotDerivable(f"the velocity at the {end} is beyond v_max", f"{end}_velocity")
    high, low = (v_f, v_0) if rising > 0 else (v_0, v_f)
    top = subtract(*(squared(speed) if speed != ZERO else ZERO for speed in (high, low)))
    work = work.worked(D_B.name, top / (2 * motion.a))
    further = work.sign(motion.d - D_B)
    if further is None:
        raise NotDerivable(NUMBERS_ONLY)
    return _changed(motion, work=work, ahead=1 if further >= 0 else -1)


def _peaked(motion: Motion) -> Motion:
    """The velocity at which it switches, and whether the limit allows it."""
    work, ahead = motion.work, motion.ahead
    squares = [squared(speed) for speed in (motion.v_0, motion.v_f) if speed != ZERO]
    way = motion.a * motion.d if ahead > 0 else -(motion.a * motion.d)
    inside = add(way, add(*squares) / number(2)) if squares else way
    root = sqrt(inside)
    work = work.worked(V_P.name, root if ahead > 0 else -root, rule="in-numbers" if free_symbols(way) else "")
    if motion.fastest is None:
        return _changed(motion, work=work)
    beyond = work.sign(squared(V_P) - squared(motion.fastest))
    if beyond is None:
        raise NotDerivable(NUMBERS_ONLY)
    return _changed(motion, work=work, coasts=beyond > 0)


def _timed(motion: Motion) -> Motion:
    """The times at which it switches, and the whole time."""
    work, ahead, a, v_0, v_f = motion.work, motion.ahead, motion.a, motion.v_0, motion.v_f
    if not motion.coasts or motion.fastest is None:
        half = _half(motion)
        rule = "in-numbers" if half else ""  # equal for positive sizes only, which the search checks
        work = work.worked(T_1.name, _difference(V_P, v_0, ahead) / a, half, rule)
        whole = T_1 + _difference(V_P, v_f, ahead) / a
        return _changed(motion, work=work.worked(TIME.name, whole, half and 2 * half, rule))
    work = work.worked(V.name, motion.fastest if ahead > 0 else -motion.fastest)
    work = work.worked(T_1.name, _difference(V, v_0, ahead) / a)
    for name, speed in ((S_1, v_0), (S_3, v_f)):
        square = squared(speed) if speed != ZERO else ZERO
        work = work.worked(name.name, _difference(squared(V), square, ahead) / (2 * a))
    work = work.worked(T_2.name, T_1 + (motion.d - S_1 - S_3) / V)
    return _changed(motion, work=work.worked(TIME.name, T_2 + _difference(V, v_f, ahead) / a))


def _half(motion: Motion) -> Expr | None:
    """In symbols, from rest to rest, half of the time without a root below the line."""
    ratio = motion.work.shown(motion.d / motion.a)
    return sqrt(ratio) if motion.rests and free_symbols(ratio) else None


def _difference(high: Expr, low: Expr, ahead: int) -> Expr:
    """high - low, or the opposite of a motion that goes backward first."""
    return subtract(high, low) if ahead > 0 else subtract(low, high)


# -- by search ----------------------------------------------------------------------------------------


def names_of(motion: Motion, at: Point) -> Names:
    """What is given, and what a search over all velocities in between finds."""
    ways = motion.at(at)
    found = searched(ways)
    free = searched(Ways(ways.d, ways.v_0, ways.v_f, ways.a_max))
    known = completed(at, motion.work.problem.where)
    names: dict[Expr, float] = {Symbol(name): value for name, value in known.items()}
    names |= {motion.d: ways.d, motion.a: ways.a_max, D_B: covered(ways.v_0, ways.v_f, ways.a_max)}
    if motion.fastest:
        names[motion.fastest] = ways.v_max
    names |= {name: value for name, value in ((motion.v_0, ways.v_0), (motion.v_f, ways.v_f)) if name != ZERO}
    names |= {V_P: free.v, V: found.v, T_1: found.t_1, T_2: found.t_2, TIME: found.time}
    ramps = (covered(ways.v_0, found.v, ways.a_max), covered(found.v, ways.v_f, ways.a_max))
    return {**names, S_1: ramps[0], S_3: ramps[1]}
