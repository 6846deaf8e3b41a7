"""Stability: the array row by row from the polynomial of the closed loop, the conditions by its roots."""

from __future__ import annotations

from collections.abc import Iterator

import mpmath
import sympy

from derive.audit.algebra import determinant
from derive.audit.asked import EVALUATED, Asked, Holds, Test
from derive.audit.conditions import holds
from derive.audit.points import NEAR, Point, floating
from derive.audit.putting_back import is_real, put_back
from derive.audit.subjects.system.loops import controller, response_of
from derive.audit.subjects.system.plant import Plant, S, numbered
from derive.audit.subjects.system.rationals import lowest, roots, same_roots
from derive.audit.text import Unreadable

ZERO = sympy.Integer(0)
PLACES = 12  # where conditions and roots are held against each other
ON_AXIS = mpmath.mpf(10) ** -12


def stability(asked: Asked, point: Point) -> Iterator[Test]:
    """The polynomial in the first two rows, the rule of the others, and whether all roots lie left."""
    array = asked.result("routh")
    degree = len(array) - 1
    told = [array[k % 2][k // 2] for k in range(degree + 1)]
    small = _small(asked, told)
    found = next((of for of in POLYNOMIALS if _is_multiple(told, of(asked, point), point, small)), None)
    yield Holds("routh", found is not None, "its first rows are those of another polynomial")
    if found is None:
        return
    coefficients = found(asked, point)
    if _vanish(coefficients[1::2], point):
        yield _derivative(array, 1, point)
    for k in range(2, degree + 1):
        yield _row(array, k, point)
    for place in range(PLACES):
        there = Point(point.seed + 50 * place, False, point.angles, asked.assumptions, point.fixed)
        yield from _conditions(asked, there, found(asked, there))
    if "unstable_poles" in asked.results:
        beyond = sum(root.real > ON_AXIS for root in _roots(coefficients))
        yield Holds("unstable_poles", asked.results["unstable_poles"] == str(beyond), f"{beyond} lie right")
    if asked.evaluated:
        yield from _in_numbers(asked, found(asked, asked.here))


def _of_equations(asked: Asked, point: Point) -> list[sympy.Expr]:
    """Coefficients of what vanishes at the poles: the determinant of the equations, the controller's among
    them."""
    plant = Plant(asked)
    unknowns, rows = list(plant.unknowns), list(plant.equations)
    if asked.options.controller is not None:
        rows.append(plant.input + controller(asked) * plant.output)
        unknowns.append(plant.input)
    still = dict.fromkeys(plant.driving - set(unknowns), 0)
    numbers = [numbered(row.subs(still), point, unknowns) for row in rows]
    cleared = [sympy.fraction(sympy.together(row))[0] for row in numbers]
    return determinant(sympy.Matrix(cleared).jacobian(unknowns), S)


def _of_output(asked: Asked, point: Point) -> list[sympy.Expr]:
    """Those of the denominator of what is left of it in the output."""
    found: list[sympy.Expr] = lowest(response_of(asked, point))[1].all_coeffs()
    return found


POLYNOMIALS = (_of_equations, _of_output)


def _small(asked: Asked, told: list[sympy.Expr]) -> bool:
    """Whether a name that stands nowhere on the sheet is told for a zero: that of a small number."""
    formulas = [*Plant(asked).equations, *([] if asked.options.controller is None else [controller(asked)])]
    known = sympy.Matrix(formulas).free_symbols
    return bool(told[1].is_Symbol and told[1] not in known)


def _is_multiple(told: list[sympy.Expr], wanted: list[sympy.Expr], point: Point, small: bool) -> bool:
    """Whether two polynomials are one but for a factor; a row of zeros is told by another, and a zero in
    front of others by a small number."""
    if len(told) != len(wanted):
        return False
    told = [told[0], ZERO, *told[2:]] if small else told
    step = 2 if _vanish(wanted[1::2], point) else 1
    left, right = [k * wanted[0] for k in told[::step]], [k * told[0] for k in wanted[::step]]
    return put_back("", point, left, right, "").holds


def _vanish(exprs: list[sympy.Expr], point: Point) -> bool:
    return all(abs(floating(point.at(each))) <= NEAR for each in exprs)


def _roots(coefficients: list[sympy.Expr]) -> list[mpmath.mpc]:
    return roots(sympy.Poly(coefficients, S))


# -- the array ----------------------------------------------------------------------------------------


def _row(array: list[list[sympy.Expr]], k: int, point: Point) -> Test:
    """b_i = (c_1 a_{i+1} - a_1 c_{i+1})/c_1; a zero in front of others is a small number."""
    above, before, ours = ([point.at(entry) for entry in array[k - i]] for i in (2, 1, 0))
    after = [*above[1:], 0 * above[0]], [*before[1:], 0 * before[0]]
    found = [(before[0] * a - above[0] * b) / before[0] for a, b in zip(*after, strict=True)]
    if all(abs(floating(each)) <= NEAR for each in found):
        return _derivative(array, k, point)
    if abs(floating(found[0])) <= NEAR and array[k][0].is_Symbol:
        found[0] = ours[0]
    return put_back("routh", point, ours, found, f"row {k + 1} does not follow from those above it")


def _derivative(array: list[list[sympy.Expr]], k: int, point: Point) -> Test:
    """In place of a row of zeros the derivative of the polynomial in the row above it, or a multiple."""
    before, ours = ([point.at(entry) for entry in array[k - i]] for i in (1, 0))
    degree = len(array) - k
    slopes = [max(degree - 2 * i, 0) * each for i, each in enumerate(before)]
    scale = next((each / slope for each, slope in zip(ours, slopes, strict=True) if slope), 1)
    said = f"row {k + 1} is not the derivative of the one above it"
    if floating(scale) < 0:
        return Holds("routh", False, said)
    return put_back("routh", point, ours, [slope * scale for slope in slopes], said)


# -- the conditions -----------------------------------------------------------------------------------


def _conditions(asked: Asked, point: Point, coefficients: list[sympy.Expr]) -> Iterator[Test]:
    """They hold where all roots lie left, and nowhere else."""
    told = asked.results["conditions"]
    if not isinstance(told, list):
        raise Unreadable("the conditions are no list")
    met = [holds(str(each), asked, point) for each in told]
    if None in met or not all(is_real(point.at(k)) for k in coefficients):
        return
    left = all(root.real < -ON_AXIS for root in _roots(coefficients))
    said = f"somewhere they are {met}, and all roots left of the axis: {left}"
    yield Holds("conditions", all(met) == left, said)


def _in_numbers(asked: Asked, coefficients: list[sympy.Expr]) -> Iterator[Test]:
    """Where the author wants numbers."""
    here, told = asked.here, asked.evaluated
    each: list[object] = told["conditions"] if isinstance(told["conditions"], list) else []
    results = asked.results["conditions"]
    conditions = results if isinstance(results, list) else []
    met = [holds(str(one), asked, here) for one in conditions]
    ours = [holds(one, asked, here) if isinstance(one, str) else bool(one) for one in each]
    right = all(a == b for a, b in zip(ours, met, strict=True) if b is not None)
    yield Holds(EVALUATED + "conditions", right and len(each) == len(met), f"they are {met}")
    if "poles" in told:
        found = _roots(coefficients)
        beyond = sum(root.real > ON_AXIS for root in found)
        yield Holds(EVALUATED + "poles", same_roots(told["poles"], found), "the roots are others")
        yield Holds(EVALUATED + "unstable_poles", told["unstable_poles"] == beyond, f"{beyond} lie right")
        left = all(root.real < -ON_AXIS for root in found)
        yield Holds(EVALUATED + "stable", told["stable"] == left, f"stable is {left}")
