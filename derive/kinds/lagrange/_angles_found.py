"""Equations in sines and cosines solved as polynomials in them, and the angles they belong to."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import prod

from flint import arb

from derive.algebra.angles import Form, combination
from derive.algebra.exact_values import fixed_trig
from derive.algebra.generators import PI
from derive.algebra.multivariate import grouped
from derive.algebra.normal import normal
from derive.algebra.readable.terms import Alphabet
from derive.algebra.scalar import Scalar
from derive.algebra.solving.polynomial_systems import solve
from derive.algebra.solving.polynomials import known_sign
from derive.errors import NotDerivable
from derive.expression import Approximate, Call, Expr, Symbol, add, atan2, multiply, number, walk
from derive.kinds.function._writing import written
from derive.kinds.problem import Problem


@dataclass(frozen=True, slots=True)
class Found:
    """The coordinates of one solution; `free` ones may have any value. Real where each of `real_if` is
    positive or zero."""

    values: Mapping[str, Expr]
    free: tuple[str, ...]
    real_if: tuple[Scalar, ...]


@dataclass(frozen=True, slots=True)
class _Letters:
    """Plain letters for the sine and cosine of each angle that holds a coordinate."""

    forms: tuple[Form, ...]

    def pair(self, form: Form) -> tuple[str, str]:
        k = self.forms.index(form)
        return f"cosine_{k}", f"sine_{k}"

    def spoken(self, message: str) -> str:
        """A message with the sines and cosines themselves."""
        for form in self.forms:
            for letter, function in zip(self.pair(form), ("cos", "sin"), strict=True):
                message = re.sub(rf"\b{letter}\b", f"{function}({form})", message)
        return message

    @property
    def names(self) -> list[str]:
        """Sines first, so that a basis ends with an equation in a cosine."""
        pairs = [self.pair(form) for form in self.forms]
        return [s for _, s in pairs] + [c for c, _ in pairs]


def solved(
    equations: Sequence[Scalar], coordinates: Sequence[str], positive: Collection[str], problem: Problem
) -> list[Found]:
    """Every real solution for the coordinates. Raises NotDerivable where it is out of reach."""
    home = sum(equations, Scalar.of(0)).ring
    for equation in equations:
        home = home.union(equation.ring)
    forms = tuple(form for form in home.angles if any(form.of_atom(q) for q in coordinates))
    letters = _Letters(forms)
    _require_plain(forms, coordinates, home.symbols, equations)
    plain = [_renamed(equation.into(home), letters) for equation in equations]
    circles = [_circle(letters.pair(form)) for form in forms]
    straight = [q for q in coordinates if not any(form.of_atom(q) for form in forms)]
    try:
        case = solve([*plain, *circles], [*letters.names, *straight], positive)
    except NotDerivable as error:
        raise NotDerivable(letters.spoken(str(error))) from error
    found = []
    for each in case.all_solutions():
        values = _values(each.values, letters, coordinates, positive, problem)
        found.append(Found(values, _free(each.free, letters, coordinates), each.real_if))
    return found


def _require_plain(
    forms: Sequence[Form], coordinates: Sequence[str], symbols: Sequence[str], equations: Sequence[Scalar]
) -> None:
    """Raises NotDerivable for a coordinate inside and outside a sine, or in one with a parameter."""
    used = {name for equation in equations for name in equation.generators()}
    for form in forms:
        for atom, _ in form.moving.parts:
            if atom not in coordinates:
                raise NotDerivable(f"an angle that holds {atom} besides a coordinate is not solved for here")
            if atom in symbols and atom in used:
                raise NotDerivable(
                    f"{atom} stands inside a sine or cosine and outside of one: that is not solved here"
                )
    plain = {f"{function}({form})" for form in forms for function in ("cos", "sin")} | {*coordinates}
    for equation in equations:
        inner = (equation.ring.letters(name) for name in _deciding(equation) - plain)
        if hidden := sorted(frozenset().union(*inner).intersection(coordinates)):
            raise NotDerivable(f"{hidden[0]} stands inside another function: that is not solved here")


def _deciding(equation: Scalar) -> set[str]:
    """The generators that decide where it is zero: an exponential that all its terms share is no zero."""
    terms = [dict(powers) for powers, _ in equation.ring.terms(equation.numerator)]
    names = {name for powers in terms for name in powers}
    return {
        name
        for name in names
        if not name.startswith("exp(") or len({powers.get(name, 0) for powers in terms}) > 1
    }


def _circle(pair: tuple[str, str]) -> Scalar:
    c, s = map(Scalar.symbol, pair)
    return c * c + s * s - 1


def _renamed(value: Scalar, letters: _Letters) -> Scalar:
    """With letters in place of the sines and cosines."""
    home = value.ring
    places: dict[int, Scalar] = {}
    for k, form in enumerate(home.angles):
        if form in letters.forms:
            c, s = home.pair_index(k)
            places[c], places[s] = map(Scalar.symbol, letters.pair(form))
    total = Scalar.of(0)
    for powers, rest in grouped(value.numerator, places).items():
        letter = prod(map(pow, places.values(), powers), start=Scalar.of(1))
        total = total + Scalar(home, rest) * letter
    return total


def _free(free: tuple[str, ...], letters: _Letters, coordinates: Sequence[str]) -> tuple[str, ...]:
    """Coordinates that no equation holds. Raises NotDerivable for a curve of angles."""
    if any(name in letters.names for name in free):
        raise NotDerivable("a whole curve of angles solves the equations; it is not written down here")
    return tuple(name for name in coordinates if name in free)


def _values(
    found: Mapping[str, Scalar | arb],
    letters: _Letters,
    coordinates: Sequence[str],
    positive: Collection[str],
    problem: Problem,
) -> dict[str, Expr]:
    """The coordinates as trees: those of angles from their sines and cosines."""
    pairs = [[found[name] for name in letters.pair(form)] for form in letters.forms]
    angles = [
        _moving_part(form, _angle(c, s, positive, problem), problem)
        for form, (c, s) in zip(letters.forms, pairs, strict=True)
    ]
    moving = [form.moving for form in letters.forms]
    values: dict[str, Expr] = {}
    for q in coordinates:
        if q in found:
            values[q] = written(found[q], problem)
        elif (parts := combination(Form.of({q: 1}), moving)) is not None and any(parts):
            values[q] = _combined(angles, parts, problem)
    return values


def _moving_part(form: Form, angle: Expr, problem: Problem) -> Expr:
    """What moves in an angle: theta where theta + 25 deg is the angle."""
    return angle + Alphabet(problem.style).angle(form.fixed.scaled(-1)) if form.fixed.parts else angle


def _combined(angles: Sequence[Expr], parts: Sequence[Fraction], problem: Problem) -> Expr:
    """A sum of angles; fixed ones as one angle in (-pi, pi]."""
    total = add(*(multiply(number(n), angle) for n, angle in zip(parts, angles, strict=True) if n))
    if any(isinstance(node, Call | Approximate) for node in walk(total)):
        return total
    turns = (normal(total) / Scalar.symbol(PI)).constant
    if turns is None:
        return total
    return problem.readable(Scalar.symbol(PI) * (1 - (1 - turns) % 2))


def _angle(c: Scalar | arb, s: Scalar | arb, positive: Collection[str], problem: Problem) -> Expr:
    """The angle in (-pi, pi] of a cosine and a sine."""
    if isinstance(c, arb) or isinstance(s, arb):
        sine, cosine = (v if isinstance(v, arb) else arb(0) + _float(v) for v in (s, c))
        return Approximate(float(arb.atan2(sine, cosine).mid()))
    for steps in range(-11, 13):
        turns = Fraction(steps, 12)
        cosine_of, sine_of = fixed_trig(turns)
        if cosine_of == c and sine_of == s:
            return problem.readable(Scalar.symbol(PI) * turns)
    if c.ring.roots and not s.ring.roots and (side := known_sign(c, positive)) is not None:
        from_sine = Call("asin", (written(s, problem),))
        return from_sine if side > 0 else Symbol(PI) - from_sine
    sign = known_sign(s, positive)
    if sign is None:
        return atan2(written(s, problem), written(c, problem))
    angle: Expr = Call("acos", (written(c, problem),))
    return angle if sign > 0 else -angle


def _float(value: Scalar) -> float:
    from derive.algebra.numbers.floats import scalar_number

    return scalar_number(value, {})
