"""What is said of the parameters of a regressor: what they gather, which are made of others or are equal."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction

from derive.algebra.infix import text
from derive.algebra.rationals import significant_digits
from derive.algebra.scalar import Scalar
from derive.derivation import Phrase, Step, Table
from derive.expression import ZERO, Approximate, Expr, Indexed, Measured, Symbol, add, multiply, replace, walk
from derive.kinds.problem import Problem
from derive.kinds.robot._dynamics.regressor import Base, Standard
from derive.mechanics.regressor import MOMENTS

UNITS = {"M": "kg", **dict.fromkeys(MOMENTS, "kg m")}  # of the parameters of bodies, and of what they gather
MOMENT = "kg m^2"  # of all the others
MOST_DIGITS = 4  # of a decimal that is still written in full
LONGEST_NUMBER = 10**6  # denominator of a number that is still written in full


def gathered_by(problem: Problem, each: Base, value: Expr) -> Step:
    """Theta_1 = ZZ_1 + a1^2 M_2 = its value, rounded where that is a long number."""
    sum_of = add(*(multiply(problem.readable(weight), name) for name, weight in each.parts))
    constant = each.value.constant
    long = constant is not None and _is_long(constant)
    shown = Approximate(float(constant)) if long and constant is not None else value
    if constant is not None and problem.style.units:
        shown = Measured(shown, UNITS.get(each.parts[0][0].base, MOMENT))
    return Step(each.name.name, (each.name, sum_of, shown), "base-parameter")


def made_of_others(
    problem: Problem, parameters: Sequence[Standard], j: int, weights: Mapping[int, Scalar]
) -> Step:
    """y_M2 = a1^2 y_ZZ1 + a1 y_MX1."""
    name = column_name(parameters[j].name)
    terms = (
        multiply(problem.readable(weight), column_name(parameters[i].name)) for i, weight in weights.items()
    )
    return Step(f"y_{j + 1}_dependent", (name, add(*terms)), "dependent")


def equal_ones(problem: Problem, base: Sequence[Base]) -> Iterator[tuple[Expr, Expr]]:
    """Theta_2 and Theta_3, or Theta_3 and a multiple of Theta_2, where this arm has them equal:
    each beside the first that it goes with; and those that are zero. Of other numbers none is told."""
    first: list[Base] = []
    yield from ((each.name, ZERO) for each in base if not each.value)
    for each in (each for each in base if each.value.constant is None):
        ratios = (((each.value / other.value).constant, other) for other in first)
        ratio, other = next(((ratio, other) for ratio, other in ratios if ratio is not None), (None, None))
        if other is None or ratio is None:
            first.append(each)
        else:
            yield (
                (other.name, each.name)
                if ratio == 1
                else (each.name, multiply(problem.readable(Scalar.of(ratio)), other.name))
            )


def column_name(name: Indexed) -> Indexed:
    """The column of a parameter."""
    return Indexed("y", (name,))


def typed_name(expr: Expr) -> Expr:
    """With names that can be typed, ZZ_1, in place of those with an index."""
    names: dict[Expr, Expr] = {
        node: Symbol(f"{node.base}_{text(node.lower[0])}") for node in walk(expr) if isinstance(node, Indexed)
    }
    return replace(expr, names)


def table_of(values: Mapping[Expr, Expr]) -> Table:
    """Every parameter and its value."""
    return Table((Phrase("parameter"), Phrase("value")), tuple(values.items()))


def _is_long(value: Fraction) -> bool:
    """Whether a number is rounded where it is said."""
    return value.denominator > LONGEST_NUMBER or (significant_digits(value) or 0) > MOST_DIGITS
