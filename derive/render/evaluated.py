"""The results of a question in numbers, at the point its author asked for."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import groupby
from typing import Any, get_args

from derive.algebra.formulas.quantities import rational
from derive.algebra.numbers.floats import number
from derive.algebra.rationals import significant_digits
from derive.algebra.readable.terms import Style
from derive.derivation import Branch, Derivation, PageFacts
from derive.errors import NotAsWritten
from derive.expression import (
    PI,
    ZERO,
    Approximate,
    Degrees,
    Expr,
    Matrix,
    Measured,
    Number,
    Product,
    Sum,
    Symbol,
    column,
    free_symbols,
    multiply,
    walk,
)
from derive.expression import number as exact_number
from derive.expression import replace as put_in
from derive.render import twists
from derive.render.chain_links import chain_links
from derive.render.latex import Printer
from derive.render.layout import Chain, lay_out, one_line
from derive.render.notation import Notation
from derive.render.phrases import Speech, on_page
from derive.render.point_table import ABOUT, PointTable
from derive.render.point_units import PointUnits, point_units, unit_typed
from derive.render.printed import Printed
from derive.render.same_numbers import same_numbers
from derive.render.skin import Skin, environment
from derive.render.values import SPARE, in_unit

TREES = get_args(Expr)
WHOLE_BELOW = 10**6
WHOLE_WITHIN = 1e-7  # degrees
EXACT = 1e-12  # radians
MANY = 6  # numbers beside each other
IMAGINARY = Symbol("j")


def evaluated_words(
    derivation: Derivation, folder: str, at: Mapping[str, Expr], skin: Skin, notation: Notation,
    printed: list[Printed] | None = None, given: bool = False,
) -> str:  # fmt: skip
    """The sentence "At theta1 = 30 deg:" and the numbers; "" where nothing was evaluated. A pose that the
    question has `given` is not told again.

    What is printed, and by which name, the facts of the derivation say; see `PageFacts`. It is added to
    `printed` with its trees.
    """
    derivation = twists.answer(derivation) if notation.angular_first else derivation
    facts = derivation.facts
    shown = derivation.evaluated if facts.numbers is None else facts.numbers
    found = {name: [each] if name in facts.lying else each for name, each in derivation.evaluated.items()}
    names = [name for name in found if name in shown]
    if not names:
        return ""
    printer, style = Printer(notation), _style(facts, at, notation)
    units = point_units(derivation, at, style.degrees)
    seen = [] if printed is None else printed
    speech = on_page(folder, derivation.kind, printer, skin.plain, seen, style)
    exact = _Exact(_lying(derivation.results, facts.lying), at, max(notation.digits + SPARE, style.longest))
    telling = Telling(printer, speech, skin, facts.angle_results, units, exact, style, seen)
    chains = {
        chain: (found[name], name)
        for name in names
        if (chain := telling.chain(_called(facts.page_names.get(name, name)), found[name], name))
    }
    working = _working(derivation)
    tabled = bool(facts.labels) and any(each.get("real", True) for each in found["solutions"])
    given = given and facts.at_pose is not None
    pose = "" if given else telling.pose(facts.at_pose, at)
    told = free_symbols(facts.at_pose[1]) if facts.at_pose and pose else frozenset()
    context = {
        "given": given,
        "pose": pose,
        "unit": ", ".join({unit_typed(value) for name, value in at.items() if name in told} - {""}),
        "point": [telling.given(name, value) for name, value in at.items() if not given and name not in told],
        "display": telling.displays(chains) if chains else "",
        "branches": [
            telling.branch(branch, working, facts.page_names)
            for branch in (found["solutions"] if "solutions" in names and not tabled else ())
            if branch.get("real", True) or not facts.met
        ],
        "items": skin.items,
        "table": PointTable(telling, working, facts.turn_limits).written(found["solutions"], facts.labels)
        if tabled
        else "",
        "remark": speech.say(facts.remark) if facts.remark else "",
        "in_si": any(units.are_mixed(name) for _, name in chains.values() if _is_matrix(found[name])),
    }
    return environment().get_template("words/_evaluated.j2").render(context).strip()


def _lying(results: Mapping[str, Any], rows: tuple[str, ...]) -> dict[str, Any]:
    """The results, columns that lie on the page as rows."""
    return {
        name: each.T if name in rows and isinstance(each, Matrix) else each for name, each in results.items()
    }


@dataclass(frozen=True, slots=True)
class _Exact:
    """Results at a point without a root or an angle in them: decimals of at most so many digits."""

    results: Mapping[str, Any]
    at: Mapping[str, Expr]
    most: int

    def result(self, name: str) -> Expr | None:
        """A scalar or a matrix of decimals; None for any other."""
        tree = self.results.get(name)
        if not isinstance(tree, TREES):
            return None
        entries = tree.rows if isinstance(tree, Matrix) else ((tree,),)
        found = tuple(tuple(map(self._number, row)) for row in entries)
        if any(entry is None for row in found for entry in row):
            return None
        rows = tuple(tuple(entry for entry in row if entry is not None) for row in found)
        return Matrix(rows) if isinstance(tree, Matrix) else rows[0][0]

    def _number(self, tree: Expr) -> Number | None:
        value = rational(put_in(tree, {Symbol(name): given for name, given in self.at.items()}))
        digits = None if value is None else significant_digits(value)
        if value is None or (value.denominator != 1 and (digits is None or digits > self.most)):
            return None
        return Number(value, value.denominator != 1)


def _is_matrix(value: Any) -> bool:
    return isinstance(numeric(value), Matrix)


def _without_unit(value: Expr) -> Expr:
    """As it stands in a matrix."""
    return replace(value, unit="") if isinstance(value, Number) else value


def _called(name: str | Expr) -> Expr:
    return Symbol(name) if isinstance(name, str) else name


def _working(derivation: Derivation) -> set[str]:
    """The names of the working in solutions, which the page has above. Raises NotAsWritten where an unknown
    is among them."""
    found = derivation.results.get("solutions")
    solutions = [part for part in found if isinstance(part, Branch)] if isinstance(found, tuple) else []
    working = {name for each in solutions for name in each.short.keys() - each.values.keys()}
    if any(not working.isdisjoint(each.values) for each in solutions):
        raise NotAsWritten("a value of a solution is left out")
    return working


def _style(facts: PageFacts, at: Mapping[str, Expr], notation: Notation) -> Style:
    """That of the subject, in degrees also where a value of the point is, unless the sheet says how."""
    typed = any(isinstance(node, Degrees) for value in at.values() for node in walk(value))
    degrees = facts.style.degrees or facts.style.turned or typed or facts.in_degrees
    return facts.style if notation.angles else replace(facts.style, degrees=degrees)


@dataclass(frozen=True, slots=True)
class Telling:
    """Values on one page; `angles` are names of results that are angles."""

    printer: Printer
    speech: Speech
    skin: Skin
    angles: tuple[str, ...]
    units: PointUnits
    exact: _Exact
    style: Style
    printed: list[Printed]

    def display(self, chains: Mapping[Chain, tuple[Any, str]]) -> str:
        """Equations side by side, each of which tells a value."""
        display = lay_out(tuple(chains), self.printer.notation)
        shown = Printed.display(display, self.printer.notation)
        self.printed.append(
            replace(shown, evaluated=all(self._tells(c, *told) for c, told in chains.items()))
        )
        return self.skin.display(display)

    def displays(self, chains: Mapping[Chain, tuple[Any, str]]) -> str:
        """The same; many numbers stand apart from matrices, beside which a row has room for fewer."""
        sizes = {chain: _is_matrix(told[0]) for chain, told in chains.items()}
        if len(sizes) - sum(sizes.values()) <= MANY:
            return self.display(chains)
        groups = (tuple(group) for _, group in groupby(chains, key=lambda chain: sizes[chain]))
        return "\n".join(self.display({chain: chains[chain] for chain in group}) for group in groups)

    def inline(self, chain: Chain, value: Any, name: str) -> str:
        """An equation in a line of text that tells a value."""
        shown = Printed.inline(one_line(chain), chain, self.printer.notation)
        self.printed.append(replace(shown, evaluated=self._tells(chain, value, name)))
        return f"${one_line(chain)}$"

    def in_line(self) -> Telling:
        """The same for a line of text."""
        return replace(self, printer=replace(self.printer, in_line=True, flat=True))

    def pose(self, of: tuple[Expr, Matrix] | None, at: Mapping[str, Expr]) -> str:
        """The matrix with the values of the point, where it has one for every name."""
        if of is None or not free_symbols(of[1]) <= at.keys():
            return ""
        name, named = of
        values: dict[Expr, Expr] = {Symbol(key): _without_unit(value) for key, value in at.items()}
        placed = put_in(named, values)
        return self.display({chain_links((name, placed), self.printer): (placed, "")})

    def given(self, name: str, value: Expr) -> str:
        """A value of the point, with the unit its author gave it."""
        chain = (Symbol(name), in_unit(value, unit_typed(value)))
        return self.inline(chain_links(chain, self.in_line().printer), value, "")

    def chain(self, called: Expr, value: Any, name: str) -> Chain:
        """`called = value`; nothing for what is no number."""
        tree = numeric(value)
        if tree is None:
            return ()
        unit = self.unit(name)
        exact = None if unit.startswith(("deg", "rad")) else self.exact.result(name)
        if exact is not None and not isinstance(value, TREES):
            tree = in_unit(exact, unit if exact != ZERO else "")
        elif isinstance(value, float | int):
            tree = self.scalar(float(value), unit, name in self.angles)
        elif unit and not isinstance(value, TREES) and isinstance(tree, Matrix):
            degrees = unit.startswith("deg")
            tree = in_unit(_in_degrees(tree) if degrees else tree, unit.removeprefix("deg"))
        return chain_links((called, tree), self.printer)

    def unit(self, name: str) -> str:
        """That of a result; an angle has one whether or not any was typed."""
        unit = self.units.of(name)
        if unit or name not in self.angles:
            return unit
        return "deg" if self.style.degrees else "rad"

    def scalar(self, value: float, unit: str, angle: bool) -> Expr:
        """A number in its unit; an angle in radians by pi where it is a multiple of a right angle."""
        if unit.startswith("deg"):
            degrees = _degrees(value)
            return in_unit(degrees, unit.removeprefix("deg"))
        if angle and (exact := _by_pi(value)):
            return exact
        return in_unit(_real(value), unit if value else "")

    def branch(
        self, branch: Mapping[str, Any], working: Collection[str], page_names: Mapping[str, str | Expr]
    ) -> dict[str, Any]:
        """One solution: its equations as inline mathematics, and when it is the one."""
        names = [name for name in branch if name not in ABOUT and name not in working]
        in_line = self.in_line()
        called = {name: _called(page_names.get(name, name)) for name in names}
        chains = [(name, in_line.chain(called[name], branch[name], name)) for name in names]
        equations = [self.inline(chain, branch[name], name) for name, chain in chains if chain]
        when = self.speech.when(branch.get("when", ()))
        return {"when": when, "real": branch.get("real", True), "equations": equations}

    def _tells(self, chain: Chain, value: Any, name: str) -> bool:
        """Whether an equation ends in the value with its unit, which its formula has too, in degrees only
        where it is an angle or its rate."""
        tree = chain[-1].tree
        if tree is None or not same_numbers(tree, value):
            return False
        if isinstance(value, TREES):
            return True
        unit = self.unit(name)
        behind = unit.removeprefix("deg")
        if value and behind not in ("", "rad") and not (isinstance(tree, Measured) and tree.unit == behind):
            return False  # radians may be multiples of pi
        turned = any(isinstance(node, Degrees) for node in walk(tree))
        return turned <= unit.startswith("deg") and self.units.agrees(name, unit)


def _degrees(angle: float) -> Expr:
    """An angle in radians, in degrees; whole ones and tenths exactly."""
    value = math.degrees(angle)
    tenths = round(10 * value)
    if abs(value - tenths / 10) < WHOLE_WITHIN:
        return Degrees(Fraction(tenths, 10))
    return Approximate(value) * Degrees(Fraction(1))


def _in_degrees(matrix: Matrix) -> Matrix:
    return Matrix(tuple(tuple(_degrees(number(entry, {})) for entry in row) for row in matrix.rows))


def _by_pi(angle: float) -> Expr | None:
    """A multiple of a right angle."""
    quarters = round(2 * angle / math.pi)
    exact = abs(angle - quarters * math.pi / 2) < EXACT
    return multiply(exact_number(Fraction(quarters, 2)), PI) if exact else None


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
            return _polynomial(num) / _polynomial(den)
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
    imaginary = _real(im) * IMAGINARY
    return _real(re) + imaginary if im else _real(re)


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
    powers: tuple[Expr, ...] = () if power == 0 else (s,) if power == 1 else (s ** _real(power),)
    return Product((_real(coefficient), *powers)) if powers else _real(coefficient)
