"""Elimination as a person does it: each signal expressed by the output, back to the input.

The equation with the fewest unknown signals is solved next, those without the input first and the last
written first, for equations are mostly listed from the input to the output. It is Gaussian elimination,
with the coefficients kept as unexpanded products.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import lru_cache

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.readable.terms import Style
from derive.algebra.scalar import Scalar
from derive.control.exact import divided
from derive.control.linear import Form, cleared, combined, one_side, term, tree
from derive.control.rational import Polynomial, polynomial, scalar, shared
from derive.control.ratios import PLAIN, Ratio
from derive.control.signals import signals, unknowns
from derive.control.system import Equation, System
from derive.errors import NotDerivable, how_many
from derive.expression import ZERO, Expr, Product, Symbol, add, multiply, rebuild

MOST = 12  # equations whose determinant is taken


@dataclass(frozen=True, slots=True)
class Elimination:
    """One signal eliminated: `equation` (its place in the system) solved for it.

    `chain` starts with the signal and ends with what it is in terms of the signals still unknown; `put`
    are the signals that earlier eliminations replaced in it; `explicit` says that it was written
    solved.
    """

    signal: Symbol
    equation: int
    chain: tuple[Expr, ...]
    put: tuple[Symbol, ...]
    explicit: bool


@dataclass(frozen=True, slots=True)
class Solution:
    """How the output follows from one input, the other inputs `zero`.

    `relation` is what the eliminations leave: the last equation between input and output. `ratio` is
    output / input, unexpanded; `values` gives every signal in terms of the input.
    """

    source: Symbol
    zero: tuple[Symbol, ...]
    steps: tuple[Elimination, ...]
    relation: Elimination
    ratio: Ratio
    values: Mapping[Expr, Expr]


@lru_cache(maxsize=64)
def solve(system: System, source: Symbol | None = None, style: Style = PLAIN) -> Solution:
    """The output over `source` (the input, or the disturbance). Raises NotDerivable."""
    source = source or system.input
    inputs = [system.input, *filter(None, (system.disturbance,))]
    if source not in inputs:
        names = " and ".join(signal.name for signal in inputs)
        raise NotDerivable(f"{source.name} is no input of the system: its inputs are {names}", "from")
    zero = tuple(signal for signal in inputs if signal != source)
    found = signals(system)
    _count(system, unknowns(system, found))
    return _Elimination(system, source, zero, found, style).solution()


def without(expr: Expr, zero: Iterable[Symbol]) -> Expr:
    """A tree with signals that are zero dropped."""
    gone = frozenset(zero)

    def dropped(part: Expr) -> Expr:
        if part in gone:
            return ZERO
        inner = rebuild(part, dropped)
        if inner == part:
            return part
        parts = getattr(inner, "terms", None) or getattr(inner, "factors", None)
        if parts is None:
            return inner
        return multiply(*parts) if isinstance(inner, Product) else add(*parts)

    return dropped(expr)


def _count(system: System, unknown: tuple[Symbol, ...]) -> None:
    if len(system.equations) != len(unknown):
        names = ", ".join(signal.name for signal in unknown)
        equations = how_many(len(system.equations), "equation")
        lacking = how_many(abs(len(unknown) - len(system.equations)), "equation")
        remedy = f"add {lacking}" if len(unknown) > len(system.equations) else f"leave {lacking} out"
        raise NotDerivable(
            f"{equations} for {how_many(len(unknown), 'unknown signal')} ({names}): {remedy}", "equations"
        )


class _Elimination:
    """One run; `known` gives eliminated signals in terms of the output, the input and what is left."""

    def __init__(
        self,
        system: System,
        source: Symbol,
        zero: tuple[Symbol, ...],
        found: tuple[Symbol, ...],
        style: Style,
    ) -> None:
        self.system, self.source, self.zero, self.style = system, source, zero, style
        kept = [Equation(without(e.left, zero), without(e.right, zero)) for e in system.equations]
        self.equations = kept
        self.forms = [one_side(equation, found, style) for equation in kept]
        self.unknown = [signal for signal in unknowns(system, found) if signal != system.output]
        self.known: dict[Symbol, Form] = {}
        self.left = list(range(len(kept)))

    def solution(self) -> Solution:
        steps = []
        while self.unknown:
            steps.append(self.eliminate(self.choice()))
        relation, ratio = self.close()
        output = self.system.output
        values: dict[Expr, Expr] = {output: term(ratio, self.source)}
        values |= dict.fromkeys(self.zero, ZERO)
        values |= {signal: tree(form) for signal, form in self.known.items()}
        return Solution(self.source, self.zero, tuple(steps), relation, ratio, values)

    # -- one elimination --------------------------------------------------------------------------

    def choice(self) -> int:
        """The equation to solve next."""
        able = [place for place in self.left if self.open_in(place)]
        if not able:
            names = ", ".join(signal.name for signal in self.unknown)
            raise NotDerivable(f"the equations do not determine {names}", "equations")
        return min(able, key=lambda k: (len(self.open_in(k)), self.source in self.forms[k], -k))

    def open_in(self, place: int) -> list[Symbol]:
        """The unknown signals of an equation once what is known is put in."""
        form = self.put_in(self.forms[place])
        return [signal for signal in self.unknown if signal in form]

    def put_in(self, form: Form) -> Form:
        parts = [(c, self.known.get(signal, {signal: Ratio()})) for signal, c in form.items()]
        return combined(parts, self.style)

    def eliminate(self, place: int) -> Elimination:
        candidates = self.open_in(place)
        signal = min(candidates, key=lambda each: not self.is_explicit(place, each))
        step = self.solved(place, signal)
        new = self.put_in(self.forms[place])
        value = _solved_for(signal, new, self.style)
        self.known[signal] = value
        self.unknown.remove(signal)
        self.left.remove(place)
        self.known = {each: self.put_in(form) for each, form in self.known.items()}
        return step

    def is_explicit(self, place: int, signal: Symbol) -> bool:
        equation = self.equations[place]
        return signal in (equation.left, equation.right)

    def solved(self, place: int, signal: Symbol) -> Elimination:
        """The chain: the signal by its own equation, with what is known put in, then collected."""
        equation, form = self.equations[place], self.forms[place]
        explicit = self.is_explicit(place, signal)
        own = _solved_for(signal, form, self.style) if signal in form else {}
        typed = equation.right if equation.left == signal else equation.left
        first = (typed if explicit else tree(own, self.style),) if explicit or own else ()
        put = tuple(each for each in form if each in self.known)
        pieces = [self._piece(each, c) for each, c in own.items()]
        last = tree(_solved_for(signal, self.put_in(form), self.style), self.style)
        put_in = (add(*pieces),) if put and first else ()
        chain = _distinct((signal, *first, *put_in, last))
        return Elimination(signal, place, chain, put, explicit)

    def _piece(self, signal: Symbol, coefficient: Ratio) -> Expr:
        form = combined([(coefficient, self.known.get(signal, {signal: Ratio()}))], self.style)
        return tree(form, self.style)

    # -- what is left -----------------------------------------------------------------------------

    def close(self) -> tuple[Elimination, Ratio]:
        """The relation between input and output, and their ratio."""
        output, source = self.system.output, self.source
        (place,) = self.left
        form = self.put_in(self.forms[place])
        if output not in form:
            raise NotDerivable(
                f"the equations do not determine {output.name} from {source.name}", "equations"
            )
        if source not in form:
            chain: tuple[Expr, ...] = (tree(form, self.style), ZERO)
            return Elimination(output, place, chain, (), False), Ratio(Ratio().scale * 0)
        if source in self.forms[place] and not self._hidden(place):
            step = self.solved(place, source)
        else:
            left, right = term(form[source], source), term(-form[output], output)
            put = tuple(each for each in self.forms[place] if each in self.known)
            step = Elimination(source, place, (left, right), put, False)
        return step, -form[source] / form[output]

    def _hidden(self, place: int) -> bool:
        """Whether the input also stands in what is put into the equation."""
        return any(self.source in self.known.get(signal, {}) for signal in self.forms[place])


def _solved_for(signal: Symbol, form: Form, style: Style) -> Form:
    scale = -form[signal].inverse()
    return combined([(scale * c, {each: Ratio()}) for each, c in form.items() if each != signal], style)


def _distinct(chain: tuple[Expr, ...]) -> tuple[Expr, ...]:
    """Without links that repeat the one before."""
    return tuple(expr for place, expr in enumerate(chain) if place == 0 or expr != chain[place - 1])


def hidden(system: System, den: Polynomial, style: Style) -> Polynomial:
    """What the determinant of the equations has beyond a denominator; (1,) where there is nothing.

    Equations with more than MOST unknown signals are not looked into.
    """
    found = signals(system)
    columns = unknowns(system, found)
    if len(columns) > MOST:
        return (Scalar.of(1),)
    rows = [cleared(one_side(equation, found, style)) for equation in system.equations]
    entries = ([scalar(row.get(signal, ())) for signal in columns] for row in rows)
    determinant = polynomial(ScalarMatrix.of(entries).det())
    beside, rest = divided(determinant, den)
    if rest or len(beside) < 2:
        return (Scalar.of(1),)
    return tuple(k / shared(beside) for k in beside)
