"""Systems as equations of first order: by the signals that store something, or in canonical form."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.readable.form import readable
from derive.algebra.readable.terms import Style
from derive.algebra.scalar import Scalar
from derive.control.rational import Rational
from derive.control.realisation import Realised, realisations
from derive.control.system import System
from derive.expression import MINUS_ONE, Expr, Symbol, add, factors_of, is_negative, multiply

MOST = 10  # states that are looked at
ORDERS = ("", "_dot", "_ddot")
Form: TypeAlias = Mapping[str, Scalar]  # name of a signal or of its derivative -> its coefficient
ZERO, ONE = Scalar.of(0), Scalar.of(1)


@dataclass(frozen=True, slots=True)
class Law:
    """What a name is: by its own equation, and by the states and the input alone."""

    name: str
    own: Form
    final: Form


@dataclass(frozen=True, slots=True)
class StateSpace:
    """dx/dt = A x + B u, y = C x + D u. `states` are (signal, order of its derivative); `algebraic` are the
    signals that follow at once, `rates` the highest derivatives. Both are empty in canonical form."""

    states: tuple[tuple[str, int], ...]
    algebraic: tuple[Law, ...]
    rates: tuple[Law, ...]
    A: ScalarMatrix
    B: ScalarMatrix
    C: ScalarMatrix
    D: ScalarMatrix

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the states: theta, theta_dot."""
        return tuple(signal + ORDERS[order] for signal, order in self.states)


def physical(system: System, style: Style) -> StateSpace | None:
    """By the signals whose derivatives the equations give; None where they ask for derivatives of the input
    or for higher ones."""
    for found in realisations(system, style):
        if (space := _space(system, found)) is not None:
            return space
    return None


def canonical(rational: Rational) -> StateSpace:
    """Controllable canonical form of a proper function (Ogata, Modern Control Engineering, section 9.2)."""
    lead, order = rational.den[0], len(rational.den) - 1
    den = [k / lead for k in rational.den]
    num = [*[ZERO] * (order + 1 - len(rational.num)), *(k / lead for k in rational.num)]
    through = num[0]
    rows = [[ONE if j == i + 1 else ZERO for j in range(order)] for i in range(order - 1)]
    last = [-k for k in reversed(den[1:])]
    seen = [b - through * a for a, b in zip(reversed(den[1:]), reversed(num[1:]), strict=True)]
    return StateSpace(
        (), (), (),
        ScalarMatrix.of([*rows, last]),
        ScalarMatrix.column([*[0] * (order - 1), 1]),
        ScalarMatrix.of([seen]),
        ScalarMatrix.of([[through]]),
    )  # fmt: skip


def _space(system: System, found: Sequence[Realised]) -> StateSpace | None:
    orders = {each.signal.name: len(each.den) - 1 + each.integrators for each in found}
    output = system.output.name
    ahead = sorted(orders, key=lambda name: name != output)
    states = tuple((name, k) for name in ahead for k in range(orders[name]))
    if not 0 < len(states) <= MOST or max(orders.values()) > 2 or _taken(system, orders):
        return None
    own = {}
    for each in found:
        law = _own(system, each, orders)
        if law is None:
            return None
        own[each.signal.name + ORDERS[orders[each.signal.name]]] = law
    solved = _solved(own)
    if solved is None:
        return None
    laws = {name: Law(name, own[name], solved[name]) for name in own}
    names = [signal + ORDERS[order] for signal, order in states]
    rows = [_row(signal + ORDERS[order + 1], names, solved) for signal, order in states]
    u = system.input.name
    seen = _row(output, names, solved)
    return StateSpace(
        states,
        tuple(laws[name] for name, order in orders.items() if order == 0),
        tuple(laws[name + ORDERS[orders[name]]] for name in ahead if orders[name]),
        ScalarMatrix.of([row.get(name, ZERO) for name in names] for row in rows),
        ScalarMatrix.column([row.get(u, ZERO) for row in rows]),
        ScalarMatrix.of([[seen.get(name, ZERO) for name in names]]),
        ScalarMatrix.of([[seen.get(u, ZERO)]]),
    )


def _taken(system: System, orders: Mapping[str, int]) -> bool:
    """Whether the equations use the name of a derivative for something else."""
    needed = {name + ORDERS[k] for name, order in orders.items() for k in range(1, order + 1)}
    return bool(needed & system.names)


def _row(name: str, states: Sequence[str], solved: Mapping[str, Form]) -> Form:
    """What a name is in the states and the input; a state is itself."""
    return {name: ONE} if name in states else solved[name]


def _own(system: System, each: Realised, orders: Mapping[str, int]) -> Form | None:
    """The highest derivative of a signal by its own equation; None where that takes higher ones of others."""
    name, lead = each.signal.name, each.den[0]
    found: dict[str, Scalar] = {}
    order = len(each.den) - 1
    for place, k in enumerate(each.den[1:], 1):
        if k:
            found[name + ORDERS[each.integrators + order - place]] = -k / lead
    for branch in each.branches:
        if branch.signal == system.disturbance:
            continue
        most = orders.get(branch.signal.name, 0)
        top = len(branch.num) - 1 + branch.tap
        if top > most:
            return None
        for place, k in enumerate(branch.num):
            if k:
                own = branch.signal.name + ORDERS[top - place]
                found[own] = found.get(own, ZERO) + k / lead
    return found


def _solved(own: Mapping[str, Form]) -> dict[str, Form] | None:
    """Each name without the others: put in one by one. None where they do not determine each other."""
    forms = dict(own)
    for name in own:
        form = forms[name]
        if name in form:
            rest = ONE - form[name]
            if not rest:
                return None
            form = {each: k / rest for each, k in form.items() if each != name}
        forms[name] = form
        forms = {other: _put(kept, name, form) if other != name else form for other, kept in forms.items()}
    return forms


def _put(form: Form, name: str, value: Form) -> Form:
    """A form with a name replaced; what cancels is left out."""
    if name not in form:
        return form
    found = {each: k for each, k in form.items() if each != name}
    for each, k in value.items():
        found[each] = found.get(each, ZERO) + form[name] * k
    return {each: k for each, k in found.items() if k}


def written(form: Form, style: Style) -> Expr:
    """A form over one denominator, terms with a plus first, each signal after its coefficient."""
    below = ONE
    for k in form.values():
        rest = k * below
        if rest.denominator is not None:
            below = below * Scalar(rest.ring, rest.denominator)
    terms = [_term(readable(k * below, style), Symbol(name)) for name, k in form.items()]
    top = add(*sorted(terms, key=is_negative))
    return top if below.constant == 1 else top / readable(below, style)


def _term(coefficient: Expr, signal: Symbol) -> Expr:
    if coefficient == MINUS_ONE:
        return -signal
    return multiply(*factors_of(coefficient), signal)


def symbols_of(space: StateSpace) -> Iterator[Symbol]:
    """The names of the states."""
    return map(Symbol, space.names)
