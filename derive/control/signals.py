"""Which names of the equations are signals, and which are parameters.

Every term of a linear equation holds exactly one signal. The input, the output and the disturbance are
known; the others follow from that rule, and from there being as many unknown signals as equations.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

from derive.algebra.normal import normal
from derive.control.system import Equation, System
from derive.errors import NotDerivable
from derive.expression import PI, Symbol, free_symbols

LAPLACE = Symbol("s")
MOST_READINGS = 500  # readings of ambiguous equations that are looked at


@dataclass(frozen=True, slots=True)
class Reading:
    """Names taken as signals, and those taken as parameters, so far."""

    signals: frozenset[str]
    parameters: frozenset[str]

    def narrowed(self, term: frozenset[str]) -> Iterator[Reading]:
        """The readings in which this term holds exactly one signal."""
        chosen = term & self.signals
        choices = chosen if len(chosen) == 1 else frozenset() if chosen else term - self.parameters
        for name in sorted(choices):
            yield Reading(self.signals | {name}, self.parameters | (term - {name}))


@lru_cache(maxsize=64)
def signals(system: System) -> tuple[Symbol, ...]:
    """The signals in the order they are met: input, output, disturbance and all between.

    Raises NotDerivable where no reading of the equations is linear in as many unknown signals as there
    are equations.
    """
    given = [system.input, system.output, *filter(None, (system.disturbance,))]
    start = Reading(frozenset(signal.name for signal in given), frozenset({LAPLACE.name, PI.name}))
    terms = sorted({term for equation in system.equations for term in _terms(equation)}, key=_difficulty)
    readings = list(_first(_readings(start, tuple(terms))))
    if not readings:
        raise _not_linear(system, start)
    best = min(readings, key=lambda reading: _doubt(reading, system))
    names = dict.fromkeys(name for equation in system.equations for name in _in_order(equation))
    return tuple(Symbol(name) for name in names if name in best.signals)


def unknowns(system: System, found: tuple[Symbol, ...]) -> tuple[Symbol, ...]:
    """The signals that the equations determine: all but the input and the disturbance."""
    return tuple(signal for signal in found if signal not in (system.input, system.disturbance))


def _not_linear(system: System, start: Reading) -> NotDerivable:
    """What is wrong with the equations: one that has no reading by itself, or all of them together."""
    for k, equation in enumerate(system.equations):
        if not any(_readings(start, tuple({*_terms(equation)}))):
            terms = [*_terms(equation)]
            why = "a term has none" if frozenset() in terms else "a term has none, several or a power of one"
            return NotDerivable(
                f"this equation is not linear in signals, of which each term needs exactly one: {why}",
                f"equations/{k}",
            )
    return NotDerivable(
        "the equations are not linear in signals: each term needs exactly one of them", "equations"
    )


def _readings(reading: Reading, terms: tuple[frozenset[str], ...]) -> Iterator[Reading]:
    """Every reading that gives each term one signal; the most decided term first."""
    if not terms:
        yield reading
        return
    term = min(terms, key=lambda each: (not each & reading.signals, len(each - reading.parameters)))
    rest = tuple(each for each in terms if each != term)
    for narrower in reading.narrowed(term):
        yield from _readings(narrower, rest)


def _first(readings: Iterator[Reading]) -> Iterator[Reading]:
    yield from (reading for reading, _ in zip(readings, range(MOST_READINGS), strict=False))


def _doubt(reading: Reading, system: System) -> tuple[int, int, list[str]]:
    """How unlikely a reading is: unknowns that the equations do not determine, then signals that never
    stand alone on a side."""
    given = {system.input.name, *([system.disturbance.name] if system.disturbance else ())}
    alone = {side.name for e in system.equations for side in (e.left, e.right) if isinstance(side, Symbol)}
    excess = abs(len(reading.signals - given) - len(system.equations))
    return excess, len(reading.signals - alone), sorted(reading.signals)


def _terms(equation: Equation) -> Iterator[frozenset[str]]:
    """The names in each term of an equation brought to one side; a name with a power counts for none."""
    difference = normal(equation.left) - normal(equation.right)
    for exponents, _ in difference.numerator.terms():
        powers = zip(difference.ring.names, exponents, strict=True)
        yield frozenset(name for name, power in powers if power == 1)


def _difficulty(term: frozenset[str]) -> tuple[int, list[str]]:
    return len(term), sorted(term)


def _in_order(equation: Equation) -> Iterator[str]:
    for side in (equation.left, equation.right):
        yield from sorted(free_symbols(side))
