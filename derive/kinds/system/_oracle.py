"""What kinds of systems are held to: the equations as they were typed, solved in complex numbers."""

from __future__ import annotations

import cmath
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from derive.algebra.formulas.grammar import parse
from derive.algebra.numbers.floats import completed
from derive.control.controllers import Controller
from derive.control.diagram import Diagram
from derive.control.oracle import motor, poles
from derive.control.oracle.equations import Numeric, is_close, pid, quotient, value
from derive.control.signals import signals
from derive.control.system import System
from derive.derivation import Claim, Phrase, Step
from derive.expression import Expr, Symbol, free_symbols
from derive.kinds.checks import random_points, route
from derive.kinds.problem import Problem
from derive.kinds.system._pairs import Roots, by_place, said_roots

POINTS, TRIES = 3, 40
NOTHING = 1e-10  # of the size of signals
ROOTS = 1e-6  # how closely roots give back the polynomial they are of
Point = Mapping[str, complex]
NOWHERE = (ValueError, ZeroDivisionError, OverflowError)


@dataclass(frozen=True)
class Held:
    """A system, or its loop where there is a controller, at values of its parameters. `given` are values of
    an author's; all names without one are drawn at random."""

    problem: Problem
    source: Symbol
    controller: Controller | None = None
    given: Mapping[str, Expr] | None = None

    @property
    def system(self) -> System:
        """The equations."""
        system: System = self.problem.subject
        return system

    @cached_property
    def names(self) -> frozenset[str]:
        """The names that need a value."""
        known = {**self.problem.where, **(self.given or {})}
        trees = [*known.values(), *(self.controller.gains if self.controller else ())]
        found = self.system.names.union(*map(free_symbols, trees)) - known.keys()
        return frozenset(found) - {signal.name for signal in signals(self.system)} - {"s", "pi"}

    def points(self) -> Iterator[tuple[Mapping[str, float], complex]]:
        """Values of all names, and an s off the axes."""
        known = {**self.problem.where, **(self.given or {})}
        for k, point in enumerate(random_points(self.names | {"s"}, TRIES)):
            at = dict(point)
            s = complex(at.pop("s"), 1.0 + k % POINTS)
            try:
                yield completed(at, known), s
            except NOWHERE:
                continue

    def gain(self, point: Mapping[str, float], s: complex) -> complex:
        """Output over source, or over the reference of the loop."""
        solved = Numeric.of(self.system, self.source, point)
        if self.controller is None:
            return solved.gain(s)
        return solved.closed(s, self.strength(point, s))

    def strength(self, point: Mapping[str, float], s: complex) -> complex:
        """C there."""
        if self.controller is None:
            return 1 + 0j
        gains = [value(gain, dict(point)) for gain in self.controller.gains]
        return pid(self.controller.family, gains, s)

    def compared(self, of: Callable[[Point], Iterable[bool]]) -> Iterator[bool]:
        """What holds at a few points, `s` among their names. Points without a value are passed over."""
        import numpy

        met = 0
        for at, s in self.points():
            try:
                found = [*of({**at, "s": s})]
            except (*NOWHERE, numpy.linalg.LinAlgError):
                continue
            yield from found
            met += 1
            if met == POINTS:
                return


def as_printed(key: str, held: Held, tree: Expr, **about: str) -> Claim:
    """A transfer function as it is printed, against the equations."""
    return route(
        key, held.compared(lambda at: [_same(value(tree, at), held.gain(reals(at), at["s"]))]), **about
    )


def as_drawn(held: Held, diagram: Diagram) -> Claim:
    """The blocks and lines of a diagram, in which C(s) and G(s) may stand for the controller and the whole
    system, against the equations."""
    alone = replace(held, controller=None)

    def of(at: Point) -> Iterator[bool]:
        s, point = at["s"], reals(at)
        known = {**at, "C(s)": held.strength(point, s), "G(s)": alone.gain(point, s)}
        yield _same(diagram.gain(s, known), held.gain(point, s))

    return route("as-drawn", held.compared(of))


def controller_as_printed(key: str, held: Held, tree: Expr) -> Claim:
    """C as it is printed: it multiplies, integrates and differentiates as the letters of its family say."""
    return route(key, held.compared(lambda at: [_same(value(tree, at), held.strength(reals(at), at["s"]))]))


def given_claims(held: Held, steps: Sequence[Step]) -> Iterator[Claim]:
    """The equations as they are printed hold of the signals that those of the sheet give; those of a motor
    are what its power demands."""
    printed = [step.chain for step in steps if step.rule == "given"]
    zero = [step.chain for step in steps if step.rule == "superposition"]
    if printed:
        yield route("as-given", held.compared(lambda at: _hold(held, printed, at)))
    if zero:
        yield route("superposition", (chain[0] != held.source and not value(chain[-1], {}) for chain in zero))


def _hold(held: Held, printed: Sequence[tuple[Expr, ...]], at: Point) -> Iterator[bool]:
    """Every equation, the inputs being what they are; none is left out."""
    solved = Numeric.of(held.system, held.source, reals(at))
    inputs = (
        {held.source: 1.0}
        if _are_less(held, printed)
        else {each: 0.7 + k for k, each in enumerate(solved.inputs)}
    )
    found = {**at, **solved.signals(at["s"], inputs)}
    yield len(printed) == len(held.system.equations)
    size = max(map(abs, found.values()))
    for left, right in printed:
        a, b = value(left, found), value(right, found)
        yield abs(a - b) <= NOTHING * max(abs(a), abs(b), size)


def _are_less(held: Held, printed: Sequence[tuple[Expr, ...]]) -> bool:
    """Whether inputs that are zero are left out of the equations."""
    names = frozenset[str]().union(*(free_symbols(side) for chain in printed for side in chain))
    disturbance = held.system.disturbance
    return disturbance is not None and disturbance.name not in names


def motor_claims(held: Held) -> Iterator[Claim]:
    """The equations of a motor: its gains by impedances, the power of its terminals, and that it is
    passive."""
    if not held.system.motor:
        return
    control, output = held.system.motor
    yield route("impedances", held.compared(lambda at: _impedances(held.system, control, output, at)))
    yield route("power", held.compared(lambda at: _powers(held.system, control, output, at)))


def _impedances(system: System, control: str, output: str, at: Point) -> Iterator[bool]:
    for source in filter(None, (system.input, system.disturbance)):
        ours = Numeric.of(system, source, reals(at)).gain(at["s"])
        yield _same(ours, motor.gain(control, output, source == system.disturbance, reals(at), at["s"]))


def _powers(system: System, control: str, output: str, at: Point) -> Iterator[bool]:
    """At an imaginary s, with both constants the same, both inputs driven; the resistance that the terminals
    have at an s on the right is positive, for what is stored and what turns to heat comes from there."""
    point = {**reals(at), "K_b": at["K_m"].real}
    solved = Numeric.of(system, system.input, point)
    s = complex(0.0, at["s"].imag)
    driven = {source: 1.0 + 0.3j * k for k, source in enumerate(solved.inputs)}
    given, spent = motor.balance(control, output, point, s, solved.signals(s, driven))
    yield _same(given, spent)
    there = solved.signals(at["s"], {system.input: 1.0})
    current = there["I_a" if control == "armature" else "I_f"]
    if all(number > 0 for number in point.values()):
        yield current.real > 0


def names_inside(held: Held, inside: Phrase | None) -> Iterator[bool]:
    """Whether what is called current, torques and induced voltage of a motor is that, by the circuit and the
    shaft."""
    if inside is None:
        return
    control, output = held.system.motor
    yield inside.key == f"inside-{control}"
    yield ("induced" in inside.about) == (control == "armature")
    yield from held.compared(lambda at: _inside(held.system, control, output, inside, at))


def _inside(system: System, control: str, output: str, inside: Phrase, at: Point) -> Iterator[bool]:
    point, s = reals(at), at["s"]
    solved = Numeric.of(system, system.input, point)
    driven = {source: 1.0 + 0.3j * k for k, source in enumerate(solved.inputs)}
    signals = solved.signals(s, driven)
    found = {key: signals[name.name] for key, name in inside.about.items() if isinstance(name, Symbol)}
    circuit, shaft = motor.sides(control, point, s)
    speed = signals["omega"] if output == "speed" else s * signals["theta"]
    voltage, brake = driven[system.input], driven.get(system.disturbance, 0.0) if system.disturbance else 0.0
    yield _same(circuit * found["current"] + found.get("induced", 0.0), voltage)
    yield _same(found["torque"], point["K_m"] * found["current"])
    yield _same(found["load"], shaft * speed)
    yield _same(found["torque"] - found["load"], brake)


# -- at the values asked for --------------------------------------------------------------------------


def number_claims(held: Held, functions: Mapping[str, Mapping[str, Any]]) -> Iterator[Claim]:
    """Transfer functions in numbers as the JSON has them, C and the others: num over den, and by poles and
    zeros."""
    yield route("in-numbers", held.compared(lambda at: _functions(held, functions, at)))


def _functions(held: Held, functions: Mapping[str, Mapping[str, Any]], at: Point) -> Iterator[bool]:
    for name, told in functions.items():
        other = (held.strength if name == "C" else held.gain)(reals(at), at["s"])
        num, den = ([_coefficient(each, at) for each in told[side]] for side in ("num", "den"))
        yield _same(quotient(num, den, at["s"]), other)
        if "poles" in told:
            zeros, found = (complexes(told[each]) for each in ("zeros", "poles"))
            top = next((k for k in num if k), 0j)
            below = poles.product(den[0], found, at["s"])
            yield _same(poles.product(top, zeros, at["s"]) / below, other, ROOTS)


def _coefficient(told: float | str, at: Point) -> complex:
    return value(parse(told), at) if isinstance(told, str) else complex(told)


def complexes(told: Iterable[Any]) -> list[complex]:
    """Roots as the JSON has them."""
    return [complex(z["re"], z["im"]) if isinstance(z, Mapping) else complex(z) for z in told]


def same_roots(printed: Roots | None, told: Iterable[Any]) -> bool:
    """Whether the roots on the page are those of the JSON, which are called several where they are."""
    ours, other = by_place(said_roots(printed)), by_place(complexes(told))
    counted = printed is None or printed.several == (len(other) > 1)
    return counted and len(ours) == len(other) and all(map(_same, ours, other))


def reals(at: Point) -> dict[str, float]:
    """The values of the parameters."""
    return {name: number.real for name, number in at.items() if name != "s"}


def _same(left: complex, right: complex, tolerance: float = 1e-8) -> bool:
    return is_close(left, right, tolerance) and cmath.isfinite(left)
