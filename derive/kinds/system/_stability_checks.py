"""What an answer about stability is held to: the roots themselves."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from derive.algebra.numeric import number as value_of
from derive.algebra.numeric import scalar_number
from derive.algebra.scalar import Scalar
from derive.control.axis import points, roots_at
from derive.control.hurwitz import Condition
from derive.control.roots import roots
from derive.control.routh import remainder, sign_changes
from derive.derivation import Claim
from derive.kinds.checks import SECOND_ROUTE, law
from derive.kinds.system._plant import (
    verdict,
)
from derive.kinds.system._stability_answer import Answer, right_of_axis
from derive.kinds.system._stability_limit import (
    frequency_squared,
    is_marginal,
    limiting,
    possible,
)

POINTS = 40


def claims_of(answer: Answer) -> Iterator[Claim]:
    """Auxiliary polynomials divide, sign changes count roots, conditions hold where all roots lie left."""
    array = answer.array
    if "epsilon" not in array.mended:
        for i, row in enumerate(array.rows, 1):
            if row.origin == "derivative":
                left = remainder(array.polynomial, array.rows[i - 2].polynomial)
                yield law(
                    f"the polynomial of row {i - 1} divides the characteristic polynomial", not any(left)
                )
    limit = limiting(answer)
    if limit is not None and frequency_squared(answer) is not None:
        claim = "where the row of s vanishes, that of s^2 divides the polynomial"
        yield law(claim, _divides(answer, limit))
    if not answer.symbols:
        right = right_of_axis(roots(array.polynomial))
        yield Claim(
            "sign changes of the first column: roots on the right", SECOND_ROUTE, answer.changes == right
        )
    yield from _at_random(answer)


def _divides(answer: Answer, limit: Scalar) -> bool:
    """The remainder after the row of s^2 holds what makes the row of s vanish as a factor."""
    array = answer.array
    left = remainder(array.polynomial, array.rows[-3].polynomial)
    return all(not each or _is_free(each / limit, limit) for each in left)


def _is_free(value: Scalar, factor: Scalar) -> bool:
    """Whether nothing of the factor is left in the denominator."""
    if value.denominator is None:
        return True
    below = Scalar(value.ring, value.denominator)
    both = below + factor
    common = below.into(both.ring).numerator.gcd(factor.into(both.ring).numerator)
    return bool(common.is_constant())


def _at_random(answer: Answer) -> Iterator[Claim]:
    """Conditions and sign changes against the roots themselves."""
    tried = points(answer.symbols, answer.positive, POINTS if answer.symbols else 1)
    found = [each for point in tried if (each := _compared(answer, point)) is not None]
    stable, marginal, right = (all(each[k] for each in found) for k in range(3))
    yield Claim("the conditions hold exactly where all roots lie left", SECOND_ROUTE, stable)
    if answer.symbols and is_marginal(answer):
        claim = "the other conditions hold where it is marginally stable, and at their limits at most"
        yield Claim(claim, SECOND_ROUTE, marginal)
    if answer.symbols and "epsilon" not in answer.array.mended:
        yield Claim("sign changes at random values: roots on the right", SECOND_ROUTE, right)


def _compared(answer: Answer, point: Mapping[str, float]) -> tuple[bool, bool, bool] | None:
    """Whether conditions, those of marginal stability and sign changes are right at a point; None where
    the polynomial is not real or of lower degree there."""
    try:
        found = roots_at(answer.array.polynomial, point)
        met = all(holds(each, point) for each in answer.written)
        others = all(holds(each, point) for each in possible(answer))
        at_limit = any(is_at_limit(each, point) for each in possible(answer))
    except (ValueError, ZeroDivisionError):
        return None
    if not found:
        return None
    signs = _signs_at(answer, point)
    return (
        met == all(each.real < 0 for each in found),
        at_limit or others == (verdict(found) in ("integrator", "oscillator")),
        signs is None or sign_changes(signs) == right_of_axis(found),
    )


def _signs_at(answer: Answer, point: Mapping[str, float]) -> list[float] | None:
    """The first column; None where it vanishes there."""
    try:
        signs = [scalar_number(entry, point) if entry else 0.0 for entry in answer.array.column]
    except ZeroDivisionError:
        return None
    return signs if all(signs) else None


def holds(condition: Condition, point: Mapping[str, float]) -> bool:
    """Whether a condition is met at a point."""
    return condition.holds(value_of(condition.left, point), value_of(condition.right, point))


def is_at_limit(condition: Condition, point: Mapping[str, float]) -> bool:
    """Whether both sides are equal at a point."""
    return value_of(condition.left, point) == value_of(condition.right, point)
