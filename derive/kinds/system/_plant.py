"""What the kinds of this folder share: the system solved, its names, its numbers at a point."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

from derive.algebra.infix import text
from derive.algebra.numbers.floats import scalar_number
from derive.algebra.readable.form import readable
from derive.algebra.readable.terms import Style
from derive.algebra.scalar import Scalar
from derive.control.elimination import Solution, solve
from derive.control.motor import INSIDE
from derive.control.rational import Polynomial, Rational, S, names_in
from derive.control.roots import as_json, isolated, roots
from derive.control.signals import signals
from derive.control.system import System
from derive.derivation import Claim, Derivation, Phrase, Record, Said, Step
from derive.errors import NotDerivable
from derive.expression import Expr, Number, Symbol, free_symbols, number, walk
from derive.kinds.checks import law
from derive.kinds.fields import Place
from derive.kinds.problem import Problem
from derive.kinds.system._pairs import Roots
from derive.names import free


@dataclass(frozen=True, slots=True)
class Plant:
    """A system solved for its output; `point` gives names values, those of `where` included."""

    problem: Problem
    solution: Solution
    rational: Rational
    style: Style
    point: Mapping[Expr, Expr]

    @property
    def system(self) -> System:
        system: System = self.problem.subject
        return system

    def named(self, name: str) -> Symbol:
        """A name for a result; with the output as its index where the equations use it already."""
        return Symbol(free(self.system.names, name, f"{name}_{self.system.output.name}"))

    def final(self, rational: Rational) -> Expr:
        """With the names of `where` replaced."""
        return rational.at(self.problem.names).expr(self.style)

    def numeric(self, rational: Rational) -> Rational:
        """At the point. Raises NotDerivable where a name has no value."""
        value = self.there(rational)
        if missing := sorted(value.symbols()):
            raise NotDerivable(
                f"no value is known for {', '.join(missing)}: give it under evaluate", "evaluate"
            )
        return value

    def there(self, rational: Rational) -> Rational:
        """At the point, which may leave names without a value."""
        value = rational.at({**self.problem.names, **self.point})
        if not value.den:
            raise NotDerivable("the denominator is zero at these values", "evaluate")
        return value.reduced() if value.num and value.symbols() else value


def plant(problem: Problem, source: str | None, point: Place | None, typed: Iterable[Expr] = ()) -> Plant:
    """The system solved. `typed` are further trees of the author; decimals in them are kept as such.

    Raises NotDerivable.
    """
    typed = tuple(typed)
    _require_numbers(problem, point or (), typed)
    trees = [*typed, *(value for _, value in point or ())]
    decimal = any(isinstance(node, Number) and node.decimal for tree in trees for node in walk(tree))
    style = replace(problem.style, decimals=problem.style.decimals or decimal)
    solution = solve(problem.subject, Symbol(source) if source else None, style)
    values: dict[Expr, Expr] = {Symbol(name): value for name, value in point or ()}
    return Plant(problem, solution, Rational.of(solution.ratio), style, values)


def _require_numbers(problem: Problem, point: Place, typed: Iterable[Expr]) -> None:
    """Raises NotDerivable where a value holds s or a signal, and for a name that is nowhere."""
    system: System = problem.subject
    moving = {S.name, *(signal.name for signal in signals(system))}
    for name, value in (*problem.where.items(), *point):
        if found := sorted(free_symbols(value) & moving):
            raise NotDerivable(
                f"{name} stands for what holds {found[0]}: write it out in the equations", "equations"
            )
    sides = (side for equation in system.equations for side in (equation.left, equation.right))
    known = frozenset[str]().union(*map(free_symbols, (*sides, *typed, *problem.where.values())))
    for name, _ in point:
        if name in moving or (name not in known and name not in problem.where):
            raise NotDerivable(f"{name} under evaluate: is no parameter of the system", "evaluate")


class Delayed(Record):
    typed: Expr
    order: int
    last: Expr  # the power of s up to which the series agree


class AtPoint(Record):
    """What is found at the values asked for; no poles where symbols are left."""

    shown: tuple[tuple[Expr, ...], ...]
    point: tuple[tuple[Expr, ...], ...]
    poles: Roots | None = None
    zeros: Roots | None = None
    verdict: Phrase | None = None  # where the poles lie


def delay_steps(system: System) -> Iterator[Step]:
    """The fractions that stand for delays."""
    for place, delay in enumerate(system.delays, 1):
        facts = Delayed(typed=delay.typed, order=delay.order, last=S ** number(2 * delay.order))
        yield Step(f"delay_{place}", (delay.fraction,), "delay", facts)


def delay_claims(system: System) -> Iterator[Claim]:
    for delay in system.delays:
        yield law("delay-series", delay.agrees(), delay=delay.typed, order=2 * delay.order)


def asked(problem: Problem, kind: str, **options: Any) -> Derivation:
    """The derivation of a question: the sheet's own, whatever it is evaluated at, if the sheet asks it."""
    for name, given in (*problem.questions, *problem.memo.answers):
        if name == kind and all(getattr(given, key) == value for key, value in options.items()):
            return problem.answer(name, given)
    return problem.ask(kind, **options)


def transfer_json(rational: Rational) -> dict[str, Any]:
    """{"num", "den", "poles", "zeros"} of a transfer function; the first two where symbols are left."""
    values = {"num": mixed(rational.num) or [0.0], "den": mixed(rational.den)}
    if rational.symbols():
        return values
    return {**values, "poles": poles_json(rational), "zeros": zeros_json(rational)}


def mixed(coefficients: Iterable[Scalar]) -> list[float | str]:
    """Each as a float, or as text in the symbols that have no value."""
    return [_float_or_text(k) if k else 0.0 for k in coefficients]


def _float_or_text(value: Scalar) -> float | str:
    return text(readable(value)) if names_in([value]) else scalar_number(value, {})


def poles_json(rational: Rational) -> list[Any]:
    return [as_json(root) for root in roots(rational.den)]


def zeros_json(rational: Rational) -> list[Any]:
    return [as_json(root) for root in roots(rational.num)] if rational.num else []


def verdict(polynomial: Polynomial) -> str:
    """Where the roots of a polynomial in numbers lie: "stable", "integrator" (one at the origin),
    "oscillator" (pairs on the imaginary axis, each once) or "unstable"."""
    found = isolated(polynomial)
    axis = [pole for pole in found if pole.value.real == 0]
    if any(pole.value.real > 0 for pole in found) or any(pole.power > 1 for pole in axis):
        return "unstable"
    if not axis:
        return "stable"
    return "integrator" if [pole.value for pole in axis] == [0] else "oscillator"


def point_chains(point: Place | None, where: Mapping[str, Expr]) -> tuple[tuple[Expr, ...], ...]:
    """`J = 2`, ... for the words."""
    return tuple((Symbol(name), value) for name, value in (*where.items(), *(point or ())))


INSIDE_SAID = {"armature": "inside-armature", "field": "inside-field"}


def inside_motor(system: System) -> Phrase | None:
    """What the signals of a motor are between its voltage and its load."""
    for control in system.motor:
        if control in INSIDE:
            current, torque, *induced, load = INSIDE[control]
            about: dict[str, Said] = {"current": current, "torque": torque, "load": load}
            return Phrase(INSIDE_SAID[control], about | dict(zip(("induced",), induced, strict=False)))
    return None
