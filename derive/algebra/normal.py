"""From a tree to its normal form, by one walk."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from functools import reduce
from operator import add, mul
from typing import TypeAlias

from derive.algebra.angles import PI, RADIAN, Form
from derive.algebra.fixed import fixed_trig
from derive.algebra.kernels import absolute, opaque, root
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.ring import Ring, ring
from derive.algebra.scalar import Scalar, as_fraction, common_ring, trig
from derive.errors import NotDerivable
from derive.expression import (
    Approximate,
    Call,
    Degrees,
    Derivative,
    Expr,
    Indexed,
    Matrix,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
    children,
)

Value: TypeAlias = Scalar | ScalarMatrix
Names: TypeAlias = Mapping[Expr, Expr]


def normal(expr: Expr, names: Names | None = None) -> Scalar:
    """The scalar an expression stands for; `names` are replaced by what they stand for.

    Raises NotDerivable where the expression is a matrix or has no exact value.
    """
    value = walk_over([expr], names or {}).value(expr)
    if isinstance(value, ScalarMatrix):
        if value.shape != (1, 1):
            raise NotDerivable("a matrix stands where a scalar is needed")
        return value[0, 0]
    return value


def normal_matrix(expr: Expr, names: Names | None = None) -> ScalarMatrix:
    """The matrix an expression stands for; blocks are joined."""
    value = walk_over([expr], names or {}).value(expr)
    return value if isinstance(value, ScalarMatrix) else ScalarMatrix.of([[value]])


def walk_over(exprs: Iterable[Expr], names: Names) -> Walk:
    """A walk whose leaves are already known, all in one ring: what follows never changes rings."""
    walk = Walk(names)
    leaves: dict[Expr, Scalar] = {}
    seen: set[Expr] = set()
    for leaf in dict.fromkeys(leaf for expr in exprs for leaf in _leaves(expr, names, seen)):
        value = walk.value(leaf)
        if isinstance(value, Scalar):
            leaves[leaf] = value
    home = common_ring(leaves.values())
    return Walk(names, home, {leaf: value.into(home) for leaf, value in leaves.items()})


def _leaves(expr: Expr, names: Names, seen: set[Expr]) -> Iterator[Expr]:
    """Symbols, and sines and cosines as a whole, through the definitions of names."""
    if isinstance(expr, Symbol | Indexed) and expr in names:
        if expr not in seen:
            seen.add(expr)  # a definition is looked through once
            yield from _leaves(names[expr], names, seen)
    elif isinstance(expr, Symbol) or (isinstance(expr, Call) and expr.function in ("cos", "sin")):
        yield expr
    elif not isinstance(expr, Indexed):
        for part in children(expr):
            yield from _leaves(part, names, seen)


@dataclass(frozen=True, slots=True)
class Walk:
    """One walk under fixed names; what a name, a sine or a cosine stands for is computed once."""

    names: Names
    home: Ring = field(default_factory=ring)
    known: dict[Expr, Value] = field(default_factory=dict)

    def value(self, expr: Expr) -> Value:
        """The scalar or matrix of a tree."""
        match expr:
            case Number(exact):
                return Scalar(self.home, self.home.constant(exact))
            case Degrees(degrees):
                return Scalar.symbol(PI) * (degrees / 180)
            case Symbol() | Indexed():
                return self._name(expr)
            case Sum(terms):
                return reduce(add, map(self.value, terms))
            case Product(factors):
                return product([self.value(factor) for factor in factors])
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
            case Call(function, arguments):
                return self.known[expr] if expr in self.known else self._call(function, arguments)
            case Approximate():
                raise NotDerivable("a floating-point number has no exact value")

    def scalar(self, expr: Expr) -> Scalar:
        value = self.value(expr)
        if isinstance(value, ScalarMatrix):
            raise NotDerivable("a matrix stands where a scalar is needed")
        return value

    def _name(self, expr: Symbol | Indexed) -> Value:
        if expr in self.known:
            return self.known[expr]
        if expr in self.names:
            value = self.value(self.names[expr])
        elif isinstance(expr, Indexed):
            raise NotDerivable(f"{expr} stands for nothing")
        else:
            value = Scalar.symbol(expr.name)
        self.known[expr] = value
        return value

    def _power(self, base: Expr, exponent: Expr) -> Value:
        power = self.scalar(exponent).constant
        if power is None:
            return opaque("pow", (self.scalar(base), self.scalar(exponent)))
        if power.denominator == 1:
            return raised(self.value(base), int(power))
        if power.denominator == 2:
            return root(self.scalar(base)) ** int(2 * power)
        return opaque("pow", (self.scalar(base), self.scalar(exponent)))

    def _call(self, function: str, arguments: tuple[Expr, ...]) -> Value:
        if function in ("cos", "sin", "tan"):
            c, s = self.trig(arguments[0])
            return c if function == "cos" else s if function == "sin" else s / c
        if function == "atan2" and self.scalar(arguments[0]) == 0:
            return self._flat(self.scalar(arguments[1]))
        values = [self.value(argument) for argument in arguments]
        if function in MATRIX_FUNCTIONS:
            return MATRIX_FUNCTIONS[function](*map(_matrix, values))
        scalars = tuple(value for value in values if isinstance(value, Scalar))
        if len(scalars) < len(values):
            raise NotDerivable(f"{function} of a matrix")
        if function == "sqrt":
            return root(scalars[0])
        if function == "abs":
            return absolute(scalars[0])
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
                return reduce(_added, map(self.trig, terms))
            case Product((Number(n), rest)) if self._has_inverse(rest) and n.denominator == 1:
                return _multiple(self.trig(rest), int(n))
            case Symbol() if angle in self.names:
                return self.trig(self.names[angle])
            case Call("atan2", (y, x)):
                return _of_direction(self.scalar(y), self.scalar(x))
            case Call("atan", (slope,)):
                return _of_direction(self.scalar(slope), Scalar.of(1))
            case Call("acos", (cosine,)):
                c = self.scalar(cosine)
                return c, root(1 - c * c)
            case Call("asin", (sine,)):
                s = self.scalar(sine)
                return root(1 - s * s), s
        return trig_of(self.scalar(angle))

    def _has_inverse(self, expr: Expr) -> bool:
        expr = self.names.get(expr, expr)
        match expr:
            case Call(function):
                return function in ("atan2", "atan", "acos", "asin")
            case Sum(parts) | Product(parts):
                return any(map(self._has_inverse, parts))
        return False


def trig_of(angle: Scalar) -> tuple[Scalar, Scalar]:
    """(cosine, sine) of an angle that is a polynomial: fixed parts apart, the rest a linear form."""
    turns, form = linear_form(angle)
    pair = trig(form) if form.parts else (Scalar.of(1), Scalar.of(0))
    return _added(pair, fixed_trig(turns)) if turns else pair


def linear_form(angle: Scalar) -> tuple[Fraction, Form]:
    """(multiple of pi, the rest) of an angle; each monomial is an atom of the form."""
    if angle.denominator is not None:
        raise NotDerivable("an angle that is a fraction of symbols")
    turns, parts = Fraction(0), {}
    for exponents, coefficient in angle.numerator.terms():
        powers = [(n, e) for n, e in zip(angle.ring.names, exponents, strict=True) if e]
        if powers == [(PI, 1)]:
            turns = as_fraction(coefficient)
        else:
            atom = "*".join(n if e == 1 else f"{n}^{e}" for n, e in powers) or RADIAN
            parts[atom] = as_fraction(coefficient)
    return turns, Form.of(parts)


def product(values: list[Value]) -> Value:
    """The product of scalars and matrices; polynomials of one ring are reduced once at the end."""
    first = values[0]
    if isinstance(first, Scalar) and all(
        isinstance(v, Scalar) and v.ring is first.ring and v.denominator is None for v in values
    ):
        numerator = reduce(mul, (v.numerator for v in values if isinstance(v, Scalar)))
        return Scalar(first.ring, first.ring.reduce(numerator))
    return reduce(times, values)


def times(left: Value, right: Value) -> Value:
    """The product of scalars, of matrices, or of one with the other."""
    if isinstance(left, ScalarMatrix):
        return left @ right if isinstance(right, ScalarMatrix) else left.scaled(right)
    return right.scaled(left) if isinstance(right, ScalarMatrix) else left * right


def raised(base: Value, power: int) -> Value:
    """An integer power of a scalar or a square matrix."""
    if isinstance(base, Scalar):
        return base**power
    if power < 0:
        return raised(base.inverse(), -power)
    return reduce(ScalarMatrix.__matmul__, [base] * power, ScalarMatrix.identity(base.shape[0]))


def joined(rows: list[list[Value]]) -> ScalarMatrix:
    """Blocks joined into one matrix; a zero beside a block stands for a block of zeros."""
    strips = []
    for row in rows:
        height = max((v.shape[0] for v in row if isinstance(v, ScalarMatrix)), default=1)
        strips.append(ScalarMatrix.beside([_block(value, height) for value in row]))
    return ScalarMatrix.stacked(strips)


def _block(value: Value, height: int) -> ScalarMatrix:
    if isinstance(value, ScalarMatrix):
        return value
    if height > 1 and value != 0:
        raise NotDerivable("a scalar beside a block of a matrix")
    return ScalarMatrix.of([[value]] * height)


def _matrix(value: Value) -> ScalarMatrix:
    return value if isinstance(value, ScalarMatrix) else ScalarMatrix.of([[value]])


MATRIX_FUNCTIONS: dict[str, Callable[..., Value]] = {
    "transpose": lambda a: a.T,
    "inverse": lambda a: a.inverse(),
    "cross": lambda a, b: a.cross(b),
    "det": lambda a: a.det(),
}


def _added(a: tuple[Scalar, Scalar], b: tuple[Scalar, Scalar]) -> tuple[Scalar, Scalar]:
    """The addition theorem on (cosine, sine) pairs."""
    return a[0] * b[0] - a[1] * b[1], a[1] * b[0] + a[0] * b[1]


def _multiple(pair: tuple[Scalar, Scalar], n: int) -> tuple[Scalar, Scalar]:
    base = pair if n >= 0 else (pair[0], -pair[1])
    return reduce(_added, [base] * abs(n), (Scalar.of(1), Scalar.of(0)))


def _of_direction(y: Scalar, x: Scalar) -> tuple[Scalar, Scalar]:
    """(cosine, sine) of atan2(y, x)."""
    length = root(x * x + y * y)
    return x / length, y / length
