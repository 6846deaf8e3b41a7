"""A motion of one shape in a given time, slowed down or made faster until it just keeps its limits."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import partial

from derive.algebra.normal import normal
from derive.algebra.numbers.floats import Point, completed
from derive.algebra.numbers.floats import number as value_of
from derive.derivation import Phrase
from derive.errors import NotDerivable
from derive.expression import Expr, Number, Relation, Symbol, column, sqrt, squared
from derive.kinds.meanings import Names
from derive.kinds.problem import Problem
from derive.kinds.profile._fixed_shape import Case, Shaped, at_most, cases_of, given_names, plain, written
from derive.kinds.profile._limited import Limited, board
from derive.kinds.profile._minimum_told import Bound, Outcome
from derive.kinds.profile._shapes import PEAKS, SHAPES, WAY, laws, meanings, peak
from derive.kinds.work import Work
from derive.mechanics import shapes
from derive.mechanics.profile import Profile
from derive.names import named

K, NEW = Symbol("k"), Symbol("T_k")
LETTERS = {1: "v", 2: "a"}


def time_named(profile: Profile, problem: Problem) -> Symbol:
    """What the given time is called. Raises NotDerivable where none is given."""
    if profile.time is None:
        raise NotDerivable("the time that the motion takes is needed: time: ...")
    return named("T", profile.time, problem.taken)


def scaled(law: shapes.Law, profile: Profile, problem: Problem) -> Shaped:
    """The peaks in the given time, and the factors that they need. Raises NotDerivable where symbols of
    several axes leave open which is the greatest."""
    T, (work, axes) = time_named(profile, problem), board(profile, problem)
    shape = SHAPES[law]
    work = work.knowing({T: profile.time or T})
    if work.units:
        work = replace(work, units={**work.units, T: "s", NEW: "s", **_units(work, axes)})
    first, second, third, *_ = laws(shape, axes[0].d if len(axes) == 1 else WAY, T)
    each = Shaped(law, work.showing(first, second, third), axes, ())
    for bound in each.bounds:
        axis, rate = each.axis(bound), bound[1]
        work = each.base.worked(peak_of(axis, rate).name, peak(shape, rate, axis.d, T))
        each = replace(each, base=work)
    for bound in each.bounds:
        each = replace(each, base=_factor(each.base, each.axis(bound), bound[1]))
    return replace(each, cases=tuple(cases_of(each, factor_of, partial(_scaled, T))))


def _units(work: Work, axes: Iterable[Limited]) -> dict[Expr | Phrase, str]:
    """Those of the peaks, before and after."""
    found: dict[Expr | Phrase, str] = {}
    for axis in axes:
        for rate, limit in axis.limits.items():
            found |= {peak_of(axis, rate): work.units[limit], after_of(rate): work.units[limit]}
    return found


def peak_of(axis: Limited, rate: int) -> Symbol:
    """What the greatest velocity or acceleration in the given time is called."""
    return Symbol(f"{PEAKS[rate - 1]}{axis.end}")


def factor_of(axis: Limited, rate: int) -> Symbol:
    """What the factor is called that a limit needs."""
    return Symbol(f"k_{LETTERS[rate]}{axis.end}")


def after_of(rate: int) -> Symbol:
    """What the greatest velocity or acceleration is called after it was scaled."""
    return Symbol(f"{LETTERS[rate]}_k")


def _factor(work: Work, axis: Limited, rate: int) -> Work:
    """Velocities are divided by the factor, accelerations by its square."""
    ratio = peak_of(axis, rate) / axis.limits[rate]
    name, formula = factor_of(axis, rate).name, ratio if rate == 1 else sqrt(ratio)
    found = work.shown(formula)
    if rate == 1 or isinstance(found, Number):
        return work.worked(name, formula, found)
    return work.worked(name, formula, sqrt(work.problem.readable(normal(ratio, work.definitions))))


def _scaled(T: Symbol, each: Shaped, active: tuple[Bound, ...], when: tuple[Relation, ...]) -> Case:
    """The factor, the new time, and what is reached in it."""
    axis, rate = each.axis(active[0]), active[0][1]
    longest = factor_of(axis, rate)
    work = each.base.worked(K.name, longest, each.base[longest])
    work = work.worked(NEW.name, K * T, written(SHAPES[each.law], work, rate, axis), "in-numbers")
    values = {"k": work.final(K), "time": work.final(NEW)}
    if each.several:
        shape = SHAPES[each.law]
        reached = {
            after_of(rate).name: [work.shown(peak(shape, rate, axis.d, NEW)) for axis in each.axes]
            for rate in LETTERS
        }
        columns = {name: column(map(work.problem.final, trees)) for name, trees in reached.items()}
        cells = {name: tuple(map(plain, trees)) for name, trees in reached.items()}
        return Case(Outcome(active, {**values, **columns}, when), work, cells)
    for _, rate in each.bounds:
        name, formula = after_of(rate).name, peak_of(axis, rate) / (K if rate == 1 else squared(K))
        if (0, rate) in active:
            answer: Expr | None = work[axis.limits[rate]]
        else:
            answer = at_most(SHAPES[each.law], work, axis, formula) if rate == 1 else None
        work = work.worked(name, formula, answer, "in-numbers")
        values |= {peak_of(axis, rate).name: work.final(peak_of(axis, rate)), name: work.final(name)}
    return Case(Outcome(active, values, when), work, {})


def names_of(each: Shaped, T: Symbol, time: Expr, at: Point, times: Mapping[Bound, float]) -> Names:
    """The given motion, and the one in the longest of the times that a search finds."""
    names = given_names(each, at)
    whole = value_of(time, completed(at, each.base.problem.where))
    longest = max(times.values())
    first = each.axes[0]
    d, way = (WAY, 1.0) if each.several else (first.d, names[first.d])
    names |= meanings(each.law, d, T, way, whole)
    for bound, least in times.items():
        axis, rate = each.axis(bound), bound[1]
        names[factor_of(axis, rate)] = least / whole
        names[peak_of(axis, rate)] = shapes.peaks(each.law, names[axis.d], whole)[rate - 1]
        if not each.several:
            names[after_of(rate)] = shapes.peaks(each.law, names[axis.d], longest)[rate - 1]
    return {**names, K: longest / whole, NEW: longest}
