"""From a tree to its normal form, by one walk."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import reduce
from operator import add
from typing import TypeAlias

from flint import fmpq_mpoly

from derive.algebra.angles import Form
from derive.algebra.bounds import multiplied
from derive.algebra.exact_values import added, fixed_trig, multiple
from derive.algebra.generators import PI
from derive.algebra.infix import text
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.powers import power
from derive.algebra.ring import Ring, ring
from derive.algebra.roots_and_functions import opaque, root
from derive.algebra.scalar import Scalar, common_ring, trig
from derive.algebra.trigonometry import RESOLVED
from derive.algebra.trigonometry import trig_of as trig_of
from derive.algebra.values import (
    MATRIX_FUNCTIONS,
    Combine,
    Value,
    halved,
    joined,
    length,
    matrix_of,
    product,
    raised,
    scalar_of,
    times,
    total,
)
from derive.errors import NotDerivable
from derive.expression import (
    Call,
    Degrees,
    Derivative,
    Expr,
    Indexed,
    Matrix,
    Measured,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
    children,
)
from derive.names import NAMESAKE

Names: TypeAlias = Mapping[Expr, Expr]


def normal(expr: Expr, names: Names | None = None) -> Scalar:
    """The scalar an expression stands for; `names` are replaced by what they stand for. Raises NotDerivable
    where the expression is a matrix or has no exact value, DivisionByZero and NotReal where it has none at
    all."""
    if isinstance(expr, Symbol | Number) and expr not in (names or ()):
        return Scalar.symbol(expr.name) if isinstance(expr, Symbol) else Scalar.of(expr.value)
    return scalar_of(walk_over([expr], names or {}).value(expr))


def normal_matrix(expr: Expr, names: Names | None = None) -> ScalarMatrix:
    """The matrix an expression stands for, blocks joined; of a scalar the matrix (1 by 1). Raises what
    `normal` raises."""
    return matrix_of(walk_over([expr], names or {}).value(expr))


def walk_over(exprs: Iterable[Expr], names: Names, known: Mapping[Expr, Value] | None = None) -> Walk:
    """A walk whose leaves are already known, all in one ring: what follows never changes rings. `known` are
    values of names that were computed before, which no one looks through again."""
    walk = Walk(names, known={**(known or {})})
    values = {leaf: walk.value(leaf) for leaf in _leaves(exprs, names, known or {})}
    home = common_ring(value for value in values.values() if isinstance(value, Scalar))
    ours = {leaf: value.into(home) if isinstance(value, Scalar) else value for leaf, value in values.items()}
    return Walk(names, home, ours)


def walk_in(home: Ring, expr: Expr, known: dict[Expr, Value]) -> Walk:
    """A walk over a tree without names in a ring that holds most of it; `known` remembers its leaves."""
    walk = Walk({}, home, known)
    for leaf in _leaves([expr], {}, {}):
        if leaf not in known:
            value = Walk({}, known={**known}).value(leaf)
            fits = isinstance(value, Scalar) and home.union(value.ring) is home
            known[leaf] = value.into(home) if isinstance(value, Scalar) and fits else value
    return walk


def _leaves(exprs: Iterable[Expr], names: Names, known: Mapping[Expr, Value]) -> dict[Expr, None]:
    """Symbols, and sines and cosines as a whole, in order, through the definitions of names."""
    found: dict[Expr, None] = {}
    seen: set[Expr] = set()
    pending = list(exprs)[::-1]
    while pending:
        expr = pending.pop()
        if isinstance(expr, Symbol | Indexed) and expr in names and expr not in known:
            if expr not in seen:
                seen.add(expr)  # a definition is looked through once
                pending.append(names[expr])
        elif isinstance(expr, Symbol) or (isinstance(expr, Call) and expr.function in ("cos", "sin")):
            found[expr] = None
        elif not isinstance(expr, Indexed | Number):
            pending.extend(children(expr)[::-1])
    return found


@dataclass(frozen=True, slots=True)
class Walk:
    """One walk under fixed names; what a name, a sine or a cosine stands for is computed once.

    Polynomials of the home ring are added and multiplied as they are, and reduced once they are whole.
    """

    names: Names
    home: Ring = field(default_factory=ring)
    known: dict[Expr, Value] = field(default_factory=dict)

    def value(self, expr: Expr) -> Value:
        """The scalar or matrix of a tree."""
        return self._settled(self._loose(expr))

    def _settled(self, value: Value | fmpq_mpoly) -> Value:
        return Scalar(self.home, self.home.reduce(value)) if isinstance(value, fmpq_mpoly) else value

    def _loose(self, expr: Expr) -> Value | fmpq_mpoly:
        """The value, or a polynomial of the home ring that is not yet reduced."""
        match expr:
            case Number(exact):
                return self.home.constant(exact)
            case Product(factors):
                return self._combined(factors, multiplied, product)
            case Symbol() | Indexed():
                return self._opened(self._name(expr))
            case Call(function, arguments):
                known = self.known.get(expr)
                return self._opened(self._call(function, arguments) if known is None else known)
            case Power(base, Number(exact)) if exact.denominator == 1 and exact > 0:
                return self._raised(base, int(exact))
            case Sum(terms):
                return self._combined(terms, add, total)
            case _:
                return self._rarer(expr)

    def _rarer(self, expr: Expr) -> Value:
        match expr:
            case Degrees(degrees):
                return Scalar.symbol(PI) * (degrees / 180)
            case Quotient(top, bottom):
                return times(self.value(top), 1 / self.scalar(bottom))
            case Power(base, exponent):
                return self._power(base, exponent)
            case Matrix(rows):
                return joined([[self.value(entry) for entry in row] for row in rows])
            case Derivative(of, by):
                if expr not in self.known:
                    self.known[expr] = self.value(of).diff(by.name)
                return self.known[expr]
            case Measured(quantity):
                return self.value(quantity)
            case _:
                raise NotDerivable("a floating-point number has no exact value")

    def _opened(self, value: Value) -> Value | fmpq_mpoly:
        """A scalar of the home ring as its polynomial."""
        if isinstance(value, Scalar) and value.ring is self.home and value.denominator is None:
            return value.numerator
        return value

    def _combined(
        self, parts: tuple[Expr, ...], loosely: Combine, otherwise: Callable[[list[Value]], Value]
    ) -> Value | fmpq_mpoly:
        """A sum or a product: of polynomials as they are, of anything else by its own rules."""
        values = [self._loose(part) for part in parts]
        if all(isinstance(value, fmpq_mpoly) for value in values):
            return halved(values, loosely)
        return otherwise([self._settled(value) for value in values])

    def _raised(self, base: Expr, power: int) -> Value | fmpq_mpoly:
        value = self._loose(base)
        return value**power if isinstance(value, fmpq_mpoly) else raised(value, power)

    def scalar(self, expr: Expr) -> Scalar:
        """The scalar of a tree. Raises NotDerivable where it is a matrix."""
        value = self.value(expr)
        if isinstance(value, ScalarMatrix):
            raise NotDerivable("a matrix stands where a scalar is needed")
        return value

    def _name(self, expr: Symbol | Indexed) -> Value:
        if expr in self.known:
            return self.known[expr]
        if expr in self.names:
            return self._defined(expr)
        if isinstance(expr, Indexed):
            raise NotDerivable(f"{expr} stands for nothing")
        self.known[expr] = Scalar.symbol(expr.name)
        return self.known[expr]

    def _defined(self, name: Expr) -> Value:
        """What a name stands for; first the names in its definition, which may go deep."""
        path = {name: self._names_in(self.names[name])}
        while path:
            last = next(reversed(path))
            inner = next(path[last], None)
            if inner is None:
                self.known[last] = self.value(self.names[last])
                del path[last]
            elif inner in path:  # what the answer calls so rests on what the sheet calls so
                raise NotDerivable(NAMESAKE.format(text(inner)))
            elif inner not in self.known:
                path[inner] = self._names_in(self.names[inner])
        return self.known[name]

    def _names_in(self, expr: Expr) -> Iterator[Expr]:
        """Those that are defined, outside of sines and cosines."""
        pending = [expr]
        while pending:
            part = pending.pop()
            if isinstance(part, Symbol | Indexed):
                if part in self.names:
                    yield part
            elif not (isinstance(part, Call) and part.function in ("cos", "sin")):
                pending.extend(children(part))

    def _power(self, base: Expr, exponent: Expr) -> Value:
        times_itself = self.scalar(exponent)
        whole = times_itself.constant
        if whole is not None and whole.denominator == 1:
            return raised(self.value(base), int(whole))
        return power(self.scalar(base), times_itself)

    def _call(self, function: str, arguments: tuple[Expr, ...]) -> Value:
        if function in ("cos", "sin", "tan"):
            c, s = self.trig(arguments[0])
            return c if function == "cos" else s if function == "sin" else s / c
        if function == "atan2" and self.scalar(arguments[0]) == 0:
            return self._flat(self.scalar(arguments[1]))
        values = [self.value(argument) for argument in arguments]
        if function in MATRIX_FUNCTIONS:
            return MATRIX_FUNCTIONS[function](*map(matrix_of, values))
        if function == "abs":
            return length(values[0])
        scalars = tuple(value for value in values if isinstance(value, Scalar))
        if len(scalars) < len(values):
            raise NotDerivable(f"{function} of a matrix")
        if function == "sqrt":
            return root(scalars[0])
        return opaque(function, scalars)

    @staticmethod
    def _flat(x: Scalar) -> Scalar:
        """atan2(0, x): decided by the sign of x where that is known."""
        if x.constant is not None and x.constant != 0:
            return Scalar.of(0) if x.constant > 0 else Scalar.symbol(PI)
        return opaque("atan2", (Scalar.of(0), x))

    # -- sines and cosines ------------------------------------------------------------------------

    def trig(self, angle: Expr) -> tuple[Scalar, Scalar]:
        """(cosine, sine) of an angle; inverse functions inside it are resolved."""
        match angle:
            case Sum(terms) if any(map(self._has_inverse, terms)):
                return reduce(added, map(self.trig, terms))
            case Product((Number(n), rest)) if self._has_inverse(rest) and n.denominator == 1:
                return multiple(self.trig(rest), int(n))
            case Degrees(degrees):
                return fixed_trig(degrees / 180)
            case Symbol(name) if name != PI:
                return self.trig(self.names[angle]) if angle in self.names else trig(Form.of({name: 1}))
            case Call(function, arguments) if function in RESOLVED:
                return RESOLVED[function](*map(self.scalar, arguments))
        return trig_of(self.scalar(angle))

    def _has_inverse(self, expr: Expr) -> bool:
        pending, seen = [expr], set[Expr]()
        while pending:
            part = pending.pop()
            if isinstance(part, Symbol | Indexed):
                if part in self.names and part not in seen:
                    seen.add(part)
                    pending.append(self.names[part])
            elif isinstance(part, Call):
                if part.function in RESOLVED:
                    return True
            elif isinstance(part, Sum | Product):
                pending.extend(children(part))
        return False
