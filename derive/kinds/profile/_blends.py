"""How a linear segment with parabolic blends is made: by its velocity, its acceleration, the duration of its
blends, or the limits it keeps."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from derive.algebra.readable.writing import positive_first
from derive.derivation import Derivation
from derive.errors import NotDerivable
from derive.expression import (
    MINUS_ONE,
    ZERO,
    Expr,
    Symbol,
    free_symbols,
    is_negative,
    multiply,
    number,
    replace,
    sqrt,
    symbols,
)
from derive.kinds.problem import Problem
from derive.kinds.profile._pieces import Span, term
from derive.kinds.profile._units import units_of
from derive.kinds.work import Work
from derive.mechanics.profile import Journey, Profile
from derive.names import named

t, T_B, V, A = symbols("t t_b v a")
POSSIBLE = {"v": "possible-velocity", "a": "possible-acceleration", "t_b": "possible-duration"}
RATES = {"q_0": 0, "q_f": 0, "v": 1, "a": 2, "t_f": None, "t_b": None}


@dataclass(frozen=True, slots=True)
class Blended:
    """The working up to t_b, v and a, the names of the ends and of the time, and what was given."""

    working: Work
    start: Expr
    end: Expr
    T: Symbol
    by: str
    rates: Mapping[Expr, int | None]
    uses: tuple[Derivation, ...] = ()
    given: Symbol | None = None  # the velocity, acceleration or duration that was given

    @property
    def way(self) -> Expr:
        return self.end - self.start

    @property
    def open(self) -> bool:
        """Whether symbols are left in the duration of the blends."""
        return bool(free_symbols(self.working.problem.final(worked_out(T_B, self.working))))

    def laws(self) -> tuple[Expr, Expr, Expr]:
        """q as a function of t in the three pieces, as books print it (Spong et al., section 5.5.3)."""
        half = T_B / 2
        return (
            self.start + A * t**2 / 2,
            self.start + V * (t + _minus(half)),
            self.end + _minus(A * (self.T - t) ** 2 / 2),
        )

    def spans(self) -> tuple[Span, Span, Span]:
        """The same by the time since the beginning of each piece."""
        ramp = V * T_B / 2
        push = A / 2
        later = self.T - T_B
        return (
            Span(ZERO, T_B, (self.start, ZERO, push)),
            Span(T_B, later, (self.start + ramp, V)),
            Span(later, self.T, (self.end - ramp, V, -push)),
        )


def blended(journey: Journey, profile: Profile, problem: Problem) -> Blended:
    values: dict[Expr, Expr] = {}
    rates: dict[Expr, int | None] = {}

    def name(standard: str, value: Expr) -> Symbol:
        symbol = named(standard, value, problem.taken)
        values[symbol], rates[symbol] = value, RATES[standard]
        return symbol

    start = ZERO if journey.start == ZERO else name("q_0", journey.start)
    end = name("q_f", journey.end)
    angular = profile.sort == "angle" and problem.style.degrees
    chosen = (("v", journey.cruise), ("a", journey.acceleration), ("t_b", journey.blend))
    by = next((key for key, value in chosen if value is not None), "")
    if not by:
        return _by_limits(profile, problem, start, end, values, rates, angular)
    if profile.time is None:
        raise NotDerivable("no time is given: add time: t_f, or v_max: and a_max: for the shortest")
    T = name("t_f", profile.time)
    value = _same_way(dict(chosen)[by] or ZERO, by, end - start, Work(problem, values, angular))
    given = name(by, value)
    work = Work(problem, values, angular, units=units_of(profile, rates))
    working = _solved(work, by, given, end - start, T)
    return Blended(working, start, end, T, by, rates, given=given)


def _same_way(value: Expr, by: str, way: Expr, working: Work) -> Expr:
    """A velocity or an acceleration has the sign of the way; a duration has none."""
    signs = working.sign(value), working.sign(way)
    if signs[1] == 0:
        raise NotDerivable("start and end are the same: there is nowhere to go", "to")
    return working.shown(-value) if by != "t_b" and None not in signs and signs[0] != signs[1] else value


def _solved(working: Work, by: str, given: Symbol, way: Expr, T: Symbol) -> Work:
    """The other two of t_b, v and a."""
    if by == "v":
        working = working.worked("v", given).worked("t_b", T + _minus(way / given))
        _need(working, T, "the velocity must lie between the way over the time and twice that")
        symbolic = free_symbols(working.known[T_B])
        whole = with_values(given**2 / (given * T + _minus(way)), working) if symbolic else None
        return working.worked("a", given / T_B, whole)
    if by == "a":
        working = working.worked("a", given)
        inside = T**2 / 4 + _minus(way / given)
        if working.sign(inside) == -1:
            raise NotDerivable(
                "the acceleration must be at least four times the way over the time squared", "acceleration"
            )
        working = working.worked("t_b", T / 2 - sqrt(inside))
        duration = working.known[T_B]
        return working.worked(
            "v", given * T_B, multiply(working[given], duration) if free_symbols(duration) else None
        )
    working = working.worked("t_b", given)
    _need(working, T, "the two blends cannot last longer than the whole")
    return working.worked("v", way / (T - T_B)).worked("a", V / T_B)


def _minus(expr: Expr) -> Expr:
    """The opposite, its sign in front of the whole fraction."""
    return -expr if is_negative(expr) else MINUS_ONE * expr


def _need(working: Work, T: Symbol, why: str) -> None:
    """0 < t_b <= t_f/2. Raises NotDerivable."""
    if working.sign(T_B) in (0, -1) or working.sign(T / 2 - T_B) == -1:
        raise NotDerivable(f"this cannot be done in the time: {why}", "time")


def _by_limits(
    profile: Profile, problem: Problem, start: Expr, end: Expr, values: dict[Expr, Expr],
    rates: dict[Expr, int | None], angular: bool,
) -> Blended:  # fmt: skip
    """Within v_max and a_max: by the switching times of the trapezoidal profile."""
    if len(profile.axes) != 1:
        raise NotDerivable(
            "nothing says how fast it is: add cruise:, acceleration: or blend:, or both limits"
        )
    base = problem.ask("trapezoidal-profile")
    if base.results["case"] not in ("trapezoidal", "triangular"):
        raise NotDerivable(f"the profile is {base.results['case']}: its pieces cannot be written down")
    sign = number(Work(problem, values).sign(end - start) or 1)
    T = Symbol("t_f")
    found: dict[Symbol, Any] = {
        Symbol(key): base.results[name]
        for key, name in (("t_b", "t_1"), ("v", "v"), ("a", "a"), ("t_f", "t_3"))
    }
    working = Work(problem, values, angular)
    for symbol, value in found.items():
        signed = value if symbol in (T, T_B) or sign == number(1) else -value
        working = working.knowing({symbol: working.shown(signed)})
        rates[symbol] = RATES[symbol.name]
    return Blended(working, start, end, T, "limits", rates, (base,))


# -- with numbers put in ---------------------------------------------------------------------------


def with_values(tree: Expr, working: Work) -> Expr:
    """With the values of all names."""
    return replace(tree, {name: value for name, value in working.known.items() if name != value})


def filled_span(span: Span, working: Work) -> Span:
    values = tuple(worked_out(c, working) for c in span.coefficients)
    return Span(worked_out(span.start, working), worked_out(span.end, working), values)


def filled_laws(found: Blended, working: Work) -> tuple[Expr, ...]:
    """q of t in the three pieces, with numbers where there are."""
    if found.open:
        return tuple(with_values(tree, working) for tree in found.laws())
    push = A / 2
    through = found.start - V * T_B / 2
    left = worked_out(found.T, working) - t
    return (
        worked_out(found.start, working) + term(worked_out(push, working), t, 2),
        positive_first((worked_out(through, working), term(worked_out(V, working), t, 1))),
        worked_out(found.end, working) + term(worked_out(-push, working), left, 2),
    )


def worked_out(tree: Expr, working: Work) -> Expr:
    """Worked out where it is a number, with all names put in where it is not."""
    put_in = with_values(tree, working)
    return put_in if free_symbols(working.problem.final(put_in)) else working.shown(tree)
