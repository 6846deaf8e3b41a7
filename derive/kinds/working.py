"""Lines of working: a formula in names, the same with numbers put in, and what comes out."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from derive.algebra.infix import text
from derive.algebra.normal import normal
from derive.algebra.numbers.floats import scalar_number
from derive.algebra.scalar import Scalar
from derive.algebra.signs import sign_of
from derive.derivation import Step
from derive.errors import FormulaError, NotDerivable
from derive.expression import PI, Degrees, Expr, Number, Quotient, Symbol, children, free_symbols, walk
from derive.expression import replace as replaced
from derive.kinds.problem import Problem

CLOSE = 1e-12


def named(standard: str, value: Expr, problem: Problem) -> Symbol:
    """What a given quantity is called: as its author calls it, else by its usual name, with a mark where the
    author means something else by that."""
    if isinstance(value, Symbol) and value != PI:
        return value
    return Symbol(f"{standard}_g" if standard in problem.symbols | problem.where.keys() else standard)


@dataclass(frozen=True, slots=True)
class Working:
    """Given quantities by their names on the page, and the lines worked out from them so far.

    `angular` writes multiples of pi in degrees, as the author typed them. An answer whose name is `taken` by
    the author gets a `_p` on the page.
    """

    problem: Problem
    values: Mapping[Expr, Expr]  # names on the page -> trees in the symbols of the sheet
    angular: bool = False
    steps: tuple[Step, ...] = ()
    taken: frozenset[str] = frozenset()

    @property
    def given(self) -> tuple[tuple[Expr, Expr], ...]:
        """Names that stand for something typed, as chains; those worked out are left out."""
        worked = {self.symbol(step.name) for step in self.steps}
        return tuple((n, value) for n, value in self.values.items() if n != value and n not in worked)

    @property
    def definitions(self) -> dict[Expr, Expr]:
        """What every name stands for, that of a symbol of the sheet left out."""
        return {name: value for name, value in self.values.items() if name != value}

    def symbol(self, name: str) -> Symbol:
        """What an answer is called on the page."""
        return Symbol(f"{name}_p" if name in self.taken else name)

    def given_too(self, values: Mapping[Expr, Expr]) -> Working:
        """More quantities that are given."""
        return replace(self, values={**self.values, **values})

    def scalar(self, expr: Expr) -> Scalar:
        """The normal form in the symbols of the sheet, those of `where` replaced."""
        return normal(expr, {**self.problem.names, **self.definitions})

    def value(self, expr: Expr) -> Expr:
        """What an expression comes to, names of `where` kept; as it stands where it cannot be read back, as
        2^b of a symbol."""
        try:
            return self.written(normal(expr, self.definitions))
        except FormulaError:
            return replaced(expr, self.definitions)

    def written(self, value: Scalar) -> Expr:
        """A scalar as a person writes it; an angle in degrees where the author did."""
        if self.angular:
            turns = (value / Scalar.symbol("pi")).constant
            if turns is not None and value.constant is None:
                return Degrees(turns * 180)
        return self.problem.readable(value)

    def sign(self, expr: Expr) -> int | None:
        """1, 0 or -1; None where symbols leave it open."""
        value = self.scalar(expr)
        if (known := sign_of(value, self._positive())) is not None:
            return known
        try:
            number = scalar_number(value, {})
        except (KeyError, ValueError, ZeroDivisionError):
            return None
        return 0 if abs(number) < CLOSE else 1 if number > 0 else -1

    def _positive(self) -> frozenset[str]:
        return frozenset(n for n, what in self.problem.assumptions.items() if what == "positive")

    def line(self, name: str, formula: Expr, answer: Expr | None = None, rule: str = "") -> Working:
        """One line more: `name = formula = numbers put in = what comes out` (`answer` where that is to be
        written in a certain way). A quantity that is given is none."""
        symbol = self.symbol(name)
        if formula == symbol:
            return self
        if self.values.get(symbol) == symbol:
            message = (
                f"the sheet's own '{symbol.name}' is also a name of this answer; choose another name for it"
            )
            raise NotDerivable(message)
        filled = replaced(formula, {key: value for key, value in self.values.items() if key != value})
        if answer is None:  # a formula in the author's own symbols stays as books print it
            answer = formula if filled == formula else self.value(formula)
        shown = (filled,) if not free_symbols(filled) and not _piled(filled) else ()
        chain = _distinct((symbol, formula, *shown, answer))
        values = {**self.values, symbol: answer}
        return replace(self, values=values, steps=(*self.steps, Step(name, chain, rule)))

    def final(self, name: str) -> Expr:
        """The value of a line with everything replaced."""
        return self.problem.final(self.values[self.symbol(name)])


def _distinct(chain: tuple[Expr, ...]) -> tuple[Expr, ...]:
    """Without an expression that reads like the one before it."""
    texts = [text(expr) for expr in chain]
    return tuple(expr for k, expr in enumerate(chain) if k == 0 or texts[k] != texts[k - 1])


def _piled(expr: Expr) -> bool:
    """Whether a fraction stands in a fraction, which no one would write."""
    quotients = [node for node in walk(expr) if isinstance(node, Quotient)]
    return any(_fractional(part) for each in quotients for side in children(each) for part in walk(side))


def _fractional(expr: Expr) -> bool:
    return isinstance(expr, Quotient) or (
        isinstance(expr, Number) and expr.value.denominator != 1 and not expr.decimal
    )


def number_of(problem: Problem, expr: Expr) -> float:
    """A value without symbols left. Raises NotDerivable that names one that is left."""
    try:
        return scalar_number(normal(expr, problem.names), {})
    except KeyError as error:
        raise NotDerivable(f"no value is known for {error.args[0]}") from error
