"""The results of a question in numbers, at the point its author asked for."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any, get_args

from derive.derivation import Branch, Derivation
from derive.expression import Approximate, Expr, Matrix, Number, Product, Quotient, Sum, Symbol, column
from derive.expression import Power as Raised
from derive.render.conditions import condition
from derive.render.latex import Printer
from derive.render.layout import lay_out
from derive.render.notation import Notation
from derive.render.skin import Skin, environment
from derive.render.words import chain_links

TREES = get_args(Expr)
WHOLE_BELOW = 10**6
ABOUT = ("when", "real", "free", "fixed", "true_at")  # a branch, beside its values
IMAGINARY = Symbol("j")


def evaluated_words(derivation: Derivation, at: Mapping[str, Expr], skin: Skin, notation: Notation) -> str:
    """The sentence "At theta1 = 30 deg:" and the numbers; "" where nothing was evaluated.

    A derivation may choose what is worth printing by a fact `numbers`, a tuple of result names, and by a
    fact `page_names` what they are called on the page.
    """
    shown = derivation.facts.get("numbers", tuple(derivation.evaluated))
    values = {name: value for name, value in derivation.evaluated.items() if name in shown}
    if not values:
        return ""
    printer, called = Printer(notation), derivation.facts.get("page_names", {})
    chains = [
        chain_links((_called(called.get(name, name)), number), printer)
        for name, value in values.items()
        if (number := numeric(value)) is not None
    ]
    context = {
        "point": [_given(name, value, printer) for name, value in at.items()],
        "display": skin.display(lay_out(tuple(chains))) if chains else "",
        "branches": [
            _branch(_unknowns(branch, derivation), at, printer, skin)
            for branch in values.get("solutions", ())
        ],
        "items": skin.items,
    }
    return environment().get_template("words/_evaluated.j2").render(context).strip()


def _called(name: str | Expr) -> Expr:
    return Symbol(name) if isinstance(name, str) else name


def _given(name: str, value: Expr, printer: Printer) -> str:
    """A value of the point, with the unit its author gave it."""
    unit = f" {value.unit}" if isinstance(value, Number) and value.unit else ""
    return f"${printer.write(Symbol(name))} = {printer.write(value)}${unit}"


def _unknowns(branch: Mapping[str, Any], derivation: Derivation) -> dict[str, Any]:
    """A solution without the names of the working, which the page has above."""
    working = {
        name
        for each in _branches(derivation.results.get("solutions"))
        for name in each.short.keys() - each.values.keys()
    }
    return {name: value for name, value in branch.items() if name not in working}


def _branches(result: object) -> tuple[Branch, ...]:
    parts = result if isinstance(result, tuple) else ()
    return tuple(part for part in parts if isinstance(part, Branch))


def _branch(
    branch: Mapping[str, Any], at: Mapping[str, Expr], printer: Printer, skin: Skin
) -> dict[str, Any]:
    """One solution: its equations as inline mathematics, and when it is the one."""
    values = {name: numeric(value) for name, value in branch.items() if name not in ABOUT}
    shown = [
        chain_links((Symbol(name), value), printer) for name, value in values.items() if value is not None
    ]
    equations = [f"${first.latex} {second.relation} {second.latex}$" for first, second in shown]
    when = condition(branch.get("when", ""), {*values, *at}, printer, skin.plain)
    return {"when": when, "real": branch.get("real", True), "equations": equations}


def numeric(value: Any) -> Expr | None:
    """An evaluated value as a tree; None for what is not a number, a vector, a matrix or a quotient."""
    if isinstance(value, TREES):
        tree: Expr = value
        return tree
    match value:
        case bool() | str() | None:
            return None
        case int() | float():
            return _real(float(value))
        case {"re": re, "im": im}:
            return _complex(re, im)
        case {"num": num, "den": den}:
            return Quotient(_polynomial(num), _polynomial(den))
        case [[*_], *_]:
            return _matrix(value)
        case [dict() as first, *_] if "re" not in first:
            return None
        case [_, *_]:
            entries = [numeric(entry) for entry in value]
            return column(entry for entry in entries if entry is not None)
        case _:
            return None


def _real(value: float) -> Expr:
    """A whole number stays exact."""
    if abs(value) < WHOLE_BELOW and value == int(value):
        return Number(Fraction(int(value)))
    return Approximate(value)


def _complex(re: float, im: float) -> Expr:
    imaginary = Product((_real(im), IMAGINARY))
    return Sum((_real(re), imaginary)) if im else _real(re)


def _matrix(rows: list[list[Any]]) -> Matrix:
    return Matrix(tuple(tuple(numeric(entry) or Number(Fraction(0)) for entry in row) for row in rows))


def _polynomial(coefficients: list[float]) -> Expr:
    """In s, highest power first."""
    degree = len(coefficients) - 1
    terms = [
        _term(coefficient, degree - place) for place, coefficient in enumerate(coefficients) if coefficient
    ]
    return Sum(tuple(terms)) if len(terms) > 1 else terms[0] if terms else _real(0.0)


def _term(coefficient: float, power: int) -> Expr:
    s = Symbol("s")
    powers: tuple[Expr, ...] = () if power == 0 else (s,) if power == 1 else (Raised(s, _real(power)),)
    return Product((_real(coefficient), *powers)) if powers else _real(coefficient)
