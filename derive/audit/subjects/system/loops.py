"""Transfer functions of a system, and of the loop that a controller closes around it."""

from __future__ import annotations

from collections.abc import Iterator

import sympy

from derive.audit.algebra import solution
from derive.audit.asked import EVALUATED, Asked, Holds, Same, Test
from derive.audit.points import Point
from derive.audit.subjects.system.plant import Plant, S, numbered
from derive.audit.subjects.system.rationals import in_numbers, lowest, roots, same_roots

GAINS = {"P": sympy.Integer(1), "I": 1 / S, "D": S}


def transfer_function(asked: Asked, point: Point) -> Iterator[Test]:
    """Output over input, or over the disturbance asked for, everything else being zero."""
    plant = Plant(asked)
    named = asked.options.source
    source = None if named is None else sympy.Symbol(named)
    yield Same("G", point.at(plant.transfer(point, source)))
    if asked.evaluated:
        there = plant.transfer(asked.here, source)
        yield from in_numbers(EVALUATED + "G", asked.evaluated["G"], there, asked)
        yield from _roots(there, asked)


def closed_loop(asked: Asked, point: Point) -> Iterator[Test]:
    """C as its terms add up; T of the equations with the input driven by the error."""
    C = controller(asked)
    yield Same("C", point.at(C))
    yield Same("T", point.at(closed(asked, point)))
    if asked.evaluated:
        here = asked.here
        yield from in_numbers(EVALUATED + "C", asked.evaluated["C"], C, asked)
        T = closed(asked, here)
        yield from in_numbers(EVALUATED + "T", asked.evaluated["T"], T, asked)
        yield from _roots(T, asked)


def controller(asked: Asked) -> sympy.Expr:
    """C(s) = K_p + K_i/s + K_d s."""
    given = asked.options.controller
    return sum(asked.formula(k) * GAINS[letter] for letter, k in zip(given.family, given.gains, strict=True))


def closed(asked: Asked, point: Point) -> sympy.Expr:
    """Y for R = 1: the input is C (R - Y), one equation more in the system."""
    Y = sympy.Symbol("_Y")
    G, C = Plant(asked).transfer(point), numbered(controller(asked), point)
    (T,) = solution([Y - G * C * (1 - Y)], [Y])
    return T


def response_of(asked: Asked, point: Point) -> sympy.Expr:
    """Of the system by itself, or in the loop where there is a controller."""
    if asked.options.controller is not None:
        return closed(asked, point)
    return Plant(asked).transfer(point)


def _roots(ratio: sympy.Expr, asked: Asked) -> Iterator[Test]:
    """Those that are told beside the functions."""
    if "poles" in asked.evaluated:
        top, bottom = lowest(ratio)
        for name, polynomial in (("poles", bottom), ("zeros", top)):
            right = same_roots(asked.evaluated[name], roots(polynomial))
            yield Holds(EVALUATED + name, right, f"{polynomial} has other roots")
