"""The one LaTeX printer: a tree as it stands, in the notation of the sheet.

Only LaTeX that GitHub, KaTeX, pandoc and pdflatex all read: no `\\!`, no tall bars, no array rules, and no
`\\operatorname`, which GitHub refuses ("macros are not allowed").
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import chain, pairwise

from derive.algebra.infix import ATOM, POWER, PRODUCT, SUM
from derive.expression import (
    Approximate,
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
    is_negative,
)
from derive.render.juxtaposition import fractions_meet, is_letter, meet_as_numbers, need_room, sign_of
from derive.render.names import Name, name_latex, name_parts, script
from derive.render.notation import Notation
from derive.render.numbers import fraction_latex, rounded_latex, unit_latex
from derive.render.trig import SHORT, is_short_argument, is_written_out, short_index

OPERATORS = {
    "cos": r"\cos", "sin": r"\sin", "tan": r"\tan", "acos": r"\arccos", "asin": r"\arcsin",
    "atan": r"\arctan", "log": r"\ln", "det": r"\det", "adj": r"\mathrm{adj}\,","sign": r"\mathrm{sgn}",
}  # fmt: skip
BARE_ARGUMENT = ("cos", "sin", "tan", "det", "adj")  # a lone symbol after these needs no parentheses
MARKS = {"transpose": "T", "inverse": "-1"}
LONG_NUMERATOR = 3  # factors
OF_A_SUM = re.compile(r"-?\\frac.*\\(?:sin|cos|tan)\(")  # a fraction with a function that is written out


def latex(expr: Expr, notation: Notation) -> str:
    """The tree as LaTeX for math mode."""
    return Printer(notation).write(expr)


def parenthesised(inner: str) -> str:
    tall = any(mark in inner for mark in ("frac{", r"\sqrt", r"\begin"))
    return rf"\left( {inner} \right)" if tall else f"({inner})"


def is_approximate(expr: Expr) -> bool:
    """Whether it holds a rounded number, so that it follows an approximation sign."""
    return isinstance(expr, Approximate) or any(map(is_approximate, children(expr)))


@dataclass(frozen=True, slots=True)
class Printer:
    """Prints trees in one notation; `in_line` for a line of text, where a column stands as `(x, y)^T`; `flat`
    for there and for a cell of a table, where a short fraction is 3/4."""

    notation: Notation
    in_line: bool = False
    flat: bool = False

    def write(self, expr: Expr) -> str:
        return self.measured(expr)[0]

    def held(self, expr: Expr, least: int) -> str:
        """A part, in parentheses unless it holds together at least this tightly."""
        written, tightness = self.measured(expr)
        return written if tightness >= least else parenthesised(written)

    def measured(self, expr: Expr) -> tuple[str, int]:
        """The LaTeX of a tree and how tightly it holds together."""
        match expr:
            case Symbol(name):
                parts = self.notation.letters.parts(name)
                return str(parts), POWER if parts.upper else ATOM
            case Number(value, decimal):
                return _number(value, decimal, self.flat)
            case Call(function, arguments):
                return self.call(function, arguments)
            case Sum(terms):
                return self.sum(terms), SUM
            case Product(factors):
                return self.product(factors)
            case Power(base, exponent):
                return self.power(base, exponent)
            case Matrix(((alone,),)):  # its number
                return self.measured(alone)
            case Matrix(rows):
                return self.column(rows) or (self.matrix(rows), ATOM)
            case _:
                return self.rarer(expr)

    def rarer(self, expr: Expr) -> tuple[str, int]:
        match expr:
            case Quotient(top, bottom):
                return self.quotient(top, bottom)
            case Approximate(value):
                written = rounded_latex(value, self.notation.digits)
                return written, SUM if value < 0 else PRODUCT if "cdot" in written else ATOM
            case Degrees(value):
                return rf"{_whole(fraction_latex(value, decimal=True))}^\circ", SUM if value < 0 else POWER
            case Indexed():
                return self.indexed(self.notation.letters.indexed(expr))
            case Derivative(of, by):
                return self.derivative(of, by), PRODUCT
            case Measured(Matrix() as value, unit) if unit.startswith("/") and (plain := _in_degrees(value)):
                return rf"{self.write(plain)}^\circ{unit_latex(unit)}", PRODUCT
            case Measured(value, unit):
                number = self.write(value) if is_negative(value) else self.held(value, PRODUCT)
                return number + unit_latex(unit), SUM if is_negative(value) else PRODUCT
            case _:
                raise TypeError(f"not an expression: {expr!r}")

    def sum(self, terms: tuple[Expr, ...]) -> str:
        first, *rest = map(self._term, terms)
        signed = (f"- {term[1:]}" if term.startswith("-") else f"+ {term}" for term in rest)
        return " ".join((first, *signed))

    def _term(self, term: Expr) -> str:
        written = self.write(term)
        return parenthesised(written) if isinstance(term, Sum) else written

    def product(self, factors: tuple[Expr, ...]) -> tuple[str, int]:
        match factors:
            case (Approximate() as size, Degrees(Fraction(numerator=1, denominator=1))):
                return _whole(self.write(size)) + r"^\circ", SUM if size.value < 0 else POWER
        sign, rest = sign_of(factors)
        pieces = self._over_number(rest)
        if not pieces:
            pieces = [(rest[place], self._factor(rest, place, bool(sign))) for place in range(len(rest))]
        if len(pieces) > 1 and pieces[0][1] == "1":  # what a rounded number may come to
            pieces = pieces[1:]
        written = pieces[0][1]
        for (before, _), (after, piece) in pairwise(pieces):
            apart = r" \, " if need_room(before, after, self.notation) else " "
            fractions = fractions_meet(written, piece)
            dotted = isinstance(before, Measured) or meet_as_numbers(written, piece) or fractions
            written += (r" \cdot " if dotted else apart) + piece
        return sign + written, SUM if sign or written.startswith("-") else PRODUCT

    def _over_number(self, factors: tuple[Expr, ...]) -> list[tuple[Expr, str]]:
        """`p/q` times plain letters as one fraction, \\frac{m L^2}{2}; nothing where that is not the form."""
        first = factors[0]
        if not isinstance(first, Number) or first.value.denominator == 1 or first.decimal:
            return []
        count = next((place for place, f in enumerate(factors[1:]) if not is_letter(f)), len(factors) - 1)
        if count == 0 or any(isinstance(f, Call) and f.function in MARKS for f in factors):
            return []
        top = (Number(Fraction(first.value.numerator)), *factors[1 : count + 1])
        shown = top[1:] if first.value.numerator == 1 else top
        rest = factors[count + 1 :]
        above, below = self.write(Product(shown)), first.value.denominator
        flat = self.flat and not rest  # a/2 b could be read as a/(2 b)
        fraction = f"{above}/{below}" if flat else rf"\frac{{{above}}}{{{below}}}"
        return [(first, fraction), *((rest[k], self._factor(rest, k, True)) for k in range(len(rest)))]

    def _factor(self, factors: tuple[Expr, ...], place: int, inside: bool) -> str:
        """One factor among others; a leading minus sign stands bare only at the very front."""
        factor = factors[place]
        if is_written_out(factor, self.notation) and is_letter(*factors[place + 1 : place + 2]):
            return self._enclosed_function(factor)
        among = replace(self, flat=False) if len(factors) > 1 else self
        written, tightness = among.measured(factor)
        bare = tightness >= PRODUCT or (
            place == 0
            and not inside
            and isinstance(factor, Number | Approximate | Measured | Product | Quotient)
        )
        return written if bare or (len(factors) == 1 and not inside) else parenthesised(written)

    def _enclosed_function(self, factor: Expr) -> str:
        match factor:
            case Power(Call(function, (angle,)), exponent):
                raised = OPERATORS[function] + script("^", self._exponent(exponent))
                return raised + parenthesised(self.write(angle))
            case Call(function, (angle,)):
                return f"{OPERATORS[function]}{parenthesised(self.write(angle))}"
            case _:
                return self.write(factor)

    def quotient(self, top: Expr, bottom: Expr) -> tuple[str, int]:
        above = self.write(top)
        below, tightness = self.measured(bottom)
        if self.flat and "frac" not in above + below:
            loose = self.measured(top)[1] < PRODUCT and (isinstance(top, Sum) or not above.startswith("-"))
            over = parenthesised(above) if loose else above
            return f"{over}/{below if tightness >= POWER else parenthesised(below)}", SUM
        match top:
            case Product((Number(value), Sum() as whole)) if value == -1:  # the bar holds the sum together
                above = "-" + self.write(whole)
        sign = "-" if above.startswith("-") and not isinstance(top, Sum) else ""
        written = rf"{sign}\frac{{{above.removeprefix(sign)}}}{{{below}}}"
        return written, SUM if sign else PRODUCT

    def power(self, base: Expr, exponent: Expr) -> tuple[str, int]:
        if exponent == Number(Fraction(1, 2)):
            return rf"\sqrt{{{self.write(base)}}}", POWER
        raised = script("^", self._exponent(exponent))
        if isinstance(base, Call) and is_written_out(Power(base, exponent), self.notation):
            return self._function(
                base.function + raised, base.arguments[0], OPERATORS[base.function] + raised
            )
        return self.held(base, ATOM) + raised, POWER

    def _exponent(self, exponent: Expr) -> str:
        match exponent:
            case Number(value, False):
                return str(value)
            case Quotient(top, bottom):
                return f"{self.held(top, PRODUCT)}/{self.held(bottom, POWER)}"
            case _:
                return self.write(exponent)

    def call(self, function: str, arguments: tuple[Expr, ...]) -> tuple[str, int]:
        first = arguments[0]
        if function in SHORT and (index := short_index(first, self.notation)):
            return SHORT[function] + script("_", index), ATOM
        if function in MARKS:
            return f"{self.held(first, ATOM)}{script('^', MARKS[function])}", POWER
        match function:
            case "sqrt":
                return rf"\sqrt{{{self.write(first)}}}", POWER
            case "exp":
                return f"e{script('^', self._exponent(first))}", POWER
            case "abs":
                return rf"\lvert {self.write(first)} \rvert", ATOM
            case "bracket":
                return f"[{self.write(first)}]", ATOM
            case "cross":
                return r" \times ".join(self.held(part, PRODUCT) for part in arguments), SUM
            case "atan2":
                return self._atan2(*arguments), POWER
            case _ if function in OPERATORS:
                return self._function(function, first, OPERATORS[function])
            case _:
                inside = ", ".join(map(self.write, arguments))
                return _function_name(function) + parenthesised(inside), POWER

    def _function(self, function: str, argument: Expr, operator: str) -> tuple[str, int]:
        written = self.write(argument)
        short = is_short_argument(argument) or isinstance(argument, Matrix)
        bare = function.startswith(BARE_ARGUMENT) and short
        return f"{operator} {written}" if bare else f"{operator}{parenthesised(written)}", POWER

    def _atan2(self, y: Expr, x: Expr) -> str:
        name, order = ("Atan2", (x, y)) if self.notation.atan2 == "xy" else ("atan2", (y, x))
        return rf"\mathrm{{{name}}}" + parenthesised(", ".join(map(self.write, order)))

    def column(self, rows: tuple[tuple[Expr, ...], ...]) -> tuple[str, int] | None:
        """A column in a line of text, which has no room for rows."""
        if not self.in_line or len(rows) < 2 or len(rows[0]) > 1:
            return None
        return parenthesised(", ".join(self.write(entry) for (entry,) in rows)) + "^T", POWER

    def matrix(self, rows: tuple[tuple[Expr, ...], ...]) -> str:
        written = [[self.write(entry) for entry in row] for row in rows]
        tall = any(map(_is_tall, chain(*rows))) or any(map(OF_A_SUM.match, chain(*written)))
        lines = [" & ".join(_entry(each, tall) for each in row) for row in written]
        end = r" \\[0.8ex] " if any(r"\dfrac" in line for line in lines) else r" \\ "
        return r"\begin{bmatrix} " + end.join(lines) + r" \end{bmatrix}"

    def indexed(self, name: Indexed) -> tuple[str, int]:
        parts, small = name_parts(name.base), replace(self, flat=True)
        below = ",".join(filter(None, (parts.lower, *map(small.write, name.lower))))
        above = ",".join(filter(None, (parts.upper, *map(small.write, name.upper))))
        whole = Name(parts.stem, below, above)
        led = self.notation.letters.frames == "before" and bool(name.upper)
        return (str(whole.led()), ATOM) if led else (str(whole), POWER if name.upper else ATOM)

    def derivative(self, of: Expr, by: Symbol) -> str:
        d = "d" if by.name == "t" else r"\partial"
        space = "" if d == "d" else " "
        if isinstance(of, Derivative) and isinstance(of.of, Symbol | Indexed) and d != "d":
            return self._second_derivative(of.of, by, of.by)
        below = f"{d}{space}{name_latex(by.name)}"
        if isinstance(of, Symbol | Indexed):
            return rf"\frac{{{d}{space}{self.write(of)}}}{{{below}}}"
        return rf"\frac{{{d}}}{{{below}}} {self.held(of, ATOM)}"

    def _second_derivative(self, of: Expr, outer: Symbol, inner: Symbol) -> str:
        """\\partial^2 f over \\partial x \\partial y, or \\partial x^2."""
        names = [name_latex(each.name) for each in dict.fromkeys((outer, inner))]
        below = r" \partial ".join(names) if len(names) > 1 else f"{names[0]}^2"
        return rf"\frac{{\partial^2 {self.write(of)}}}{{\partial {below}}}"


def _in_degrees(matrix: Matrix) -> Matrix | None:
    """A matrix of angles without the signs of degrees, which one behind it stands for; None where another
    entry is in it."""
    rows = tuple(tuple(map(_degrees_of, row)) for row in matrix.rows)
    return Matrix(tuple(tuple(e for e in row if e) for row in rows)) if all(map(all, rows)) else None


def _degrees_of(entry: Expr) -> Expr | None:
    match entry:
        case Degrees(value):
            return Number(value, True)
        case Product((Approximate() as size, Degrees(Fraction(numerator=1, denominator=1)))):
            return size
        case Number(value) if not value:
            return entry
    return None


def _whole(number: str) -> str:
    """A fraction in parentheses, so that what is raised stands beside all of it."""
    return parenthesised(number) if "frac" in number or "^" in number else number


def _entry(written: str, tall: bool) -> str:
    """Fractions shrink in a matrix as in a line of text, unless one of them is long."""
    return re.sub(r"^-?\\frac", lambda found: found[0].replace("frac", "dfrac"), written) if tall else written


def _is_tall(entry: Expr) -> bool:
    """Whether it is a fraction, or minus a fraction, with much above its line or a sum or its root below."""
    match entry:
        case Quotient(top, below) | Product((_, Quotient(top, below))):
            long = isinstance(top, Product) and len(top.factors) > LONG_NUMERATOR
            return long or isinstance(top, Sum) or _is_sum_or_root(below)
    return False


def _is_sum_or_root(tree: Expr) -> bool:
    match tree:
        case Sum() | Power(Sum()):
            return True
        case Call(function="sqrt", arguments=(inside,)):
            return isinstance(inside, Sum)
    return False


def _number(value: Fraction, decimal: bool, flat: bool = False) -> tuple[str, int]:
    written = fraction_latex(value, decimal)
    written = str(value) if flat and "frac" in written else written
    loose = any(mark in written for mark in ("frac", "cdot", "/"))
    return written, SUM if value < 0 else PRODUCT if loose else POWER if "^" in written else ATOM


def _function_name(function: str) -> str:
    """`Rot_z` is an upright word with a subscript, `V_a` a name like any other."""
    word, _, index = function.partition("_")
    if len(word) == 1 or name_latex(word) != rf"\mathrm{{{word}}}":
        return name_latex(function)
    return rf"\mathrm{{{word}}}" + script("_", index)
