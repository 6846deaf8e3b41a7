"""Sines and cosines of angles that are scalars, as pairs (cosine, sine)."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import reduce

from derive.algebra.angles import Form
from derive.algebra.exact_values import Pair, added, form_trig, multiple
from derive.algebra.generators import ITSELF, RADIAN, Opaque
from derive.algebra.rationals import as_fraction
from derive.algebra.ring import Ring
from derive.algebra.roots_and_functions import canonical, in_single_angles, root
from derive.algebra.scalar import Scalar


def trig_of(angle: Scalar) -> Pair:
    """(cosine, sine) of an angle: of the linear form that it is, multiples of inverse functions resolved."""
    pairs: list[Pair] = []
    rest = angle
    for powers, coefficient in angle.ring.terms(angle.numerator) if angle.denominator is None else ():
        match powers:
            case ((Opaque(function=name) as inverse, 1),) if (
                name in RESOLVED and coefficient.denominator == 1
            ):
                pairs.append(multiple(RESOLVED[name](*inverse.arguments), int(coefficient)))
                rest = rest - Scalar.symbol(inverse) * coefficient
    return reduce(added, pairs, form_trig(linear_form(rest)))


def linear_form(angle: Scalar) -> Form:
    """An angle as a linear form; each monomial is an atom of it."""
    angle = in_single_angles(angle)
    if angle.denominator is not None:
        return _of_fraction(angle)
    terms = angle.numerator.terms()
    return Form.of({_atom(angle.ring, exponents): as_fraction(k) for exponents, k in terms})


def _of_fraction(angle: Scalar) -> Form:
    """Of x/y + z/y: each term over the denominator is an atom, unless it cancels there."""
    home, found = angle.ring, Form(())
    bottom = Scalar(home, angle.denominator)
    for exponents, coefficient in angle.numerator.terms():
        part = Scalar(home, home.context.from_dict({exponents: coefficient})) / bottom
        if part.denominator is None:
            found = found + linear_form(part)
        else:
            lead = as_fraction(part.numerator.leading_coefficient())
            found = found + Form.of({_whole(part / lead): lead})
    return found


def _atom(home: Ring, exponents: tuple[int, ...]) -> str:
    """A product of powers of letters by its text, `w*t^2`; one that holds functions as itself."""
    powers = [(n, int(e)) for n, e in zip(home.names, exponents, strict=True) if e]
    if all(n in home.symbols and not isinstance(n, Opaque) for n, _ in powers):
        # by the alphabet, which is the same in every ring
        return "*".join(n if e == 1 else f"{n}^{e}" for n, e in sorted(powers)) or RADIAN
    return _whole(Scalar(home, home.context.from_dict({exponents: 1})))


def _whole(part: Scalar) -> Opaque[Scalar]:
    return Opaque(canonical(part), ITSELF, (part,))


def _of_direction(y: Scalar, x: Scalar) -> Pair:
    """(cosine, sine) of atan2(y, x): x and y over their length. Raises DivisionByZero where both vanish."""
    length = root(x * x + y * y)
    return x / length, y / length


# (cosine, sine) of inverse functions, from their arguments.
RESOLVED: Mapping[str, Callable[..., Pair]] = {
    "atan2": _of_direction,
    "atan": lambda slope: _of_direction(slope, Scalar.of(1)),
    "acos": lambda c: (c, root(1 - c * c)),
    "asin": lambda s: (root(1 - s * s), s),
}
