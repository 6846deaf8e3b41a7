"""A system in SymPy: its equations, which of their names are signals, what one signal makes of another."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from functools import cached_property

import sympy

from derive.audit.algebra import expanded, solution
from derive.audit.asked import Asked
from derive.audit.budget import spend
from derive.audit.points import Point, floating
from derive.audit.text import sympy_of_text

S = sympy.Symbol("s")
# Dorf and Bishop, Modern Control Systems, section 2.5; each side by side with what it is equal to.
MOTORS = {
    "armature": (("V_a", "(R_a + L_a*s)*I_a + V_b"), ("V_b", "K_b*speed"), ("T_m", "K_m*I_a")),
    "field": (("V_f", "(R_f + L_f*s)*I_f"), ("T_m", "K_m*I_f")),
}
LOAD = (("T_m", "T_L + T_d"), ("T_L", "J*s*speed + b*speed"))
SPEED = {"angle": "s*theta", "speed": "omega"}


class Plant:
    """The system of a question, `equations` that vanish."""

    def __init__(self, asked: Asked) -> None:
        system = asked.subject
        self.asked = asked
        self.input, self.output = (sympy.Symbol(each.name) for each in (system.input, system.output))
        others = [] if system.disturbance is None else [sympy.Symbol(system.disturbance.name)]
        source = getattr(asked.options, "source", None)
        others += [] if source is None else [sympy.Symbol(source)]
        self.driving = {self.input, *others}
        if system.motor:
            control, output = system.motor
            self.equations = list(_of_motor(control, output, asked))
        else:
            self.equations = [asked.formula(e.left) - asked.formula(e.right) for e in system.equations]

    @cached_property
    def unknowns(self) -> list[sympy.Symbol]:
        """The signals that nothing prescribes, as many as there are equations. Raises NotImplementedError
        where it is not clear which these are."""
        terms = [_names_in(term) for each in self.equations for term in _terms(each)]
        known = {self.output, *self.driving}
        found = {
            frozenset(signals - self.driving)
            for signals in _signals(terms, known, frozenset())
            if len(signals - self.driving) == len(self.equations)
        }
        if len(found) != 1:
            raise NotImplementedError("it is not clear which names are signals")
        return sorted(found.pop(), key=str)

    def transfer(self, point: Point, source: sympy.Symbol | None = None) -> sympy.Expr:
        """The output for a source of 1, the input if left out, as a function of s."""
        prescribed = {each: sympy.Integer(each == (source or self.input)) for each in self.driving}
        rows = [numbered(each.subs(prescribed), point, self.unknowns) for each in self.equations]
        found = solution(rows, self.unknowns)
        if not found:
            raise NotImplementedError("the equations have no solution")
        return found[self.unknowns.index(self.output)]


def numbered(expr: sympy.Expr, point: Point, but: Collection[sympy.Symbol] = ()) -> sympy.Expr:
    """An expression in s and these names, all others having their values at the point."""
    return expr.subs({name: sympified(point, name) for name in expr.free_symbols - {S, *but}})


def sympified(point: Point, name: sympy.Expr) -> sympy.Expr:
    """The value of an expression as SymPy has its numbers, exact where the author gave it."""
    given = point.fixed.get(name.name) if name.is_Symbol else None
    if isinstance(given, sympy.Basic) and not given.free_symbols:
        return given
    value = point.at(name)
    if point.exact:
        return sympy.Rational(value.numerator, value.denominator)
    return sympy.nsimplify(sympy.Float(floating(value), 60), rational=True)


def _of_motor(control: str, output: str, asked: Asked) -> Iterator[sympy.Expr]:
    names = {**asked.names, "speed": sympy_of_text(SPEED[output], {})}
    for left, right in (*MOTORS[control], *LOAD):
        yield sympy_of_text(left, names) - sympy_of_text(right, names)


def _terms(equation: sympy.Expr) -> tuple[sympy.Expr, ...]:
    return tuple(sympy.Add.make_args(expanded(equation)))


def _names_in(term: sympy.Expr) -> frozenset[sympy.Symbol]:
    """Those that can be signals: no divisors, no squares, nothing in a function."""
    factors = sympy.Mul.make_args(term)
    return frozenset(factor for factor in factors if factor.is_Symbol and factor != S)


def _signals(
    terms: list[frozenset[sympy.Symbol]], known: set[sympy.Symbol], others: frozenset[sympy.Symbol]
) -> Iterator[set[sympy.Symbol]]:
    """Every choice of signals of which each term holds one, and `others` none."""
    while True:
        spend(len(terms))
        open_: frozenset[sympy.Symbol] | None = None
        for names in terms:
            here, free = names & known, names - others - known
            if len(here) > 1 or not (here or free):
                return
            if here and free:
                others |= free
                break
            if not here and len(free) == 1:
                known = known | free
                break
            if not here:
                open_ = open_ or free
        else:
            break
    if open_ is None:
        yield known
        return
    for name in sorted(open_, key=str):
        yield from _signals(terms, known | {name}, others | (open_ - {name}))
