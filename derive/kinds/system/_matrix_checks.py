"""Matrices of a state space as they are printed, held to the equations in complex numbers."""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any, TypeAlias

from derive.algebra.formulas.grammar import parse
from derive.algebra.formulas.quantities import rational
from derive.control.oracle import poles
from derive.control.oracle.equations import Numeric, is_close, value
from derive.control.oracle.minimal import order
from derive.control.system import System
from derive.derivation import Claim, Phrase, Step
from derive.expression import ZERO, Expr, Matrix, Symbol, free_symbols, number
from derive.expression import replace as put_in
from derive.kinds.checks import route
from derive.kinds.system._oracle import Held, Point, complexes, names_inside, reals, same_roots
from derive.kinds.system._state_facts import Facts
from derive.kinds.system._states import MATRICES

Numbers: TypeAlias = Any  # an array of NumPy's
CLOSE = 1e-6  # of a determinant and the product of eigenvalues
LARGEST = 10**6  # number put in for a symbol
LOST = 1e-11  # of a coefficient of det(s 1 - A), by what its terms come to
RATES = {"_ddot": 2, "_dot": 1}


def routes(
    held: Held,
    steps: Sequence[Step],
    results: Mapping[str, Matrix],
    evaluated: Mapping[str, Any],
    told: Facts,
    given: Mapping[str, Expr],
) -> Iterator[Claim]:
    """The matrices of the results and those on the page; what the state is; what is said of it; what is
    found at the values asked for, which are `given`."""
    printed = {step.name: step.chain for step in steps}
    names = {name: chain[-1] for name, chain in printed.items() if name in MATRICES}
    both = [results, {name: tree for name, tree in names.items() if isinstance(tree, Matrix)}]
    yield route("equations-again", held.compared(lambda at: (_same_gain(held, each, at) for each in both)))
    state = printed["x"][-1]
    if told.physical and isinstance(state, Matrix):
        signals = tuple(entry for (entry,) in state.rows)
        yield route("state", held.compared(lambda at: _moves(held, both[-1], signals, at)))
    yield route("as-said", _said(held, told, printed, results, both[-1]))
    if told.at is not None:
        there = replace(held, given=given)
        yield route("in-numbers", there.compared(lambda at: _in_numbers(there, evaluated, told, at)))
        if "poles" in evaluated:
            A = _array(evaluated["A"], {})
            yield route("eigenvalues", _eigenvalues(A, evaluated["poles"], told))
            yield route("verdict", (told.at.verdict is not None and told.at.verdict.key in _verdicts(A),))


def _array(rows: Matrix | Sequence[Sequence[float | str]], at: Point) -> Numbers:
    """Of a matrix as a tree or as the JSON has it."""
    import numpy

    entries = rows.rows if isinstance(rows, Matrix) else rows
    return numpy.array([[_number(entry, at) for entry in row] for row in entries])


def _number(entry: Expr | float | str, at: Point) -> complex:
    if isinstance(entry, int | float):
        return complex(entry)
    return complex(value(parse(entry) if isinstance(entry, str) else entry, at))


def _same_gain(held: Held, matrices: Mapping[str, Any], at: Point) -> bool:
    """C (s 1 - A)^-1 B + D against the equations."""
    import numpy

    A, B, C, D = (_array(matrices[name], at) for name in MATRICES)
    ours = complex((C @ numpy.linalg.solve(at["s"] * numpy.eye(len(A)) - A, B) + D)[0, 0])
    return is_close(ours, held.gain(reals(at), at["s"]))


def _moves(held: Held, matrices: Mapping[str, Matrix], state: Sequence[Expr], at: Point) -> Iterator[bool]:
    """s x = A x + B u and y = C x + D u, with the signals of the equations in the place of the state."""
    import numpy

    found = Numeric.of(held.system, held.source, reals(at)).signals(at["s"], {held.source: 1.0})
    rates = {f"{name}{dot}": at["s"] ** k * y for name, y in found.items() for dot, k in RATES.items()}
    x = numpy.array([[value(entry, rates | found)] for entry in state])
    A, B, C, D = (_array(matrices[name], at) for name in MATRICES)
    size = max(1.0, float(abs(at["s"] * x).max()))
    yield bool(abs(at["s"] * x - A @ x - B).max() <= 1e-9 * size)
    yield is_close(complex((C @ x + D)[0, 0]), found[held.system.output.name])


def _said(
    held: Held,
    told: Facts,
    printed: Mapping[str, Sequence[Expr]],
    results: Mapping[str, Matrix],
    matrices: Mapping[str, Matrix],
) -> Iterator[bool]:
    """The equations of the state, in letters; what passes straight through; motions that are hidden."""
    system: System = held.system
    yield (told.motor, told.disturbance) == (system.motor, system.disturbance if told.physical else None)
    yield from names_inside(held, told.inside)
    letters = [printed[name][0] for name in MATRICES]
    yield list(told.matrices) == letters
    x, u = printed["x"][0], system.input
    known: dict[str, complex] = {
        each.name: 0.3 + 0.2j * k for k, each in enumerate((*letters, x, u)) if isinstance(each, Symbol)
    }
    A, B, C, D = (known[each.name] for each in letters if isinstance(each, Symbol))
    for (left, right), (state, drive) in zip((told.law, told.output_law), ((A, B), (C, D)), strict=True):
        yield is_close(value(right, known), state * value(x, known) + drive * known[u.name])
        yield left in (system.output, _dotted(x))
    through = any(entry != ZERO for row in matrices["D"].rows for entry in row)
    yield told.form == (None if told.physical else Phrase("form-beside" if through else "form"))
    yield from _hidden(told, matrices)
    changed = {name: results[name] for name in MATRICES if results[name] != matrices[name]}
    yield [*told.final] == [(printed[name][0], tree) for name, tree in changed.items()]


def _dotted(x: Expr) -> Expr:
    return Symbol(f"{x.name}_dot") if isinstance(x, Symbol) else x


def _hidden(told: Facts, matrices: Mapping[str, Matrix]) -> Iterator[bool]:
    """States beyond those that the input drives and the output shows; not told apart where entries are no
    rational numbers."""
    names = sorted(frozenset[str]().union(*(free_symbols(matrices[each]) for each in "ABC")) - {"pi"})
    draw = random.Random(" ".join(names))
    known: dict[Expr, Expr] = {Symbol(name): number(draw.randint(2, LARGEST)) for name in names}
    found = [
        [[rational(put_in(entry, known)) for entry in row] for row in matrices[each].rows] for each in "ABC"
    ]
    A, B, C = ([[x for x in row if x is not None] for row in rows] for rows in found)
    if found == [A, B, C]:
        beyond = len(A) - order(A, B, C)
        yield told.physical or beyond == 0
        yield told.hidden == (Phrase("hidden-motions", {"count": beyond}) if beyond else None)


# -- at the values asked for --------------------------------------------------------------------------


def _in_numbers(held: Held, evaluated: Mapping[str, Any], told: Facts, at: Point) -> Iterator[bool]:
    """The matrices of the JSON and those shown, by what they make up; the values, as they are told."""
    if told.at is None:
        return
    shown = {name: chain[-1] for name, chain in zip(MATRICES, told.at.shown, strict=True)}
    yield tuple(chain[0] for chain in told.at.shown) == told.matrices
    yield _same_gain(held, evaluated, at)
    for name, tree in shown.items():
        left, right = _array(evaluated[name], at), _array(tree, at) if isinstance(tree, Matrix) else None
        yield right is not None and bool(abs(left - right).max() <= 1e-9 * max(1.0, abs(right).max()))
    known = {**held.problem.where, **(held.given or {})}
    yield {chain[0]: chain[-1] for chain in told.at.point} == {Symbol(k): tree for k, tree in known.items()}


def _eigenvalues(A: Numbers, told: Sequence[Any], facts: Facts) -> Iterator[bool]:
    """The poles multiply to the determinant of s 1 - A, and are those on the page."""
    import numpy

    found = complexes(told)
    for size in {abs(root) for root in found} - {0.0} or {1.0}:
        s = size * (0.7 + 0.6j)
        determinant = complex(numpy.linalg.det(s * numpy.eye(len(A)) - A))
        yield is_close(poles.product(1.0, found, s), determinant, CLOSE)
    yield facts.at is not None and same_roots(facts.at.poles, told)


def _verdicts(A: Numbers) -> frozenset[str]:
    """Those that det(s 1 - A) leaves, coefficients that may be zero taken as such or not."""
    import numpy

    found = [float(each.real) for each in numpy.poly(A)]
    size = float(numpy.abs(A).max()) or 1.0
    whole = [0.0 if abs(k) <= LOST * size**power else k for power, k in enumerate(found)]
    return poles.possible(found) | poles.possible(whole)
